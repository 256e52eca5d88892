#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "stimuli/direct/lit_scene.h"

namespace plenolab {

/// Ten sequences of nine HDR frames that look like those of video games, for tone mapping of rendered
/// content. Zhao 2019 took captures of ten Unreal demos (DML-Video-Gaming-Content-HDR), which are not ours to
/// give away; these are named after them, stand in the same lighting categories and are drawn in the way of
/// games: large surfaces of one material, analytic lights with hard shadows, even ambient light without
/// occlusion, reflections off polished floors, nothing scattered twice.
enum class GameLight { kDarkHighContrast, kDarkLowContrast, kBrightHighContrast, kBrightLowContrast };

/// "dark, high contrast" …
const char* name_of(GameLight light);

/// What the categories mean here, in terms of a frame's pixels above 0: dark below and bright above a
/// geometric mean luminance; low below and high above a number of decades that hold the middle 99 %.
inline constexpr double kDarkBelow_cd_m2 = 5, kBrightAbove_cd_m2 = 30;
inline constexpr double kLowContrastBelow_log10 = 2.25, kHighContrastAbove_log10 = 2.75;

inline constexpr int kGameFrames = 9;

struct GameCamera {
  Vec3 position_m, target_m;
};

/// A scene and the way of the camera through it.
struct GameScene {
  LitScene lit;
  GameCamera first, last;  ///< of frames 0 and kGameFrames − 1; even steps in between
  float fov_h_deg = 75;
};

struct GameSequence {
  const char* id;     ///< "after-sun-temple"
  const char* title;  ///< "after Sun Temple"
  GameLight light;    ///< category that the thesis gives its namesake
  GameScene (*build)();
};

/// In the order of the categories.
std::span<const GameSequence> game_sequences();

/// A scene ready for frames. Cheap to copy; copies share.
class GameRenderer {
 public:
  explicit GameRenderer(const GameScene& scene);
  /// Frame in [0, kGameFrames) in cd/m²: 2×2 rays a pixel. Deterministic, the same for any number of threads.
  SceneImage frame(int frame, int width, int height, int threads = 0) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

/// What decides the category of a frame.
struct GameExposure {
  double geometric_mean_cd_m2 = 0;
  double range_log10 = 0;  ///< between the 0.5th and the 99.5th percentile
};
/// Of the pixels above 0; all 0 if there is none.
GameExposure exposure_of(const SceneImage& frame_cd_m2);

}  // namespace plenolab
