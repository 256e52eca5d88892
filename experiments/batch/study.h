#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/viewing_conditions.h"

namespace plenolab {

/// A key view of a light field, 0-based from the top left.
struct BatchView {
  int column = 0, row = 0;
  friend auto operator<=>(const BatchView&, const BatchView&) = default;
};

/// Which key views of a light field are mapped.
struct BatchViews {
  enum class Which {
    kCentre,  ///< the middle one (of an even number the right or lower one)
    kAll,
    kListed,
  };
  Which which = Which::kCentre;
  std::vector<BatchView> listed;
  friend bool operator==(const BatchViews&, const BatchViews&) = default;
};

/// What is mapped: a built-in scene, a light field on disk, or one image with radiance.
struct BatchInputChoice {
  enum class Kind { kScene, kLightField, kImage };
  Kind kind = Kind::kScene;
  std::string source;                    ///< id of a scene or "all", or a path as the file has it
  std::string name;                      ///< in tables; empty: the source
  std::string preset;                    ///< of scenes: tiny, quick or paper; empty for others
  BatchViews views;                      ///< not of images
  std::optional<double> cd_m2_per_unit;  ///< replaces what the input says about its unit; not of scenes

  const std::string& title() const { return name.empty() ? source : name; }
  friend bool operator==(const BatchInputChoice&, const BatchInputChoice&) = default;
};

/// An operator with its variant (empty: its first) and settings, "name=value" each.
struct BatchOperatorChoice {
  std::string name, variant;
  std::vector<std::string> settings;
  friend bool operator==(const BatchOperatorChoice&, const BatchOperatorChoice&) = default;
};

/// Everything that is mapped and measured: every view of every input by every operator, with every metric.
struct BatchStudy {
  std::string title;
  std::vector<BatchInputChoice> inputs;
  std::vector<BatchOperatorChoice> operators;
  std::vector<std::string> metrics{"all"};
  ViewingConditions viewing;
  int repeat = 3;                     ///< timed runs of fit and mapping
  bool keep_images = false;           ///< mapped images in full size
  std::optional<std::uint64_t> seed;  ///< of renderings
};

/// Parses a study file, "plenolab-batch" version 1; `name` stands for it in messages. Whether scenes,
/// operators, settings, metrics and files exist is seen when it is planned (plan.h). Throws InputError with
/// one sentence naming file and key for anything missing, unknown, of a wrong type or out of range.
BatchStudy parse_batch_study(std::string_view json, const std::string& name);

}  // namespace plenolab
