#include "metrics/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/base/error.h"
#include "metrics/brisque.h"
#include "metrics/difference.h"
#include "metrics/drim.h"
#include "metrics/feature_distortion.h"
#include "metrics/psnr.h"
#include "metrics/ssim.h"
#include "metrics/tmqi.h"

namespace plenolab {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDependsOnImage = std::numeric_limits<double>::quiet_NaN();

using SceneCompare = std::vector<Measurement> (*)(const SceneImage&, const SceneImage&,
                                                  const ComparisonConditions&);
using DisplayCompare = std::vector<Measurement> (*)(const DisplayImage&, const DisplayImage&,
                                                    const ComparisonConditions&);
using MappedCompare = std::vector<Measurement> (*)(const DisplayImage&, const SceneImage&,
                                                   const ComparisonConditions&);

MetricQuantity decibels(std::string name, std::string meaning) {
  return {std::move(name), "dB", Better::kHigher, -kInfinity, kInfinity, kInfinity, std::move(meaning)};
}

MetricQuantity share_clipped(std::string name, std::string meaning) {
  return {std::move(name), "1", Better::kNeither, 0, 1, kDependsOnImage, std::move(meaning)};
}

std::vector<MetricQuantity> difference_quantities() {
  std::vector<MetricQuantity> quantities;
  const auto add = [&](std::string name, Better better, double minimum, std::string meaning) {
    quantities.push_back({std::move(name), "1", better, minimum, 1, 0, std::move(meaning)});
  };
  for (const std::string channel : {"_r", "_g", "_b"}) {
    add("mean_difference" + channel, Better::kNearerZero, -1, "Mean of test − reference (bias).");
    add("mean_abs_difference" + channel, Better::kLower, 0, "Mean absolute difference.");
    add("rms_difference" + channel, Better::kLower, 0, "Root of the mean squared difference.");
    add("max_abs_difference" + channel, Better::kLower, 0, "Largest absolute difference.");
    add("abs_difference_p50" + channel, Better::kLower, 0, "Median of absolute differences.");
    add("abs_difference_p95" + channel, Better::kLower, 0, "95th percentile of absolute differences.");
    add("abs_difference_p99" + channel, Better::kLower, 0, "99th percentile of absolute differences.");
    add("share_above_threshold" + channel, Better::kLower, 0,
        "Share of pixels that differ by more than the threshold.");
  }
  add("share_above_threshold", Better::kLower, 0,
      "Share of pixels of which any channel differs by more than the threshold.");
  return quantities;
}

std::vector<MetricQuantity> drim_quantities() {
  std::vector<MetricQuantity> quantities{{"drim_share_any", "1", Better::kLower, 0, 1, 0,
                                          "Share of pixels with a distortion of probability ≥ 0.5."}};
  const std::vector<std::pair<std::string, std::string>> kinds{
      {"loss", "loss of visible contrast"},
      {"amplification", "invisible contrast made visible"},
      {"reversal", "visible contrast reversed"}};
  for (const auto& [kind, words] : kinds)
    quantities.push_back({"drim_share_" + kind, "1", Better::kLower, 0, 1, 0,
                          fmt::format("Share of pixels with probability ≥ 0.5: {}.", words), false});
  for (const auto& [kind, words] : kinds)
    quantities.push_back({"drim_mean_" + kind, "%", Better::kLower, 0, 100, 0,
                          fmt::format("Mean probability: {}.", words), false});
  quantities.push_back(
      {"drim_mean_total", "%", Better::kLower, 0, 300, 0, "Sum of the three mean probabilities.", false});
  return quantities;
}

std::vector<MetricQuantity> tmqi_quantities() {
  return {
      {"tmqi", "1", Better::kHigher, 0, 1, kDependsOnImage, "Quality: fidelity and naturalness.", false},
      {"tmqi_fidelity", "1", Better::kHigher, 0, 1, kDependsOnImage, "Structural fidelity on five scales."},
      {"tmqi_naturalness", "1", Better::kHigher, 0, 1, kDependsOnImage,
       "How usual mean luma and deviation are in photographs.", false}};
}

std::vector<MetricQuantity> feature_quantities(const std::string& name) {
  const auto quantity = [&](const std::string& part, std::string meaning) {
    return MetricQuantity{name + part, "1", Better::kLower, 0, 1, kDependsOnImage, std::move(meaning), false};
  };
  return {quantity("", "Mean of the three distortions."),
          quantity("_brightness", "Difference of mean luma from that of the photographs."),
          quantity("_saliency", "How far saliency lies elsewhere than in the photographs."),
          quantity("_detail", "Gradient energy lost in the darkest and brightest quarter.")};
}

/// One line a metric.
std::vector<Metric> make_table() {
  return {
      {"psnr_linear",
       "psnr",
       "PSNR of linear radiance; the peak is the largest value of the reference.",
       false,
       {decibels("psnr_linear_db", "10·log10(peak² / mean squared error)."),
        {"psnr_linear_peak", "image unit", Better::kNeither, 0, kInfinity, kDependsOnImage,
         "Largest reference value."}},
       psnr_linear,
       {}},
      {"psnr_gamma",
       "psnr",
       "PSNR of gamma-encoded values at one exposure, peak 1.",
       true,
       {decibels("psnr_gamma_db", "10·log10(1 / mean squared error)."),
        share_clipped("gamma_clipped_share", "Share of reference pixels outside [0, 1] at the exposure.")},
       static_cast<SceneCompare>(psnr_gamma),
       static_cast<DisplayCompare>(psnr_gamma)},
      {"psnr_pq",
       "psnr",
       "PSNR of luminance encoded with PQ (SMPTE ST 2084), peak 1.",
       true,
       {decibels("psnr_pq_db", "10·log10(1 / mean squared error)."),
        share_clipped("pq_clipped_share", "Share of reference pixels outside 0 … 10 000 cd/m².")},
       psnr_pq,
       {}},
      {"ssim_gamma",
       "ssim",
       "SSIM (Wang et al. 2004) of gamma-encoded luma at one exposure.",
       true,
       {{"ssim_gamma", "1", Better::kHigher, -1, 1, 1, "Mean structural similarity of 11×11 windows."}},
       static_cast<SceneCompare>(ssim_gamma),
       static_cast<DisplayCompare>(ssim_gamma)},
      {"difference_gamma", "difference",
       "Statistics of differences of gamma-encoded values, channel by channel.", true,
       difference_quantities(), static_cast<SceneCompare>(difference_gamma),
       static_cast<DisplayCompare>(difference_gamma)},
      {.name = "drim",
       .family = "drim",
       .summary = "Visible contrast lost, amplified or reversed, at any dynamic range (Aydin et al. 2008).",
       .symmetric = false,
       .quantities = drim_quantities(),
       .compare_scene = static_cast<SceneCompare>(drim),
       .compare_display = static_cast<DisplayCompare>(drim),
       .compare_mapped = static_cast<MappedCompare>(drim),
       .viewing = true,
       .absolute_luminance = true},
      {.name = "tmqi",
       .family = "tmqi",
       .summary = "Tone mapped image quality index (Yeganeh & Wang 2013).",
       .symmetric = false,
       .quantities = tmqi_quantities(),
       .compare_mapped = tmqi},
      {.name = "feature_photographic",
       .family = "feature",
       .summary = "Brightness, saliency and detail against virtual photographs (after Gao et al. 2017).",
       .symmetric = false,
       .quantities = feature_quantities("feature_photographic"),
       .compare_mapped = feature_photographic},
      {.name = "feature_content_adaptive",
       .family = "feature",
       .summary = "The same with photographs by the content adaptive operator (Zhao 2019).",
       .symmetric = false,
       .quantities = feature_quantities("feature_content_adaptive"),
       .compare_mapped = feature_content_adaptive,
       .absolute_luminance = true},
      {.name = "brisque_plenolab",
       .family = "brisque",
       .summary = "Features of BRISQUE (Mittal et al. 2012) in a regressor trained on plenolab's scenes; not "
                  "the published score.",
       .symmetric = false,
       .quantities =
           {{"brisque_plenolab", "1", Better::kLower, 0, 100, kDependsOnImage,
             "How unlike undistorted pictures the statistics of the image are. It knows distortions "
             "of well exposed pictures only: nearly white ones can score well.",
             false}},
       .judge = brisque_plenolab},
  };
}

}  // namespace

std::span<const Metric> metrics() {
  static const std::vector<Metric> table = make_table();
  return table;
}

std::vector<const Metric*> select_metrics(std::span<const std::string> names) {
  std::vector<const Metric*> selected;
  const auto wanted_by = [](const Metric& metric) {
    return [&metric](const std::string& name) {
      return name == "all" || name == metric.name || name == metric.family;
    };
  };
  for (const Metric& metric : metrics()) {
    if (std::any_of(names.begin(), names.end(), wanted_by(metric))) selected.push_back(&metric);
  }
  for (const std::string& name : names) {
    const auto knows = [&](const Metric& metric) { return wanted_by(metric)(name); };
    if (std::any_of(metrics().begin(), metrics().end(), knows)) continue;
    std::vector<std::string> known{"all"};
    for (const Metric& metric : metrics()) {
      if (std::find(known.begin(), known.end(), metric.family) == known.end()) known.push_back(metric.family);
      known.push_back(metric.name);
    }
    throw InputError(fmt::format("there is no metric \"{}\"; choose from {}", name, fmt::join(known, ", ")));
  }
  return selected;
}

}  // namespace plenolab
