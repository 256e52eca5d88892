#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/image/colour.h"
#include "core/synthesis/synthesizer.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_occluders.h"
#include "experiments/reproduce/claims/geometry_restored.h"
#include "experiments/reproduce/figure_tools.h"
#include "stimuli/scenes/modelling/textures.h"

namespace plenolab {
namespace {

FlatSurface plain_surface(double disparity_px, float value) {
  return {disparity_px, {}, Rgb{value, value, value}};
}

Mask rectangle_mask(int width, int height, int x, int y, int w, int h) {
  Mask mask(width, height);
  for (int j = y; j < y + h; ++j)
    for (int i = x; i < x + w; ++i) mask.at(i, j) = 1;
  return mask;
}

OccluderPlacement facing_squares(double gap_px, double disparity_px) {
  Shape left{.kind = ShapeKind::kSquare, .y = kOccluderHeight / 2.0, .radius_px = 15};
  Shape right = left;
  const double half = reach(left, 0) + gap_px / 2;
  left.x = kOccluderWidth / 2.0 - half;
  right.x = kOccluderWidth / 2.0 + half;
  return {{left, right}, {disparity_px, disparity_px}, 0};
}

TEST(Probes, AFlatSurfaceMovesAgainstTheCameraByItsDisparity) {
  FlatSurface square = plain_surface(6, 1);
  square.covers = [](double x, double y) { return x >= 8 && x < 12 && y >= 4 && y < 8; };
  FlatWorld world;
  world.origin = {0, 0};
  world.surfaces = {plain_surface(0, 0.25f), square};
  const KeyView<SceneReferred> view = flat_view(world, probe_grid(2, 2, 0.1, 24, 16), {1, 0});
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x) {
      const bool on_square = x >= 2 && x < 6 && y >= 4 && y < 8;
      EXPECT_FLOAT_EQ(view.colour.at(x, y).g, on_square ? 1 : 0.25f) << x << ' ' << y;
      EXPECT_FLOAT_EQ(view.disparity.at(x, y), on_square ? 6 : 0) << x << ' ' << y;
    }
}

TEST(Probes, SynthesisReproducesAFlatWorldWithoutOccluders) {
  FlatWorld world;
  world.surfaces = {{5, {}, flat_pattern(6, 3)}};
  const ViewGrid grid = probe_grid(2, 2, 0.1, 48, 36);
  const auto view = synthesize(flat_light_field(world, grid, "plane"), {0.3, 0.6});
  const SceneImage truth = flat_view(world, grid, {0.3, 0.6}).colour;
  ErrorSum sum;
  const Plane<float> squares = squared_error(view.image, truth, 1);
  for (const float square : squares.pixels()) sum.add(static_cast<double>(square));
  EXPECT_LT(sum.rms(), 0.005);
}

TEST(Probes, SealingTellsScenesApartByGeometryAndTexture) {
  const auto sealed = [](float albedo, float size) {
    Scene scene = empty_probe("probe-test");
    Material material;
    material.albedo = plain({albedo, albedo, albedo});
    add_surface(scene, material, card({0, 2, 0}, size, 1));
    seal(scene);
    return scene.variant;
  };
  EXPECT_EQ(sealed(0.5f, 1), sealed(0.5f, 1));
  EXPECT_NE(sealed(0.5f, 1), sealed(0.6f, 1));
  EXPECT_NE(sealed(0.5f, 1), sealed(0.5f, 1.5f));
}

TEST(Probes, ABlockIsClosedAndItsFacesLookOutwards) {
  const Mesh mesh = block({1, 2, 3}, {2, 4, 6});
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.positions_m[t[0]], b = mesh.positions_m[t[1]], c = mesh.positions_m[t[2]];
    EXPECT_GT((b - a).cross(c - a).dot(mesh.normals[t[0]]), 0);
    volume += static_cast<double>(a.dot(b.cross(c))) / 6;
  }
  EXPECT_NEAR(volume, 48, 1e-3);
}

TEST(GeometryMeasures, AStripOfTwoPixelsIsRimAndABlockOfThreeIsNot) {
  EXPECT_EQ(count_set(beyond_rim(rectangle_mask(12, 12, 1, 4, 10, 2))), 0u);
  EXPECT_EQ(count_set(beyond_rim(rectangle_mask(12, 12, 9, 9, 3, 3))), 9u);
}

