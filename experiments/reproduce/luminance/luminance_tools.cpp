#include "experiments/reproduce/luminance/luminance_tools.h"

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

std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

}  // namespace plenolab
