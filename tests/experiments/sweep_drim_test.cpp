#include "experiments/sweep_drim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/experiments/plane_field.h"

namespace plenolab {
namespace {

double value_of(const ResultTable& table, const std::string& quantity, long long divisor,
                long long orientations) {
  for (const ResultRow& row : table.rows()) {
    bool matches = row.quantity == quantity;
    for (const auto& [name, cell] : row.columns) {
      if (name == "divisor") matches = matches && cell == Cell(divisor);
      if (name == "orientations") matches = matches && cell == Cell(orientations);
    }
    if (matches) return row.value;
  }
  ADD_FAILURE() << quantity;
  return NAN;
}

TEST(DrimSweep, MeasuresEverySettingAgainstFullSizeAndSixOrientations) {
  SceneImage scene(70, 45);
  for (int y = 0; y < 45; ++y)
    for (int x = 0; x < 70; ++x)
      scene.at(x, y) = Rgb{1, 1, 1} * static_cast<float>(std::pow(10, x / 20.0) *
                                                         (2 + std::sin(0.9 * x) * std::sin(0.7 * y)));
  SweepImage image{"waves", {}};
  image.view.colour = std::make_shared<const SceneImage>(scene);
  OperatorOptions chosen;
  chosen.name = "reinhard02";
  const ResultTable table =
      sweep_drim(image, 10, choose_operator(chosen), {{1, 6}, {1, 2}, {2, 6}, {4, 1}}, {.runs = 1});
  EXPECT_EQ(value_of(table, "mean_error", 1, 6), 0);
  EXPECT_GT(value_of(table, "mean_error", 1, 2), 0);
  EXPECT_GT(value_of(table, "mean_error", 4, 1), 0);
  EXPECT_GT(value_of(table, "seconds_median", 2, 6), 0);
  EXPECT_EQ(value_of(table, "on_pareto_front", 1, 6), 1) << "nothing has less error than none";
}

}  // namespace
}  // namespace plenolab
