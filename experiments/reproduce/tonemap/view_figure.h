#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "experiments/reproduce/figure_tools.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/measures.h"

namespace plenolab {

/// The figures that compare mappings of one view (38 to 41 of the thesis).

/// Adds the box of tone mapped images enlarged four times, the HDR view first, all with contrast raised as
/// for print: the 1st to the 99th percentile of luma of each part fills the range. `maps` (same size) are
/// enlarged as they are.
void add_enlarged(ReproductionResult& result, const std::string& name, const std::string& what,
                  const SceneImage& hdr, const std::vector<ReportImage>& mapped, const PixelBox& box,
                  const std::vector<ReportImage>& maps = {});

/// Where an effect at borders of visibility shows most.
struct StepPlace {
  std::size_t index = 0;  ///< of the frame
  PixelBox box;           ///< the crop (crop_size) with most of it
  double sum = -1;        ///< of weights inside the box; < 0 as long as no frame was looked at
};

/// Takes frame `index` if one of its boxes holds more weight (border_step_weights) than the place so far.
void keep_densest(StepPlace& place, std::size_t index, const Plane<float>& weights);

/// Among frames mapped in two ways, in the same order: the steps of the difference of their lumas, which
/// leaves out texture that both show alike. At least one frame.
StepPlace largest_steps(std::span<const ReferenceFrame> frames, std::span<const DisplayImage> mapped,
                        std::span<const DisplayImage> other);

/// One view of a figure, mapped in several ways.
struct ViewPictures {
  std::string what;  ///< of the captions, e.g. "Cellar"
  const ReferenceFrame* frame = nullptr;
  std::vector<ReportImage> mapped, maps;
  PixelBox box;        ///< what is enlarged
  std::string choice;  ///< how view and box were chosen, for the caption
};

/// Adds the whole view, HDR at one exposure first, with the box marked red, and add_enlarged of the box.
void add_view(ReproductionResult& result, const ViewPictures& pictures);

/// The map of visibility at a position of a scene.
ReportImage visibility_at(Laboratory& laboratory, const std::string& scene, CameraPosition position);

/// The image with a range of luma spread over [0, 1]: its 1st percentile becomes 0, its 99th 1, the same for
/// all channels. Unchanged where they are equal.
DisplayImage raise_contrast(const DisplayImage& image);

}  // namespace plenolab
