#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/display/subimages.h"
#include "core/lightfield/light_field.h"
#include "core/reprojection/reprojection.h"
#include "stimuli/direct/direct_view.h"
#include "stimuli/render.h"

namespace plenolab {

/// Light-field images of scenes for the near-eye display, by reprojection (IC of the thesis) or with every
/// camera rendered (VC): what the command, the sweep, the benchmark and the report items share.

/// Pixels of a subimage on the display's light field (section 3.2).
inline constexpr int kSubimagePixels = 81;

/// A scene ready to be rendered for the display.
struct NearEyeScene {
  DirectScene scene;
  ViewGrid grid;       ///< cameras; images `supersampling` times the subimage's size
  float exposure = 1;  ///< the same for all cameras and both methods
  int supersampling = 2;
};

/// `supersampling` is 1, 2 or 4. The scene's quick preset says how many cameras there are, and how far apart;
/// the subimages have 81 px. `fov_deg` > 0 replaces the angle of the preset. The exposure brings the 99th
/// percentile of the top-left camera to 1.
NearEyeScene prepare_near_eye(const DirectScene& scene, int supersampling = 2, double fov_deg = 0);

/// The array of a grid of square views, equally far apart. Throws InputError for any other grid.
CameraArray camera_array(const ViewGrid& grid);

/// The corner cameras, and the central one if `cameras` is 5.
std::vector<std::array<int, 2>> rendered_positions(const SubimageLayout& layout, int cameras);

std::vector<RenderedCamera> render_cameras(const NearEyeScene& scene, int cameras, int threads);
/// The same from a recorded light field, radiance exposed by `exposure`.
std::vector<RenderedCamera> cameras_of(const LightField& field, int cameras, float exposure);

/// Every camera rendered.
struct DirectLightField {
  DisplayImage light_field;
  Plane<float> depth_m;
  double seconds = 0;
};
DirectLightField render_directly(const NearEyeScene& scene, int threads);
DirectLightField directly_from(const LightField& field, float exposure);

/// Down to the display's subimages: halved once or twice (core/display/subimages.h), or as it is.
DisplayImage to_subimages(const DisplayImage& light_field, SubimageLayout layout, int supersampling,
                          int threads);

/// The code of 8 bits of an encoded value, clipped to [0, 1]: displays show no more, and differences are
/// taken between codes.
int display_code(float value);

/// |a − b| of one channel over the whole light field, codes of 8 bits in [0, 1] (tables 5.2 to 5.4).
struct ChannelDifference {
  double min = 0, max = 0, mean = 0, median = 0;
};
std::array<ChannelDifference, 3> difference_statistics(const DisplayImage& a, const DisplayImage& b);
/// Mean of the three channels' means.
double mean_difference(const std::array<ChannelDifference, 3>& channels);

/// |a − b| · gain, clipped at 1, for looking.
DisplayImage difference_picture(const DisplayImage& a, const DisplayImage& b, float gain);

/// Names of methods and fills on the command line and in results, and what they stand for.
const std::vector<std::string>& hole_fill_names();
HoleFill hole_fill_named(const std::string& name);
std::string name_of(HoleFill fill);
std::string name_of(ReprojectionMethod method);

}  // namespace plenolab
