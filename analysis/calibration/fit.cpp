#include "analysis/calibration/fit.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <memory>

#include "analysis/calibration/coordinates.h"
#include "analysis/calibration/loss.h"
#include "core/base/error.h"
#include "core/base/random.h"

namespace plenolab {

namespace {

constexpr std::uint64_t kStarts = 0x63616c6962737461ull;
/// Further starts lie within this distance of the nominal coordinates: a tenth of each length.
constexpr double kStartSpread = 0.1;
/// A curve of sharpness is begun up to ten times wider: a narrow one that misses its readings has no slope to
/// follow.
constexpr double kWidthSpread = 2.3;
constexpr double kSameCost = 1e-6;

/// Lengths between a twentieth and twenty times their nominal values: beyond, exponentials overflow, and no
/// display is built like that.
template <class T>
bool within_reach(const T* x) {
  constexpr double kLargestLogRatio = 3;
  for (std::size_t i = 0; i < kCalibrationParameters; ++i)
    if (traits_of(i).positive && !(x[i] <= kLargestLogRatio && x[i] >= -kLargestLogRatio)) return false;
  return true;
}

bool is_finite(double value) {
  return std::isfinite(value);
}

template <int kSize>
bool is_finite(const ceres::Jet<double, kSize>& value) {
  return std::isfinite(value.a) && value.v.allFinite();
}

struct ResidualFunctor {
  const CalibrationMeasurements* measurements;
  const CalibrationCoordinates* coordinates;
  CalibrationResidual residual;
  double reading, deviation;

  template <class T>
  bool operator()(const T* x, T* result) const {
    // False takes a step back that went too far, without a word of the solver about it.
    if (!within_reach(x)) return false;
    result[0] = (prediction_of(residual, *measurements, coordinates->geometry(x)) - reading) / deviation;
    return is_finite(result[0]);
  }
};

std::unique_ptr<ceres::LossFunction> make_loss(const CalibrationFitOptions& options) {
  switch (options.loss) {
    case CalibrationLoss::kHuber:
      return std::make_unique<ceres::HuberLoss>(options.scale());
    case CalibrationLoss::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(options.scale());
    case CalibrationLoss::kNone:
      break;
  }
  return nullptr;
}

std::vector<int> fixed_parameters(const CalibrationMeasurements& measurements) {
  std::vector<int> fixed;
  for (std::size_t i = 0; i < measurements.parameters.size(); ++i)
    if (measurements.parameters[i].role == ParameterSetting::Role::kFixed)
      fixed.push_back(static_cast<int>(i));
  return fixed;
}

/// Anchors are not among what a robust loss may doubt: they are chosen, not read off.
void build(ceres::Problem& problem, const CalibrationMeasurements& measurements,
           const CalibrationCoordinates& coordinates, const CalibrationFitOptions& options, double* x) {
  problem.AddParameterBlock(x, kCalibrationParameters);
  for (const CalibrationResidual& residual : residuals_of(measurements)) {
    auto* cost = new ceres::AutoDiffCostFunction<ResidualFunctor, 1, kCalibrationParameters>(
        new ResidualFunctor{&measurements, &coordinates, residual, reading_of(residual, measurements),
                            deviation_of(residual, measurements)});
    problem.AddResidualBlock(cost, residual.anchor ? nullptr : make_loss(options).release(), x);
  }
  if (const std::vector<int> fixed = fixed_parameters(measurements); !fixed.empty())
    problem.SetManifold(x, new ceres::SubsetManifold(kCalibrationParameters, fixed));
}

struct SolvedStart {
  ParameterValues x{};
  double cost = 0;
  bool converged = false;
  int iterations = 0;
  std::string message;
};

SolvedStart solve_from(const ParameterValues& start, const CalibrationMeasurements& measurements,
                       const CalibrationCoordinates& coordinates, const CalibrationFitOptions& options) {
  SolvedStart solved;
  solved.x = start;
  if (!whitened_jacobian(measurements, start).allFinite()) {
    solved.message = "the model is not finite at the start";
    return solved;
  }
  ceres::Problem problem;
  build(problem, measurements, coordinates, options, solved.x.data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.logging_type = ceres::SILENT;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-14;
  solver.gradient_tolerance = 1e-10;
  solver.parameter_tolerance = 1e-13;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  solved.cost = summary.final_cost;
  solved.converged = summary.termination_type == ceres::CONVERGENCE && std::isfinite(summary.final_cost);
  solved.iterations = static_cast<int>(summary.iterations.size());
  solved.message = summary.message;
  return solved;
}

/// The nominal coordinates, then places around them, by a hash of the seed.
ParameterValues start_of(int number, const ParameterValues& nominal,
                         const CalibrationMeasurements& measurements, std::uint64_t seed) {
  ParameterValues x = nominal;
  if (number == 0) return x;
  RandomStream random(seed, kStarts, static_cast<std::uint64_t>(number));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double draw = random.next_double();
    if (measurements.parameters[i].role == ParameterSetting::Role::kFixed) continue;
    const bool width = i == index_of(CalibrationParameter::kSharpnessWidth);
    x[i] += width ? kWidthSpread * draw : kStartSpread * (2 * draw - 1);
  }
  return x;
}

bool better(const SolvedStart& a, const SolvedStart& b) {
  if (a.converged != b.converged) return a.converged;
  return a.cost < b.cost;
}

std::vector<FittedReading> readings_against(const CalibrationMeasurements& measurements,
                                            const DisplayGeometry<double>& geometry,
                                            const CalibrationFitOptions& options) {
  std::vector<FittedReading> fitted;
  for (const CalibrationResidual& residual : residuals_of(measurements)) {
    FittedReading f;
    f.record = residual.anchor ? index_of(*residual.anchor) : residual.record;
    f.kind = residual.anchor ? "anchor" : kind_of(measurements.records[residual.record]);
    f.what = reading_name(residual, measurements);
    f.measured = reading_of(residual, measurements);
    f.predicted = prediction_of(residual, measurements, geometry);
    f.sd = deviation_of(residual, measurements);
    f.deviations = (f.predicted - f.measured) / f.sd;
    f.weight = residual.anchor ? 1 : loss_weight(options, f.deviations);
    f.outlier = std::abs(f.deviations) > options.outlier_deviations;
    fitted.push_back(std::move(f));
  }
  return fitted;
}

std::vector<double> deviations_of_readings(const std::vector<FittedReading>& readings) {
  std::vector<double> deviations;
  for (const FittedReading& reading : readings)
    if (reading.kind != "anchor") deviations.push_back(reading.deviations);
  return deviations;
}

/// χ² with its degrees of freedom and how often one as large comes by chance.
void judge(CalibrationFit& fit) {
  for (const FittedReading& reading : fit.readings) fit.chi2 += reading.deviations * reading.deviations;
  fit.degrees_of_freedom = static_cast<int>(fit.readings.size()) - fit.uncertainty.rank;
  if (fit.degrees_of_freedom > 0 && std::isfinite(fit.chi2))
    fit.p_value = boost::math::gamma_q(fit.degrees_of_freedom / 2.0, fit.chi2 / 2);
}

/// A solver can end where the model is not finite, e.g. with deviations of 1e-12.
void require_finite(CalibrationFit& fit) {
  bool finite = std::isfinite(fit.chi2);
  for (const double value : fit.values) finite = finite && std::isfinite(value);
  for (const double value : fit.uncertainty.singular_values) finite = finite && std::isfinite(value);
  if (finite) return;
  fit.converged = false;
  if (fit.message.empty()) fit.message = "the model is not finite there";
}

}  // namespace

void CalibrationFitOptions::validate() const {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) throw InputError(fmt::format("a calibration fit takes {}, not {}", what, value));
  };
  require(loss_scale >= 0 && std::isfinite(loss_scale), "a loss scale of 0 or more", loss_scale);
  require(starts >= 1 && starts <= 10000, "1 to 10000 starts", starts);
  require(max_iterations >= 1, "at least one iteration", max_iterations);
  require(outlier_deviations > 0, "a threshold for outliers above 0", outlier_deviations);
}

