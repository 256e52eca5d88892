#include <gtest/gtest.h>

#include "experiments/reproduce/optimisation/luminance_histograms.h"

namespace plenolab {
namespace {

HistogramSource source(double concentration, bool photograph) {
  HistogramSource source{"image", photograph, {}, {}};
  source.shape.concentration = concentration;
  return source;
}

Verdict verdict(const std::vector<HistogramSource>& natural) {
  const std::vector<HistogramSource> games{source(0.7, false), source(0.72, false), source(0.71, false)};
  return decide_spikiness(games, natural, &HistogramShape::concentration, "concentration_difference");
}

TEST(SpikinessVerdict, RenderedAgainstRenderedDecidesNothingAboutPhotographs) {
  const Verdict undecided = verdict({source(0.3, false), source(0.31, false), source(0.29, false)});
  EXPECT_EQ(undecided.outcome, Outcome::kUndecided);
  EXPECT_TRUE(undecided.quantity.empty());
  EXPECT_NE(undecided.explanation.find("No photograph"), std::string::npos) << undecided.explanation;
}

TEST(SpikinessVerdict, IsDecidedByTheDifferenceOnceThereIsAPhotograph) {
  EXPECT_EQ(verdict({source(0.3, true), source(0.31, false), source(0.29, false)}).outcome,
            Outcome::kConfirmed);
  EXPECT_EQ(verdict({source(0.9, true), source(0.91, false), source(0.89, false)}).outcome,
            Outcome::kRefuted);
}

}  // namespace
}  // namespace plenolab
