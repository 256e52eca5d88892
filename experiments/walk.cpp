#include "experiments/walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/image/cielab.h"
#include "core/image/colour.h"

namespace plenolab {

namespace {

constexpr double kEyeHeight_m = 1.65, kFieldOfView_deg = 75, kBlendRadius_m = 2.5;
/// Becomes 1 in every picture.
constexpr float kWhite_cd_m2 = 280;

/// Ends of a leg; yaw from +y towards +x. The next leg begins where this one ends.
struct Leg {
  const char* name;
  bool turning;
  double from_x_m, from_y_m, from_yaw_deg, to_x_m, to_y_m, to_yaw_deg;
  int steps;
};
constexpr std::array kLegs{
    Leg{"along the corridor", false, 0, 2, 0, 0, 11.2, 0, 6},
    Leg{"turns between corridor and hall", true, 0, 11.2, 0, 0, 11.2, -180, 6},
    Leg{"turns on and enters the hall", false, 0, 11.2, -180, 0, 14.5, -360, 6},
    Leg{"through the hall", false, 0, 14.5, 0, 6.8, 16.1, 90, 6},
    Leg{"turns between hall and garden house", true, 6.8, 16.1, 90, 6.8, 16.1, 270, 6},
    Leg{"turns on and enters the garden house", false, 6.8, 16.1, 270, 11, 16.2, 450, 6},
    Leg{"looks out of the garden house", false, 11, 16.2, 90, 12, 16.2, 0, 4},
};

WalkPose pose_at(const Leg& leg, double t) {
  const auto between = [t](double from, double to) { return from + t * (to - from); };
  const double yaw = between(leg.from_yaw_deg, leg.to_yaw_deg) * std::numbers::pi / 180;
  return {leg.name,
          leg.turning,
          {{between(leg.from_x_m, leg.to_x_m), between(leg.from_y_m, leg.to_y_m), kEyeHeight_m},
           {std::sin(yaw), std::cos(yaw), 0},
           {0, 0, 1},
           kFieldOfView_deg}};
}

Vec3 vec3(const Point3& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

LitCamera lit_camera(const DepthCamera& camera) {
  return {vec3(camera.position_m), vec3(camera.forward), vec3(camera.up),
          static_cast<float>(camera.fov_h_deg)};
}

/// Colours of dark, middling and bright parts, and how far they scatter in a* and b*.
struct Mood {
  const char *name, *place;
  CieLab dark, middle, bright;
  double spread, amount;
};
constexpr std::array<Mood, kWalkLooks> kMoods{{
    {"cold steel", "corridor", {5, 2, -12}, {42, -9, -18}, {90, -7, -4}, 6, 0.75},
    {"candle light", "hall", {4, 8, 4}, {45, 17, 36}, {92, 3, 26}, 8, 0.75},
    {"morning green", "garden house", {6, -8, 8}, {52, -20, 26}, {96, -7, 16}, 10, 0.75},
    {"clear day", "background", {5, 1, -6}, {50, -4, -4}, {97, -1, 2}, 14, 0.4},
}};
constexpr std::uint64_t kSpreadPurpose = 0x70616c65747465ull;  // keeps these random words apart from others

CieLab mixed(const CieLab& a, const CieLab& b, double t) {
  return {a.l + t * (b.l - a.l), a.a + t * (b.a - a.a), a.b + t * (b.b - a.b)};
}

CieLab along(const Mood& mood, double t) {
  return t < 0.5 ? mixed(mood.dark, mood.middle, 2 * t) : mixed(mood.middle, mood.bright, 2 * t - 1);
}

}  // namespace

std::vector<WalkPose> walk_path(double density) {
  std::vector<WalkPose> poses;
  for (const Leg& leg : kLegs) {
    const int steps = std::max(1, static_cast<int>(std::lround(leg.steps * density)));
    // The last pose on the spot is the first of the leg that leads away.
    const bool stood = !poses.empty() && poses.back().turning;
    for (int i = 0; i < steps; ++i) {
      poses.push_back(pose_at(leg, static_cast<double>(i) / steps));
      poses.back().turning |= stood && i == 0;
    }
  }
  poses.push_back(pose_at(kLegs.back(), 1));
  return poses;
}

WalkStage::WalkStage() : scene_(build_walk_scene()), views_(scene_.lit) {
  for (const WalkRoom& room : scene_.rooms) {
    const auto point = [](const Vec3& v) { return Point3{v.x(), v.y(), v.z()}; };
    volumes_.push_back({room.name, point(room.min_m), point(room.max_m), kBlendRadius_m, 1});
  }
}

WalkFrame WalkStage::frame(const WalkPose& pose, int width, int height, int threads) const {
  LitView view = views_.render(lit_camera(pose.camera), width, height, threads);
  DisplayImage picture = expose(view.radiance, 1 / kWhite_cd_m2);
  return {pose, std::move(view.radiance), std::move(picture), std::move(view.depth_m),
          std::move(view.material)};
}

WalkFrame WalkStage::surfaces(const WalkPose& pose, int width, int height, int threads) const {
  LitView view = views_.surfaces(lit_camera(pose.camera), width, height, threads);
  return {pose, {}, {}, std::move(view.depth_m), std::move(view.material)};
}

std::size_t frame_that_shows_most(std::span<const VolumeCounts> counts, int volume) {
  const auto pixels = [&](const VolumeCounts& c) {
    return volume < 0 ? c.background : c.volumes[static_cast<std::size_t>(volume)];
  };
  return static_cast<std::size_t>(std::ranges::max_element(counts, {}, pixels) - counts.begin());
}

DisplayImage walk_palette(int index, int width, int height) {
  const Mood& mood = kMoods.at(static_cast<std::size_t>(index));
  DisplayImage palette(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      RandomStream random(
          static_cast<std::uint64_t>(index), kSpreadPurpose,
          static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(x));
      CieLab colour = along(mood, (x + random.next_double()) / width);
      // The sum of two uniform numbers: most colours lie near the anchors.
      colour.a += mood.spread * (random.next_double() + random.next_double() - 1);
      colour.b += mood.spread * (random.next_double() + random.next_double() - 1);
      palette.at(x, y) = cut_to_unit(display_of_lab(colour));
    }
  return palette;
}

WalkLook make_walk_look(int index, const DisplayImage& source, int size, std::uint64_t seed) {
  const Mood& mood = kMoods.at(static_cast<std::size_t>(index));
  WalkLook look{mood.name, mood.place, source, walk_palette(index, source.width(), source.height()), {}};
  look.transfer = transfer_colours(source, look.palette,
                                   {.samples = 20000, .size = size, .amount = mood.amount, .seed = seed});
  return look;
}

std::vector<WalkLook> make_walk_looks(std::span<const VolumeCounts> counts,
                                      const std::function<DisplayImage(std::size_t)>& picture_of,
                                      std::uint64_t seed) {
  std::vector<WalkLook> looks;
  for (int look = 0; look < kWalkLooks; ++look) {
    const int volume = look < kWalkLooks - 1 ? look : -1;
    looks.push_back(
        make_walk_look(look, picture_of(frame_that_shows_most(counts, volume)), kDefaultLutSize, seed));
  }
  return looks;
}

}  // namespace plenolab
