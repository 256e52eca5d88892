#include "experiments/reproduce/luminance/luminance_bench.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/luminance/projector_display.h"
#include "experiments/reproduce/luminance/luminance_tools.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

namespace {

constexpr int kPositions = 49;

}  // namespace

const std::vector<std::string>& LuminanceBench::scene_ids() const {
  static const std::vector<std::string> ids = [] {
    std::vector<std::string> list;
    for (const LitSceneEntry& entry : display_scenes()) list.emplace_back(entry.id);
    return list;
  }();
  return ids;
}

std::vector<LuminanceMethod> LuminanceBench::methods() const {
  return {LuminanceMethod::kAll, LuminanceMethod::kBruteForce, LuminanceMethod::kAccumulative,
          LuminanceMethod::kSpread};
}

ProjectorDisplayOptions LuminanceBench::display_options() const {
  if (options_.effort == Effort::kTiny) return {.projectors = 12, .width = 40, .height = 22};
  return projector_display_options(options_.effort == Effort::kPaper ? DisplayPreset::kPaper
                                                                     : DisplayPreset::kSmall);
}

LuminanceOptions LuminanceBench::method_options(LuminanceMethod method) {
  const ProjectorDisplayOptions display = display_options();
  return {.method = method, .pinhole = {display.width, display.height}, .threads = options_.threads};
}

const ShownField& LuminanceBench::field(const std::string& id, int projectors) {
  ProjectorDisplayOptions display = display_options();
  if (projectors > 0) display.projectors = projectors;
  const std::pair key{id, display.projectors};
  if (const auto found = fields_.find(key); found != fields_.end()) return found->second;
  return fields_
      .emplace(key, show_scene(build_display_scene(id), std::make_shared<const ProjectorDisplay>(display),
                               rendering()))
      .first->second;
}

ObserverSamples LuminanceBench::samples() {
  const int count = options_.effort == Effort::kTiny ? 50 : options_.effort == Effort::kQuick ? 200 : 1000;
  return samples_of(ProjectorDisplay(display_options()), count);
}

const GlobalLuminance& LuminanceBench::estimate(const std::string& id, const LuminanceOptions& options,
                                                int projectors) {
  const std::tuple key{
      id, projectors,
      fmt::format("{} {}x{}", setting_name(options), options.pinhole.width, options.pinhole.height)};
  if (const auto found = estimates_.find(key); found != estimates_.end()) return found->second;
  const ShownField& shown = field(id, projectors);
  return estimates_.emplace(key, estimate_luminance(*shown.display, shown.luminance, samples(), options))
      .first->second;
}

LuminanceBench::Scores LuminanceBench::score(const std::string& id) {
  const ShownField& shown = field(id);
  const PinholeSize size = shown.display->resolution();
  Scores scores;
  std::vector<ReferencePictures> references;
  const ObserverSamples positions =
      samples_of(*shown.display, options_.effort == Effort::kTiny ? 5 : kPositions);
  for (int i = 0; i < positions.size(); ++i) {
    scores.x_m.push_back(positions.position(i).x_m);
    references.push_back(reference_pictures(shown, positions.position(i), size, {}, {}, rendering()));
  }
  for (const LuminanceMethod method : methods()) {
    const GlobalLuminance& estimated = estimate(id, method_options(method));
    const DisplayRays mapped = map_rays(*shown.display, shown.rays, estimated, {}, options_.threads).light;
    std::vector<double> truth_db, result_db;
    std::vector<std::optional<double>> ln_error;
    for (std::size_t i = 0; i < references.size(); ++i) {
      const ObserverPosition at{scores.x_m[i], 0};
      const DisplayLightImage seen = perceive(*shown.display, mapped, at, size, options_.threads).image;
      truth_db.push_back(light_psnr_db(seen, references[i].ground_truth));
      result_db.push_back(light_psnr_db(seen, references[i].on_result));
      ln_error.push_back(difference(estimated.ln_at(at), references[i].ln_truth));
    }
    scores.ground_truth_db.push_back(std::move(truth_db));
    scores.on_result_db.push_back(std::move(result_db));
    scores.ln_error.push_back(std::move(ln_error));
  }
  return scores;
}

const LuminanceBench::Scores& LuminanceBench::scores(const std::string& id) {
  if (const auto found = scores_.find(id); found != scores_.end()) return found->second;
  return scores_.emplace(id, score(id)).first->second;
}

std::vector<LuminanceBench::ShownView> LuminanceBench::show(const std::string& id) {
  std::vector<ShownView> views{
      {.x_m = -4, .name = "left"}, {.x_m = 0, .name = "centre"}, {.x_m = 4, .name = "right"}};
  std::vector<ObserverPosition> observers;
  for (const ShownView& view : views) observers.push_back({view.x_m, 0});
  ProjectorDisplayOptions options = display_options();
  if (options_.effort == Effort::kQuick) options.width = 400, options.height = 225;
  const ShownField large = show_scene_to(
      build_display_scene(id), std::make_shared<const ProjectorDisplay>(options), observers, rendering());
  const RayDisplay& display = *large.display;
  for (ShownView& view : views)
    view.references = reference_pictures(large, {view.x_m, 0}, display.resolution(), {}, {}, rendering());
  for (const LuminanceMethod method : methods()) {
    const DisplayRays mapped =
        map_rays(display, large.rays, estimate(id, method_options(method)), {}, options_.threads).light;
    for (ShownView& view : views)
      view.mapped.push_back(
          perceive(display, mapped, {view.x_m, 0}, display.resolution(), options_.threads).image);
  }
  return views;
}

const std::vector<LuminanceBench::ShownView>& LuminanceBench::shown_views(const std::string& id) {
  if (const auto found = shown_.find(id); found != shown_.end()) return found->second;
  return shown_.emplace(id, show(id)).first->second;
}

}  // namespace plenolab
