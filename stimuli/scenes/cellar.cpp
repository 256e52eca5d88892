#include "stimuli/scenes/cellar_room.h"
#include "stimuli/scenes/table.h"

namespace plenolab {

Scene build_cellar() {
  Scene scene = cellar_room();
  scene.id = "cellar";
  scene.title = "Cellar";
  scene.description =
      "Dark interior with sun through ceiling slits and a window; the near timber post leaves some frustums, "
      "so that "
      "background behind it is seen by no key view, and the sun is suddenly occluded.";
  return scene;
}

}  // namespace plenolab
