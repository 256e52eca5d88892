#include "experiments/reproduce/luminance/figure_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plenolab {

namespace {

/// Share of the positions at which `first` is greater.
double share_greater(const std::vector<double>& first, const std::vector<double>& second) {
  std::size_t greater = 0;
  for (std::size_t i = 0; i < first.size(); ++i) greater += first[i] > second[i] ? 1 : 0;
  return first.empty() ? 0 : static_cast<double>(greater) / static_cast<double>(first.size());
}

std::string amplitude_words(const LuminanceCurves& curves) {
  const bool as_paper = curves.accumulative_range > curves.brute_range;
  return fmt::format("{} the amplitude of {} is the larger (a factor of {:.2f} against {:.2f} of {})",
                     as_paper ? "as in the paper," : "other than in the paper,",
                     as_paper ? "Accumulative" : "BruteForce",
                     std::exp(as_paper ? curves.accumulative_range : curves.brute_range),
                     std::exp(as_paper ? curves.brute_range : curves.accumulative_range),
                     as_paper ? "BruteForce" : "Accumulative");
}

std::string restlessness_words(const LuminanceCurves& curves) {
  const bool as_paper = curves.accumulative_variation > curves.brute_variation;
  return fmt::format("Accumulative is {}restless (total variation of ln {:.2f} against {:.2f})",
                     as_paper ? "the more " : "no more ", curves.accumulative_variation,
                     curves.brute_variation);
}

/// Positions in a row, both ends included.
struct Run {
  std::size_t begin = 0, end = 0;
};

std::vector<Run> runs_where_greater(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!(first[i] > second[i])) continue;
    if (runs.empty() || runs.back().end + 1 != i) runs.push_back({i, i});
    runs.back().end = i;
  }
  return runs;
}

}  // namespace

std::string compare_with_figure_3(const LuminanceCurves& curves) {
  std::string text =
      fmt::format("In {}, {}, and {}", curves.title, amplitude_words(curves), restlessness_words(curves));
  if (!curves.all_to_truth || !curves.brute_to_truth) return text + ".";
  constexpr double kAlike = 0.05;
  const double ratio = *curves.brute_to_truth / *curves.all_to_truth;
  const char* words = ratio < 1 - kAlike   ? "nearer to the true pictures than"
                      : ratio > 1 + kAlike ? "farther from the true pictures than"
                                           : "no nearer to the true pictures than";
  return text + fmt::format("; BruteForce is {} All ({:.3f} against {:.3f} in ln).", words,
                            *curves.brute_to_truth, *curves.all_to_truth);
}

std::string where_greater(const std::vector<double>& x_m, const std::vector<double>& first,
                          const std::vector<double>& second) {
  const std::vector<Run> runs = runs_where_greater(first, second);
  const auto words = [&](const Run& run) {
    return run.begin == run.end ? fmt::format("at {:.2g} m", x_m[run.begin])
                                : fmt::format("from {:.2g} to {:.2g} m", x_m[run.begin], x_m[run.end]);
  };
  constexpr std::size_t kListed = 4;
  if (runs.empty()) return "nowhere";
  if (runs.size() <= kListed) {
    std::string text;
    for (const Run& run : runs) text += (text.empty() ? "" : ", ") + words(run);
    return text;
  }
  const Run longest = *std::max_element(
      runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.end - a.begin < b.end - b.begin; });
  return fmt::format("in {} pieces between {:.2g} and {:.2g} m, the longest {}", runs.size(),
                     x_m[runs.front().begin], x_m[runs.back().end], words(longest));
}

std::string compare_with_figure_4(const PsnrCurves& curves) {
  const double brute = share_greater(curves.brute_db, curves.all_db),
               accumulative = share_greater(curves.accumulative_db, curves.all_db);
  const bool agrees = brute > 0.5 && accumulative > 0.5;
  return fmt::format(
      "In {} against {} BruteForce lies above All at {:.0f} % and Accumulative at {:.0f} % of the positions: "
      "{} All is better than Accumulative {}.",
      curves.title, curves.reference, 100 * brute, 100 * accumulative,
      agrees ? "mostly above, as in the paper." : "not both mostly above, other than in the paper.",
      where_greater(curves.x_m, curves.all_db, curves.accumulative_db));
}

}  // namespace plenolab
