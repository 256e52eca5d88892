#include "experiments/reproduce/reproduction.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace plenolab {

void ReproductionResult::add_plot(const std::string& name, ReportPlot plot) {
  blocks.emplace_back(plot);
  plots.push_back({name, std::move(plot)});
}

namespace {
std::string file_name(std::string label) {
  for (char& c : label) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
  }
  return label;
}
}  // namespace

void ReproductionResult::add_comparison(const std::string& name, ImageComparison comparison,
                                        std::vector<SceneImage> radiance) {
  for (std::size_t i = 0; i < comparison.images.size(); ++i) {
    const ReportImage& image = comparison.images[i];
    images.push_back({name + "-" + file_name(image.label), image.image,
                      i < radiance.size() ? std::move(radiance[i]) : SceneImage{}});
  }
  blocks.emplace_back(std::move(comparison));
}

const char* title_of(Chapter chapter) {
  switch (chapter) {
    case Chapter::kScenes:
      return "Scenes";
    case Chapter::kGeometry:
      return "Geometry";
    case Chapter::kAppearance:
      return "Appearance";
    case Chapter::kQuality:
      return "Quality of synthesised views";
    case Chapter::kOperators:
      return "Tone mapping operators";
    case Chapter::kConsistency:
      return "Consistency of tone mapping";
    case Chapter::kDisplay:
      return "A near-eye light-field display";
    case Chapter::kStudy:
      return "What participants could tell apart";
    case Chapter::kCalibration:
      return "Calibration of the display";
    case Chapter::kLuminance:
      return "Luminance on a projector display";
    case Chapter::kOptimisation:
      return "Tone mapping tuned by metrics";
    case Chapter::kLuts:
      return "Look-up tables";
    case Chapter::kSpeed:
      return "Error against run time";
    case Chapter::kClaims:
      return "Claims";
  }
  return "";
}

std::vector<const Reproduction*> select_reproductions(const std::vector<std::string>& ids) {
  const auto wanted = [&](const char* id) {
    return ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end() ||
           std::find(ids.begin(), ids.end(), "all") != ids.end();
  };
  std::vector<const Reproduction*> chosen;
  std::string known;
  for (const Reproduction& item : reproductions()) {
    known += (known.empty() ? "" : ", ") + std::string(item.id);
    if (wanted(item.id)) chosen.push_back(&item);
  }
  for (const std::string& id : ids) {
    const bool is_known = id == "all" || std::any_of(reproductions().begin(), reproductions().end(),
                                                     [&](const Reproduction& item) { return id == item.id; });
    if (!is_known) throw UsageError(fmt::format("there is no reproduction '{}'; there are: {}", id, known));
  }
  return chosen;
}

}  // namespace plenolab
