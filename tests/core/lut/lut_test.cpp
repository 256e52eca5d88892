// Look-up tables on the lattice: what is exact, what is near, what is refused.
#include "core/lut/lut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/lut/grade.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {

constexpr LutInterpolation kBoth[]{LutInterpolation::kTrilinear, LutInterpolation::kTetrahedral};

Rgb random_colour(std::uint64_t index) {
  RandomStream random(3, 1, index);
  return {random.next_float(), random.next_float(), random.next_float()};
}

/// Not linear along any axis nor along grey.
Lut curved_lut(int size) {
  return bake_lut(size, [](Rgb c) {
    return Rgb{c.r * c.r, std::sqrt(c.g) * (1 - 0.5f * c.b), 0.3f + 0.5f * c.r * c.b};
  });
}

double difference(Rgb a, Rgb b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(Lut, GivesItsNodesExactly) {
  for (const LutInterpolation interpolation : kBoth)
    for (const int size : {2, 17, 32, 33}) {
      const Lut lut = curved_lut(size);
      const PreparedLut prepared(lut);
      for (int b = 0; b < size; b += 3)
        for (int g = 0; g < size; g += 2)
          for (int r = 0; r < size; ++r) {
            const Rgb input = lut.input_of(r, g, b);
            // Inputs of 2^n + 1 nodes are exact in binary; others are rounded, as is what lies between.
            const double slack = size == 32 ? 3e-6 : 0;
            EXPECT_LE(difference(sample_lut(lut, input, interpolation), lut.node(r, g, b)), slack) << size;
            const DisplayImage pixel(1, 1, input);
            EXPECT_LE(difference(prepared.grade(pixel, {interpolation, 1}).image.at(0, 0), lut.node(r, g, b)),
                      slack);
          }
    }
}

TEST(Lut, IdentityKeepsEveryCodeOfEightAndSixteenBits) {
  for (const LutInterpolation interpolation : kBoth)
    for (const int size : {2, 16, 33, 65}) {
      const PreparedLut identity(identity_lut(size));
      DisplayImage ramp(65536, 1);
      for (int i = 0; i < ramp.width(); ++i) {
        const float v = static_cast<float>(i) / 65535.0f;
        ramp.at(i, 0) = {v, 1 - v, static_cast<float>((i * 7919) % 65536) / 65535.0f};
      }
      const GradedImage graded = identity.grade(ramp, {interpolation, 1});
      for (int i = 0; i < ramp.width(); ++i) {
        const Rgb in = ramp.at(i, 0), out = graded.image.at(i, 0);
        for (const auto& [a, b] : {std::pair(in.r, out.r), std::pair(in.g, out.g), std::pair(in.b, out.b)})
          ASSERT_EQ(std::lround(a * 65535), std::lround(b * 65535)) << size << " " << i;
      }
    }
}

TEST(Lut, FastRowsAgreeWithTheDefinitionForAnyNumberOfThreads) {
  DisplayImage image(61, 47);
  for (std::size_t i = 0; i < image.size(); ++i) image.pixels()[i] = random_colour(i);
  for (const LutInterpolation interpolation : kBoth) {
    const Lut lut = curved_lut(21);
    const PreparedLut prepared(lut);
    const GradedImage one = prepared.grade(image, {interpolation, 1}),
                      two = prepared.grade(image, {interpolation, 2});
    EXPECT_EQ(one.image, two.image);
    EXPECT_EQ(one.cut, 0);
    for (std::size_t i = 0; i < image.size(); ++i)
      ASSERT_LE(difference(one.image.pixels()[i], sample_lut(lut, image.pixels()[i], interpolation)), 1e-6);
  }
}

TEST(Lut, BothInterpolationsReproduceALinearTableAndNearlyACurvedOne) {
  const Lut linear = bake_lut(5, [](Rgb c) { return Rgb{0.2f * c.r + 0.3f * c.g, c.b, 1 - c.g}; });
  const Lut curved = curved_lut(33);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Rgb c = random_colour(i);
    for (const LutInterpolation interpolation : kBoth) {
      EXPECT_LE(difference(sample_lut(linear, c, interpolation), {0.2f * c.r + 0.3f * c.g, c.b, 1 - c.g}),
                1e-6);
      // The square of red errs by at most a quarter of the squared spacing; the root of green is steep at 0
      // only.
      if (c.g > 0.1f) {
        EXPECT_LE(difference(sample_lut(curved, c, interpolation),
                             {c.r * c.r, std::sqrt(c.g) * (1 - 0.5f * c.b), 0.3f + 0.5f * c.r * c.b}),
                  2e-3);
      }
    }
  }
}

