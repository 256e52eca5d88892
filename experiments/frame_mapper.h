#pragma once

#include <optional>

#include "core/tonemap/adaptation.h"
#include "core/tonemap/light_field_mapping.h"
#include "experiments/cli/operator_options.h"
#include "experiments/tonemap_field.h"

namespace plenolab {

/// A tone mapped frame of a motion.
struct FrameMapping {
  DisplayImage image;
  FitSummary fit;  ///< of the frame; empty where one fit of the light field maps all frames
  MappingCounts counts;
};

struct FrameMapperOptions {
  AdaptationOptions adaptation;  ///< of variants for frames
  double frames_per_second = 30;
  int threads = 0;
};

/// Maps synthesised HDR frames one after the other: with statistics of the key views that are near and what
/// came before (variants for frames), with the one fit of the light field, or with a fit of each frame by
/// itself (variants for views). Handed frames in order, it starts as at a cut.
class FrameMapper {
 public:
  /// `field` are the key views behind the frames, `statistics` theirs.
  FrameMapper(const LightField& field, LightFieldStatistics statistics, const OperatorChoice& choice,
              const FrameMapperOptions& options);

  /// Empty unless one fit maps all frames.
  FitSummary fit_of_light_field() const { return {of_light_field_.values, of_light_field_.notes}; }

  /// `disparity` is that of the frame; null if unknown, then the variant must not need it.
  FrameMapping map(const SceneImage& frame, const DisparityMap* disparity, CameraPosition position);

 private:
  FrameMapping map_adaptively(const SceneImage& frame, CameraPosition position);
  FrameMapping map_by_itself(const OperatorView& frame) const;

  ViewGrid grid_;
  LightFieldStatistics statistics_;
  OperatorChoice choice_;
  FrameMapperOptions options_;
  FittedOperator of_light_field_;
  std::optional<FrameState> state_;
};

}  // namespace plenolab
