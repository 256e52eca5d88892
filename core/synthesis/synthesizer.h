#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/lightfield/light_field.h"
#include "core/synthesis/novel_view.h"
#include "core/synthesis/options.h"
#include "core/synthesis/prepared_view.h"

namespace plenolab {

/// Synthesises novel views of one light field (thesis of Altmeier, section 4). Prepared key views are kept
/// between calls, least recently used ones dropped first, within a memory bound (the up to four of the view
/// at work are always held); apart from that cache it has no state, and calls do not influence each other's
/// results. Thread-safe.
template <class Referral>
class BasicSynthesizer {
 public:
  static constexpr std::size_t kDefaultMemoryBound = std::size_t{1} << 30;

  explicit BasicSynthesizer(BasicLightField<Referral> field,
                            std::size_t memory_bound_bytes = kDefaultMemoryBound);

  /// The view from `position` (spacings; see CameraPosition). The search starts at the light field's largest
  /// disparity, which loads every key view once. Throws InputError if the position is outside the grid or an
  /// option out of range.
  NovelView<Referral> synthesize(CameraPosition position, const SynthesisOptions& options = {}) const;

  /// A sequence of positions, e.g. of a video: calls `receive(index, view)` in order. Key views are prepared
  /// once where the memory bound allows it.
  void synthesize_sequence(
      std::span<const CameraPosition> positions, const SynthesisOptions& options,
      const std::function<void(std::size_t index, NovelView<Referral>&& view)>& receive) const;

  const BasicLightField<Referral>& field() const;
  /// Memory held by prepared views now.
  std::size_t prepared_bytes() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

using Synthesizer = BasicSynthesizer<SceneReferred>;
using DisplaySynthesizer = BasicSynthesizer<DisplayReferred>;

/// One novel view without keeping anything: prepares the key views it needs and drops them.
template <class Referral>
NovelView<Referral> synthesize(const BasicLightField<Referral>& field, CameraPosition position,
                               const SynthesisOptions& options = {}) {
  return BasicSynthesizer<Referral>(field).synthesize(position, options);
}

/// `count` positions evenly spaced on the straight line from `from` to `to`, both ends included (count ≥ 1;
/// one position is `from`). For videos and EPIs.
std::vector<CameraPosition> straight_path(CameraPosition from, CameraPosition to, int count);

}  // namespace plenolab