double CalibrationFitOptions::scale() const {
  if (loss_scale > 0) return loss_scale;
  return loss == CalibrationLoss::kCauchy ? 2.385 : 1.345;
}

CalibrationFit fit_calibration(const CalibrationMeasurements& measurements,
                               const CalibrationFitOptions& options) {
  measurements.validate("measurements");
  options.validate();
  const CalibrationCoordinates coordinates(measurements);
  std::vector<SolvedStart> solved;
  for (int i = 0; i < options.starts; ++i)
    solved.push_back(solve_from(start_of(i, coordinates.nominal(), measurements, options.seed), measurements,
                                coordinates, options));
  const SolvedStart& best = *std::min_element(solved.begin(), solved.end(), better);

  CalibrationFit fit;
  fit.loss = options.loss;
  fit.converged = best.converged;
  if (!best.converged) fit.message = best.message;
  fit.iterations = best.iterations;
  fit.starts = options.starts;
  fit.starts_agreeing =
      static_cast<int>(std::count_if(solved.begin(), solved.end(), [&](const SolvedStart& s) {
        return s.converged && s.cost <= best.cost + kSameCost * (1 + best.cost);
      }));
  fit.geometry = coordinates.geometry(best.x.data());
  fit.readings = readings_against(measurements, fit.geometry, options);
  fit.uncertainty =
      uncertainty_at(measurements, best.x, loss_moments(options, deviations_of_readings(fit.readings)));
  for (std::size_t i = 0; i < fit.values.size(); ++i) fit.values[i] = fit.uncertainty.parameters[i].value;
  judge(fit);
  require_finite(fit);
  return fit;
}

}  // namespace plenolab
