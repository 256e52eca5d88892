#include "experiments/brisque_training.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/image/colour.h"
#include "metrics/ssim.h"
#include "stimuli/render_cache.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace {

constexpr std::uint64_t kNoisePurpose = 0x627269737175650a;
constexpr int kStrengths = 5;
constexpr std::array<float, 3> kExposures{0.4f, 1, 2.5f};  // of exposure_from

float clamp_unit(float v) {
  return std::clamp(v, 0.0f, 1.0f);
}

template <class Change>
DisplayImage changed(DisplayImage image, Change change) {
  for (Rgb& c : image.pixels())
    c = {clamp_unit(change(c.r)), clamp_unit(change(c.g)), clamp_unit(change(c.b))};
  return image;
}

DisplayImage with_noise(const DisplayImage& image, int strength, std::uint64_t seed, std::uint64_t index) {
  const double deviation = 0.01 * std::exp2(strength - 1);
  RandomStream random(seed, kNoisePurpose, index);
  return changed(image, [&](float v) {
    const double radius = std::sqrt(-2 * std::log(1 - random.next_double()));
    return v + static_cast<float>(deviation * radius * std::cos(2 * std::numbers::pi * random.next_double()));
  });
}

cv::Mat to_mat(const DisplayImage& image) {
  cv::Mat mat(image.height(), image.width(), CV_32FC3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.at(x, y);
      mat.at<cv::Vec3f>(y, x) = {c.b, c.g, c.r};
    }
  return mat;
}

DisplayImage from_mat(const cv::Mat& mat) {
  DisplayImage image(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y)
    for (int x = 0; x < mat.cols; ++x) {
      const auto c = mat.at<cv::Vec3f>(y, x);
      image.at(x, y) = {clamp_unit(c[2]), clamp_unit(c[1]), clamp_unit(c[0])};
    }
  return image;
}

DisplayImage with_blur(const DisplayImage& image, int strength) {
  const double sigma = 0.6 * std::pow(16, (strength - 1) / 4.0);
  cv::Mat blurred;
  cv::GaussianBlur(to_mat(image), blurred, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
  return from_mat(blurred);
}

DisplayImage with_jpeg(const DisplayImage& image, int strength) {
  constexpr std::array<int, kStrengths> kQuality{60, 35, 20, 10, 5};
  cv::Mat codes, decoded;
  to_mat(image).convertTo(codes, CV_8UC3, 255);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", codes, bytes,
               {cv::IMWRITE_JPEG_QUALITY, kQuality.at(static_cast<std::size_t>(strength - 1))});
  cv::imdecode(bytes, cv::IMREAD_COLOR).convertTo(decoded, CV_32FC3, 1 / 255.0);
  return from_mat(decoded);
}

DisplayImage with_levels(const DisplayImage& image, int strength) {
  constexpr std::array<float, kStrengths> kLevels{32, 16, 10, 6, 4};
  const float steps = kLevels.at(static_cast<std::size_t>(strength - 1)) - 1;
  return changed(image, [&](float v) { return std::round(v * steps) / steps; });
}

/// Nothing left of the picture but its mean grey.
DisplayImage blank(const DisplayImage& image, int) {
  double sum = 0;
  for (const Rgb c : image.pixels()) sum += static_cast<double>(luminance(c));
  const auto grey = static_cast<float>(sum / static_cast<double>(image.size()));
  return changed(image, [&](float) { return grey; });
}

struct Distortion {
  const char* name;
  int strengths;
  DisplayImage (*apply)(const DisplayImage& image, int strength, std::uint64_t seed, std::uint64_t index);
};

constexpr std::array kDistortions{
    Distortion{"noise", kStrengths, with_noise},
    Distortion{"blur", kStrengths,
               [](const DisplayImage& image, int strength, std::uint64_t, std::uint64_t) {
                 return with_blur(image, strength);
               }},
    Distortion{"jpeg", kStrengths,
               [](const DisplayImage& image, int strength, std::uint64_t, std::uint64_t) {
                 return with_jpeg(image, strength);
               }},
    Distortion{"levels", kStrengths,
               [](const DisplayImage& image, int strength, std::uint64_t, std::uint64_t) {
                 return with_levels(image, strength);
               }},
    Distortion{"blank", 1,
               [](const DisplayImage& image, int strength, std::uint64_t, std::uint64_t) {
                 return blank(image, strength);
               }},
};

