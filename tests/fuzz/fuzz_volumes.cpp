#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/lut/volume_file.h"

namespace {

using namespace plenolab;

void check_weights(const VolumeWeights& weights) {
  double sum = weights.background;
  for (const double weight : weights.volumes) sum += weight;
  if (!(sum > 0.999999 && sum < 1.000001)) std::abort();
}

void check_camera(const std::vector<Volume>& volumes, const Point3& position_m) {
  check_weights(linear_weights(volumes, position_m));
  Plane<float> depth_m(9, 5, 2);
  depth_m.at(0, 0) = 1e-3f;
  depth_m.at(8, 4) = 3e38f;
  const DepthCamera camera{position_m, {0, 1, 0}, {0, 0, 1}, 90};
  const VolumeCounts counts = count_pixels(depth_m, camera, volumes);
  if (counts.pixels() != 45 || counts.background < 0) std::abort();
  check_weights(pixel_weights(counts, volumes));
  // The counts are those of the map.
  VolumeCounts mapped{std::vector<std::int64_t>(volumes.size()), 0};
  const Plane<int> map = map_pixels(depth_m, camera, volumes);
  for (const int v : map.pixels())
    ++(v < 0 ? mapped.background : mapped.volumes.at(static_cast<std::size_t>(v)));
  if (mapped.volumes != counts.volumes) std::abort();
}

}  // namespace

// What is accepted can be blended at any place: at the origin, at corners of the boxes, and far away.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const VolumeScene scene = parse_volumes({reinterpret_cast<const char*>(data), size}, "fuzz");
    if (scene.tables.size() != scene.volumes.size()) std::abort();
    check_camera(scene.volumes, {0, 0, 0});
    check_camera(scene.volumes, {1e7, -1e300, 1e-300});
    constexpr std::size_t kTried = 4;
    for (std::size_t i = 0; i < std::min(kTried, scene.volumes.size()); ++i) {
      const Volume& volume = scene.volumes[i];
      check_camera(scene.volumes, volume.min);
      check_camera(scene.volumes,
                   {volume.max[0], volume.min[1] - 0.5 * volume.blend_radius_m, volume.max[2]});
    }
  } catch (const InputError&) {
  }
  return 0;
}
