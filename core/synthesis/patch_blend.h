#pragma once

#include <array>
#include <cstdint>

#include "core/synthesis/novel_view.h"
#include "core/synthesis/options.h"
#include "core/synthesis/prepared_view.h"
#include "core/synthesis/search.h"

namespace plenolab {

/// What one key view says about the pixels of a patch: where A is and what is found there.
struct PatchView {
  PatchHits hits;
  alignas(64) float colour_disparity[4 * Patch::kMaxPixels];  ///< r, g, b, disparity, bilinear at A
  alignas(64) float range[Patch::kMaxPixels];  ///< max − min disparity of the pixels with non-zero weight
                                               ///< around A
  alignas(64) float share[Patch::kMaxPixels];  ///< out: weight in the output colour
  alignas(64) std::int32_t state[Patch::kMaxPixels];  ///< out: CorrespondenceState
  std::uint8_t thin[Patch::kMaxPixels];               ///< 1 where keep_thin replaced the hit
};

/// The key views of a patch at work.
struct PatchViews {
  std::array<PatchView, kMaxViews> views;
};

/// Constants of a blend that all patches share.
struct BlendSetup {
  int count = 0;  ///< key views
  std::array<const PreparedView*, kMaxViews> prepared{};
  std::array<UsedView, kMaxViews> used{};
  SynthesisOptions options;
  bool test_disocclusion = true, test_occlusion = true;
  bool decode = true;   ///< blend in gamma-encoded values and decode the sum
  bool record = false;  ///< fill PatchView::share and state
};

/// Where the results of a patch go.
struct BlendOutput {
  Plane<Rgb>* image = nullptr;
  Plane<std::uint8_t>* visible_views = nullptr;
  Mask* unseen = nullptr;
  Mask* restored = nullptr;
};

/// Fetches colour, disparity and disparity range at the hits of a patch.
void look_up_patch(const PreparedView& prepared, const Patch& patch, PatchView& view);

/// Rules 2 to 5 for a patch whose hits were looked up. Returns the counts of states, nothing about searches.
SynthesisStatistics blend_patch(const BlendSetup& setup, const Patch& patch, PatchViews& views,
                                const BlendOutput& out);

/// Rule 4 for one correspondence: the pixel with the lowest disparity among those with non-zero weight around
/// A; of equally low ones the one with the largest weight.
Hit background_pixel(const PreparedView& prepared, const Hit& hit);

}  // namespace plenolab
