#include "experiments/reproduce/exhibits/tables.h"

namespace plenolab {

using enum ExhibitStatus;

std::span<const Exhibit> altmeier_exhibits() {
  static constexpr Exhibit kExhibits[] = {
      {"Figure 1", "camera array and lenslet camera", kNotReproducible, "", "photographs of hardware"},
      {"Figure 2", "stages of bilateral tone mapping", kDiagram, "altmeier-fig-22",
       "its stages as images of a key view"},
      {"Figure 3", "curves of Reinhard & Devlin", kRecomputed, "altmeier-fig-3", ""},
      {"Figure 4", "histogram equalisation", kRerun, "altmeier-fig-4", ""},
      {"Figure 5", "trimming of the histogram", kRecomputed, "altmeier-fig-5",
       "the pseudo-code as a log of its passes"},
      {"Figure 6", "capture with camera arrays", kNotReproducible, "", "photographs of hardware"},
      {"Figure 7", "capture with a lenslet camera", kNotReproducible, "", "photographs of hardware"},
      {"Figure 8", "capture of the space shuttle", kNotReproducible, "", "photographs of hardware"},
      {"Figure 9", "prototype of a near-eye display", kNotReproducible, "", "photographs of hardware"},
      {"Figure 10", "a 360° light-field display", kNotReproducible, "", "photographs of hardware"},
      {"Figure 11", "the scenes", kRerun, "altmeier-fig-11", ""},
      {"Figure 12", "camera plane of the array", kDiagram, "", "the geometry is that of core/lightfield"},
      {"Figure 13", "epipolar geometry", kDiagram, "", "'plenolab epi' draws measured epipolar lines"},
      {"Figure 14", "disparity", kDiagram, "", "'plenolab info' checks disparity by warping neighbours"},
      {"Figure 15", "search in the disparity map", kDiagram, "altmeier-claim-g1",
       "what the step of the search costs and saves"},
      {"Figure 16", "visible pixels of a warped key view", kRerun, "altmeier-fig-16", ""},
      {"Figure 17", "visibility behind occluders", kRerun, "altmeier-claim-g4",
       "counted behind placed occluders; several of them: altmeier-claim-g5"},
      {"Figure 18", "modelling of a BRDF", kNotReproducible, "", "another paper's images"},
      {"Figure 19", "points at different depths", kNotReproducible, "", "another paper's drawing"},
      {"Figure 20", "interpolated reflection of a glossy surface", kDiagram, "altmeier-claim-a2",
       "the error of glossy surfaces"},
      {"Figure 21", "an edge through the naive bilateral operator", kRecomputed, "altmeier-fig-21", ""},
      {"Figure 22", "the naive bilateral operator on a key view", kRerun, "altmeier-fig-22", ""},
      {"Figure 23", "an edge without foreground layer", kRecomputed, "altmeier-fig-23", ""},
      {"Figure 24", "an edge through the enhanced operator", kRecomputed, "altmeier-fig-24", ""},
      {"Figure 25", "the enhanced bilateral operator on a key view", kRerun, "altmeier-fig-25", ""},
      {"Figure 26", "smallest visible difference", kRecomputed, "altmeier-fig-26", ""},
      {"Figure 27", "histogram adjustment by trimming passes", kRerun, "altmeier-fig-27", ""},
      {"Figure 28", "neighbouring key views, mapped naively", kRerun, "altmeier-fig-28", ""},
      {"Figure 29", "neighbouring key views, joint statistics", kRerun, "altmeier-fig-29", ""},
      {"Figure 30", "neighbouring key views, adjusted", kRerun, "altmeier-fig-30", ""},
      {"Figure 31", "background that no key view shows", kRerun, "altmeier-fig-31", ""},
      {"Figure 32", "restored sky", kRerun, "altmeier-fig-32", ""},
      {"Figure 33", "thin branches are lost", kRerun, "altmeier-fig-33", ""},
      {"Figure 34", "copies of light shafts", kRerun, "altmeier-fig-34", ""},
      {"Figure 35", "copies of reflections", kRerun, "altmeier-fig-35", ""},
      {"Figure 36", "rippled water", kRerun, "altmeier-fig-36", ""},
      {"Figure 37", "a light shaft cut off", kRerun, "altmeier-fig-37", ""},
      {"Figure 38", "bilateral operator at borders of visibility", kRerun, "altmeier-fig-38", ""},
      {"Figure 39", "naive Reinhard 2005 with a stable highlight", kRerun, "altmeier-fig-39", ""},
      {"Figure 40", "border regions of key views", kRerun, "altmeier-fig-40", ""},
      {"Figure 41", "borders of visibility", kRerun, "altmeier-fig-41", ""},
      {"Figure 42", "adaptation over a motion, Desk", kRerun, "altmeier-fig-42", ""},
      {"Figure 43", "adaptation over a motion, Cellar", kRerun, "altmeier-fig-43", ""},
      {"Figure 44", "adaptation over a motion, Dunes", kRerun, "altmeier-fig-44", ""},
      {"Figure 45", "failure of histogram adjustment", kRerun, "altmeier-fig-45", ""},
      {"Figure 46", "failure of bilateral filtering", kRerun, "altmeier-fig-46", ""},
      {"Figure 47", "failure of Reinhard 2005", kRerun, "altmeier-fig-47", ""},
  };
  return kExhibits;
}

}  // namespace plenolab