TEST(GeometryMeasures, WithARimOfOnePixelAStripOfTwoPixelsIsNoRim) {
  EXPECT_EQ(count_set(beyond_rim(rectangle_mask(12, 12, 1, 4, 10, 2), 2)), 20u);
  EXPECT_EQ(count_set(beyond_rim(rectangle_mask(12, 12, 1, 4, 10, 1), 2)), 0u);
}

TEST(GeometryOccluders, TheRarestShapeIsFoundForGeometryAndSynthesisApart) {
  const auto study = [](ShapeKind kind, bool unseen, bool hidden) {
    OccluderStudy s;
    s.kind = kind;
    s.outcomes.resize(2);
    s.outcomes[1].unseen = unseen;
    s.outcomes[1].hidden = hidden;
    return s;
  };
  const std::vector<OccluderStudy> studies{study(ShapeKind::kDisc, true, false),
                                           study(ShapeKind::kSquare, false, true)};
  EXPECT_EQ(rarest_of(studies, UnseenBy::kGeometry).kind, ShapeKind::kDisc);
  EXPECT_EQ(rarest_of(studies, UnseenBy::kSynthesis).kind, ShapeKind::kSquare);
  EXPECT_EQ(unseen_share(studies, UnseenBy::kGeometry).estimate, 0.25);
}

TEST(GeometryMeasures, TheWilsonIntervalOfAShareHasPublishedValues) {
  const Interval half = share_interval(5, 10);
  EXPECT_NEAR(half.low, 0.2366, 1e-4);
  EXPECT_NEAR(half.high, 0.7634, 1e-4);
  const Interval none = share_interval(0, 96);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 3.8415 / (96 + 3.8415), 1e-4);
  EXPECT_EQ(share_interval(7, 7).high, 1);
  const Interval of_four = share_interval(5, 10, kNormal95OfFour);
  EXPECT_LT(of_four.low, half.low);
  EXPECT_GT(of_four.high, half.high);
  // Phi(2.497705) = 1 - 0.05/8
  EXPECT_NEAR(0.5 * std::erfc(kNormal95OfFour / std::numbers::sqrt2), 0.05 / 8, 1e-7);
  EXPECT_NEAR(0.5 * std::erfc(kNormal95 / std::numbers::sqrt2), 0.025, 1e-7);
}

TEST(GeometryShapes, ReachIsTheSupportFunctionOfTheSilhouette) {
  const Shape square{.kind = ShapeKind::kSquare, .x = 3, .y = 4, .radius_px = 10};
  EXPECT_NEAR(reach(square, 0), 7.07, 0.2);
  EXPECT_NEAR(reach(square, std::numbers::pi / 4), 10, 0.2);
}

TEST(GeometryShapes, ConvexShapesContainTheMiddleOfAnyTwoOfTheirPoints) {
  for (const ShapeKind kind : convex_shapes()) {
    RandomStream random(1, 2, static_cast<std::uint64_t>(kind));
    const auto covers = silhouette(random_shape(kind, 10, 20, random));
    std::vector<std::array<double, 2>> inside;
    while (inside.size() < 60) {
      const double x = uniform(random, -20, 20), y = uniform(random, -20, 20);
      if (covers(x, y)) inside.push_back({x, y});
    }
    for (const auto& p : inside)
      for (const auto& q : inside) EXPECT_TRUE(covers((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)) << name_of(kind);
  }
}

TEST(GeometryOccluders, ASingleConvexOccluderHidesNothingFromAllKeyViews) {
  for (const ShapeKind kind : convex_shapes())
    for (std::uint64_t i = 0; i < 3; ++i) {
      RandomStream random(5, 6, i);
      const FlatWorld world = world_of(place_inside(kind, random), Patterned::kNothing);
      EXPECT_EQ(count_set(hidden_from_all(world, occluder_grid(), {0.4, 0.6})), 0u) << name_of(kind);
    }
}

TEST(GeometryOccluders, BackgroundBetweenTwoSquaresIsHiddenWhereTheGapIsNarrow) {
  const auto hidden = [](double gap_px) {
    return count_set(beyond_rim(hidden_from_all(world_of(facing_squares(gap_px, 12), Patterned::kNothing),
                                                occluder_grid(), {0.5, 0.5})));
  };
  EXPECT_GT(hidden(4), 20u);
  EXPECT_EQ(hidden(24), 0u);  // wider than the displacement between key views: some key view looks through
}

TEST(GeometryOccluders, SynthesisMissesWhatGeometryHides) {
  const OccluderOutcome outcome = judge(facing_squares(4, 12), 1, 1);
  EXPECT_TRUE(outcome.unseen);
  EXPECT_GT(outcome.unseen_px.hidden, 5);
}

TEST(GeometryOccluders, AStudyDoesNotDependOnTheNumberOfThreads) {
  const auto study = [](int threads) {
    LaboratoryOptions options;
    options.threads = threads;
    Laboratory laboratory(options);
    return study_occluders(laboratory, concave_shapes().first(2), place_inside, 3, 0x77);
  };
  const auto one = study(1), four = study(4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    ASSERT_EQ(one[k].outcomes.size(), 3u);
    EXPECT_EQ(one[k].name, name_of(one[k].kind));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(one[k].placements[i].shapes[0].x, four[k].placements[i].shapes[0].x);
      EXPECT_EQ(one[k].outcomes[i].unseen_px.all(), four[k].outcomes[i].unseen_px.all());
      EXPECT_EQ(one[k].outcomes[i].geometry_px, four[k].outcomes[i].geometry_px);
    }
  }
}

