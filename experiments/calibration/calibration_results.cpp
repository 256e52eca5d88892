#include "experiments/calibration/calibration_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/reproduce/claims/claim_statistics.h"

namespace plenolab {

namespace {

/// χ² as small or smaller is as rare as a contradiction: deviations are stated too large.
constexpr double kTooGood = 1 - kContradiction;
/// χ² of readings that are met exactly.
constexpr double kRounding = 1e-9;

using Columns = std::vector<std::pair<std::string, Cell>>;

void add_estimate(ResultTable& table, const CalibrationEstimate& e, const std::string& role) {
  const Columns columns{{"parameter", e.name}, {"role", role}};
  if (e.determined()) {
    table.add({"estimate", e.value, e.unit, columns});
    if (*e.sd > 0) {
      table.add({"sd", *e.sd, e.unit, columns});
      table.add({"interval_low", e.low(), e.unit, columns});
      table.add({"interval_high", e.high(), e.unit, columns});
    }
  }
  table.add({"determined", e.determined() ? 1.0 : 0.0, "1", columns});
}

void add_estimates(ResultTable& table, const CalibrationMeasurements& measurements,
                   const CalibrationFit& fit) {
  for (std::size_t i = 0; i < fit.uncertainty.parameters.size(); ++i) {
    const CalibrationEstimate& e = fit.uncertainty.parameters[i];
    const ParameterSetting& setting = measurements.parameters[i];
    add_estimate(table, e, name_of(setting.role));
    table.add({"nominal",
               setting.nominal,
               e.unit,
               {{"parameter", e.name}, {"role", std::string(name_of(setting.role))}}});
  }
  for (const CalibrationEstimate& e : fit.uncertainty.derived) add_estimate(table, e, "derived");
}

void add_correlations(ResultTable& table, const CalibrationUncertainty& uncertainty) {
  for (std::size_t i = 0; i < uncertainty.correlation.size(); ++i)
    for (std::size_t j = i + 1; j < uncertainty.correlation.size(); ++j)
      if (const auto& r = uncertainty.correlation[i][j])
        table.add(
            {"correlation",
             *r,
             "1",
             {{"parameter", uncertainty.parameters[i].name}, {"other", uncertainty.parameters[j].name}}});
}

void add_summary(ResultTable& table, const CalibrationFit& fit, const Columns& columns) {
  table.add({"chi2", fit.chi2 < kRounding ? 0 : fit.chi2, "1", columns});
  table.add({"degrees_of_freedom", static_cast<double>(fit.degrees_of_freedom), "1", columns});
  if (fit.p_value) table.add({"p_value", *fit.p_value, "1", columns});
}

void add_solution(ResultTable& table, const CalibrationFit& fit) {
  const CalibrationUncertainty& u = fit.uncertainty;
  table.add({"unknowns", static_cast<double>(u.unknowns), "1", {}});
  table.add({"rank", static_cast<double>(u.rank), "1", {}});
  if (u.condition_number) table.add({"condition_number", *u.condition_number, "1", {}});
  for (std::size_t i = 0; i < u.singular_values.size(); ++i)
    table.add({"singular_value", u.singular_values[i], "1", {{"number", static_cast<long long>(i + 1)}}});
  add_summary(table, fit, {});
  table.add({"iterations", static_cast<double>(fit.iterations), "1", {}});
  table.add({"starts", static_cast<double>(fit.starts), "1", {}});
  table.add({"starts_agreeing", static_cast<double>(fit.starts_agreeing), "1", {}});
}

std::string unit_of_reading(const std::string& name) {
  for (const char* unit : {"mm", "deg", "px", "dpt"})
    if (name.ends_with(std::string("_") + unit)) return unit;
  return "1";
}

void add_readings(ResultTable& table, const CalibrationFit& fit) {
  for (const FittedReading& r : fit.readings) {
    const Columns columns{
        {"record", r.kind == "anchor" ? Cell(std::string("—")) : Cell(static_cast<long long>(r.record))},
        {"kind", r.kind},
        {"reading", r.what}};
    const std::string unit = unit_of_reading(r.what);
    table.add({"measured", r.measured, unit, columns});
    table.add({"predicted", r.predicted, unit, columns});
    table.add({"deviations", r.deviations, "1", columns});
    table.add({"weight", r.weight, "1", columns});
    table.add({"outlier", r.outlier ? 1.0 : 0.0, "1", columns});
  }
}

/// 0 where rounding is all that there is.
double without_rounding(const CalibrationEstimate& e) {
  return std::abs(e.value) < 1e-9 * *e.sd ? 0 : e.value;
}

/// Of the display and the height of the camera, which contradictions are about.
bool is_length(CalibrationParameter parameter) {
  using P = CalibrationParameter;
  return parameter == P::kPixelPitch || parameter == P::kLensPitch || parameter == P::kLensDistance ||
         parameter == P::kFocalLength || parameter == P::kPupilOffset;
}

/// "d_l [mm]".
std::string heading_of(const CalibrationEstimate& e) {
  return e.unit == "1" ? e.symbol : fmt::format("{} [{}]", e.symbol, e.unit);
}

const char* fitted_by(CalibrationLoss loss) {
  switch (loss) {
    case CalibrationLoss::kHuber:
      return "With the Huber loss";
    case CalibrationLoss::kCauchy:
      return "With the Cauchy loss";
    case CalibrationLoss::kNone:
      break;
  }
  return "By plain least squares";
}

std::string judgement(const CalibrationFit& fit) {
  const std::string chi2 = format_number(fit.chi2 < kRounding ? 0 : fit.chi2);
  if (!fit.p_value)
    return fmt::format("{} χ² is {} without degrees of freedom: nothing is left to test.",
                       fitted_by(fit.loss), chi2);
  return fmt::format("{} χ² is {} with {} degrees of freedom (p = {}): {}.", fitted_by(fit.loss), chi2,
                     fit.degrees_of_freedom, format_number(*fit.p_value, 2),
                     *fit.p_value > kTooGood
                         ? "the readings agree even better than their deviations let expect"
                     : !contradicts(fit)      ? "the readings agree within their deviations"
                     : isolated_outliers(fit) ? "the readings agree but for the outliers"
                                              : "the readings contradict each other");
}

}  // namespace

ResultTable calibration_rows(const CalibrationMeasurements& measurements, const CalibrationFit& fit) {
  ResultTable table;
  add_estimates(table, measurements, fit);
  add_correlations(table, fit.uncertainty);
  add_solution(table, fit);
  add_readings(table, fit);
  return table;
}

ResultTable doubt_rows(const std::vector<DoubtedSource>& doubts) {
  ResultTable table;
  for (const DoubtedSource& doubt : doubts) {
    const Columns columns{{"without", doubt.source}};
    add_summary(table, doubt.fit, columns);
    for (const auto* estimates : {&doubt.fit.uncertainty.parameters, &doubt.fit.uncertainty.derived})
      for (const CalibrationEstimate& e : *estimates)
        if (e.determined() && *e.sd > 0) table.add({e.name, without_rounding(e), e.unit, columns});
    for (const LeftOutReading& left_out : doubt.left_out) {
      const std::string unit = unit_of_reading(left_out.what);
      const Columns named{{"without", doubt.source}, {"reading", left_out.what}};
      table.add({"left_out_measured", left_out.measured, unit, named});
      table.add({"left_out_predicted", left_out.predicted, unit, named});
    }
  }
  return table;
}

ResultTable coverage_rows(const CoverageResult& coverage) {
  ResultTable table;
  table.add({"rigs", static_cast<double>(coverage.rigs), "1", {}});
  table.add({"converged", static_cast<double>(coverage.converged), "1", {}});
  table.add({"seconds", coverage.seconds, "s", {}});
  for (const ParameterCoverage& c : coverage.parameters) {
    const ParameterTraits& traits = traits_of(c.parameter);
    const Columns columns{{"parameter", std::string(traits.name)}};
    table.add({"fits", static_cast<double>(c.fits), "1", columns});
    if (c.fits == 0) continue;
    const Interval share =
        share_interval(static_cast<std::size_t>(c.covered), static_cast<std::size_t>(c.fits));
    table.add({"coverage", share.estimate, "1", columns});
    table.add({"coverage_low", share.low, "1", columns});
    table.add({"coverage_high", share.high, "1", columns});
    table.add({"rms_error", c.rms_error, traits.unit, columns});
    table.add({"mean_sd", c.mean_sd, traits.unit, columns});
    table.add({"mean_error", c.mean_error, traits.unit, columns});
  }
  return table;
}

WideDesign estimate_design() {
  return {{"parameter", "role"},
          {{"estimate", "estimate"},
           {"sd", "sd"},
           {"interval_low", "95 % from"},
           {"interval_high", "to"},
           {"nominal", "nominal"}}};
}

WideDesign reading_design() {
  return {{"record", "kind", "reading"},
          {{"measured", "measured"},
           {"predicted", "predicted"},
           {"deviations", "deviations"},
           {"weight", "weight"},
           {"outlier", "outlier"}}};
}

WideDesign doubt_design(const std::vector<DoubtedSource>& doubts) {
  WideDesign design{{"without"}, {{"chi2", "χ²"}, {"degrees_of_freedom", "dof"}, {"p_value", "p-value"}}};
  if (doubts.empty()) return design;
  // Columns that are not empty: what is estimated in any of the fits. Of the parameters the lengths, and what
  // was fixed before it was doubted.
  const auto add = [&](auto estimates, std::size_t i) {
    const auto is_estimated = [&](const DoubtedSource& doubt) {
      return (doubt.fit.uncertainty.*estimates)[i].sd.value_or(0) > 0;
    };
    const CalibrationEstimate& e = (doubts.front().fit.uncertainty.*estimates)[i];
    if (std::any_of(doubts.begin(), doubts.end(), is_estimated))
      design.columns.push_back({e.name, heading_of(e)});
  };
  const CalibrationUncertainty& all = doubts.front().fit.uncertainty;
  for (std::size_t i = 0; i < all.parameters.size(); ++i)
    if (is_length(static_cast<CalibrationParameter>(i)) || all.parameters[i].sd == 0.0)
      add(&CalibrationUncertainty::parameters, i);
  for (std::size_t i = 0; i < all.derived.size(); ++i)
    if (const std::string& name = all.derived[i].name;
        name == "fov_deg" || name == "subimage_per_lens" || name == "vergence_dpt")
      add(&CalibrationUncertainty::derived, i);
  return design;
}

WideDesign coverage_design() {
  return {{"parameter"},
          {{"fits", "fits"},
           {"coverage", "coverage"},
           {"coverage_low", "95 % from"},
           {"coverage_high", "to"},
           {"rms_error", "RMS error"},
           {"mean_sd", "mean sd"}}};
}

std::vector<std::string> calibration_sentences(const CalibrationFit& fit) {
  std::vector<std::string> sentences;
  const CalibrationUncertainty& u = fit.uncertainty;
  if (!fit.converged) sentences.push_back("The fit did not converge: " + fit.message);
  sentences.push_back(judgement(fit));
  if (contradicts(fit) && !isolated_outliers(fit))
    sentences.emplace_back(
        "The estimates are a compromise between contradictory readings, and their deviations do not cover "
        "that.");
  if (u.condition_number)
    sentences.push_back(fmt::format("The readings see all {} unknowns; the condition number is {}.",
                                    u.unknowns, format_number(*u.condition_number, 3)));
  else
    sentences.push_back(fmt::format(
        "The rank is {} of {} unknowns: {} cannot be determined.", u.rank, u.unknowns,
        u.unknowns - u.rank == 1 ? "one direction" : fmt::format("{} directions", u.unknowns - u.rank)));
  for (const OpenDirection& open : u.open) sentences.push_back(open.sentence);
  for (const FittedReading& r : fit.readings)
    if (r.outlier)
      sentences.push_back(
          fmt::format("{}: {} was {} and should be {}, {:.1f} deviations away (weight {:.2f}).",
                      r.kind == "anchor" ? "An anchor lies far off"
                                         : fmt::format("records[{}] ({}) lies far off", r.record, r.kind),
                      r.what, format_number(r.measured, 5), format_number(r.predicted, 5),
                      std::abs(r.deviations), r.weight));
  return sentences;
}

namespace {

std::string no_single_source(const std::vector<DoubtedSource>& doubts, int pairs) {
  if (pairs > 0)
    return fmt::format(
        "No single source explains the contradiction; {} pairs of them do, each with other lengths.", pairs);
  // A second source takes at least one more degree of freedom.
  const bool pairs_can_be_tested =
      std::any_of(doubts.begin() + 1, doubts.end(),
                  [](const DoubtedSource& doubt) { return doubt.fit.degrees_of_freedom > 1; });
  return pairs_can_be_tested
             ? "No source explains the contradiction, nor do any two of them that leave something to test."
             : "No single source explains the contradiction, and without any two of them nothing is left to "
               "test.";
}

}  // namespace

std::vector<std::string> doubt_sentences(const std::vector<DoubtedSource>& doubts) {
  std::vector<std::string> sentences;
  int pairs = 0;
  for (const DoubtedSource& doubt : doubts) {
    if (&doubt == &doubts.front() || contradicts(doubt.fit) || doubt.left_out.empty()) continue;
    if (doubt.left_out.size() > 1) {
      ++pairs;
      continue;
    }
    const LeftOutReading& left_out = doubt.left_out.front();
    sentences.push_back(fmt::format(
        "Without the source “{}” {}, and {} would be {} instead of {}.", doubt.source,
        doubt.fit.p_value ? fmt::format("the rest agrees (p = {})", format_number(*doubt.fit.p_value, 2))
                          : "nothing is left to test",
        left_out.what, format_number(left_out.predicted), format_number(left_out.measured)));
  }
  if (sentences.empty() && !doubts.empty() && contradicts(doubts.front().fit))
    sentences.push_back(no_single_source(doubts, pairs));
  return sentences;
}

}  // namespace plenolab
