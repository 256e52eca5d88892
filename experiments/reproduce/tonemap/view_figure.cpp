#include "experiments/reproduce/tonemap/view_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/base/error.h"
#include "core/base/quantile.h"
#include "core/image/colour.h"
#include "core/synthesis/visibility_map.h"
#include "experiments/reproduce/figure_pictures.h"

namespace plenolab {

namespace {

constexpr int kMagnification = 4;

}  // namespace

DisplayImage raise_contrast(const DisplayImage& image) {
  std::vector<float> lumas;
  for (const Rgb& c : image.pixels()) lumas.push_back(luminance(c));
  std::sort(lumas.begin(), lumas.end());
  const auto low = static_cast<float>(quantile_of_sorted(std::span<const float>(lumas), 0.01)),
             high = static_cast<float>(quantile_of_sorted(std::span<const float>(lumas), 0.99));
  if (!(high > low)) return image;
  DisplayImage raised = image;
  const auto spread = [&](float v) { return std::clamp((v - low) / (high - low), 0.0f, 1.0f); };
  for (Rgb& c : raised.pixels()) c = {spread(c.r), spread(c.g), spread(c.b)};
  return raised;
}

void add_enlarged(ReproductionResult& result, const std::string& name, const std::string& what,
                  const SceneImage& hdr, const std::vector<ReportImage>& mapped, const PixelBox& box,
                  const std::vector<ReportImage>& maps) {
  const auto part = [&](const DisplayImage& image) {
    return magnify(raise_contrast(crop(image, box)), kMagnification);
  };
  ImageComparison shown{
      fmt::format("{}: {} × {} pixels at {}, {}, enlarged {} times, contrast raised (the 1st to the 99th "
                  "percentile of luma of each part fills the range)",
                  what, box.width, box.height, box.x, box.y, kMagnification),
      what + ", enlarged",
      {{"HDR, one exposure", part(expose(hdr, crop_exposure(hdr, box)))}}};
  for (const ReportImage& image : mapped)
    shown.images.push_back({short_label(image.label), part(image.image)});
  for (const ReportImage& map : maps)
    shown.images.push_back({map.label, magnify(crop(map.image, box), kMagnification)});
  result.add_comparison(name, std::move(shown));
}

void keep_densest(StepPlace& place, std::size_t index, const Plane<float>& weights) {
  const PixelBox box = densest_box(weights, crop_size(weights.width(), weights.height()));
  double sum = 0;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) sum += static_cast<double>(weights.at(x, y));
  if (sum > place.sum) place = {index, box, sum};
}

StepPlace largest_steps(std::span<const ReferenceFrame> frames, std::span<const DisplayImage> mapped,
                        std::span<const DisplayImage> other) {
  PLENOLAB_CHECK(!frames.empty() && mapped.size() == frames.size() && other.size() == frames.size(),
                 "one image of each mapping for each frame");
  StepPlace place;
  for (std::size_t i = 0; i < frames.size(); ++i)
    keep_densest(place, i, border_step_weights(luma_difference(mapped[i], other[i]), frames[i]));
  return place;
}

void add_view(ReproductionResult& result, const ViewPictures& pictures) {
  const SceneImage& hdr = pictures.frame->hdr;
  const bool shortened =
      std::any_of(pictures.mapped.begin(), pictures.mapped.end(),
                  [](const ReportImage& image) { return short_label(image.label) != image.label; });
  const std::string what = fmt::format("{} from {}", pictures.what, name_of(pictures.frame->position));
  ImageComparison shown{fmt::format("{}. Red: the part enlarged below. {}{}", what, pictures.choice,
                                    shortened ? fmt::format(". {}", kShortLabels) : ""),
                        what + ", tone mapped in several ways",
                        {{"HDR, one exposure", mark_box(expose(hdr, figure_exposure(hdr)), pictures.box)}}};
  for (const ReportImage& image : pictures.mapped)
    shown.images.push_back({short_label(image.label), mark_box(image.image, pictures.box)});
  for (const ReportImage& map : pictures.maps) shown.images.push_back(map);
  result.add_comparison("view", std::move(shown));
  add_enlarged(result, "crop", what, hdr, pictures.mapped, pictures.box, pictures.maps);
}

ReportImage visibility_at(Laboratory& laboratory, const std::string& scene, CameraPosition position) {
  SynthesisOptions options;
  options.threads = laboratory.options().threads;
  return {"Visibility", visibility_map(laboratory.synthesizer(scene).synthesize(position, options))};
}

}  // namespace plenolab
