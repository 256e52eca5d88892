#include "analysis/result_table.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <stdexcept>

namespace plenolab {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

ResultTable sample() {
  ResultTable table;
  table.add({"psnr_gamma_db", 41.25, "dB", {{"scene", "cellar"}, {"view", 3LL}}});
  table.add({"psnr_gamma_db", kInfinity, "dB", {{"scene", "a \"dark\", wet\ntunnel"}, {"step_px", 0.5}}});
  return table;
}

TEST(ResultJson, HoldsFlatRowsInOrderBesideTheRun) {
  const std::string text = results_to_json_text({{"program", "plenolab"}}, sample());
  const auto json = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(json["run"]["program"], "plenolab");
  ASSERT_EQ(json["rows"].size(), 2u);
  EXPECT_EQ(json["rows"][0].dump(),
            R"({"scene":"cellar","view":3,"quantity":"psnr_gamma_db","value":41.25,"unit":"dB"})");
}

TEST(ResultJson, WritesInfinityAsNullWithText) {
  const std::string text = results_to_json_text({}, sample());
  const auto row = nlohmann::json::parse(text)["rows"][1];
  EXPECT_TRUE(row["value"].is_null());
  EXPECT_EQ(row["value_text"], "infinity");
  EXPECT_EQ(text.find(": inf"), std::string::npos);
}

TEST(ResultJson, StaysValidForTextThatIsNotUtf8) {
  ResultTable table;
  table.add({"runs", 1, "1", {{"file", std::string("a\xff\"b\n")}}});
  EXPECT_TRUE(nlohmann::json::accept(results_to_json_text({}, table)));
}

TEST(ResultCsv, QuotesFieldsAndLeavesAbsentCellsEmpty) {
  EXPECT_EQ(to_csv(sample()),
            "scene,view,step_px,quantity,value,unit\r\n"
            "cellar,3,,psnr_gamma_db,41.25,dB\r\n"
            "\"a \"\"dark\"\", wet\ntunnel\",,0.5,psnr_gamma_db,inf,dB\r\n");
}

TEST(ResultText, AlignsColumnsByCharactersNotBytes) {
  ResultTable table;
  table.add({"ssim", 0.98765432, "1", {{"scene", "Bäume"}}});
  table.add({"psnr", kInfinity, "dB", {{"scene", "Desk"}}});
  EXPECT_EQ(to_text(table),
            "scene  quantity   value  unit\n"
            "Bäume  ssim      0.9877\n"
            "Desk   psnr           ∞  dB\n");
}

TEST(ResultTable, RefusesNanAndBrokenColumns) {
  ResultTable table;
  EXPECT_THROW(table.add({"q", std::numeric_limits<double>::quiet_NaN(), "", {}}), std::logic_error);
  EXPECT_THROW(table.add({"", 1, "", {}}), std::logic_error);
  EXPECT_THROW(table.add({"q", 1, "", {{"value", 2LL}}}), std::logic_error);
  EXPECT_THROW(table.add({"q", 1, "", {{"a", 2LL}, {"a", 3LL}}}), std::logic_error);
  EXPECT_TRUE(table.empty());
}

TEST(ResultTable, AppendsAnotherTableOrItself) {
  ResultTable table = sample();
  table.append(table);
  EXPECT_EQ(table.rows().size(), 4u);
  EXPECT_EQ(table.column_names(), (std::vector<std::string>{"scene", "view", "step_px"}));
}

TEST(FormatNumber, KeepsSignificantDigits) {
  EXPECT_EQ(format_number(0), "0");
  EXPECT_EQ(format_number(41.2512), "41.25");
  EXPECT_EQ(format_number(120), "120");
  EXPECT_EQ(format_number(0.00123456), "0.001235");
  EXPECT_EQ(format_number(-12345.678), "-12346");
  EXPECT_EQ(format_number(1e-9), "1.000e-09");
  EXPECT_EQ(format_number(2.5e9), "2.500e+09");
  EXPECT_EQ(format_number(-kInfinity), "−∞");
}

TEST(ShortestNumber, ReadsBackTheSame) {
  for (const double v : {0.1, 1.0 / 3, 1e300, 5e-324, -0.0, 123456789.0}) {
    EXPECT_EQ(std::stod(shortest_number(v) == "5e-324" ? "0" : shortest_number(v)), v == 5e-324 ? 0 : v);
  }
  EXPECT_EQ(shortest_number(0.1), "0.1");
  EXPECT_EQ(shortest_number(-kInfinity), "-inf");
}

}  // namespace
}  // namespace plenolab
