#include "experiments/reproduce/figure_epi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <span>

#include "analysis/epi.h"
#include "core/image/colour.h"
#include "experiments/reproduce/figure_pictures.h"
#include "metrics/error_map.h"
#include "metrics/psnr.h"

namespace plenolab {

namespace {

constexpr int kStretch = 4;  // rows a frame is drawn with
constexpr int kMagnification = 4;
constexpr double kEpiSpan = 2;  // column spacings
constexpr double kNear = 0.1;   // column spacings

/// RMS of the errors of the frames that are as near as any to one of the positions `wanted`, or within
/// `tolerance` of it.
double error_near(const EpiPair& epi, const std::vector<double>& errors, std::initializer_list<double> wanted,
                  double tolerance) {
  constexpr double kSame = 1e-6;
  const auto distance = [&](std::size_t frame) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double s : wanted) nearest = std::min(nearest, std::abs(epi.positions[frame].s - s));
    return nearest;
  };
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < errors.size(); ++i) limit = std::min(limit, distance(i));
  limit = std::max(limit, tolerance) + kSame;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (distance(i) > limit) continue;
    sum += errors[i] * errors[i];
    ++count;
  }
  return std::sqrt(sum / count);
}

std::vector<double> errors_of_frames(const EpiPair& epi, const PixelBox& box, float exposure) {
  std::vector<double> errors;
  for (int frame = 0; frame < epi.truth.height(); ++frame) {
    const PixelBox part{box.x, frame, box.width, 1};
    const Plane<float> squares =
        smoothed_squared_difference(crop(epi.synthesised, part), crop(epi.truth, part), exposure);
    const double sum = std::accumulate(squares.pixels().begin(), squares.pixels().end(), 0.0);
    errors.push_back(std::sqrt(sum / box.width));
  }
  return errors;
}

ReportPlot error_plot(const EpiPair& epi, const std::vector<double>& errors) {
  Plot plot;
  plot.x.title = "Camera position s";
  plot.x.unit = "column spacings";
  plot.y.title = "RMS difference, encoded luma";
  plot.y.minimum = 0;
  plot.key = KeyPosition::kNone;
  PlotSeries series{"", PlotSeries::Style::kLinesPoints, {}};
  for (std::size_t i = 0; i < errors.size(); ++i)
    series.points.push_back(
        {.x = epi.positions[i].s, .y = errors[i], .y_low = {}, .y_high = {}, .label = {}});
  plot.series.push_back(std::move(series));
  return {
      std::move(plot),
      "Error of the enlarged columns of the epipolar image over the camera position; columns of key views "
      "stand at whole numbers",
      "Error of synthesised frames over the camera position"};
}

/// Truth, synthesis and difference of a part of the epipolar image.
std::vector<ReportImage> epi_images(const EpiPair& epi, const PixelBox& part, float exposure) {
  ComparisonConditions conditions;
  conditions.exposure = exposure;
  const SceneImage truth = crop(epi.truth, part), synthesised = crop(epi.synthesised, part);
  return {{"EPI ground truth", expose(truth, exposure)},
          {"EPI synthesised", expose(synthesised, exposure)},
          {"EPI difference", error_map(synthesised, truth, conditions)}};
}

ImageComparison whole_epi(const EpiPair& epi, const PixelBox& box, float exposure,
                          const std::string& motion) {
  const int frames = epi.truth.height();
  ImageComparison whole{motion + ". Green: the frame of the view above, red: enlarged below", motion,
                        epi_images(epi, {0, 0, epi.truth.width(), frames}, exposure)};
  for (ReportImage& image : whole.images) {
    image.image = stretch_epi(image.image, EpiDirection::kRow, kStretch);
    if (image.label == "EPI difference") continue;
    image.image = mark_row(std::move(image.image), epi.frame * kStretch + kStretch / 2);
    image.image = mark_box(std::move(image.image), {box.x, 0, box.width, frames * kStretch});
  }
  return whole;
}

/// The columns of the box. Enlarged alike along both axes, lines keep their slope.
ImageComparison enlarged_epi(const EpiPair& epi, const PixelBox& box, float exposure, double disparity_px,
                             const std::string& motion) {
  const double step = epi.positions[1].s - epi.positions[0].s;
  const EpiLine line{.position_px = kMagnification * box.width / 2.0,
                     .frame = kMagnification * (epi.frame + 0.5) - 0.5,
                     .slope_px_per_frame = expected_epi_slope(disparity_px, step)};
  ImageComparison part{
      fmt::format("{}, enlarged {} times. Line: slope expected of the surface (disparity {:.1f} px) in the "
                  "middle of the part that the view above enlarges",
                  motion, kMagnification, disparity_px),
      motion + ", enlarged", epi_images(epi, {box.x, 0, box.width, epi.truth.height()}, exposure)};
  for (ReportImage& image : part.images)
    image.image =
        draw_epi_lines(magnify(image.image, kMagnification), EpiDirection::kRow, std::span(&line, 1));
  return part;
}

}  // namespace

bool fades(const EpiNumbers& epi) {
  return epi.rms_between > kFadingRatio * epi.rms_at_keys;
}

