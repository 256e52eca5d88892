#include "experiments/reproduce/optimisation/published_tuning.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "experiments/cli/suggest.h"

namespace plenolab {

namespace {

constexpr std::array kTable2{
    PrintedSequence{"Reflections",
                    {{{39.3, 22.3, 2.3, 63.9}, {37.2, 30.4, 1.9, 69.5}, {28.1, 18, 2.1, 48.2}}}},
    PrintedSequence{"Sun Temple",
                    {{{36.1, 12.6, 1.8, 50.5}, {35.7, 16.2, 1.5, 53.4}, {30.7, 10.4, 2.1, 43.2}}}},
    PrintedSequence{"Effects Cave",
                    {{{19.4, 52.6, 1.2, 73.1}, {21.3, 47.3, 0.6, 69.2}, {10.9, 49.3, 0.5, 60.7}}}},
    PrintedSequence{"Vehicle Game", {{{9.9, 46.5, 2.8, 59.2}, {11.7, 60.9, 2.5, 75.1}, {7, 45.6, 4.4, 57}}}},
    PrintedSequence{"Realistic Reflections",
                    {{{38.6, 23.2, 1.4, 63.2}, {38.5, 27.1, 1.1, 66.7}, {26.3, 14.1, 0.3, 40.7}}}},
    PrintedSequence{"Living Room",
                    {{{7.1, 35.5, 0.6, 43.2}, {9.6, 42.7, 1.1, 53.4}, {6.8, 35.2, 0.5, 42.5}}}},
    PrintedSequence{"Research Lab",
                    {{{13.9, 19.3, 1.9, 35.1}, {13.7, 19.9, 2.1, 35.7}, {11.4, 20.1, 1.7, 33.2}}}},
    PrintedSequence{"Effects Cave 2",
                    {{{25.5, 13.1, 1.8, 40.1}, {17.2, 24.2, 1.5, 42.9}, {11.3, 22.8, 2.1, 36.2}}}},
    PrintedSequence{"Temple", {{{39.2, 28.5, 3.8, 71.5}, {33.3, 28.5, 2.1, 63.9}, {31.9, 27.1, 1.9, 60.9}}}},
    PrintedSequence{"Realistic Reflections 2",
                    {{{8.1, 30.5, 2.8, 41.4}, {11.7, 28.1, 2.5, 42.3}, {8.3, 26.6, 4.4, 39.3}}}},
};

constexpr std::array kFigure15{
    PrintedScene{"Sun Temple", {60.23, 66.23, 47.88}, {38.49, 33.2, 31.19}},
    PrintedScene{"Vehicle Game", {57.09, 71.91, 69.12}, {49.25, 49.65, 47.83}},
    PrintedScene{"Effect Cave", {74.13, 71.69, 64.88}, {48.31, 41.93, 40.49}},
    PrintedScene{"Realistic Reflections", {69.15, 62.73, 60.01}, {32.3, 29.41, 29.73}},
    PrintedScene{"Reflections", {58.02, 55.25, 51.25}, {54.62, 55.71, 54.1}},
    PrintedScene{"Living Room", {52.11, 60.44, 51.36}, {52.7, 53.66, 50.32}},
    PrintedScene{"Research Lab", {36.8, 47.9, 34.4}, {25.8, 26.2, 21.3}},
    PrintedScene{"Realistic Reflections 2", {68.2, 61.33, 59.7}, {59.7, 53.1, 51.8}},
    PrintedScene{"Temple", {63.9, 65.2, 61.8}, {52.9, 47.6, 45.7}},
    PrintedScene{"Effects Cave 2", {41.9, 42.1, 40.3}, {51.7, 53.6, 49.3}},
};

/// The entry whose name is that of the sequence, or most like it.
template <class Entry>
const Entry& namesake(std::span<const Entry> entries, const GameSequence& sequence) {
  const std::string_view prefix = "after ";
  const std::string name = std::string(sequence.title).substr(prefix.size());
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  const std::string found = nearest(name, names);
  const auto entry = std::find(names.begin(), names.end(), found);
  PLENOLAB_CHECK(entry != names.end(), name);
  return entries[static_cast<std::size_t>(entry - names.begin())];
}

}  // namespace

std::span<const PrintedSequence> printed_table_2() {
  return kTable2;
}

std::span<const PrintedScene> printed_figure_15() {
  return kFigure15;
}

const PrintedSequence& printed_namesake(const GameSequence& sequence) {
  return namesake(printed_table_2(), sequence);
}

const PrintedScene& printed_scene_namesake(const GameSequence& sequence) {
  return namesake(printed_figure_15(), sequence);
}

}  // namespace plenolab
