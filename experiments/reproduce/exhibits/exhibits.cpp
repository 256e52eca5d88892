#include "experiments/reproduce/exhibits/exhibits.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "experiments/reproduce/exhibits/tables.h"

namespace plenolab {

const char* name_of(ExhibitStatus status) {
  static constexpr std::array kNames{"recomputed", "re-run on our stimuli", "diagram", "not reproducible"};
  return kNames[static_cast<std::size_t>(status)];
}

const char* meaning_of(ExhibitStatus status) {
  static constexpr std::array kMeanings{
      "determined by what the paper prints: the same numbers, computed here",
      "the same experiment on our own scenes and pictures",
      "a drawing; with what is measured in its place, if anything is",
      "a photograph, another paper's picture, or data that nobody has"};
  return kMeanings[static_cast<std::size_t>(status)];
}

namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// "zhao-fig-13" of Zhao's Figure 13.
std::string id_of(const Paper& paper, const Exhibit& exhibit) {
  const std::string author = lower_case(paper.name), name = lower_case(exhibit.name);
  return author.substr(0, author.find_first_of(" ,")) + (name.starts_with("table") ? "-table-" : "-fig-") +
         name.substr(name.rfind(' ') + 1);
}

}  // namespace

NamedExhibit exhibit_called(const std::string& id) {
  for (const Paper& paper : papers())
    for (const Exhibit& exhibit : paper.exhibits)
      if (id_of(paper, exhibit) == lower_case(id)) return {&paper, &exhibit};
  return {};
}

std::span<const Paper> papers() {
  static const std::array kPapers{
      Paper{"Altmeier 2018", "Tonemapping approaches for rendering sparse HDR-lightfields",
            altmeier_exhibits()},
      Paper{"Doronin & Barsi", "Estimation of global luminance for HoloVizio 3D display", doronin_exhibits()},
      Paper{"Hansen & Klein 2016", "Rendering the Light Field", hansen_thesis_exhibits()},
      Paper{"Hansen, Klein & Kraus", "Pixel reprojection for light field displays", hansen_paper_exhibits()},
      Paper{"Zhao 2019", "Tone mapping optimization for real time applications", zhao_exhibits()}};
  return kPapers;
}

}  // namespace plenolab
