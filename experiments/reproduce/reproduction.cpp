#include "experiments/reproduce/reproduction.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "experiments/cli/suggest.h"
#include "experiments/reproduce/exhibits/exhibits.h"

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

namespace {

/// One sentence on an id that is none, with where to look instead.
std::string unknown_item(const std::string& id, const std::vector<std::string>& known) {
  const auto [paper, exhibit] = exhibit_called(id);
  if (exhibit && *exhibit->item)
    return fmt::format("'{}' is no item of its own: {} of {} is in '{}'", id, exhibit->name, paper->name,
                       exhibit->item);
  if (exhibit)
    return fmt::format("{} of {} is not reproduced ({}: {})", exhibit->name, paper->name,
                       name_of(exhibit->status), exhibit->note);
  return fmt::format("there is no reproduction '{}'{} 'plenolab reproduce --list' lists all {}", id,
                     did_you_mean(id, known).empty() ? ";" : did_you_mean(id, known), known.size());
}

}  // namespace

std::vector<const Reproduction*> select_reproductions(const std::vector<std::string>& ids) {
  const auto is_wanted = [&](const std::string& id) {
    return ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end() ||
           std::find(ids.begin(), ids.end(), "all") != ids.end();
  };
  std::vector<const Reproduction*> chosen;
  std::vector<std::string> known;
  for (const Reproduction& item : reproductions()) {
    known.emplace_back(item.id);
    if (is_wanted(item.id)) chosen.push_back(&item);
  }
  for (const std::string& id : ids)
    if (id != "all" && std::find(known.begin(), known.end(), id) == known.end())
      throw UsageError(unknown_item(id, known));
  return chosen;
}

}  // namespace plenolab