std::string fading_text(const EpiNumbers& epi) {
  std::string text = fmt::format(
      "Along the camera motion the error of these columns is {:.3f} (encoded RMS) within a tenth of the "
      "spacing from the columns of key views and {:.3f} around the middle between them",
      epi.rms_at_keys, epi.rms_between);
  if (epi.rms_at_keys > 0) text += fmt::format(", {:.1f} times as much", epi.rms_between / epi.rms_at_keys);
  if (epi.rms_noise)
    text += fmt::format(
        ". At the key views exactly it is {:.3f}: the synthesis is the key view itself there, so this is "
        "path tracing noise. Without the noise expected in the middle {:.3f} remain there",
        *epi.rms_noise, *epi.rms_between_without_noise);
  return text + ".";
}

double without_noise(double rms_between, double rms_noise) {
  constexpr double kTruthNoise = 1.0 / kTruthPathFactor;  // variance in units of a key view's
  constexpr double kOfKeys = (0.5 + kTruthNoise) / (1 - kTruthNoise);
  return std::sqrt(std::max(0.0, rms_between * rms_between - kOfKeys * rms_noise * rms_noise));
}

EpiPair record_epi(Laboratory& laboratory, const std::string& scene, CameraPosition at, int row) {
  const ViewGrid grid = laboratory.grid(scene);
  EpiPair result;
  result.row = row;
  result.at_s = at.s;
  const double last = grid.columns - 1;
  const double from = std::clamp(at.s - kEpiSpan / 2, 0.0, std::max(last - kEpiSpan, 0.0));
  result.positions = straight_path({from, at.t}, {std::min(from + kEpiSpan, last), at.t}, kEpiFrames);
  SynthesisOptions options;
  options.threads = laboratory.options().threads;
  std::vector<SceneImage> rows(result.positions.size());
  laboratory.synthesizer(scene).synthesize_sequence(
      result.positions, options, [&](std::size_t i, NovelView<SceneReferred>&& view) {
        rows[i] = crop(view.image, {0, row, view.image.width(), 1});
      });
  result.synthesised = epi(rows, EpiDirection::kRow, 0);
  result.truth =
      epi(laboratory.truth_rows(scene, result.positions, row, kTruthPathFactor), EpiDirection::kRow, 0);
  const auto nearest = std::min_element(result.positions.begin(), result.positions.end(),
                                        [&](const CameraPosition& a, const CameraPosition& b) {
                                          return std::abs(a.s - at.s) < std::abs(b.s - at.s);
                                        });
  result.frame = static_cast<int>(nearest - result.positions.begin());
  return result;
}

EpiNumbers measure_epi(const EpiPair& epi, const PixelBox& box, float exposure) {
  const std::vector<double> errors = errors_of_frames(epi, box, exposure);
  EpiNumbers numbers;
  const double left = std::floor(epi.at_s), right = std::ceil(epi.at_s);
  numbers.rms_at_keys = error_near(epi, errors, {left, right}, kNear);
  numbers.rms_between = error_near(epi, errors, {(left + right) / 2}, kNear);
  const auto is_left = [left](const CameraPosition& p) { return p.s == left && p.t == std::round(p.t); };
  if (std::any_of(epi.positions.begin(), epi.positions.end(), is_left)) {
    numbers.rms_noise = error_near(epi, errors, {left, right}, 0);
    numbers.rms_between_without_noise = without_noise(numbers.rms_between, *numbers.rms_noise);
  }
  const double rms =
      rms_difference(epi.synthesised, epi.truth, exposure, {box.x, 0, box.width, epi.truth.height()});
  numbers.psnr_db = psnr_db(1, rms * rms);
  return numbers;
}

EpiNumbers add_epi(ReproductionResult& result, const EpiPair& epi, const PixelBox& box, float exposure,
                   double disparity_px, const std::string& what, const Columns& columns) {
  const std::string motion =
      fmt::format("{}: row {} of {} frames, camera moving from {:.2f} (top) to {:.2f}", what, epi.row,
                  epi.truth.height(), epi.positions.front().s, epi.positions.back().s);
  result.add_comparison("epi", whole_epi(epi, box, exposure, motion), {epi.truth, epi.synthesised});
  result.add_comparison("epi-crop", enlarged_epi(epi, box, exposure, disparity_px, motion));
  result.add_plot("epi-error", error_plot(epi, errors_of_frames(epi, box, exposure)));
  const EpiNumbers numbers = measure_epi(epi, box, exposure);
  result.rows.add({"epi_psnr_gamma_db", numbers.psnr_db, "dB", columns});
  result.rows.add({"epi_rms_at_keys", numbers.rms_at_keys, "1", columns});
  result.rows.add({"epi_rms_between", numbers.rms_between, "1", columns});
  if (numbers.rms_noise) result.rows.add({"epi_rms_noise", *numbers.rms_noise, "1", columns});
  if (numbers.rms_between_without_noise)
    result.rows.add({"epi_rms_between_without_noise", *numbers.rms_between_without_noise, "1", columns});
  return numbers;
}

}  // namespace plenolab
