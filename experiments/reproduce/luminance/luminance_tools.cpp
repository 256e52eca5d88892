#include "experiments/reproduce/luminance/luminance_tools.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace plenolab {

std::string display_paper(const std::string& where) {
  return "Doronin & Barsi 2018, " + where;
}

std::string paper_name(LuminanceMethod method) {
  switch (method) {
    case LuminanceMethod::kAll:
      return "All";
    case LuminanceMethod::kBruteForce:
      return "BruteForce";
    case LuminanceMethod::kAccumulative:
      return "Accumulative";
    case LuminanceMethod::kSpread:
      return "Spread";
  }
  return "";
}

void conclude_on(ReproductionResult& result, std::vector<std::string> scenes, Claim claim, Verdict verdict,
                 std::string explanation) {
  verdict.scenes = std::move(scenes);
  verdict.explanation = std::move(explanation);
  conclude(result, std::move(claim), std::move(verdict));
}

const std::vector<std::vector<double>>& scores_against(const LuminanceBench::Scores& scores,
                                                       bool ground_truth) {
  return ground_truth ? scores.ground_truth_db : scores.on_result_db;
}

std::string trend_text(const std::vector<double>& values) {
  if (values.empty()) return "is not known";
  const auto never = [&](auto compare) {
    return std::adjacent_find(values.begin(), values.end(), compare) == values.end();
  };
  const bool falls = never(std::less_equal<>()), grows = never(std::greater_equal<>());
  if (values.size() > 1 && falls != grows)
    return fmt::format("{} from {:.3f} to {:.3f}", falls ? "falls" : "grows", values.front(), values.back());
  return fmt::format("goes over {:.3f}", fmt::join(values, ", "));
}

std::optional<double> difference(std::optional<double> a, std::optional<double> b) {
  if (!a || !b) return std::nullopt;
  return *a - *b;
}

std::optional<double> rms_of_defined(const std::vector<std::optional<double>>& values) {
  double squares = 0, count = 0;
  for (const std::optional<double>& value : values)
    if (value) squares += *value * *value, count += 1;
  if (count == 0) return std::nullopt;
  return std::sqrt(squares / count);
}

std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

}  // namespace plenolab