TEST(GeometryOccluders, GeometryAloneSaysTheSameAsBesideSynthesis) {
  Laboratory laboratory(LaboratoryOptions{});
  const Placing narrow_gap = [](ShapeKind, RandomStream&) { return facing_squares(4, 12); };
  for (const Placing placing : {narrow_gap, place_inside}) {
    const auto both = study_occluders(laboratory, concave_shapes(), placing, 1, 0x78);
    const auto alone = study_geometry(laboratory, concave_shapes(), placing, 1, 0x78);
    for (std::size_t k = 0; k < both.size(); ++k) {
      EXPECT_EQ(both[k].outcomes[0].hidden, alone[k].outcomes[0].hidden);
      EXPECT_EQ(both[k].outcomes[0].hidden_2x2, alone[k].outcomes[0].hidden_2x2);
      EXPECT_EQ(both[k].outcomes[0].geometry_px, alone[k].outcomes[0].geometry_px);
      EXPECT_TRUE(alone[k].hidden() == 1 || placing == place_inside);
    }
  }
}

TEST(GeometryOccluders, BoundsOfAnOccluderChangeNothing) {
  std::size_t hidden = 0;
  for (const Placing placing : {place_inside, place_pair, place_at_border})
    for (const ShapeKind kind : concave_shapes())
      for (const Patterned patterned : {Patterned::kNothing, Patterned::kEverything}) {
        RandomStream random(8, 9, static_cast<std::uint64_t>(kind));
        const FlatWorld bounded = world_of(placing(kind, random), patterned);
        FlatWorld unbounded = bounded;
        for (FlatSurface& surface : unbounded.surfaces) surface.bounds = {};
        const auto a = flat_view(bounded, occluder_grid(), {0, 1}),
                   b = flat_view(unbounded, occluder_grid(), {0, 1});
        EXPECT_EQ(a.colour, b.colour) << name_of(kind);
        EXPECT_EQ(a.disparity, b.disparity) << name_of(kind);
        for (const CameraPosition position : {CameraPosition{0.5, 0.5}, {0.1, 0.8}, {0.9, 0.3}}) {
          const Mask all = hidden_from_all(unbounded, occluder_grid(), position);
          EXPECT_EQ(hidden_from_all(bounded, occluder_grid(), position), all) << name_of(kind);
          hidden += count_set(all);
        }
      }
  EXPECT_GT(hidden, 100u) << "the comparison would say nothing without hidden pixels";
}

TEST(Probes, APatternIsSmoothAndRepeatsAfter64OfItsFeatures) {
  const FlatColour pattern = flat_pattern(4, 7), other = flat_pattern(4, 8);
  double difference = 0;
  for (double x = -20; x < 20; x += 0.7) {
    const Rgb here = pattern(x, 3.3);
    for (const float v : {here.r, here.g, here.b}) {
      EXPECT_GE(v, 0.04f);
      EXPECT_LE(v, 1.f);
    }
    EXPECT_NEAR(here.g, pattern(x + 64 * 4, 3.3 - 64 * 4).g, 1e-5);
    // A smooth step between two values 0.96 apart rises by at most 1.5 · 0.96 a feature.
    EXPECT_NEAR(here.g, pattern(x + 0.01, 3.3).g, 1.5 * 0.96 * 0.01 / 4 + 1e-6);
    difference += std::abs(static_cast<double>(here.g - other(x, 3.3).g));
  }
  EXPECT_GT(difference, 1);
}

