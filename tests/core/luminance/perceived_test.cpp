#include "core/luminance/perceived.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/luminance/ray_reinhard.h"
#include "core/tonemap/reinhard_global.h"
#include "tests/core/luminance/ray_fixtures.h"

namespace plenolab {
namespace {

template <class Function>
SceneRays rays_by(const RayDisplay& display, const Function& colour) {
  SceneRays rays(display.size());
  for (int k = 0; k < display.size().images; ++k)
    for (int u = 0; u < display.size().width; ++u)
      for (int v = 0; v < display.size().height; ++v) rays.at({k, u, v}) = colour(Ray{k, u, v});
  return rays;
}

SceneRays random_rays(const RayDisplay& display) {
  const auto luminance = random_luminance(display, -2, 3);
  return rays_by(display, [&](const Ray& ray) { return Rgb{1, 0.5f, 0.2f} * luminance.at(ray); });
}

TEST(Perceived, PictureIsThatOfTheLiteralDefinition) {
  const ProjectorDisplay projectors = small_projectors();
  const LensArrayDisplay slanted({.width = 60, .height = 8, .lenses_across = 10, .slant_lenses = 1.5});
  const RayDisplay* displays[] = {&projectors, &slanted};
  for (const RayDisplay* display : displays) {
    const SceneRays rays = random_rays(*display);
    for (const double x : {-0.4, 0.0, 0.31})
      for (const PinholeSize size : {display->resolution(), PinholeSize{33, 7}}) {
        const auto fast = perceive(*display, rays, {x, 0}, size, 2),
                   literal = perceive_literally(*display, rays, {x, 0}, size);
        EXPECT_EQ(fast.unlit, literal.unlit);
        for (std::size_t i = 0; i < fast.image.size(); ++i)
          EXPECT_NEAR(fast.image.pixels()[i].g, literal.image.pixels()[i].g,
                      1e-5f * (1 + literal.image.pixels()[i].g));
      }
  }
}

TEST(Perceived, PictureOfAConstantDisplayIsConstantWithoutRipple) {
  const ProjectorDisplay display = small_projectors();
  const SceneRays rays = rays_by(display, [](const Ray&) { return Rgb{3, 2, 1}; });
  for (double x = -5; x < 5; x += 0.37) {
    const auto seen = perceive(display, rays, {x, 0}, display.resolution());
    for (const Rgb c : seen.image.pixels()) EXPECT_NEAR(c.r, 3, 1e-5f);
  }
}

TEST(Perceived, PixelsThatNoRayLightsAreBlackAndCounted) {
  const ProjectorDisplay display = small_projectors();
  const SceneRays rays = rays_by(display, [](const Ray&) { return Rgb{1, 1, 1}; });
  const auto far = perceive(display, rays, {200, 0}, {16, 9});
  EXPECT_EQ(far.unlit, 16 * 9);
  EXPECT_EQ(far.image.at(3, 3), Rgb{});
}

TEST(Perceived, ProjectorPictureIsSeenFromWhereItsRaysMeetTheObserver) {
  // Projector k alone is bright: an observer at X of its ray through column u sees it there and nowhere far
  // from it.
  const ProjectorDisplay display = small_projectors(24, 64, 4);
  const SceneRays rays = rays_by(display, [](const Ray& ray) {
    return ray.image == 9 ? Rgb{1, 1, 1} : Rgb{};
  });
  const auto seen = perceive(display, rays, display.position({9, 30, 0}), {64, 4});
  EXPECT_GT(seen.image.at(30, 2).r, 0.5f);
  const double columns_of_reach = display.reach_m() / (5 * 0.645 / 64);
  EXPECT_EQ(seen.image.at(std::min(63, 30 + static_cast<int>(columns_of_reach) + 2), 2).r, 0);
}

TEST(RayImages, PicturesGoInAndOutUnchanged) {
  const ProjectorDisplay display = small_projectors(3, 5, 4);
  const SceneRays rays = random_rays(display);
  SceneRays copy(display.size());
  for (int k = 0; k < 3; ++k) set_image(copy, k, image_of(rays, k));
  EXPECT_EQ(static_cast<const RayValues<Rgb>&>(copy), rays);
  EXPECT_THROW(set_image(copy, 0, SceneImage(4, 4)), InputError);
}

TEST(RayImages, DefectsAreRepairedAndCounted) {
  const ProjectorDisplay display = small_projectors(3, 70, 4);
  SceneRays rays = rays_by(display, [](const Ray&) { return Rgb{2, 2, 2}; });
  EXPECT_NEAR(luminance_of(rays).at({1, 2, 3}), 2, 1e-6f);
  EXPECT_EQ(repair(rays).total(), 0);
  rays.at({0, 1, 2}).r = std::numeric_limits<float>::quiet_NaN();
  rays.at({2, 69, 3}).g = std::numeric_limits<float>::infinity();
  rays.at({1, 0, 0}).b = -1;
  EXPECT_EQ(repair(rays), (PixelRepairs{1, 1, 1}));
  const auto luminance = luminance_of(rays);
  EXPECT_NEAR(luminance.at({2, 69, 3}), 2, 1e-6f);
  EXPECT_NEAR(luminance.at({0, 1, 2}), 2 * (1 - 0.2126f), 1e-6f);
}

TEST(RayReinhard, IsThePhotographicCurveWithTheLuminanceOfEachRay) {
  const ProjectorDisplay display = small_projectors();
  const SceneRays rays = random_rays(display);
  const auto estimate = estimate_luminance(display, luminance_of(rays), samples_of(display, 50), {});
  const auto mapped = map_rays(display, rays, estimate, {.key = 0.3});
  for (const Ray ray : {Ray{0, 0, 0}, {5, 20, 7}, {11, 39, 19}}) {
    const double l = static_cast<double>(luminance(rays.at(ray)));
    const double average = std::exp(*estimate.ln_at(display.position(ray)));
    const double adapted = reinhard_curve(0.3 * l / average);
    EXPECT_NEAR(static_cast<double>(mapped.light.at(ray).g),
                std::min(1.0, static_cast<double>(rays.at(ray).g) * adapted / l), 1e-5);
  }
}

TEST(RayReinhard, OfAPictureEqualsThatOfRaysWithOneLuminanceForAll) {
  const ProjectorDisplay display = small_projectors(2, 9, 5);
  const SceneRays rays = random_rays(display);
  const LuminanceOptions all{.method = LuminanceMethod::kAll};
  const auto estimate = estimate_luminance(display, luminance_of(rays), samples_of(display, 4), all);
  const auto by_rays = map_rays(display, rays, estimate);
  const auto picture = map_picture(image_of(rays, 1), estimate.ln_luminance[0]);
  for (int v = 0; v < 5; ++v)
    for (int u = 0; u < 9; ++u) EXPECT_NEAR(picture.light.at(u, v).r, by_rays.light.at({1, u, v}).r, 1e-6f);
}

TEST(RayReinhard, StaysWithinTheDisplayAndCountsWhatItCuts) {
  const MultiViewDisplay display({.views = 1, .width = 2, .height = 1});
  SceneRays rays(display.size());
  rays.at({0, 0, 0}) = {0, 0, 1e6f};  // saturated: blue times L_a/L is far above 1
  rays.at({0, 1, 0}) = {1e-9f, 1e9f, 0};
  const GlobalLuminance one{samples_of(display, 1), {0.0}, {1}};
  const auto mapped = map_rays(display, rays, one);
  EXPECT_EQ(mapped.clipped, 2);
  EXPECT_EQ(mapped.light.at({0, 0, 0}).b, 1);
  EXPECT_GE(mapped.light.at({0, 1, 0}).r, 0);
}

TEST(RayReinhard, HoldsOverTheWholeRangeOfFloat) {
  for (const float level : {1e-38f, 1e-20f, 1.0f, 1e20f, 3e38f}) {
    // A grey at L̄ becomes α/(1 + α); what is far brighter white, what is far darker black.
    SceneImage picture(9, 1);
    for (int x = 0; x < 9; ++x) picture.at(x, 0) = {level, level, level};
    picture.at(7, 0) = {3e38f, 3e38f, 3e38f};
    picture.at(8, 0) = {0, 0, 0};
    const auto mapped = map_picture(picture, std::log(static_cast<double>(level)), {.key = 0.18});
    EXPECT_NEAR(mapped.light.at(0, 0).g, 0.18f / 1.18f, 1e-5f) << level;
    EXPECT_GE(mapped.light.at(7, 0).g, 0.18f / 1.18f - 1e-5f) << level;
    EXPECT_LE(mapped.light.at(7, 0).g, 1) << level;
    EXPECT_EQ(mapped.light.at(8, 0), Rgb{}) << level;
  }
}

TEST(RayReinhard, BrighterPixelsAreNeverShownDarker) {
  SceneImage picture(78, 1);
  for (int x = 0; x < 78; ++x) {
    const float v = static_cast<float>(3 * std::pow(10.0, x - 39));
    picture.at(x, 0) = {v, v, v};
  }
  for (const double average : {1e-30, 1.0, 1e30}) {
    const auto mapped = map_picture(picture, std::log(average));
    for (int x = 1; x < 78; ++x)
      EXPECT_GE(mapped.light.at(x, 0).g, mapped.light.at(x - 1, 0).g - 1e-6f) << x << " " << average;
    EXPECT_GT(mapped.light.at(77, 0).g, 0.9f) << average;
  }
}

TEST(RayReinhard, LeavesAFieldWithoutLuminanceBlackAndSaysSo) {
  const ProjectorDisplay display = small_projectors(2, 4, 3);
  const SceneRays black(display.size());
  const auto estimate = estimate_luminance(display, luminance_of(black), samples_of(display, 10), {});
  const auto mapped = map_rays(display, black, estimate);
  EXPECT_EQ(mapped.undefined, 24);
  EXPECT_EQ(map_picture(SceneImage(3, 3), std::nullopt).undefined, 9);
  EXPECT_THROW(map_rays(display, black, estimate, {.key = 0}), InputError);
}

}  // namespace
}  // namespace plenolab
