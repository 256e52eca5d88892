#include "stimuli/scenes/cellar_room.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

Scene build_cellar_shafts() {
  Scene scene = cellar_room();
  scene.id = "cellar-shafts";
  scene.title = "Cellar with light shafts";
  scene.description =
      "The cellar filled with dust: light shafts lie before the surfaces whose disparity they get, so that "
      "copies of them fade in and out and are cut off at disocclusions.";
  scene.medium = Medium{.min_m = {-2.4f, -2.5f, -0.1f},
                        .max_m = {2.6f, 7.5f, 2.45f},
                        .scattering_per_m = 0.0045f,
                        .absorption_per_m = 0.0005f,
                        .anisotropy = 0.6f};
  return scene;
}

}  // namespace plenolab