/// The picture and its distortions.
void add_pictures(std::vector<TrainingPicture>& pictures, const std::string& scene, const DisplayImage& truth,
                  const BrisqueTrainingOptions& options) {
  ComparisonConditions conditions;
  conditions.threads = options.threads;
  pictures.push_back({scene, "none", 0, brisque_features(truth), 0});
  for (const Distortion& distortion : kDistortions) {
    for (int strength = 1; strength <= distortion.strengths; ++strength) {
      const DisplayImage image = distortion.apply(truth, strength, options.seed, pictures.size());
      const double similarity = ssim_gamma(image, truth, conditions).front().value;
      pictures.push_back({scene, distortion.name, strength, brisque_features(image), 100 * (1 - similarity)});
    }
  }
}

/// Means of 2×2 pixels: a quarter of the noise's power, so that what counts as undistorted is smooth.
SceneImage halved(const SceneImage& view) {
  SceneImage half(view.width() / 2, view.height() / 2);
  for (int y = 0; y < half.height(); ++y)
    for (int x = 0; x < half.width(); ++x)
      half.at(x, y) = 0.25f * (view.at(2 * x, 2 * y) + view.at(2 * x + 1, 2 * y) + view.at(2 * x, 2 * y + 1) +
                               view.at(2 * x + 1, 2 * y + 1));
  return half;
}

std::vector<SceneImage> views_of(const SceneEntry& entry, const BrisqueTrainingOptions& options) {
  const PreparedScene scene(entry.build());
  ViewGrid grid = grid_of(scene.scene(), Preset::kQuick);
  grid.height = std::max(16, grid.height * options.width / grid.width);
  grid.width = options.width;
  RenderSettings settings;
  settings.paths_per_pixel = options.paths_per_pixel;
  settings.seed = options.seed;
  settings.threads = options.threads;
  std::vector<SceneImage> views;
  for (const CameraPosition position :
       {CameraPosition{0, 0}, {0.5 * (grid.columns - 1), 0.5 * (grid.rows - 1)}})
    views.push_back(
        halved(render_view_cached(scene, grid, position, settings, options.cache).rendered.view.colour));
  return views;
}

/// Ranks from 1, equal values share their mean rank.
std::vector<double> ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) result[order[i]] = 0.5 * static_cast<double>(begin + end + 1);
    begin = end;
  }
  return result;
}

double correlation(std::span<const double> a, std::span<const double> b) {
  const auto n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// Mean and deviation of each input; deviations of inputs that hardly vary count as 1.
void standardise(TrainedBrisque& trained, std::span<const TrainingPicture> pictures) {
  trained.mean.assign(kBrisqueFeatures, 0);
  trained.deviation.assign(kBrisqueFeatures, 0);
  const auto n = static_cast<double>(pictures.size());
  for (const TrainingPicture& picture : pictures) {
    const BrisqueFeatures inputs = brisque_inputs(picture.features);
    for (std::size_t i = 0; i < inputs.size(); ++i) trained.mean[i] += inputs[i] / n;
  }
  for (const TrainingPicture& picture : pictures) {
    const BrisqueFeatures inputs = brisque_inputs(picture.features);
    for (std::size_t i = 0; i < inputs.size(); ++i)
      trained.deviation[i] += (inputs[i] - trained.mean[i]) * (inputs[i] - trained.mean[i]) / n;
  }
  for (double& d : trained.deviation) d = d > 1e-12 ? std::sqrt(d) : 1;
}

std::string array_text(const std::string& name, const std::vector<double>& values) {
  std::string text = fmt::format("inline constexpr double {}[{}] = {{", name, values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}{:.9g},", i % 6 == 0 ? "\n    " : " ", values[i]);
  text.back() = '}';
  return text + ";\n";
}

}  // namespace

