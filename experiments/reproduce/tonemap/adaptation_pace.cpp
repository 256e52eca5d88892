#include "experiments/reproduce/tonemap/adaptation_pace.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "experiments/reproduce/tonemap/measures.h"

namespace plenolab {

namespace {

/// The most that the track changes between two frames at most `frames` apart with the steepest between them.
double change_around(std::span<const double> track, std::size_t steepest, std::size_t frames) {
  double most = 0;
  for (std::size_t from = steepest > frames ? steepest - frames : 0; from < steepest; ++from)
    for (std::size_t to = steepest; to <= from + frames && to < track.size(); ++to)
      most = std::max(most, std::abs(track[to] - track[from]));
  return most;
}

/// Sum of absolute changes between frames `from` and `to`.
double path_length(std::span<const double> track, std::size_t from, std::size_t to) {
  double sum = 0;
  for (std::size_t i = from + 1; i <= to; ++i) sum += std::abs(track[i] - track[i - 1]);
  return sum;
}

}  // namespace

const char* name_of(Pace pace) {
  switch (pace) {
    case Pace::kSteady:
      return "steady";
    case Pace::kGradual:
      return "gradual";
    case Pace::kAbrupt:
      return "abrupt";
  }
  return "";
}

Adaptation adaptation_of(std::span<const double> track, std::size_t event, int frames_per_spacing) {
  PLENOLAB_CHECK(event >= 1 && event < track.size() && frames_per_spacing >= 1, "event within the motion");
  Adaptation adaptation;
  const auto [low, high] = std::minmax_element(track.begin(), track.end());
  adaptation.range = *high - *low;
  for (std::size_t i = 1; i < track.size(); ++i)
    if (const double step = std::abs(track[i] - track[i - 1]); step > adaptation.largest_step) {
      adaptation.largest_step = step;
      adaptation.steepest = i;
    }
  if (adaptation.steepest == 0) return adaptation;
  const auto spacing = static_cast<std::size_t>(frames_per_spacing);
  adaptation.largest_change = change_around(track, adaptation.steepest, spacing);
  adaptation.duration_frames = adaptation.largest_change / adaptation.largest_step;
  const std::size_t first = event - 1 > spacing ? event - 1 - spacing : 0;
  const double before = path_length(track, first, event - 1),
               after = path_length(track, event - 1, std::min(event + spacing - 1, track.size() - 1));
  if (event > 1 && before + after > 0) adaptation.share_before = before / (before + after);
  const bool fast =
      adaptation.largest_step >= kSmallestStep && adaptation.duration_frames < 0.5 * frames_per_spacing;
  if (adaptation.largest_change >= kSmallestStep) adaptation.pace = fast ? Pace::kAbrupt : Pace::kGradual;
  return adaptation;
}

}  // namespace plenolab
