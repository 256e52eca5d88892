#include <gtest/gtest.h>

#include <cmath>

#include "experiments/reproduce/calibration/naive_focus.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {
namespace {

ReproductionResult run(const std::string& id) {
  Laboratory laboratory({.effort = Effort::kTiny, .cache = {}, .seed = 1, .threads = 2, .on_view = {}});
  return select_reproductions({id}).front()->run(laboratory);
}

/// Values of a quantity whose column has this value.
std::vector<double> values_of(const ReproductionResult& result, const std::string& quantity,
                              const std::string& column = "", const Cell& wanted = {}) {
  std::vector<double> values;
  for (const ResultRow& row : result.rows.rows()) {
    bool matches = row.quantity == quantity;
    if (!column.empty())
      matches = matches && std::any_of(row.columns.begin(), row.columns.end(), [&](const auto& cell) {
                  return cell.first == column && cell.second == wanted;
                });
    if (matches) values.push_back(row.value);
  }
  return values;
}

TEST(CalibrationItems, AllSayWhatThePaperAndWeShowAndWhyTheyDiffer) {
  for (const Reproduction& item : reproductions()) {
    if (item.chapter != Chapter::kCalibration) continue;
    const ReproductionResult result = run(item.id);
    for (const std::string* text : {&result.paper_shows, &result.ours_shows, &result.differs}) {
      EXPECT_FALSE(text->empty()) << item.id;
      EXPECT_TRUE(text->ends_with('.')) << item.id << ": " << *text;
      EXPECT_EQ(text->find("nan"), std::string::npos) << item.id << ": " << *text;
    }
    EXPECT_FALSE(result.rows.empty()) << item.id;
    EXPECT_FALSE(result.plots.empty()) << item.id;
    for (const NamedPlot& plot : result.plots) EXPECT_NO_THROW(plot.plot.plot.validate()) << item.id;
  }
}

TEST(CalibrationItems, FigureC3IsFlatOnlyWhereTheFieldsOfViewAgree) {
  const ReproductionResult result = run("hansen-fig-c.3");
  const auto equal = values_of(result, "position_mm", "display_fov_deg", 19.86),
             narrow = values_of(result, "position_mm", "display_fov_deg", 17.28);
  ASSERT_EQ(equal.size(), narrow.size());
  ASSERT_FALSE(equal.empty());
  for (const double position : equal) EXPECT_NEAR(position, 0, 1e-9);
  for (std::size_t i = 1; i < narrow.size(); ++i) EXPECT_LT(narrow[i], narrow[i - 1]);
}

TEST(CalibrationItems, TheCheckOfFigureC4PassesForARangeAroundTheRenderedAngle) {
  const ReproductionResult result = run("hansen-fig-c.4");
  const double low = values_of(result, "passing_fov_low_deg").at(0),
               high = values_of(result, "passing_fov_high_deg").at(0);
  EXPECT_LT(low, 19.86);
  EXPECT_GT(high, 19.86);
  EXPECT_GT(low, 17.28) << "it must exclude the calculated angle, or it would confirm nothing";
}

TEST(CalibrationItems, TheFitNearTheFocalLengthKeepsItsAccuracyAndThePlainOneDoesNot) {
  const ReproductionResult result = run("hansen-calibration-stability");
  for (const double error : values_of(result, "relative_error", "fit", std::string("vergence")))
    EXPECT_LT(error, 1e-6);
  EXPECT_GT(values_of(result, "relative_error", "fit", std::string("image distance")).back(), 1);
}

TEST(CalibrationItems, ThePlainFitFindsLengthsFarFromThePole) {
  const double f = 3.35, d = 3.25, subimage = 1;
  const FieldOfViewRecord angle{2 * std::atan(subimage / (2 * d)) * 180 / M_PI, 0.05};
  const NaiveFocusFit fit = fit_naive_focus(angle, {1000 * (1 / d - 1 / f), 0.1}, subimage, 3.2, 3.32, 100);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.lens_distance_mm, d, 1e-6);
  EXPECT_NEAR(fit.focal_length_mm, f, 1e-6);
}

TEST(CalibrationItems, TheAngleOfTheThesisIsNotCloseToTheCalculatedOne) {
  const ReproductionResult result = run("hansen-fov-conflict");
  ASSERT_EQ(result.ledger.size(), 2u);
  // 19.86 / 17.28 − 1, by the printed figures.
  EXPECT_NEAR(result.ledger[0].verdict.number, 0.149, 0.002);
  EXPECT_EQ(result.ledger[0].verdict.outcome, Outcome::kRefuted);
}

TEST(CalibrationItems, WhetherTheThinLensIsToBlameIsNotDecidedByAPValue) {
  const Verdict verdict = run("hansen-fov-conflict").ledger.at(1).verdict;
  EXPECT_EQ(verdict.outcome, Outcome::kUndecided);
  EXPECT_FALSE(verdict.interval.has_value()) << "a p-value is no measurement with an interval";
  EXPECT_TRUE(verdict.quantity.empty()) << verdict.quantity;
  EXPECT_NE(verdict.explanation.find("p = "), std::string::npos) << verdict.explanation;
}

}  // namespace
}  // namespace plenolab
