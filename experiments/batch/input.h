#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/tonemap/light_field_mapping.h"
#include "experiments/batch/study.h"
#include "experiments/reproduce/laboratory.h"

namespace plenolab {

/// What is known of an input before any of its pixels is.
struct BatchInput {
  BatchInputChoice choice;               ///< of one scene, never "all"
  std::filesystem::path path;            ///< of files: from the folder of the study
  std::string content;                   ///< hash of everything that decides its pixels; empty with a problem
  int columns = 0, rows = 0;             ///< of its key views; 0 for images
  std::vector<BatchView> views;          ///< to be mapped, even where there are none; empty for images
  std::optional<double> cd_m2_per_unit;  ///< luminance of a value of 1, as the study or the input says
  std::string problem;                   ///< why it cannot be opened; empty if it can

  /// A message with the input's path as the study spells it, so that it reads alike on every machine.
  std::string as_spelled(std::string message) const;
  /// Why this view of it cannot be mapped; empty if nothing is known.
  std::string problem_with(const BatchView& view) const;
};

/// Inputs of a study, with "all" scenes one by one. `folder` is what relative paths start from. Nothing is
/// rendered and no pixel is read: scenes are known by what decides their rendering, files by their bytes. An
/// input that is missing or damaged has a problem. Throws InputError, naming `file`, for a scene that there
/// is not and for two inputs with the same title and preset.
std::vector<BatchInput> identify_inputs(const BatchStudy& study, const std::filesystem::path& folder,
                                        std::uint64_t seed, const std::string& file);

/// How inputs are loaded.
struct LoadInputOptions {
  std::filesystem::path cache;  ///< of rendered views
  std::uint64_t seed = 1;       ///< of renderings
  int threads = 0;
  std::function<void(const RenderingTally&)> on_view;  ///< after each rendered view; may be empty
};

/// An input with what all of its items share. Light fields are mapped as `tonemap-lf` does it: with the log
/// floor, scale and, for variants that have one fit for all views, statistics of the whole light field.
class LoadedInput {
 public:
  /// Renders or reads it and measures its statistics. Throws InputError as the readers do.
  LoadedInput(const BatchInput& input, const LoadInputOptions& options);
  LoadedInput(const LoadedInput&) = delete;
  LoadedInput& operator=(const LoadedInput&) = delete;

  /// `place` is that in a light field, and not read for images.
  OperatorView view(const BatchView& place) const;
  /// Null for images.
  const LightField* light_field() const { return field_ ? &*field_ : nullptr; }
  /// What a variant of this scope is fitted to.
  FitScope scope(OperatorScope scope, const BatchView& place, int threads) const;

 private:
  std::unique_ptr<Laboratory> laboratory_;
  std::optional<LightField> field_;
  LightFieldStatistics statistics_;
  OperatorView image_;
  FitScope image_scope_;
};

}  // namespace plenolab
