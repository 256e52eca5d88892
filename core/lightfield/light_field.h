#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/lightfield/view_grid.h"

namespace plenolab {

/// What one key view records: colour and the disparity of what is seen, pixel by pixel, of equal size.
template <class Referral>
struct KeyView {
  RgbImage<Referral> colour;
  DisparityMap disparity;  ///< finite, ≥ 0
};

/// Unit of the scene-referred radiance of a light field.
enum class RadianceUnit { kCdM2, kRelative };

/// Loads the key view of (column, row). May be called from any thread, and for different views at the same
/// time.
template <class Referral>
using ViewLoader = std::function<KeyView<Referral>(int column, int row)>;

/// A light field: a grid of key views that are loaded when first used. Loaded views are kept, least recently
/// used ones dropped first, within `memory_bound_bytes`; views handed out stay valid for as long as their
/// pointer is held. Copies share views and bound. Thread-safe.
template <class Referral>
class BasicLightField {
 public:
  BasicLightField(ViewGrid grid, RadianceUnit unit, std::string name, ViewLoader<Referral> load,
                  std::size_t memory_bound_bytes = kDefaultMemoryBound);

  /// All views in memory, row by row (row·columns + column). Throws InputError if their number or sizes
  /// differ from the grid's.
  static BasicLightField from_views(ViewGrid grid, RadianceUnit unit, std::string name,
                                    std::vector<KeyView<Referral>> views);

  const ViewGrid& grid() const;
  RadianceUnit unit() const;
  /// Folder or scene it comes from, for messages.
  const std::string& name() const;

  /// The key view at (column, row), 0-based. Throws InputError (naming the file) if it cannot be loaded or
  /// its size is not that of the grid.
  std::shared_ptr<const KeyView<Referral>> view(int column, int row) const;

  /// Largest disparity of all views, d_max of the thesis. Loads every view once; later calls are free.
  float max_disparity_px() const;

  static constexpr std::size_t kDefaultMemoryBound = std::size_t{2} << 30;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

using LightField = BasicLightField<SceneReferred>;
using DisplayLightField = BasicLightField<DisplayReferred>;

}  // namespace plenolab
