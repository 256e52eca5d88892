#pragma once

#include "analysis/evolution_strategy.h"
#include "core/tonemap/generic.h"
#include "experiments/optimise/objective.h"

namespace plenolab {

/// The generic operator's parameters found for one image by an evolution strategy (Zhao 2019, chapter 3).

struct ToneOptimisationOptions {
  std::string quantity = "feature_content_adaptive";  ///< of objective_quantities()
  EvolutionOptions evolution;
  int shrink = 1;  ///< the search sees the image averaged over blocks of shrink × shrink pixels, [1, 64]

  /// Throws InputError naming the value out of range.
  void validate() const;
};

/// The ranges that are searched, and where the search starts (core/tonemap/generic.h).
std::vector<SearchParameter> generic_search_space();
GenericOptions generic_options(std::span<const double> parameters);
std::vector<double> parameters_of(const GenericOptions& options);

struct ToneOptimisation {
  GenericOptions best;        ///< with the bands of the size of the search; the start's if that is better
  Evolution evolution;        ///< costs at the size of the search
  double start_value = 0;     ///< of the objective at full size, with the parameters of the start
  double found_value = 0;     ///< at full size, with what the search found
  double best_value = 0;      ///< at full size: the better one of the two
  bool start_kept = false;    ///< because what was found on the smaller image is worse at full size
  PixelRepairs repairs;       ///< of the scene, before anything else
  DisplayImage image;         ///< full size, best parameters
  double seconds_search = 0;  ///< with the preparation of the objective
};

/// Deterministic for a seed, whatever the number of threads. `conditions.threads` evaluate candidates at
/// once; its mask must be empty. The viewer of the search stands as far away as makes the smaller image as
/// large to them. Throws InputError as the parts do, and if that image had less than 1 pixel per degree.
ToneOptimisation optimise_tones(const SceneImage& scene, const ComparisonConditions& conditions,
                                const ToneOptimisationOptions& options,
                                const std::function<void(const EvolutionStep&)>& progress = {});

/// Mean of blocks; those at the right and lower border are smaller.
SceneImage averaged_down(const SceneImage& image, int shrink);

}  // namespace plenolab
