#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/lut/volume_file.h"

// What is accepted can be blended at any place.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plenolab;
  try {
    const VolumeScene scene = parse_volumes({reinterpret_cast<const char*>(data), size}, "fuzz");
    if (scene.tables.size() != scene.volumes.size()) std::abort();
    const VolumeWeights weights = linear_weights(scene.volumes, {0, 0, 0});
    double sum = weights.background;
    for (const double weight : weights.volumes) sum += weight;
    if (!(sum > 0.999999 && sum < 1.000001)) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
