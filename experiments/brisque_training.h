#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "metrics/brisque.h"

/// Trains the regressor behind the metric brisque_plenolab: pictures of plenolab's scenes, distorted, with a
/// full-reference target. Reproducible from a seed.
namespace plenolab {

struct BrisqueTrainingOptions {
  std::filesystem::path cache;  ///< of rendered views
  std::uint64_t seed = 1;
  int threads = 0;
  int paths_per_pixel = 64;  ///< of the views, a multiple of 16
  int width = 384;           ///< px, of the rendered views, [64, 4096]; pictures have half of it
  double ridge = 1;          ///< penalty on squared weights, thousandths of the number of pictures, > 0
};

/// One picture: a view of a scene at some exposure, distorted.
struct TrainingPicture {
  std::string scene;
  std::string distortion;  ///< none, noise, blur, jpeg, levels or blank
  int strength = 0;        ///< 0 for none, 1 … 5
  BrisqueFeatures features{};
  double target = 0;  ///< 100·(1 − SSIM with the undistorted picture)
};

/// Two views of every scene, near-eye ones included, at three exposures, each undistorted, by four
/// distortions of five strengths (Gaussian noise, standard deviation 0.01 … 0.16 of full scale; Gaussian
/// blur, σ 0.6 … 9.6 px; JPEG, quality 60 … 5; few levels, 32 … 4 per channel) and blank, of the mean grey.
/// Loss of contrast all over, cut highlights and cut shadows are not among them: locally normalised luma
/// hardly changes with them (tried: no correlation on scenes left out, and others were judged worse).
std::vector<TrainingPicture> brisque_training_pictures(const BrisqueTrainingOptions& options,
                                                       const Progress& progress = {});

/// A trained regressor that owns its numbers.
struct TrainedBrisque {
  std::vector<double> mean, deviation, weights;
  double intercept = 0;
  BrisqueModel model() const { return {mean, deviation, weights, intercept}; }
};

/// Ridge regression of the targets on brisque_terms. At least two pictures.
TrainedBrisque train_brisque(std::span<const TrainingPicture> pictures, double ridge);

/// How scores agree with targets.
struct Agreement {
  int pictures = 0;
  double pearson = 0, spearman = 0;  ///< 0 where one side does not vary
  double rms_error = 0;
};
Agreement agreement(std::span<const double> scores, std::span<const double> targets);

/// Scores of every picture by a regressor trained without any picture of its scene.
std::vector<double> hold_out_scores(std::span<const TrainingPicture> pictures, double ridge);

/// Source of metrics/brisque_weights.h, with `provenance` (lines of text) in its comment.
std::string brisque_weights_header(const TrainedBrisque& trained, const std::vector<std::string>& provenance);

}  // namespace plenolab