std::vector<TrainingPicture> brisque_training_pictures(const BrisqueTrainingOptions& options,
                                                       const Progress& progress) {
  std::vector<SceneEntry> entries(scenes().begin(), scenes().end());
  entries.insert(entries.end(), near_eye_scenes().begin(), near_eye_scenes().end());
  std::vector<TrainingPicture> pictures;
  double done = 0;
  for (const SceneEntry& entry : entries) {
    for (const SceneImage& view : views_of(entry, options))
      for (const float exposure : kExposures)
        add_pictures(pictures, entry.id, expose(view, exposure * exposure_from(view)), options);
    if (progress) progress(++done / static_cast<double>(entries.size()));
  }
  return pictures;
}

TrainedBrisque train_brisque(std::span<const TrainingPicture> pictures, double ridge) {
  PLENOLAB_CHECK(pictures.size() >= 2, "too few pictures to train");
  TrainedBrisque trained;
  standardise(trained, pictures);
  trained.weights.assign(2 * kBrisqueFeatures, 0);
  const auto rows = static_cast<Eigen::Index>(pictures.size());
  Eigen::MatrixXd terms(rows, 2 * kBrisqueFeatures);
  Eigen::VectorXd targets(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const TrainingPicture& picture = pictures[static_cast<std::size_t>(r)];
    const auto values = brisque_terms(trained.model(), picture.features);
    terms.row(r) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), 2 * kBrisqueFeatures);
    targets(r) = picture.target;
  }
  const Eigen::RowVectorXd means = terms.colwise().mean();
  const double mean_target = targets.mean();
  const Eigen::MatrixXd centred = terms.rowwise() - means;
  Eigen::MatrixXd normal = centred.transpose() * centred;
  normal.diagonal().array() += ridge * 1e-3 * static_cast<double>(rows);
  const Eigen::VectorXd weights =
      normal.ldlt().solve(centred.transpose() * (targets.array() - mean_target).matrix());
  std::copy(weights.begin(), weights.end(), trained.weights.begin());
  trained.intercept = mean_target - means.dot(weights);
  return trained;
}

Agreement agreement(std::span<const double> scores, std::span<const double> targets) {
  double squares = 0;
  for (std::size_t i = 0; i < scores.size(); ++i)
    squares += (scores[i] - targets[i]) * (scores[i] - targets[i]);
  return {static_cast<int>(scores.size()), correlation(scores, targets),
          correlation(ranks(scores), ranks(targets)),
          std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, scores.size())))};
}

std::vector<double> hold_out_scores(std::span<const TrainingPicture> pictures, double ridge) {
  std::set<std::string> groups;
  for (const TrainingPicture& picture : pictures) groups.insert(picture.scene);
  std::vector<double> scores(pictures.size());
  for (const std::string& held_out : groups) {
    std::vector<TrainingPicture> others;
    std::copy_if(pictures.begin(), pictures.end(), std::back_inserter(others),
                 [&](const TrainingPicture& picture) { return picture.scene != held_out; });
    const TrainedBrisque trained = train_brisque(others, ridge);
    for (std::size_t i = 0; i < pictures.size(); ++i)
      if (pictures[i].scene == held_out) scores[i] = brisque_score(trained.model(), pictures[i].features);
  }
  return scores;
}

std::string brisque_weights_header(const TrainedBrisque& trained,
                                   const std::vector<std::string>& provenance) {
  std::string text = "#pragma once\n\n";
  for (const std::string& line : provenance) text += "// " + line + "\n";
  text += "namespace plenolab::brisque_weights {\n\n// clang-format off\n";
  text += array_text("kMean", trained.mean) + array_text("kDeviation", trained.deviation) +
          array_text("kWeights", trained.weights);
  text +=
      fmt::format("inline constexpr double kIntercept = {:.9g};\n// clang-format on\n", trained.intercept);
  return text + "\n}  // namespace plenolab::brisque_weights\n";
}

}  // namespace plenolab
