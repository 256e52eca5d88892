#include "experiments/reproduce/figure_pictures.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "metrics/error_map.h"

namespace plenolab {

namespace {

constexpr int kMagnification = 4;

std::vector<const Metric*> figure_metrics() {
  return select_metrics(std::vector<std::string>{"psnr_gamma", "ssim_gamma", "difference_gamma"});
}

ErrorNumbers error_of(const SceneImage& test, const SceneImage& truth,
                      const ComparisonConditions& conditions) {
  const auto measured = measure(test, truth, figure_metrics(), conditions);
  return {value_of(measured, "psnr_gamma_db"), value_of(measured, "ssim_gamma"),
          value_of(measured, "share_above_threshold")};
}

void add_rows(ReproductionResult& result, const ErrorNumbers& numbers, float exposure, Columns columns,
              const std::string& view, const std::string& region) {
  columns.emplace_back("view", view);
  columns.emplace_back("region", region);
  result.rows.add({"psnr_gamma_db", numbers.psnr_db, "dB", columns});
  result.rows.add({"ssim_gamma", numbers.ssim, "1", columns});
  result.rows.add({"visible_share", numbers.visible_share, "1", columns});
  result.rows.add({"exposure", static_cast<double>(exposure), "1", columns});
}

ComparisonConditions conditions_at(float exposure, int threads) {
  ComparisonConditions conditions;
  conditions.exposure = exposure;
  conditions.difference_threshold = kVisibleDifference;
  conditions.threads = threads;
  return conditions;
}

std::string difference_label(const FigurePictures& pictures, const LabelledView& view) {
  return pictures.synthesised.size() == 1 ? "Difference" : "Difference, " + view.label;
}

std::string sentence(const std::string& text) {
  return text.empty() ? "" : ". " + text;
}

ImageComparison whole_views(const FigurePictures& pictures, const ComparisonConditions& conditions) {
  const auto marked = [&](DisplayImage image) {
    if (pictures.cut_row) image = mark_row(std::move(image), *pictures.cut_row);
    return mark_box(std::move(image), pictures.box);
  };
  const std::string cut = pictures.cut_row ? "; green: the row of the epipolar image" : "";
  ImageComparison shown{pictures.what + ". Red: the part enlarged below" + cut + sentence(pictures.note) +
                            (pictures.note.empty() ? sentence(pictures.choice) : " " + pictures.choice),
                        pictures.what + ", views to compare",
                        {{"Ground truth", marked(expose(*pictures.truth, conditions.exposure))}}};
  for (const LabelledView& view : pictures.synthesised)
    shown.images.push_back({view.label, marked(expose(*view.image, conditions.exposure))});
  for (const LabelledView& view : pictures.synthesised)
    shown.images.push_back(
        {difference_label(pictures, view), error_map(*view.image, *pictures.truth, conditions)});
  for (const ReportImage& map : pictures.maps) shown.images.push_back(map);
  return shown;
}

ImageComparison enlarged(const FigurePictures& pictures, const ComparisonConditions& conditions) {
  const auto enlarge = [](const DisplayImage& image) { return magnify(image, kMagnification); };
  const SceneImage truth = crop(*pictures.truth, pictures.box);
  ImageComparison shown{
      fmt::format("{}, enlarged {} times{}", pictures.what, kMagnification, sentence(pictures.note)),
      pictures.what + ", enlarged, to compare",
      {{"Ground truth", enlarge(expose(truth, conditions.exposure))}}};
  for (const LabelledView& view : pictures.synthesised)
    shown.images.push_back(
        {view.label, enlarge(expose(crop(*view.image, pictures.box), conditions.exposure))});
  for (const LabelledView& view : pictures.synthesised)
    shown.images.push_back({difference_label(pictures, view),
                            enlarge(error_map(crop(*view.image, pictures.box), truth, conditions))});
  for (const ReportImage& map : pictures.maps)
    shown.images.push_back({map.label, enlarge(crop(map.image, pictures.box))});
  return shown;
}

}  // namespace

PictureNumbers add_pictures(ReproductionResult& result, const FigurePictures& pictures,
                            const Columns& columns, int threads) {
  PLENOLAB_CHECK(!pictures.synthesised.empty(), "no synthesised view");
  const SceneImage truth_inside = crop(*pictures.truth, pictures.box);
  const auto whole = conditions_at(figure_exposure(*pictures.truth), threads);
  const auto inside = conditions_at(crop_exposure(*pictures.truth, pictures.box), threads);
  PictureNumbers numbers;
  std::vector<SceneImage> radiance{*pictures.truth};
  for (const LabelledView& view : pictures.synthesised) {
    numbers.whole.push_back(error_of(*view.image, *pictures.truth, whole));
    numbers.box.push_back(error_of(crop(*view.image, pictures.box), truth_inside, inside));
    add_rows(result, numbers.whole.back(), whole.exposure, columns, view.label, "whole");
    add_rows(result, numbers.box.back(), inside.exposure, columns, view.label, "crop");
    radiance.push_back(*view.image);
  }
  result.add_comparison("view", whole_views(pictures, whole), std::move(radiance));
  result.add_comparison("crop", enlarged(pictures, inside));
  return numbers;
}

std::optional<MaskedNumbers> add_masked_rows(ReproductionResult& result, const SceneImage& test,
                                             const SceneImage& truth, const Mask& mask,
                                             const std::string& region, const Columns& columns) {
  MaskedNumbers numbers;
  numbers.pixels = count_set(mask);
  if (numbers.pixels == 0) return std::nullopt;
  ComparisonConditions conditions = conditions_at(figure_exposure(truth), 0);
  conditions.valid = &mask;
  const auto measured = measure(
      test, truth, select_metrics(std::vector<std::string>{"psnr_gamma", "difference_gamma"}), conditions);
  numbers.psnr_db = value_of(measured, "psnr_gamma_db");
  numbers.visible_share = value_of(measured, "share_above_threshold");
  const DisplayImage shown = expose(truth, conditions.exposure);
  double sum = 0, squares = 0;
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (mask.pixels()[n] == 0) continue;
    const auto luma = static_cast<double>(luminance(shown.pixels()[n]));
    sum += luma;
    squares += luma * luma;
  }
  const auto count = static_cast<double>(numbers.pixels);
  numbers.truth_spread = std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
  Columns all = columns;
  all.emplace_back("region", region);
  result.rows.add({"pixels", count, "px", all});
  result.rows.add({"psnr_gamma_db", numbers.psnr_db, "dB", all});
  result.rows.add({"visible_share", numbers.visible_share, "1", all});
  result.rows.add({"truth_spread", numbers.truth_spread, "1", all});
  return numbers;
}

std::string name_of(CameraPosition position) {
  return fmt::format("{:.2f}, {:.2f}", position.s, position.t);
}

std::string percent(double share) {
  return fmt::format("{} %", format_number(100 * share, 2));
}

}  // namespace plenolab
