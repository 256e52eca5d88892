#pragma once

#include <optional>

#include "core/image/image.h"
#include "core/image/repair.h"

namespace plenolab {

/// A scene-referred view as every tone mapping operator reads it: all channel values finite and ≥ 0 (NaN and
/// negative values → 0, +Inf → largest finite value of the view; see core/image/repair.h). Without defects it
/// refers to the original, which must outlive it; the view itself is never changed.
class RepairedView {
 public:
  explicit RepairedView(const SceneImage& view, int threads = 0);
  const SceneImage& image() const { return copy_ ? *copy_ : *original_; }
  /// Channel values that were replaced, by kind.
  const PixelRepairs& repairs() const { return repairs_; }

 private:
  const SceneImage* original_;
  std::optional<SceneImage> copy_;
  PixelRepairs repairs_;
};

/// Whether any channel value is NaN, infinite or negative. Stops at nothing, so its time is that of one read.
bool has_defects(const SceneImage& view, int threads = 0);

}  // namespace plenolab
