#include "experiments/brisque_training.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace plenolab {
namespace {

/// Pictures of four scenes whose target follows from one of their features.
std::vector<TrainingPicture> made_up(double noise) {
  std::vector<TrainingPicture> pictures;
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream random(1, 2, i);
    TrainingPicture picture;
    picture.scene = "scene-" + std::to_string(i % 4);
    picture.distortion = "noise";
    for (double& f : picture.features) f = 0.1 + random.next_double();
    picture.target = 50 + 15 * std::log(picture.features[1]) + noise * (random.next_double() - 0.5);
    pictures.push_back(picture);
  }
  return pictures;
}

TEST(BrisqueTraining, FindsWhatTheTargetFollowsFromAlsoForScenesItHasNotSeen) {
  const auto pictures = made_up(0);
  const std::vector<double> scores = hold_out_scores(pictures, 1e-3);
  std::vector<double> targets;
  for (const TrainingPicture& picture : pictures) targets.push_back(picture.target);
  EXPECT_GT(agreement(scores, targets).pearson, 0.98);
}

TEST(BrisqueTraining, FindsNothingInNoise) {
  auto pictures = made_up(0);
  for (std::size_t i = 0; i < pictures.size(); ++i)
    pictures[i].target = 100 * unit_double(random_u64(7, 8, i));
  const std::vector<double> scores = hold_out_scores(pictures, 1);
  std::vector<double> targets;
  for (const TrainingPicture& picture : pictures) targets.push_back(picture.target);
  EXPECT_LT(std::abs(agreement(scores, targets).pearson), 0.3) << "pictures of a scene are really left out";
}

TEST(BrisqueTraining, IsReproducible) {
  const auto pictures = made_up(5);
  EXPECT_EQ(train_brisque(pictures, 1).weights, train_brisque(pictures, 1).weights);
}

TEST(Agreement, IsPearsonSpearmanAndRootMeanSquare) {
  const std::vector<double> scores{1, 2, 3, 10}, targets{1, 2, 3, 4};
  const Agreement a = agreement(scores, targets);
  EXPECT_EQ(a.pictures, 4);
  EXPECT_EQ(a.spearman, 1);
  EXPECT_NEAR(a.pearson, 14 / std::sqrt(50.0 * 5), 1e-12);
  EXPECT_EQ(a.rms_error, 3);
  const std::vector<double> constant{2, 2, 2, 2};
  EXPECT_EQ(agreement(constant, targets).pearson, 0);
}

TEST(WeightsHeader, HoldsTheNumbersAndWhereTheyCameFrom) {
  const TrainedBrisque trained{std::vector<double>(36, 1.5), std::vector<double>(36, 2.0),
                               std::vector<double>(72, 0.25), 12.5};
  const std::string text = brisque_weights_header(trained, {"Trained here."});
  EXPECT_NE(text.find("// Trained here.\n"), std::string::npos);
  EXPECT_NE(text.find("kWeights[72] = {\n    0.25, 0.25"), std::string::npos);
  EXPECT_NE(text.find("kIntercept = 12.5;"), std::string::npos);
}

}  // namespace
}  // namespace plenolab
