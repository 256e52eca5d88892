// What is timed for an item, and what is counted.
#include "experiments/batch/measure.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/base/random.h"
#include "tests/experiments/batch/batch_command.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Of random luminance, with pixels of luminance 0, which the floor stands for.
SceneImage noise(std::uint64_t seed, float brightest) {
  SceneImage image(48, 32, {});
  for (std::size_t i = 200; i < image.size(); ++i) {
    const auto value = static_cast<float>(random_u64(seed, i, 0) % 1000 + 1) * brightest / 1000;
    image.pixels()[i] = {value, value * 0.9f, value * 0.7f};
  }
  return image;
}

/// Whether the mapped image changes with the statistics that the operator is fitted to.
bool depends_on_statistics(const OperatorChoice& choice, std::optional<double> unit) {
  const auto image = std::make_shared<const SceneImage>(noise(1, 3e5f));  // beyond PQ, too
  const OperatorView view{image, std::make_shared<const DisparityMap>(48, 32, 1.0f)};
  const OperatorView other{std::make_shared<const SceneImage>(noise(2, 3)), view.disparity};
  FitScope scope = scope_of_image(view, 1, unit);
  const DisplayImage own = choice.info->fit(choice.variant.id, choice.values, scope).apply(view, 1).image;
  const FitScope wrong = scope_of_image(other, 1, unit);
  scope.statistics = wrong.statistics;
  scope.floor = wrong.floor;
  scope.scale = wrong.scale;
  const DisplayImage changed = choice.info->fit(choice.variant.id, choice.values, scope).apply(view, 1).image;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own.pixels()[i].r != changed.pixels()[i].r) return true;
  return false;
}

TEST(BatchTimes, StatisticsCountToTheOperatorsThatReadThemAndToNoOther) {
  for (const OperatorInfo& info : tone_mapping_operators())
    for (const std::optional<double> unit : {std::optional<double>(1), std::optional<double>()}) {
      const OperatorChoice choice = choose_operator({info.id, "", {}});
      EXPECT_EQ(reads_statistics(choice, unit.has_value()), depends_on_statistics(choice, unit))
          << info.id << (unit ? " in cd/m²" : " in relative units");
    }
  EXPECT_FALSE(reads_statistics(choose_operator({"pq", "", {"unit=2"}}), false));
}

/// Values of a quantity in a table, by operator and variant.
std::map<std::string, std::vector<double>> values_by_operator(const std::string& csv,
                                                              const std::string& quantity) {
  std::map<std::string, std::vector<double>> values;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("," + quantity + ",");
    if (at == std::string::npos) continue;
    const std::size_t view_end = line.find("\",") + 2;
    values[line.substr(view_end, line.find(',', view_end) - view_end)].push_back(
        std::stod(line.substr(at + quantity.size() + 2)));
  }
  return values;
}

class BatchMeasurements : public BatchCommand {};

TEST_F(BatchMeasurements, TimesOfStatisticsAreThoseOfTheViewForAllOperatorsAlike) {
  Json study = tiny_batch();
  study["operators"] = Json::parse(R"([{"name": "reinhard02"}, {"name": "histogram"}, {"name": "pq"},
                                       {"name": "reinhard05", "variant": "joint"}])");
  write_tiny_batch(parent_.path(), study);
  run("out");
  const auto seconds = values_by_operator(batch_file(folder("out"), "timings.csv"), "seconds_statistics");
  ASSERT_EQ(seconds.size(), 4u);
  EXPECT_EQ(seconds.at("pq"), std::vector<double>(9, 0));
  for (const double value : seconds.at("reinhard02")) EXPECT_GT(value, 0);
  EXPECT_EQ(seconds.at("reinhard02"), seconds.at("histogram")) << "measured once, counted to each";
  EXPECT_EQ(seconds.at("reinhard02"), seconds.at("reinhard05"));
  EXPECT_EQ(csv("out").find("seconds"), std::string::npos);
}

TEST_F(BatchMeasurements, CountsOfKeyViewAdjustmentAreThoseOfTonemapLf) {
  Json study = tiny_batch();
  study["inputs"][0].erase("cd_m2_per_unit");
  study["operators"] =
      Json::parse(R"([{"name": "histogram", "variant": "adjusted"}, {"name": "reinhard02"}])");
  write_tiny_batch(parent_.path(), study);
  run("out");
  const ProgramResult mapped =
      run_program({"tonemap-lf", folder("field"), "-o", folder("mapped"), "--operator", "histogram",
                   "--variant", "adjusted", "--json", "-"});
  ASSERT_EQ(mapped.status, 0) << mapped.err;
  const Json document = Json::parse(mapped.out);
  for (const char* quantity : {"correspondences_per_pixel", "kept_dark", "adjusted_clipped_high",
                               "adjusted_floored_pixels", "hdr_repairs", "display_repairs"}) {
    const auto values = values_by_operator(csv("out"), quantity);
    ASSERT_EQ(values.size(), 1u) << quantity << ": of the adjusted operator alone";
    for (const Json& row : document.at("rows")) {
      if (row.at("quantity") != quantity) continue;
      EXPECT_EQ(values.at("histogram"), std::vector<double>(9, row.at("value"))) << quantity;
    }
  }
  EXPECT_NE(batch_file(folder("out"), "report.html").find("Of key-view adjustment"), std::string::npos);
}

}  // namespace
}  // namespace plenolab
