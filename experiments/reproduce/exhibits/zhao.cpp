#include "experiments/reproduce/exhibits/tables.h"

namespace plenolab {

using enum ExhibitStatus;

std::span<const Exhibit> zhao_exhibits() {
  static constexpr Exhibit kExhibits[] = {
      {"Figure 1", "linear against designed tone mapping", kRerun, "zhao-fig-1", ""},
      {"Figure 2", "ranges of luminance in the world, the eye, displays", kNotReproducible, "",
       "a chart of textbook ranges"},
      {"Figure 3", "slopes of the content adaptive operator", kRerun, "zhao-fig-3", ""},
      {"Figure 4", "light probes in a game engine", kNotReproducible, "", "an image of another program"},
      {"Figure 5", "histograms of photographs", kRerun, "zhao-fig-5",
       "photographs as far as PLENOLAB_OUTSIDE_DATA holds any, else path-traced scenes in their place"},
      {"Figure 6", "histograms of rendered frames", kRerun, "zhao-fig-6", ""},
      {"Figure 7", "perceptual quantiser against gamma 2.4", kRecomputed, "zhao-fig-7", ""},
      {"Figure 8", "framework of the feature metric", kDiagram, "",
       "of another paper; the metric is 'plenolab metric --metric feature_photographic'"},
      {"Figure 9", "flicker from a small change of the sky", kRerun, "zhao-fig-9",
       "game-like frames in which a camera tilts up to the sky"},
      {"Figure 10", "local flicker", kNotReproducible, "",
       "another paper's images; borders of visibility over time are in tone-mapping-consistency"},
      {"Table 1", "parameters of the generic operator", kRecomputed, "zhao-table-1", ""},
      {"Figure 11", "workflow of tweaking look-up tables", kNotReproducible, "", "images of another program"},
      {"Figure 12", "ways of storing look-up tables", kRerun, "zhao-fig-12", ""},
      {"Figure 13", "a post-processing volume", kRerun, "zhao-fig-24", "volumes of our walk, from above"},
      {"Figure 14", "flow chart of the optimisation", kDiagram, "",
       "of a program: 'plenolab optimise' runs it"},
      {"Figure 15", "distortion maps of three methods", kRerun, "zhao-fig-15", ""},
      {"Table 2", "distortion of three methods", kRerun, "zhao-table-2",
       "and its printed numbers audited: zhao-audit-table-2"},
      {"Figure 16", "a sequence of nine frames", kRerun, "zhao-fig-16", ""},
      {"Figure 17", "workflow in a game", kNotReproducible, "", "another company's slide"},
      {"Figure 18", "linear interpolation pipeline", kDiagram, "zhao-fig-25",
       "what both pipelines make of our walk"},
      {"Figure 19", "pixel-based interpolation pipeline", kDiagram, "zhao-fig-25",
       "what both pipelines make of our walk"},
      {"Figure 20", "world positions of pixels", kDiagram, "",
       "of a program: core/lut/count_pixels.cpp does it"},
      {"Figure 21", "tweaking a table by hand", kNotReproducible, "", "an image of another program"},
      {"Figure 22", "colour transfer by hand", kNotReproducible, "",
       "screenshots that nobody has, graded by hand"},
      {"Figure 23", "automatic colour transfer", kRerun, "zhao-fig-23", ""},
      {"Figure 24", "looking round between volumes", kRerun, "zhao-fig-24", ""},
      {"Figure 25", "linear against pixel-based interpolation", kRerun, "zhao-fig-25", ""},
      {"Figure 26", "mixed image against pixel-based interpolation", kRerun, "zhao-fig-26", ""},
      {"Table 3", "run times of the proposed algorithm", kRerun, "zhao-table-3", ""},
  };
  return kExhibits;
}

}  // namespace plenolab
