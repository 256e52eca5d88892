#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plenolab {

/// What measured curves say about figures 3 and 4 of Doronin & Barsi, in sentences.

/// The curves of one scene. Range and total variation are those of ln L̄ along the line, distances are RMS in
/// ln to the true pictures.
struct LuminanceCurves {
  std::string title;  ///< of the scene
  double brute_range = 0, accumulative_range = 0;
  double brute_variation = 0, accumulative_variation = 0;
  std::optional<double> all_to_truth, brute_to_truth;
};
/// Whether Accumulative has the larger amplitude and is more restless, as in figure 3, and whether BruteForce
/// is nearer to the true pictures than a constant, by more than 5 %.
std::string compare_with_figure_3(const LuminanceCurves& curves);

/// PSNR of one scene against one reference at positions from left to right.
struct PsnrCurves {
  std::string title, reference;
  std::vector<double> x_m, all_db, brute_db, accumulative_db;
};
/// At how many positions each method lies above All, and where All is better than Accumulative.
std::string compare_with_figure_4(const PsnrCurves& curves);

/// "from −1 to 2 m, at 3 m": the runs of positions at which `first` is greater than `second`, "nowhere",
/// or of many runs the longest.
std::string where_greater(const std::vector<double>& x_m, const std::vector<double>& first,
                          const std::vector<double>& second);

}  // namespace plenolab
