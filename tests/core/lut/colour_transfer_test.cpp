// Pictures that take the colours of others.
#include "core/lut/colour_transfer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/lut/grade.h"

namespace plenolab {
namespace {

/// Smooth random colours of a mean and spread of their own.
DisplayImage picture(std::uint64_t seed, Rgb mean, float spread) {
  DisplayImage image(60, 40);
  for (std::size_t i = 0; i < image.size(); ++i) {
    RandomStream random(seed, 9, i);
    const auto around = [&](float centre) {
      const float sum = random.next_float() + random.next_float() + random.next_float() - 1.5f;
      return std::clamp(centre + spread * sum, 0.0f, 1.0f);
    };
    image.pixels()[i] = {around(mean.r), around(mean.g), around(mean.b)};
  }
  return image;
}

TEST(ColourTransfer, BringsTheColoursOfOnePictureToThoseOfTheOther) {
  const DisplayImage cold = picture(1, {0.3f, 0.4f, 0.6f}, 0.15f),
                     warm = picture(2, {0.7f, 0.5f, 0.3f}, 0.2f);
  const ColourTransfer transfer = transfer_colours(cold, warm, {.size = 33});
  EXPECT_GT(transfer.distance_before, 15);
  EXPECT_LT(transfer.distance_after, 0.05 * transfer.distance_before);
}

TEST(ColourTransfer, DistancesAreOfThePicturesNotOfTheFewPixelsFitted) {
  const DisplayImage cold = picture(1, {0.3f, 0.4f, 0.6f}, 0.15f),
                     warm = picture(2, {0.7f, 0.5f, 0.3f}, 0.2f);
  const ColourTransfer two = transfer_colours(cold, warm, {.samples = 2, .size = 33}),
                       all = transfer_colours(cold, warm, {.size = 33});
  EXPECT_DOUBLE_EQ(two.distance_before, all.distance_before);
  EXPECT_GT(two.distance_after, 2) << "two pixels say little about a picture";
  EXPECT_LT(all.distance_after, 2);
}

TEST(ColourTransfer, TheDistanceWithoutTheTableTellsWhatTheTableLoses) {
  const DisplayImage cold = picture(1, {0.3f, 0.4f, 0.6f}, 0.15f),
                     warm = picture(2, {0.7f, 0.5f, 0.3f}, 0.2f);
  const ColourTransfer coarse = transfer_colours(cold, warm, {.size = 3}),
                       fine = transfer_colours(cold, warm, {.size = 65});
  EXPECT_DOUBLE_EQ(coarse.distance_unbaked, fine.distance_unbaked);
  EXPECT_LT(coarse.distance_unbaked, 0.5 * coarse.distance_after);
  EXPECT_NEAR(fine.distance_unbaked, fine.distance_after, 0.3);
}

TEST(ColourTransfer, TheTableHoldsTheTransferItselfAtItsNodes) {
  const ColourTransfer transfer =
      transfer_colours(picture(1, {0.3f, 0.4f, 0.6f}, 0.15f), picture(2, {0.7f, 0.5f, 0.3f}, 0.2f),
                       {.iterations = 4, .size = 5});
  for (int b = 0; b < 5; ++b)
    for (int g = 0; g < 5; ++g)
      for (int r = 0; r < 5; ++r)
        EXPECT_EQ(transfer.exact(transfer.lut.input_of(r, g, b)), transfer.lut.node(r, g, b));
}

TEST(ColourTransfer, ToItsOwnColoursIsNearlyTheIdentity) {
  const DisplayImage image = picture(3, {0.4f, 0.5f, 0.5f}, 0.3f);
  const ColourTransfer transfer = transfer_colours(image, image, {.iterations = 5, .size = 33});
  EXPECT_LT(transfer.distance_before, 1e-9);
  EXPECT_LT(transfer.distance_after, 0.3);
  const DisplayImage graded = PreparedLut(transfer.lut).grade(image).image;
  for (std::size_t i = 0; i < image.size(); ++i) {
    EXPECT_NEAR(graded.pixels()[i].r, image.pixels()[i].r, 0.02);
    EXPECT_NEAR(graded.pixels()[i].g, image.pixels()[i].g, 0.02);
    EXPECT_NEAR(graded.pixels()[i].b, image.pixels()[i].b, 0.02);
  }
}

TEST(ColourTransfer, IsRepeatableAndTheSeedTurnsItsAxesOnly) {
  const DisplayImage a = picture(1, {0.3f, 0.4f, 0.6f}, 0.1f), b = picture(2, {0.6f, 0.5f, 0.3f}, 0.1f);
  const auto with = [&](std::uint64_t seed) {
    return transfer_colours(a, b, {.iterations = 8, .size = 9, .seed = seed});
  };
  EXPECT_EQ(with(1).lut.nodes, with(1).lut.nodes);
  EXPECT_NE(with(1).lut.nodes, with(2).lut.nodes);
  EXPECT_NEAR(with(1).distance_after, with(2).distance_after, 0.2 * with(1).distance_before);
}

TEST(ColourTransfer, AmountMixesWithTheIdentity) {
  const DisplayImage a = picture(1, {0.3f, 0.4f, 0.6f}, 0.1f), b = picture(2, {0.6f, 0.5f, 0.3f}, 0.1f);
  const Lut none = transfer_colours(a, b, {.iterations = 2, .size = 9, .amount = 0}).lut;
  const Lut identity = identity_lut(9);
  for (std::size_t i = 0; i < none.nodes.size(); ++i) {
    EXPECT_NEAR(none.nodes[i].r, identity.nodes[i].r, 1e-5);
    EXPECT_NEAR(none.nodes[i].b, identity.nodes[i].b, 1e-5);
  }
}

TEST(ColourTransfer, OneColouredAndBlackPicturesGiveFiniteTables) {
  const DisplayImage black(4, 4, {0, 0, 0}), red(4, 4, {1, 0, 0}), one(1, 1, {0.5f, 0.2f, 0.1f});
  for (const DisplayImage* source : {&black, &red, &one})
    for (const DisplayImage* target : {&black, &red, &one}) {
      const ColourTransfer transfer = transfer_colours(*source, *target, {.iterations = 3, .size = 5});
      transfer.lut.validate();
      for (const Rgb& c : transfer.lut.nodes) EXPECT_TRUE(c.r >= 0 && c.r <= 1 && c.g >= 0 && c.b <= 1);
      const Rgb got = sample_lut(transfer.lut, source->pixels()[0], LutInterpolation::kTetrahedral);
      EXPECT_NEAR(got.r, target->pixels()[0].r, 0.1);
    }
  EXPECT_THROW(transfer_colours(DisplayImage(), red), InputError);
  EXPECT_THROW(transfer_colours(red, red, {.iterations = 0}), InputError);
  EXPECT_THROW(transfer_colours(red, red, {.amount = 2}), InputError);
}

}  // namespace
}  // namespace plenolab
