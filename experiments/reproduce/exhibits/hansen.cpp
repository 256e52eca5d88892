#include "experiments/reproduce/exhibits/tables.h"

namespace plenolab {

using enum ExhibitStatus;

std::span<const Exhibit> hansen_thesis_exhibits() {
  static constexpr Exhibit kExhibits[] = {
      {"Figure 2.1", "vergence and accommodation", kNotReproducible, "", "a textbook drawing of the eye"},
      {"Figure 2.2", "their conflict", kNotReproducible, "", "a textbook drawing of the eye"},
      {"Figure 2.3", "the light slab", kNotReproducible, "", "another paper's drawing"},
      {"Figure 2.4", "light through a lens array", kNotReproducible, "", "a textbook drawing of lenses"},
      {"Figure 3.1", "an observer looks through the lens array", kDiagram, "",
       "'plenolab reproject --eye' shows what the observer sees"},
      {"Figure 3.2", "circle of confusion", kRecomputed, "hansen-fig-3.2", ""},
      {"Figure 3.3", "a light field as a collection of images", kRerun, "hansen-fig-f.1",
       "the whole light field of each scene, all subimages side by side"},
      {"Figure 3.4", "flowchart of the process", kDiagram, "",
       "of a program: core/reprojection/reprojection.h is its entry"},
      {"Figure 3.5", "projection of vertices", kDiagram, "",
       "of how vertices are projected; the cameras are those of core/display/near_eye_optics.h"},
      {"Figure 3.6", "reprojection between two cameras", kDiagram, "hansen-claim-h11",
       "its two steps against one"},
      {"Figure 3.7", "what corner cameras cannot see", kRerun, "hansen-claim-h3",
       "shares of holes with four and five cameras"},
      {"Figure 3.8", "ways to fill holes", kRerun, "hansen-fig-3.8", ""},
      {"Figure 3.9", "flowchart of reprojection", kDiagram, "",
       "of a program: core/reprojection/reprojection.h is its entry"},
      {"Figure 4.1", "the controller", kNotReproducible, "", "a photograph of hardware"},
      {"Figure 5.1", "centre subimages of five scenes", kRerun, "hansen-fig-5.1", ""},
      {"Figure 5.2", "choices and the critical number", kRecomputed, "hansen-fig-5.2", ""},
      {"Table 5.1", "choices of 34 participants", kRecomputed, "hansen-table-5.1", ""},
      {"Table 5.2", "largest differences", kRerun, "hansen-table-5.2", ""},
      {"Figure 5.3", "extreme occlusion", kRerun, "hansen-fig-5.3", ""},
      {"Table 5.3", "mean differences", kRerun, "hansen-table-5.3", ""},
      {"Figure 5.4", "edges and textures", kRerun, "hansen-fig-5.4", ""},
      {"Table 5.4", "median differences", kRerun, "hansen-table-5.4", ""},
      {"Figure A.1", "the headset", kNotReproducible, "", "a photograph of hardware"},
      {"Figure A.2", "quality of lenslets", kNotReproducible, "", "a photograph of hardware"},
      {"Figure A.3", "printed parts", kNotReproducible, "", "a photograph of hardware"},
      {"Figure B.1", "subimages aligned with lenslets", kRerun, "hansen-fig-b.1",
       "the photographs' subject as computed grids"},
      {"Figure C.1", "moving the camera to find the field of view", kDiagram, "",
       "'plenolab calibrate --simulate' is that measurement"},
      {"Figure C.2", "finding the field of view", kDiagram, "", "of the same measurement"},
      {"Figure C.3", "confirming the field of view", kRerun, "hansen-fig-c.3", ""},
      {"Figure C.4", "confirming it with two spheres", kRerun, "hansen-fig-c.4", ""},
      {"Figure D.1", "scaling of the screen", kRerun, "hansen-fig-d.1", ""},
      {"Figure E.1", "scenes of the initial experiment", kRerun, "hansen-fig-5.1",
       "our scenes of the final experiment; those of the initial one had other textures, which are not "
       "described"},
      {"Table in E", "choices in the initial experiment", kRecomputed, "hansen-table-e", ""},
      {"Figure E.2", "without supersampling, with black holes", kRerun, "hansen-fig-e.2", ""},
      {"Figure F.1", "difference images", kRerun, "hansen-fig-f.1", ""},
      {"Figure G.1", "direction of look-up in two steps", kDiagram, "hansen-claim-h11",
       "one step against two"},
      {"Figure G.2", "small and large slope", kDiagram, "",
       "of slopes on the way of one step; core/reprojection/search_literal.cpp walks it"},
  };
  return kExhibits;
}

std::span<const Exhibit> hansen_paper_exhibits() {
  static constexpr Exhibit kExhibits[] = {
      {"Figure 1", "an observer looks through the lens array", kDiagram, "",
       "'plenolab reproject --eye' shows what the observer sees"},
      {"Figure 2", "reprojection between two cameras", kDiagram, "hansen-claim-h11",
       "its two steps against one"},
      {"Figure 3", "flow of the reprojection", kDiagram, "",
       "of a program: core/reprojection/reprojection.h is its entry"},
      {"Figure 4", "edges and textures", kRerun, "hansen-fig-5.4", ""},
      {"Figure 5", "centre subimages of five scenes", kRerun, "hansen-fig-5.1", ""},
      {"Figure 6", "choices and the critical number", kRecomputed, "hansen-fig-5.2", ""},
  };
  return kExhibits;
}

}  // namespace plenolab