TEST(Lut, TetrahedraKeepGreysBetweenGreyNodesGrey) {
  // Greys stay grey at nodes while the cells' other corners are coloured.
  const Lut lut = bake_lut(9, [](Rgb c) {
    return Rgb{c.r * c.r, c.g * c.g + (c.g - c.b) * 0.5f, c.b * c.b};
  });
  double worst_tetrahedral = 0, worst_trilinear = 0;
  for (int i = 0; i <= 1000; ++i) {
    const float v = static_cast<float>(i) / 1000;
    const Rgb tetrahedral = sample_lut(lut, {v, v, v}, LutInterpolation::kTetrahedral);
    const Lut crossed = bake_lut(2, [](Rgb c) { return Rgb{c.r, c.r * c.g, c.g}; });
    const Rgb trilinear = sample_lut(crossed, {v, v, v}, LutInterpolation::kTrilinear);
    worst_tetrahedral = std::max<double>(worst_tetrahedral, std::abs(tetrahedral.r - tetrahedral.g));
    worst_trilinear = std::max<double>(worst_trilinear, std::abs(trilinear.r - trilinear.g));
    const Rgb crossed_tetrahedral = sample_lut(crossed, {v, v, v}, LutInterpolation::kTetrahedral);
    EXPECT_NEAR(crossed_tetrahedral.r, crossed_tetrahedral.g, 1e-6);
  }
  EXPECT_LE(worst_tetrahedral, 1e-6);
  EXPECT_NEAR(worst_trilinear, 0.25, 1e-3);  // v against v² at v = ½
}

TEST(Lut, ColoursOutsideTheDomainTakeItsEnds) {
  Lut lut = curved_lut(7);
  lut.domain_min = {0.25f, 0.25f, 0.25f};
  lut.domain_max = {0.5f, 0.75f, 2};
  const float infinity = std::numeric_limits<float>::infinity(),
              nan = std::numeric_limits<float>::quiet_NaN();
  for (const LutInterpolation interpolation : kBoth) {
    EXPECT_EQ(sample_lut(lut, {-infinity, nan, -1e30f}, interpolation), lut.node(0, 0, 0));
    EXPECT_EQ(sample_lut(lut, {infinity, 1, 1e30f}, interpolation), lut.node(6, 6, 6));
    EXPECT_LE(difference(sample_lut(lut, {0.5f, 0.5f, 0.25f}, interpolation), lut.node(6, 3, 0)), 1e-6);
  }
}

TEST(Lut, GradingCutsAndCountsWhatAPictureCannotHold) {
  const PreparedLut lut(bake_lut(2, [](Rgb c) { return Rgb{c.r * 2, c.g - 0.5f, c.b}; }));
  const DisplayImage image(10, 3, {0.75f, 0.25f, 0.5f});
  const GradedImage graded = lut.grade(image);
  EXPECT_EQ(graded.cut, 60);
  EXPECT_EQ(graded.image.at(9, 2), (Rgb{1, 0, 0.5f}));
}

TEST(Lut, ABlendOfTablesGradesLikeTheBlendOfTheirPictures) {
  const Lut a = curved_lut(17), b = identity_lut(17), c = resample_lut(curved_lut(17), 9, kBoth[0]);
  const std::array<WeightedLut, 3> shares{{{&a, 0.25}, {&b, 0.5}, {&c, 0.25}}};
  const Lut blend = blend_luts(shares);
  EXPECT_EQ(blend.size, 17);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Rgb colour = random_colour(i);
    for (const LutInterpolation interpolation : kBoth) {
      const Rgb together =
          sample_lut(a, colour, interpolation) * 0.25f + sample_lut(b, colour, interpolation) * 0.5f +
          sample_lut(resample_lut(c, 17, LutInterpolation::kTetrahedral), colour, interpolation) * 0.25f;
      EXPECT_LE(difference(sample_lut(blend, colour, interpolation), together), 2e-6);
    }
  }
  const std::array<WeightedLut, 2> alone{{{&a, 1}, {&b, 0}}};
  EXPECT_EQ(blend_luts(alone).nodes, a.nodes);
}

