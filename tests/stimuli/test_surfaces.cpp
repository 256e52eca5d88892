#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "stimuli/tracer/bsdf.h"
#include "tests/stimuli/scenes_for_tests.h"

namespace plenolab {
namespace {

using namespace testing;

RenderSettings paths(int count) {
  RenderSettings settings;
  settings.paths_per_pixel = count;
  return settings;
}

// One wall before the camera, everything else white sky.
Scene wall_in_furnace(Material material) {
  Scene scene = empty_scene();
  scene.materials = {std::move(material)};
  scene.meshes = {parallelogram({-50, 3, -50}, {100, 0, 0}, {0, 0, 100}, 0)};
  scene.sky = uniform_sky(1, 1);
  return scene;
}

double seen_head_on(const Scene& scene, int count = 1024) {
  return mean_green(render(scene, small_grid(4, 4, 0.1), paths(count)).view.colour);
}

// Share of a furnace that a white GGX mirror keeps at normal incidence: facets steeper than 45° send light
// into the surface, of the others the masking of the reflected direction at twice the slope lets 1/(1 + Λ)
// pass.
double white_metal_head_on(double alpha) {
  const int steps = 100000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps, tan2 = alpha * alpha * u / (1 - u);
    if (tan2 >= 1) break;
    const double c = (1 - tan2) / (1 + tan2);
    sum += 1 / (0.5 + 0.5 * std::sqrt(1 + alpha * alpha * (1 - c * c) / (c * c)));
  }
  return sum / steps;
}

TEST(Surfaces, AMetalReflectsTheShareOfAFurnaceThatItsRoughnessLeaves) {
  EXPECT_NEAR(white_metal_head_on(1), 1 - std::numbers::ln2, 1e-4);  // the closed form at α = 1
  for (const float alpha : {0.1f, 0.3f, 1.0f}) {
    Material metal = diffuse(1);
    metal.kind = Material::Kind::kMetal;
    metal.roughness = constant(alpha);
    EXPECT_NEAR(seen_head_on(wall_in_furnace(metal)), white_metal_head_on(static_cast<double>(alpha)), 0.004);
  }
}

TEST(Surfaces, ASmoothMetalReflectsItsAlbedo) {
  Material metal = diffuse(0.7f);
  metal.kind = Material::Kind::kMetal;
  metal.roughness = constant(0.02f);
  EXPECT_NEAR(seen_head_on(wall_in_furnace(metal), 256), 0.7, 0.002);
}

TEST(Surfaces, ABlackGlossySurfaceReflectsFresnelsShare) {
  Material coat = diffuse(0);
  coat.kind = Material::Kind::kGlossy;
  coat.roughness = constant(0.02f);
  coat.ior = 1.5f;
  EXPECT_NEAR(seen_head_on(wall_in_furnace(coat), 256), 0.04, 0.0005);
}

TEST(Surfaces, DensitiesOfDirectionsIntegrateToTheShareThatLeavesTheSurface) {
  for (const auto kind : {Material::Kind::kDiffuse, Material::Kind::kGlossy, Material::Kind::kMetal})
    for (const float alpha : {0.3f, 0.9f}) {
      Material m = diffuse(0.6f);
      m.kind = kind;
      tracer::Surface s;
      s.material = &m;
      s.outgoing = Vec3(0.8f, 0, 0.6f);
      s.geometric_normal = s.normal = Vec3(0, 0, 1);
      s.albedo = {0.6f, 0.6f, 0.6f};
      s.alpha = alpha;
      double integral = 0;
      const int rows = 400;
      for (int i = 0; i < rows; ++i)
        for (int j = 0; j < rows; ++j) {
          const double c = (i + 0.5) / rows, r = std::sqrt(1 - c * c),
                       phi = 2 * std::numbers::pi * (j + 0.5) / rows;
          const Vec3 d(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                       static_cast<float>(c));
          integral += static_cast<double>(evaluate_bsdf(s, d).pdf) * 2 * std::numbers::pi / (rows * rows);
        }
      int leaving = 0;
      const int count = 20000;
      for (std::uint64_t i = 0; i < count; ++i) {
        RandomStream random(1, 5, i);
        const float lobe = random.next_float(), u = random.next_float(), v = random.next_float();
        leaving += sample_bsdf(s, lobe, {u, v}).has_value();
      }
      EXPECT_NEAR(integral, static_cast<double>(leaving) / count, 0.015)
          << static_cast<int>(kind) << " α " << alpha;
    }
}

TEST(Surfaces, ReflectionIsReciprocal) {
  Material m = diffuse(0.6f);
  m.kind = Material::Kind::kGlossy;
  tracer::Surface a;
  a.material = &m;
  a.position_m = Vec3::Zero();
  a.geometric_normal = a.normal = Vec3(0, 0, 1);
  a.albedo = {0.6f, 0.6f, 0.6f};
  a.alpha = 0.3f;
  tracer::Surface b = a;
  a.outgoing = Vec3(0.8f, 0, 0.6f);
  b.outgoing = Vec3(-0.48f, 0.36f, 0.8f);
  EXPECT_NEAR(evaluate_bsdf(a, b.outgoing).f_cos.g / b.outgoing.z(),
              evaluate_bsdf(b, a.outgoing).f_cos.g / a.outgoing.z(), 1e-6);
}

TEST(Surfaces, AMirrorShowsTheLampBehindTheCamera) {
  Scene scene = empty_scene();
  Material mirror = diffuse(0.8f);
  mirror.kind = Material::Kind::kMirror;
  scene.materials = {mirror, lamp({10, 10, 10})};
  scene.meshes = {parallelogram({-50, 3, -50}, {100, 0, 0}, {0, 0, 100}, 0),
                  sphere({0.8f, -1, 0.5f}, 0.3f, 24, 1)};
  // The image of the lamp stands as far behind the mirror: 7 m ahead, at the same side and height.
  const ViewGrid grid = small_grid(64, 64);
  const auto view = render(scene, grid, paths(16)).view;
  const double focal = 32 / std::tan(std::numbers::pi / 6);
  const int x = static_cast<int>(32 + focal * 0.8 / 7), y = static_cast<int>(32 - focal * 0.5 / 7);
  EXPECT_FLOAT_EQ(view.colour.at(x, y).g, 8);
  EXPECT_EQ(view.colour.at(64 - x, y).g, 0);
  EXPECT_NEAR(view.disparity.at(x, y) / grid.disparity_px(3), 1, 1e-5);  // the mirror's, not the image's
}

TEST(Surfaces, GlassReflectsAtNormalIncidenceWhatFresnelSays) {
  EXPECT_NEAR(tracer::fresnel_dielectric(1, 1.5f), 0.04, 1e-6);
  EXPECT_NEAR(tracer::fresnel_dielectric(1, 1 / 1.5f), 0.04, 1e-6);
  EXPECT_EQ(tracer::fresnel_dielectric(0.5f, 1 / 1.5f), 1);  // total reflection
  EXPECT_NEAR(tracer::fresnel_dielectric(std::cos(std::atan(1.5f)), 1.5f), 0.5 * std::pow(5.0 / 13, 2),
              1e-4);  // Brewster
  Scene scene = empty_scene();
  Material glass;
  glass.kind = Material::Kind::kDielectric;
  scene.materials = {glass};
  scene.meshes = {parallelogram({-50, 3, -50}, {100, 0, 0}, {0, 0, 100}, 0)};
  scene.sky = uniform_sky(1, 1);
  // One boundary: the reflected share sees the sky as it is, the rest through the change of index.
  EXPECT_NEAR(seen_head_on(scene), 0.04 + 0.96 / 2.25, 0.002);
}

TEST(Surfaces, APaneOfColouredGlassAbsorbsAlongItsThickness) {
  Scene scene = empty_scene();
  Material glass;
  glass.kind = Material::Kind::kDielectric;
  glass.ior = 1.0f;  // no reflection: what is left is absorption
  glass.absorption_per_m = {0, 0.5f, 2};
  scene.materials = {glass};
  scene.meshes = {parallelogram({-50, 3, -50}, {100, 0, 0}, {0, 0, 100}, 0),
                  parallelogram({-50, 3.7f, -50}, {0, 0, 100}, {100, 0, 0}, 0)};
  scene.sky = uniform_sky(1, 1);
  const auto view = render(scene, small_grid(2, 2, 0.1), paths(16)).view;
  EXPECT_NEAR(view.colour.at(0, 0).r, 1, 1e-5);
  EXPECT_NEAR(view.colour.at(0, 0).g, std::exp(-0.35), 1e-4);
  EXPECT_NEAR(view.colour.at(0, 0).b, std::exp(-1.4), 1e-4);
}

TEST(Surfaces, RippledWaterReflectsTheSkyAtGrazingAnglesWithoutBlackSpots) {
  Scene scene = empty_scene();
  Material water;
  water.kind = Material::Kind::kMirror;
  water.albedo = constant(Rgb{1, 1, 1});
  water.normal = [](const SurfacePoint& p) {
    return Vec3(0.4f * std::sin(7 * p.position_m.x()), 0.4f * std::sin(9 * p.position_m.y()), 1).normalized();
  };
  scene.materials = {water};
  scene.meshes = {parallelogram({-500, 0, -0.5f}, {1000, 0, 0}, {0, 1000, 0}, 0)};
  scene.sky = uniform_sky(1, 0);
  scene.max_bounces = 4;
  const auto view = render(scene, small_grid(32, 32), paths(16)).view;
  for (int y = 17; y < 32; ++y)
    for (int x = 0; x < 32; ++x) EXPECT_GT(view.colour.at(x, y).g, 0.99f);
}

TEST(Surfaces, TexturesOutOfRangeAreReported) {
  Material wrong;
  wrong.albedo = constant(Rgb{0.5f, 1.2f, 0.5f});
  EXPECT_THROW(seen_head_on(wall_in_furnace(wrong), 16), InputError);
  wrong.albedo = constant(Rgb{0.5f, std::nanf(""), 0.5f});
  EXPECT_THROW(seen_head_on(wall_in_furnace(wrong), 16), InputError);
  wrong.albedo = nullptr;
  wrong.normal = [](const SurfacePoint&) { return Vec3(0, 0, 0); };
  EXPECT_THROW(seen_head_on(wall_in_furnace(wrong), 16), InputError);
}

TEST(Surfaces, WithoutCausticsAMirrorLightsNothingButIsStillSeen) {
  Scene scene = empty_scene();
  Material mirror = diffuse(1);
  mirror.kind = Material::Kind::kMirror;
  scene.materials = {diffuse(0.5f), mirror};
  scene.meshes = {parallelogram({-5, 3, -5}, {10, 0, 0}, {0, 0, 10}, 0),
                  parallelogram({-5, -4, -1}, {10, 0, 0}, {0, 7, 0}, 1)};
  scene.sun =
      Sun{Vec3(0, 0.6f, 0.8f), 10.0f, {1000, 1000, 1000}};  // behind the wall: only the mirror could help
  RenderSettings settings = paths(256);
  scene.caustics = false;
  EXPECT_EQ(mean_green(render(scene, small_grid(4, 4, 5), settings).view.colour), 0);
  scene.sun->direction = Vec3(0, -0.6f, 0.8f);  // shines down on the mirror and the wall
  const double without = mean_green(render(scene, small_grid(4, 4, 5), settings).view.colour);
  scene.caustics = true;
  const double with = mean_green(render(scene, small_grid(4, 4, 5), settings).view.colour);
  EXPECT_NEAR(without, 0.5 / std::numbers::pi * 1000 * 0.6, 1);
  EXPECT_GT(with, 1.2 * without);
}

}  // namespace
}  // namespace plenolab
