#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/near_eye.h"
#include "experiments/reproduce/laboratory.h"

namespace plenolab {

/// What the items on the near-eye display share during one run: the five scenes, their light fields with
/// every camera rendered (VC) and reprojected (IC), each computed when first asked for and kept. References
/// stay valid. A tiny run has subimages of 27 px (54 rendered) and 5 × 3 cameras 2.8 mm apart.
class NearEyeBench {
 public:
  explicit NearEyeBench(Laboratory& laboratory) : laboratory_(laboratory) {}

  /// A way to make a light field from few cameras.
  struct Recipe {
    ReprojectionMethod method = ReprojectionMethod::kTwoStep;
    HoleFill holes = HoleFill::kMean;
    int cameras = 4, supersampling = 2;
  };

  /// Seconds that a light field took: four cameras rendered and exposed and the rest reprojected, or every
  /// camera rendered and exposed, down-sampling in both. Medians of kTimedRuns runs after one that does not
  /// count; of every camera one run, which takes as long as many of the others, after one that does not
  /// count.
  static constexpr int kTimedRuns = 3;
  struct Timing {
    double cameras_s = 0, reprojection_s = 0, down_sampling_s = 0;
    double every_camera_s = 0;  ///< 0 where it was not asked for
    double reprojected_s() const { return cameras_s + reprojection_s + down_sampling_s; }
    double direct_s() const { return every_camera_s + down_sampling_s; }
  };
  /// Of one scene, all measured together: run by run with supersampling and without.
  struct SceneTiming {
    Timing supersampled, plain;
  };

  const std::vector<std::string>& scene_ids() const;
  const NearEyeScene& scene(const std::string& id, int supersampling = 2);
  CameraArray array(const std::string& id, int supersampling = 2);
  /// Every camera rendered, at the rendered size.
  const DirectLightField& direct(const std::string& id, int supersampling = 2);
  /// True disparity, px per camera, of every pixel of direct().
  const Plane<float>& true_disparity_px(const std::string& id);
  /// direct() at the size of the display's subimages.
  const DisplayImage& truth(const std::string& id, int supersampling = 2);
  const std::vector<RenderedCamera>& cameras(const std::string& id, int cameras, int supersampling = 2);
  /// Reprojected with maps recorded, at the rendered size. Only those of the default recipe are kept: the
  /// others are large and rarely asked for twice.
  std::shared_ptr<const ReprojectionResult> reprojected(const std::string& id, const Recipe& recipe);
  /// The same at the size of the display's subimages.
  DisplayImage image(const std::string& id, const Recipe& recipe);
  /// `with_direct`: rendering every camera takes most of the time of an item.
  const SceneTiming& timing(const std::string& id, bool with_direct = false);
  /// Layout at the size of the display's subimages.
  SubimageLayout subimages(const std::string& id);

  int threads() const { return laboratory_.options().threads; }

 private:
  /// Seconds of cameras, reprojection and down-sampling of a light field that is made and thrown away.
  std::vector<double> time_reprojected(const std::string& id, int supersampling);
  /// Seconds of rendering every camera once more, or for the second time.
  double time_every_camera(const std::string& id, int supersampling);

  using Key = std::tuple<std::string, int>;
  using RecipeKey = std::tuple<std::string, int, int, int, int>;
  static RecipeKey key_of(const std::string& id, const Recipe& recipe) {
    return {id, static_cast<int>(recipe.method), static_cast<int>(recipe.holes), recipe.cameras,
            recipe.supersampling};
  }

  Laboratory& laboratory_;
  std::map<std::string, DirectScene> built_;
  std::map<Key, NearEyeScene> scenes_;
  std::map<Key, DirectLightField> direct_;
  std::map<Key, DisplayImage> truth_;
  std::map<std::string, Plane<float>> true_disparity_px_;
  std::map<std::tuple<std::string, int, int>, std::vector<RenderedCamera>> cameras_;
  std::map<std::string, std::shared_ptr<const ReprojectionResult>> reprojected_;
  std::map<std::string, SceneTiming> timings_;
};

}  // namespace plenolab
