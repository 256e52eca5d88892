#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "analysis/result_table.h"
#include "core/lightfield/light_field.h"
#include "core/synthesis/options.h"
#include "core/tonemap/adaptation.h"
#include "experiments/tonemap_field.h"

namespace plenolab {

/// Where in the pipeline of Altmeier's thesis (section 3.2) an operator stands.
enum class MappingPlace {
  kKeyViews,  ///< preprocessing: key views are mapped, frames synthesised from them
  kFrames,    ///< postprocessing: every synthesised HDR frame is mapped
};

/// Where a variant stands if nothing else is asked for: those for frames behind synthesis, others before it.
MappingPlace default_place(const OperatorChoice& choice);

/// Throws UsageError if the variant cannot stand there.
void require_possible(const OperatorChoice& choice, MappingPlace place);

struct MappedVideoOptions {
  FieldMappingOptions mapping;
  MappingPlace place = MappingPlace::kFrames;
  SynthesisOptions synthesis;
  AdaptationOptions adaptation;  ///< of variants for frames
  double frames_per_second = 30;
};

/// One finished frame.
struct MappedVideoFrame {
  std::size_t index = 0;
  CameraPosition position;
  DisplayImage image;
  std::size_t unseen_pixels = 0;
  FitSummary fit;        ///< of the frame; empty where key views are mapped
  MappingCounts counts;  ///< likewise
  double seconds_prepare = 0, seconds_synthesis = 0, seconds_postprocess = 0;
};

/// What is done once.
struct VideoPreprocessing {
  std::optional<FieldMapping> key_views;  ///< where key views are mapped
  FitSummary fit;                         ///< of the light field, where all frames share one
  double seconds = 0;                     ///< statistics, fit or mapping, and reading
};

/// The three stages: preprocesses the light field once, synthesises each frame, maps it where the operator
/// stands behind synthesis: with statistics of the key views that are near (variants for frames), with the
/// fit of the light field, or with a fit of its own (variants for views). `scratch` is a folder that exists
/// and is empty, for mapped key views. `receive` is called in order.
VideoPreprocessing make_mapped_video(const LightField& field, std::span<const CameraPosition> positions,
                                     const MappedVideoOptions& options, const std::filesystem::path& scratch,
                                     const std::function<void(const MappedVideoFrame&)>& receive);

}  // namespace plenolab
