#include "experiments/metric_maps.h"

#include <algorithm>
#include <type_traits>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "experiments/score.h"
#include "metrics/drim.h"
#include "metrics/error_map.h"
#include "metrics/ssim.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

template <class Test, class Reference>
constexpr bool kComparable = std::is_same_v<Test, DisplayImage> || std::is_same_v<Reference, SceneImage>;

DisplayImage grey(const Plane<float>& values) {
  DisplayImage image(values.width(), values.height());
  for (std::size_t i = 0; i < values.size(); ++i)
    image.pixels()[i] = Rgb{1, 1, 1} * std::clamp(values.pixels()[i], 0.0f, 1.0f);
  return image;
}

DisplayImage backdrop_of(const DisplayImage& image, const ComparisonConditions&) {
  return image;
}

DisplayImage backdrop_of(const SceneImage& image, const ComparisonConditions& conditions) {
  return expose(image, conditions.exposure);
}

void write_drim(const DrimMaps& maps, const DisplayImage& backdrop, const fs::path& folder) {
  write_display_image(folder / "drim.png", drim_false_colour(maps, backdrop));
  write_display_image(folder / "drim-loss.png", grey(maps.loss));
  write_display_image(folder / "drim-amplification.png", grey(maps.amplification));
  write_display_image(folder / "drim-reversal.png", grey(maps.reversal));
}

template <class Test, class Reference>
void write_maps(const Metric& metric, const Test& test, const Reference& reference,
                const ComparisonConditions& conditions, const fs::path& folder) {
  if constexpr (std::is_same_v<Test, Reference>) {
    if (metric.name == "ssim_gamma")
      write_display_image(folder / "ssim.png", grey(ssim_map(test, reference, conditions)));
    if (metric.name == "difference_gamma")
      write_display_image(folder / "difference.png", error_map(test, reference, conditions));
  }
}

/// Numbers and maps of DRIM from one computation, which takes seconds.
template <class Test, class Reference>
std::vector<Measurement> drim_with_maps(const Test& test, const Reference& reference,
                                        const ComparisonConditions& conditions, const fs::path& folder) {
  const DrimMaps maps = drim_maps(test, reference, conditions);
  write_drim(maps, backdrop_of(test, conditions), folder);
  return drim_measurements(maps, conditions.valid);
}

template <class Test, class Reference>
std::vector<Measurement> measure_pair(const Test& test, const Reference& reference,
                                      const std::vector<const Metric*>& chosen,
                                      const ComparisonConditions& conditions, const fs::path& folder) {
  if constexpr (!kComparable<Test, Reference>) {
    throw InputError(
        "the test image has radiance and the reference is a display image; give the tone mapped image as the "
        "test and its scene as the reference");
  } else {
    if (folder.empty()) return measure(test, reference, chosen, conditions);
    std::vector<Measurement> all;
    for (const Metric* metric : chosen) {
      std::vector<Measurement> rows = metric->name == "drim"
                                          ? drim_with_maps(test, reference, conditions, folder)
                                          : measure(test, reference, {metric}, conditions);
      write_maps(*metric, test, reference, conditions, folder);
      std::move(rows.begin(), rows.end(), std::back_inserter(all));
    }
    return all;
  }
}

}  // namespace

std::vector<Measurement> measure_with_maps(const ComparedImage& test, const ComparedImage& reference,
                                           const std::vector<const Metric*>& chosen,
                                           const ComparisonConditions& conditions, const fs::path& folder) {
  return std::visit(
      [&](const auto& a, const auto& b) { return measure_pair(a, b, chosen, conditions, folder); }, test,
      reference);
}

}  // namespace plenolab
