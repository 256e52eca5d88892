#include "experiments/reproduce/display/near_eye_bench.h"

#include "analysis/timing.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

const std::vector<std::string>& NearEyeBench::scene_ids() const {
  static const std::vector<std::string> ids = [] {
    std::vector<std::string> list;
    for (const SceneEntry& entry : near_eye_scenes()) list.emplace_back(entry.id);
    return list;
  }();
  return ids;
}

const NearEyeScene& NearEyeBench::scene(const std::string& id, int supersampling) {
  const Key key{id, supersampling};
  if (const auto found = scenes_.find(key); found != scenes_.end()) return found->second;
  auto built = built_.find(id);
  if (built == built_.end()) built = built_.emplace(id, DirectScene(build_scene(id))).first;
  NearEyeScene made = prepare_near_eye(built->second, supersampling);
  if (laboratory_.options().effort == Effort::kTiny) {
    made.grid.width = made.grid.height = 27 * supersampling;
    made.grid.columns = 5;
    made.grid.rows = 3;
    made.grid.spacing_x_m = made.grid.spacing_y_m = 0.0028;
  }
  return scenes_.emplace(key, std::move(made)).first->second;
}

CameraArray NearEyeBench::array(const std::string& id, int supersampling) {
  return camera_array(scene(id, supersampling).grid);
}

SubimageLayout NearEyeBench::subimages(const std::string& id) {
  return array(id, 1).layout;
}

const DirectLightField& NearEyeBench::direct(const std::string& id, int supersampling) {
  const Key key{id, supersampling};
  if (const auto found = direct_.find(key); found != direct_.end()) return found->second;
  return direct_.emplace(key, render_directly(scene(id, supersampling), threads())).first->second;
}

const Plane<float>& NearEyeBench::true_disparity_px(const std::string& id) {
  if (const auto found = true_disparity_px_.find(id); found != true_disparity_px_.end()) return found->second;
  Plane<float> disparity = direct(id).depth_m;
  const double at_one_metre = array(id).disparity_px(1);
  for (float& v : disparity.pixels()) v = static_cast<float>(at_one_metre / static_cast<double>(v));
  return true_disparity_px_.emplace(id, std::move(disparity)).first->second;
}

const DisplayImage& NearEyeBench::truth(const std::string& id, int supersampling) {
  const Key key{id, supersampling};
  if (const auto found = truth_.find(key); found != truth_.end()) return found->second;
  return truth_
      .emplace(key, to_subimages(direct(id, supersampling).light_field, array(id, supersampling).layout,
                                 supersampling, threads()))
      .first->second;
}

const std::vector<RenderedCamera>& NearEyeBench::cameras(const std::string& id, int cameras,
                                                         int supersampling) {
  const std::tuple key{id, cameras, supersampling};
  if (const auto found = cameras_.find(key); found != cameras_.end()) return found->second;
  return cameras_.emplace(key, render_cameras(scene(id, supersampling), cameras, threads())).first->second;
}

std::shared_ptr<const ReprojectionResult> NearEyeBench::reprojected(const std::string& id,
                                                                    const Recipe& recipe) {
  const bool kept = key_of(id, recipe) == key_of(id, {});
  if (const auto found = reprojected_.find(id); kept && found != reprojected_.end()) return found->second;
  const ReprojectionOptions options{recipe.method, recipe.holes, true, threads()};
  auto result = std::make_shared<const ReprojectionResult>(
      reproject(array(id, recipe.supersampling), cameras(id, recipe.cameras, recipe.supersampling), options));
  if (kept) reprojected_.emplace(id, result);
  return result;
}

DisplayImage NearEyeBench::image(const std::string& id, const Recipe& recipe) {
  return to_subimages(reprojected(id, recipe)->light_field, array(id, recipe.supersampling).layout,
                      recipe.supersampling, threads());
}

std::vector<double> NearEyeBench::time_reprojected(const std::string& id, int supersampling) {
  const NearEyeScene& prepared = scene(id, supersampling);
  const CameraArray cameras_array = array(id, supersampling);
  std::vector<double> seconds;
  const auto timed = [&](const auto& work) {
    const Stopwatch watch;
    auto made = work();
    seconds.push_back(watch.seconds());
    return made;
  };
  const auto rendered = timed([&] { return render_cameras(prepared, Recipe{}.cameras, threads()); });
  const ReprojectionResult result =
      timed([&] { return reproject(cameras_array, rendered, {.threads = threads()}); });
  timed([&] { return to_subimages(result.light_field, cameras_array.layout, supersampling, threads()); });
  return seconds;
}

double NearEyeBench::time_every_camera(const std::string& id, int supersampling) {
  direct(id, supersampling);  // the run that does not count
  return render_directly(scene(id, supersampling), threads()).seconds;
}

const NearEyeBench::SceneTiming& NearEyeBench::timing(const std::string& id, bool with_direct) {
  if (const auto found = timings_.find(id);
      found != timings_.end() && (!with_direct || found->second.plain.every_camera_s > 0))
    return found->second;
  const auto medians =
      medians_in_turn({[&] { return time_reprojected(id, 2); }, [&] { return time_reprojected(id, 1); }},
                      {.runs = kTimedRuns});
  const auto timing_of = [&](const std::vector<double>& stages, int supersampling) {
    return Timing{stages[0], stages[1], stages[2], with_direct ? time_every_camera(id, supersampling) : 0};
  };
  const SceneTiming timing{timing_of(medians[0], 2), timing_of(medians[1], 1)};
  return timings_.insert_or_assign(id, timing).first->second;
}

}  // namespace plenolab
