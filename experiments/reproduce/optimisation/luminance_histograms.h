#pragma once

#include <string>
#include <vector>

#include "analysis/histogram_shape.h"
#include "experiments/reproduce/optimisation/optimisation_bench.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// An image whose histogram is looked at.
struct HistogramSource {
  std::string name;
  bool photograph = false;  ///< taken with a camera
  SceneImage image;         ///< about as many pixels as a game-like frame
  HistogramShape shape;
};

/// Photographs below the folder PLENOLAB_OUTSIDE_DATA (hdr/Desk.exr), if it is at hand, and middle views of
/// our path-traced scenes, whose light is scattered and textures rich as in photographs, for which they stand
/// in.
std::vector<HistogramSource> natural_images(Laboratory& laboratory);
/// How many of them are photographs.
std::size_t photographs_in(const std::vector<HistogramSource>& images);

/// Whether game-like images have more of a measure of the histogram than photographs, by Welch's interval of
/// the difference of the means, images being independent. Undecidable unless `natural` holds at least one
/// photograph: rendered scenes alone say nothing about rendered against photographed. At least two images
/// each.
Verdict decide_spikiness(const std::vector<HistogramSource>& games,
                         const std::vector<HistogramSource>& natural, double HistogramShape::*measure,
                         const std::string& quantity);

/// The middle judged frame of each game-like sequence.
std::vector<HistogramSource> game_images(Laboratory& laboratory);

/// One histogram plot and one picture (Reinhard's operator) an image, and their rows and table.
void add_histograms(ReproductionResult& result, const std::vector<HistogramSource>& images,
                    const std::string& name, const std::string& caption);

}  // namespace plenolab
