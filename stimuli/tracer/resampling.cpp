#include "stimuli/tracer/resampling.h"

#include <algorithm>
#include <cmath>

namespace plenolab::tracer {

LightCandidate resample(std::span<const LightCandidate> candidates, float u) {
  float total = 0;
  for (const LightCandidate& c : candidates) total += max_component(c.light);
  if (!(total > 0)) return {};
  const LightCandidate* chosen = nullptr;
  float passed = 0;
  for (const LightCandidate& c : candidates) {
    if (is_black(c.light)) continue;
    chosen = &c;
    passed += max_component(c.light);
    if (u * total < passed) break;
  }
  const float scale = total / (static_cast<float>(candidates.size()) * max_component(chosen->light));
  return {chosen->direction, chosen->distance_m, chosen->light * scale};
}

float spread(float u, std::size_t index, std::size_t count) {
  const float moved = u + static_cast<float>(index) / static_cast<float>(count);
  return moved < 1 ? moved : std::min(moved - 1, 0x1.fffffep-1f);
}

std::array<float, 2> spread(std::array<float, 2> u, std::size_t index) {
  const auto wrap = [](float x) { return std::min(x - std::floor(x), 0x1.fffffep-1f); };
  const auto i = static_cast<float>(index);
  return {wrap(u[0] + i * 0.7548777f), wrap(u[1] + i * 0.5698403f)};
}

}  // namespace plenolab::tracer
