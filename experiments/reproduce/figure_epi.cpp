#include "experiments/reproduce/figure_epi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

double distance_to_key(CameraPosition position) {
  return std::abs(position.s - std::round(position.s));
}

/// RMS of the frames' errors whose distance to the nearest column of key views is as near to `wanted` as any
/// frame comes.
double error_at(const EpiPair& epi, const std::vector<double>& errors, double wanted) {
  constexpr double kSame = 1e-6;
  double nearest = 1;
  for (const CameraPosition& p : epi.positions)
    nearest = std::min(nearest, std::abs(distance_to_key(p) - wanted));
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (std::abs(distance_to_key(epi.positions[i]) - wanted) > nearest + kSame) continue;
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

bool is_whole(double value) {
  return value == std::round(value);
}

EpiNumbers numbers_of(const EpiPair& epi, const PixelBox& box, float exposure,
                      const std::vector<double>& errors) {
  EpiNumbers numbers;
  numbers.rms_at_keys = error_at(epi, errors, 0);
  numbers.rms_between = error_at(epi, errors, 0.5);
  const bool through_keys =
      std::any_of(epi.positions.begin(), epi.positions.end(),
                  [](const CameraPosition& p) { return is_whole(p.s) && is_whole(p.t); });
  if (through_keys)
    numbers.rms_between_without_noise = without_noise(numbers.rms_between, numbers.rms_at_keys);
  const double rms =
      rms_difference(epi.synthesised, epi.truth, exposure, {box.x, 0, box.width, epi.truth.height()});
  numbers.psnr_db = psnr_db(1, rms * rms);
  return numbers;
}

}  // namespace

bool fades(const EpiNumbers& epi) {
  return epi.rms_between > kFadingRatio * epi.rms_at_keys;
}

std::string fading_text(const EpiNumbers& epi) {
  std::string text = fmt::format(
      "Along the camera motion the error of these columns is {:.3f} (encoded RMS) at columns of key views "
      "and "
      "{:.3f} midway between them",
      epi.rms_at_keys, epi.rms_between);
  if (epi.rms_at_keys > 0) text += fmt::format(", {:.1f} times as much", epi.rms_between / epi.rms_at_keys);
  if (epi.rms_between_without_noise)
    text += fmt::format(
        ". At key views the synthesis is the key view itself, so that the error there is path tracing noise; "
        "less the noise to be expected midway, {:.3f} remain there",
        *epi.rms_between_without_noise);
  return text + ".";
}

double without_noise(double rms_between, double rms_at_keys) {
  constexpr double kTruthNoise = 1.0 / kTruthPathFactor;  // variance in units of a key view's
  constexpr double kOfKeys = (0.5 + kTruthNoise) / (1 - kTruthNoise);
  return std::sqrt(std::max(0.0, rms_between * rms_between - kOfKeys * rms_at_keys * rms_at_keys));
}

EpiPair record_epi(Laboratory& laboratory, const std::string& scene, CameraPosition at, int row) {
  const ViewGrid grid = laboratory.grid(scene);
  EpiPair result;
  result.row = row;
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

EpiNumbers add_epi(ReproductionResult& result, const EpiPair& epi, const PixelBox& box, float exposure,
                   double disparity_px, const std::string& what, const Columns& columns) {
  const std::string motion =
      fmt::format("{}: row {} of {} frames, camera moving from {:.2f} (top) to {:.2f}", what, epi.row,
                  epi.truth.height(), epi.positions.front().s, epi.positions.back().s);
  result.add_comparison("epi", whole_epi(epi, box, exposure, motion), {epi.truth, epi.synthesised});
  result.add_comparison("epi-crop", enlarged_epi(epi, box, exposure, disparity_px, motion));
  const std::vector<double> errors = errors_of_frames(epi, box, exposure);
  result.add_plot("epi-error", error_plot(epi, errors));
  const EpiNumbers numbers = numbers_of(epi, box, exposure, errors);
  result.rows.add({"epi_psnr_gamma_db", numbers.psnr_db, "dB", columns});
  result.rows.add({"epi_rms_at_keys", numbers.rms_at_keys, "1", columns});
  result.rows.add({"epi_rms_between", numbers.rms_between, "1", columns});
  if (numbers.rms_between_without_noise)
    result.rows.add({"epi_rms_between_without_noise", *numbers.rms_between_without_noise, "1", columns});
  return numbers;
}

}  // namespace plenolab
