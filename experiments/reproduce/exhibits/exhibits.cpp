#include "experiments/reproduce/exhibits/exhibits.h"

#include <array>

#include "experiments/reproduce/exhibits/tables.h"

namespace plenolab {

const char* name_of(ExhibitStatus status) {
  static constexpr std::array kNames{"recomputed", "re-run on our stimuli", "diagram", "not reproducible"};
  return kNames[static_cast<std::size_t>(status)];
}

std::span<const Paper> papers() {
  static const std::array kPapers{
      Paper{"Altmeier 2018", "Tonemapping approaches for rendering sparse HDR-lightfields",
            altmeier_exhibits()},
      Paper{"Doronin & Barsi", "Estimation of global luminance for HoloVizio 3D display", doronin_exhibits()},
      Paper{"Hansen & Klein 2016", "Rendering the Light Field", hansen_thesis_exhibits()},
      Paper{"Hansen, Klein & Kraus", "Pixel reprojection for light field displays", hansen_paper_exhibits()},
      Paper{"Zhao 2019", "Tone mapping optimization for real time applications", zhao_exhibits()}};
  return kPapers;
}

}  // namespace plenolab
