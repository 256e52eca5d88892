#include "experiments/reproduce/exhibits/tables.h"

namespace plenolab {

using enum ExhibitStatus;

std::span<const Exhibit> doronin_exhibits() {
  static constexpr Exhibit kExhibits[] = {
      {"Figure 1", "placement of virtual cameras", kDiagram, "doronin-fig-2",
       "what three such cameras see; 'plenolab luminance -o' lists all of them in samples.csv"},
      {"Figure 2", "Pillars in HDR", kRerun, "doronin-fig-2", ""},
      {"Figure 3", "estimated luminance", kRerun, "doronin-fig-3", ""},
      {"Figure 4", "PSNR along the line", kRerun, "doronin-fig-4", ""},
      {"Figure 5", "Sphere, tone mapped", kRerun, "doronin-fig-5", ""},
      {"Figure 6", "Pillars, tone mapped", kRerun, "doronin-fig-6", ""},
  };
  return kExhibits;
}

}  // namespace plenolab
