#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image/image.h"
#include "core/tonemap/adaptation.h"
#include "core/tonemap/radiance_scale.h"
#include "core/tonemap/reinhard_devlin.h"
#include "core/tonemap/settings.h"
#include "core/tonemap/statistics.h"
#include "core/tonemap/tone_mapped.h"

/// The table of tone mapping operators, for programs that choose one by name. The operators themselves are
/// plain functions in their own headers (fit: options, statistics → parameters; apply: parameters, view →
/// result).
///
/// Use for one image or a light field:
///   const OperatorInfo& info = find_operator("reinhard05");
///   const OperatorVariant& variant = find_variant(info, "joint");
///   const SettingValues values = parse_settings(info.id, info.settings, {"b=-1"});
///   scope = whole light field or one view, as variant.scope says;
///   FittedOperator fitted = info.fit(variant.id, values, scope);   then fitted.apply(view) for each view.
/// Use for frames of a video (variant.scope == kFrame): info.map_frame, handing the state on.
namespace plenolab {

/// What one fit of a variant is for.
enum class OperatorScope {
  kView,        ///< each view is fitted by itself
  kLightField,  ///< one fit for all views
  kFrame,       ///< synthesised views, mapped one after the other with statistics of key views
};

struct OperatorVariant {
  std::string id;  ///< e.g. "joint"
  OperatorScope scope = OperatorScope::kView;
  bool needs_disparity = false;
  std::string description;  ///< one line
};

/// A view and, for operators that use it, its disparity (same size, may be null). Held only during a call.
struct OperatorView {
  std::shared_ptr<const SceneImage> colour;
  std::shared_ptr<const DisparityMap> disparity;
};

/// The views that one fit is for. They are loaded one at a time, perhaps more than once.
struct FitScope {
  int views = 1;
  std::function<OperatorView(int index)> load;
  ImageStatistics statistics;  ///< of all views of the scope together
  double floor = 1;            ///< log_floor of the whole light field
  int threads = 0;
  RadianceScale scale{};  ///< of the whole light field
};

/// A single image as the whole light field. `image` must outlive the scope. `cd_m2_per_unit`: what radiance 1
/// is, absent if that is not known.
FitScope scope_of_image(const OperatorView& image, int threads = 0, std::optional<double> cd_m2_per_unit = 1);

/// A number of a fit, for reports.
struct FittedValue {
  std::string name;
  double value = 0;
  std::string unit;
};

/// An operator with all its parameters: maps views alike however often and in whatever order it is called.
struct FittedOperator {
  std::function<ToneMapped(const OperatorView& view, int threads)> apply;
  std::vector<FittedValue> values;
  std::vector<std::string> notes;  ///< branches taken, one sentence each
};

/// One frame of a video for operators with kFrame variants.
struct FrameInput {
  const SceneImage* view = nullptr;        ///< the synthesised view
  std::vector<ImageStatistics> key_views;  ///< of the nearest key views, 1 … 4, evaluated with one floor
  std::vector<double> weights;             ///< bilinear, ≥ 0, sum 1
  double step_s = 0;                       ///< since the previous frame, ≥ 0
  AdaptationOptions adaptation;
  int threads = 0;
  RadianceScale scale{};  ///< of the light field
};

/// What one frame hands on to the next; a plain value. An empty optional of it means first frame or cut.
struct FrameState {
  Adapted<ImageStatistics> statistics;
  Adapted<double> limit_min, limit_max;  ///< of the normalisation, Reinhard & Devlin only
  Adapted<double> log_eye_average;       ///< of the frame, robust adaptive only
};

struct MappedFrame {
  ToneMapped mapped;
  FrameState state;
  std::vector<FittedValue> values;
};

struct OperatorInfo {
  std::string id;
  std::string title;
  std::string description;  ///< one line
  std::string source;       ///< paper and section
  std::string input_unit;   ///< "any", "cd/m2" …
  std::vector<Setting> settings;
  std::vector<OperatorVariant> variants;  ///< the first is the default
  /// For variants of scope kView and kLightField.
  std::function<FittedOperator(std::string_view variant, const SettingValues&, const FitScope&)> fit;
  /// For variants of scope kFrame; empty if there are none.
  std::function<MappedFrame(std::string_view variant, const SettingValues&, const FrameInput&,
                            const std::optional<FrameState>& previous)>
      map_frame;
};

/// All operators, in the order in which they are listed.
const std::vector<OperatorInfo>& tone_mapping_operators();

/// Throw InputError that lists what there is.
const OperatorInfo& find_operator(std::string_view id);
const OperatorVariant& find_variant(const OperatorInfo& info, std::string_view id);

/// Maps a single image with a variant of scope kView or kLightField, the image being the whole light field.
ToneMapped tone_map(const OperatorInfo& info, std::string_view variant, const SettingValues& values,
                    const OperatorView& image, int threads = 0);

}  // namespace plenolab
