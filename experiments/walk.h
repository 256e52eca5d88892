#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/lut/colour_transfer.h"
#include "core/lut/volumes.h"
#include "stimuli/direct/lit_view.h"
#include "stimuli/direct/walk_scene.h"

namespace plenolab {

/// A walk through three post-processing volumes (stimuli/direct/walk_scene.h), what the report items on
/// look-up tables and their sweep share.

/// One place of the walk.
struct WalkPose {
  std::string leg;       ///< what the walker does, e.g. "along the corridor"
  bool turning = false;  ///< stands between two volumes, where the walker turns by 180°
  DepthCamera camera;
};

/// The walk, about 40 poses at `density` 1: along the corridor; half a turn on the spot between corridor and
/// hall, back to the door, and the other half while entering the hall; through the hall; the same between
/// hall and garden house; and a look out of that. Positive densities change the number of poses of each leg
/// alike, to no fewer than one.
std::vector<WalkPose> walk_path(double density = 1);

/// What the camera records.
struct WalkFrame {
  WalkPose pose;
  SceneImage radiance;   ///< cd/m²
  DisplayImage picture;  ///< not graded; the same exposure everywhere
  Plane<float> depth_m;  ///< planar, ∞ for the sky
  Plane<int> object;     ///< −1 for the sky
};

/// The scene with its volumes, ready for cameras. Copies share.
class WalkStage {
 public:
  WalkStage();

  const std::vector<std::string>& objects() const { return scene_.objects; }
  /// Corridor, hall and garden house, each with a blend radius of 2.5 m and weight 1.
  const std::vector<Volume>& volumes() const { return volumes_; }
  WalkFrame frame(const WalkPose& pose, int width, int height, int threads = 0) const;
  /// Depth and objects alone; the images are empty.
  WalkFrame surfaces(const WalkPose& pose, int width, int height, int threads = 0) const;

 private:
  WalkScene scene_;
  LitViews views_;
  std::vector<Volume> volumes_;
};

/// Index of the frame in which most pixels show a volume, −1: the background, by the counts of the frames. At
/// least one frame.
std::size_t frame_that_shows_most(std::span<const VolumeCounts> counts, int volume);

/// A look: the table of a volume and how it was made, by transferring the colours of a painted palette to a
/// picture of the walk.
struct WalkLook {
  std::string name;   ///< e.g. "cold steel"
  std::string place;  ///< of the volume, or "background"
  DisplayImage source, palette;
  ColourTransfer transfer;
};

/// The palette of look `index` as a picture: lightness from left to right, its colours by three anchors, with
/// a spread that is a hash of the pixel. Looks 0 … 2 are those of the volumes, 3 is the background's.
inline constexpr int kWalkLooks = 4;
DisplayImage walk_palette(int index, int width, int height);

/// A look made from a picture. `index` as above.
WalkLook make_walk_look(int index, const DisplayImage& source, int size = kDefaultLutSize,
                        std::uint64_t seed = 1);

/// All looks, each made from the frame that shows most of its place: picture_of(i) is the picture of frame i
/// of the `counts`.
std::vector<WalkLook> make_walk_looks(std::span<const VolumeCounts> counts,
                                      const std::function<DisplayImage(std::size_t)>& picture_of,
                                      std::uint64_t seed = 1);

}  // namespace plenolab