TEST(Lut, RefusesBlendsAndTablesThatMeanNothing) {
  const Lut a = identity_lut(4);
  Lut b = a;
  b.domain_max = {2, 2, 2};
  const auto blend = [&](double first, double second, const Lut& other) {
    const std::array<WeightedLut, 2> shares{{{&a, first}, {&other, second}}};
    return message_of([&] { blend_luts(shares); });
  };
  EXPECT_EQ(blend(0.5, 0.4, a), "the weights of a blend sum to 0.9 and must sum to 1");
  EXPECT_EQ(blend(1.5, -0.5, a), "a weight of -0.5 is below 0");
  EXPECT_EQ(blend(0.5, 0.5, b), "look-up tables of the domains 0 to 1 and 0 to 2 cannot be blended");
  EXPECT_THROW(identity_lut(1), InputError);
  EXPECT_THROW(identity_lut(257), InputError);
  EXPECT_THROW(bake_lut(3, [](Rgb) { return Rgb{NAN, 0, 0}; }), InputError);
  Lut short_lut = a;
  short_lut.nodes.pop_back();
  EXPECT_THROW(PreparedLut{short_lut}, InputError);
}

TEST(Lut, RefusesNumbersThatItsArithmeticCannotBear) {
  Lut wide = identity_lut(4);
  wide.domain_min = {-3e38f, -3e38f, -3e38f};
  wide.domain_max = {3e38f, 3e38f, 3e38f};
  EXPECT_THROW(wide.validate(), InputError) << "the width of the domain overflows";
  Lut narrow = identity_lut(4);
  narrow.domain_max = {1e-44f, 1, 1};
  EXPECT_THROW(narrow.validate(), InputError) << "its inverse overflows";
  Lut steep = identity_lut(2);
  steep.nodes[1] = {3e38f, 0, 0};
  EXPECT_THROW(steep.validate(), InputError);
}

TEST(Lut, AtTheLimitsOfItsNumbersEveryColourIsFinite) {
  const float most = kLargestLutNumber;
  Lut lut = bake_lut(3, [](Rgb c) { return c; }, {-most, 0, -most}, {most, kNarrowestDomain, most});
  for (std::size_t i = 0; i < lut.nodes.size(); ++i)
    lut.nodes[i] = i % 2 == 0 ? Rgb{most, -most, most} : Rgb{-most, most, -most};
  lut.validate();
  for (const LutInterpolation interpolation : kBoth)
    for (std::uint64_t i = 0; i < 100; ++i) {
      const Rgb c = random_colour(i);
      for (const Rgb& colour : {c, c * 1e30f, c * 1e-30f, c * -3e38f}) {
        const Rgb out = sample_lut(lut, colour, interpolation);
        EXPECT_TRUE(std::isfinite(out.r) && std::isfinite(out.g) && std::isfinite(out.b));
        const Rgb fast =
            PreparedLut(lut).grade(DisplayImage(1, 1, colour), {interpolation, 1}).image.at(0, 0);
        EXPECT_TRUE(fast.r >= 0 && fast.r <= 1 && fast.g >= 0 && fast.g <= 1);
      }
    }
  EXPECT_EQ(sample_lut(lut, {0, 0, 0}, kBoth[0]), lut.node(1, 0, 1))
      << "the middle of the domain, not node 0";
}

TEST(Lut, OverAnotherDomainItIsTheSameTableAndBeyondItsOwnThatOfItsEnds) {
  const Lut lut = curved_lut(17);
  const Lut wide = resample_lut(lut, 49, {-1, -1, -1}, {2, 2, 2}, LutInterpolation::kTetrahedral);
  EXPECT_EQ(wide.domain_min, (Rgb{-1, -1, -1}));
  EXPECT_EQ(wide.node(0, 0, 0), lut.node(0, 0, 0));
  EXPECT_EQ(wide.node(48, 40, 48), lut.node(16, 16, 16));
  // Every third node of 49 over three widths is a node of 17 over one.
  for (int i = 0; i < 17; ++i) EXPECT_LE(difference(wide.node(16 + i, 16, 32), lut.node(i, 0, 16)), 1e-6);
  EXPECT_THROW(resample_lut(lut, 17, {0, 0, 0}, {0, 1, 1}, LutInterpolation::kTetrahedral), InputError);
  EXPECT_EQ(identity_lut(3, {-1, 0, 0}, {1, 2, 4}).node(2, 1, 1), (Rgb{1, 1, 2}));
}

TEST(Lut, CuttingNodesCountsWhatItChanges) {
  Lut lut = bake_lut(2, [](Rgb c) { return Rgb{2 * c.r, c.g - 0.5f, c.b}; });
  EXPECT_EQ(cut_all_to_unit(lut.nodes), 8);
  EXPECT_EQ(lut.node(1, 0, 1), (Rgb{1, 0, 1}));
  EXPECT_EQ(cut_all_to_unit(lut.nodes), 0);
}

}  // namespace
}  // namespace plenolab