/// Two by one pixels: the left one restored to disparity 2, the right one needed no restoration.
NovelView<SceneReferred> half_restored() {
  NovelView<SceneReferred> view;
  view.image = SceneImage(2, 1);
  view.restored = view.unseen = Mask(2, 1);
  view.restored.at(0, 0) = 1;
  view.provenance = Plane<PixelProvenance>(2, 1);
  view.provenance.at(0, 0)[0] = {.state = CorrespondenceState::kRestored, .disparity_px = 2, .weight = 1};
  return view;
}

TEST(RestoredBackground, IsToldFromStructuresThatAreNearerInTheTruth) {
  KeyView<SceneReferred> truth{SceneImage(2, 1, Rgb{1, 1, 1}), DisparityMap(2, 1, 2.5f)};
  const RestorationErrors background = restoration_errors(half_restored(), truth, 1);
  EXPECT_EQ(background.background.pixels, 1);
  EXPECT_EQ(background.foreground.pixels, 0);
  EXPECT_EQ(background.rest.pixels, 1);
  EXPECT_DOUBLE_EQ(background.background.rms(), 1);
  truth.disparity.at(0, 0) = 4;
  const RestorationErrors nearer = restoration_errors(half_restored(), truth, 1);
  EXPECT_EQ(nearer.background.pixels, 0);
  EXPECT_EQ(nearer.foreground.pixels, 1);
}

TEST(RestoredBackground, IsComparedWithTheRestOfTheViewsThatHaveAny) {
  const RestorationErrors twice{.background = {4, 1}, .foreground = {}, .rest = {1, 1}},
      none{.background = {}, .foreground = {}, .rest = {100, 1}},
      no_error{.background = {1, 1}, .foreground = {}, .rest = {}};
  const Interval ratio = restored_over_rest({twice, none, twice}, 1).value();
  EXPECT_DOUBLE_EQ(ratio.estimate, 2);
  EXPECT_DOUBLE_EQ(ratio.low, 2);
  EXPECT_FALSE(restored_over_rest({twice, none}, 1).has_value());
  EXPECT_FALSE(restored_over_rest({twice, no_error}, 1).has_value());
}

TEST(GeometryClaims, TheFrustumBoundHoldsOnlyWithOnePixelLessThanTheImage) {
  constexpr int kHeight = 36;
  const auto lost_rays = [](double disparity_px) {
    FlatWorld world;
    world.surfaces = {plain_surface(disparity_px, 0.5f)};
    SynthesisOptions options;
    options.record_provenance = true;
    const auto view =
        synthesize(flat_light_field(world, probe_grid(2, 2, 0.1, 48, kHeight), "plane"), {0.5, 0.3}, options);
    const auto pixels = view.provenance.pixels();
    return std::count_if(pixels.begin(), pixels.end(), [](const PixelProvenance& pixel) {
      return std::all_of(pixel.begin(), pixel.end(), [](const Correspondence& c) {
        return c.state == CorrespondenceState::kOutOfFrustum;
      });
    });
  };
  EXPECT_EQ(lost_rays(kHeight - 1), 0);
  EXPECT_EQ(lost_rays(kHeight - 0.05), 48);  // one row of pixels
}

TEST(GeometryClaims, EveryClaimOnProbesIsDecidedOnFiniteNumbersInATinyRun) {
  LaboratoryOptions options;
  options.effort = Effort::kTiny;
  options.threads = 1;
  Laboratory laboratory(options);
  for (const Reproduction* item :
       select_reproductions({"altmeier-claim-g5", "altmeier-claim-g7", "altmeier-claim-g8"})) {
    const ReproductionResult result = item->run(laboratory);
    EXPECT_FALSE(result.rows.empty()) << item->id;
    ASSERT_FALSE(result.ledger.empty()) << item->id;
    for (const LedgerEntry& entry : result.ledger) {
      EXPECT_TRUE(std::isfinite(entry.verdict.number)) << item->id;
      EXPECT_FALSE(entry.verdict.explanation.empty()) << item->id;
    }
  }
}

}  // namespace
}  // namespace plenolab
