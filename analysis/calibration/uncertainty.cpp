#include "analysis/calibration/uncertainty.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "analysis/calibration/coordinates.h"
#include "analysis/calibration/open_directions.h"

namespace plenolab {

namespace {

/// Singular values below this share of the largest are rounding: derivatives are exact.
constexpr double kRankTolerance = 1e-10;
/// A gradient with less than this share in an exactly open direction lies outside it.
constexpr double kGradientTolerance = 1e-7;

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

std::vector<Eigen::Index> fitted_of(const CalibrationMeasurements& measurements) {
  std::vector<Eigen::Index> fitted;
  for (std::size_t i = 0; i < measurements.parameters.size(); ++i)
    if (measurements.parameters[i].role != ParameterSetting::Role::kFixed)
      fitted.push_back(static_cast<Eigen::Index>(i));
  return fitted;
}

/// Singular values, largest first, and right singular vectors, as columns: all of them, also where there are
/// fewer rows.
struct Directions {
  Vector singular;
  Matrix right;
};

Directions directions_of(const Matrix& matrix) {
  Matrix padded = Matrix::Zero(std::max(matrix.rows(), matrix.cols()), matrix.cols());
  padded.topRows(matrix.rows()) = matrix;
  const Eigen::JacobiSVD<Matrix> svd(padded, Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixV()};
}

/// The covariance of the fitted coordinates, by which variances of anything are asked: the sandwich
/// A⁻¹·B·A⁻¹ with A = JᵀJ of the anchors + mean ψ′ · JᵀJ of the readings, B the same with mean ψ².
struct Spread {
  std::vector<Eigen::Index> fitted;
  Directions plain;  // of the whitened Jacobian itself: what the data see, whatever the loss
  Directions bread;  // of the square root of A
  Matrix meat;       // B
  int rank = 0;      // of both

  Vector pick(const Vector& gradient) const { return gradient(fitted); }

  /// A⁺·gradient; nothing where the gradient reaches into a direction that is exactly open.
  std::optional<Vector> solve(const Vector& gradient) const {
    const Vector components = bread.right.transpose() * gradient;
    Vector solved = Vector::Zero(components.size());
    for (Eigen::Index k = 0; k < components.size(); ++k)
      if (k < rank)
        solved(k) = components(k) / (bread.singular(k) * bread.singular(k));
      else if (std::abs(components(k)) > kGradientTolerance * gradient.norm())
        return std::nullopt;
    return Vector(bread.right * solved);
  }
};

Spread spread_of(const CalibrationMeasurements& measurements, const Matrix& jacobian,
                 const LossMoments& moments) {
  Spread spread;
  spread.fitted = fitted_of(measurements);
  const Matrix all = jacobian(Eigen::all, spread.fitted);
  const auto residuals = residuals_of(measurements);
  const auto anchors = std::count_if(residuals.begin(), residuals.end(),
                                     [](const CalibrationResidual& r) { return r.anchor.has_value(); });
  const auto readings = static_cast<Eigen::Index>(residuals.size()) - anchors;
  Matrix bread = all;
  bread.topRows(readings) *= std::sqrt(std::max(moments.mean_slope, 1e-3));
  Matrix meat = all;
  meat.topRows(readings) *= std::sqrt(moments.mean_square);
  spread.plain = directions_of(all);
  spread.bread = directions_of(bread);
  spread.meat = meat.transpose() * meat;
  const Vector& singular = spread.plain.singular;
  for (Eigen::Index k = 0; k < singular.size(); ++k)
    if (singular(k) > kRankTolerance * singular(0)) ++spread.rank;
  return spread;
}

/// Standard deviation of a number with this value and gradient; nothing unless known within a share of
/// `size`.
std::optional<double> deviation_of(const Spread& spread, const Vector& gradient, double size) {
  const auto solved = spread.solve(spread.pick(gradient));
  if (!solved) return std::nullopt;
  const double sd = std::sqrt(std::max(0.0, solved->dot(spread.meat * *solved)));
  if (!(sd <= kKnownWithin * size)) return std::nullopt;
  return sd;
}

Vector gradient_of(const CalibrationJet& jet) {
  return jet.v;
}

std::vector<CalibrationEstimate> estimate_parameters(const CalibrationMeasurements& measurements,
                                                     const CalibrationCoordinates& coordinates,
                                                     const DisplayGeometry<CalibrationJet>& geometry,
                                                     const Spread& spread) {
  std::vector<CalibrationEstimate> estimates;
  for (std::size_t i = 0; i < kCalibrationParameters; ++i) {
    const ParameterTraits& traits = traits_of(i);
    CalibrationEstimate e{traits.name, traits.symbol, traits.unit, traits.meaning};
    const CalibrationJet value = parameter_value(geometry, static_cast<CalibrationParameter>(i));
    const bool fixed = measurements.parameters[i].role == ParameterSetting::Role::kFixed;
    e.value = fixed ? measurements.parameters[i].nominal : value.a;
    e.sd = fixed ? 0.0 : deviation_of(spread, gradient_of(value), coordinates.unit_of(i));
    estimates.push_back(std::move(e));
  }
  return estimates;
}

/// The size against which "determined" is judged: the number itself; for a vergence a useful one, and for
/// f − d_l what that comes to, d_l·f·V with f ≈ d_l.
double size_of(const DerivedQuantity& quantity, double value, const DisplayGeometry<CalibrationJet>& g) {
  if (std::string_view(quantity.unit) == "dpt") return kUsefulVergence_dpt;
  if (std::string_view(quantity.name) == "focal_gap_mm")
    return g.lens_distance.a * g.lens_distance.a * kUsefulVergence_dpt / kDioptresPerMm;
  return std::abs(value);
}

std::vector<CalibrationEstimate> estimate_derived(const CalibrationMeasurements& measurements,
                                                  const DisplayGeometry<CalibrationJet>& geometry,
                                                  const Spread& spread) {
  std::vector<CalibrationEstimate> estimates;
  const auto values = derived_values(geometry, measurements.instrument);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const DerivedQuantity& quantity = derived_quantities()[i];
    estimates.push_back(
        {quantity.name, quantity.symbol, quantity.unit, quantity.meaning, values[i].a,
         deviation_of(spread, gradient_of(values[i]), size_of(quantity, values[i].a, geometry))});
  }
  return estimates;
}

std::vector<std::vector<std::optional<double>>> correlate(const CalibrationUncertainty& uncertainty,
                                                          const DisplayGeometry<CalibrationJet>& geometry,
                                                          const Spread& spread) {
  constexpr std::size_t n = kCalibrationParameters;
  std::vector<std::optional<Vector>> solved(n);
  for (std::size_t i = 0; i < n; ++i)
    if (uncertainty.parameters[i].sd.value_or(0) > 0)
      solved[i] = spread.solve(
          spread.pick(gradient_of(parameter_value(geometry, static_cast<CalibrationParameter>(i)))));
  std::vector<std::vector<std::optional<double>>> correlation(n, std::vector<std::optional<double>>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (solved[i] && solved[j])
        correlation[i][j] = solved[i]->dot(spread.meat * *solved[j]) /
                            (*uncertainty.parameters[i].sd * *uncertainty.parameters[j].sd);
  return correlation;
}

}  // namespace

Matrix whitened_jacobian(const CalibrationMeasurements& measurements, const ParameterValues& x) {
  const auto geometry = geometry_with_derivatives(CalibrationCoordinates(measurements), x);
  const auto residuals = residuals_of(measurements);
  Matrix jacobian(static_cast<Eigen::Index>(residuals.size()), kCalibrationParameters);
  for (std::size_t i = 0; i < residuals.size(); ++i)
    jacobian.row(static_cast<Eigen::Index>(i)) =
        prediction_of(residuals[i], measurements, geometry).v.transpose() /
        deviation_of(residuals[i], measurements);
  return jacobian;
}

CalibrationUncertainty uncertainty_at(const CalibrationMeasurements& measurements, const ParameterValues& x,
                                      const LossMoments& moments) {
  const CalibrationCoordinates coordinates(measurements);
  const auto geometry = geometry_with_derivatives(coordinates, x);
  const Spread spread = spread_of(measurements, whitened_jacobian(measurements, x), moments);
  CalibrationUncertainty result;
  result.parameters = estimate_parameters(measurements, coordinates, geometry, spread);
  result.derived = estimate_derived(measurements, geometry, spread);
  result.correlation = correlate(result, geometry, spread);
  result.unknowns = static_cast<int>(spread.fitted.size());
  result.rank = spread.rank;
  const Vector& singular = spread.plain.singular;
  result.singular_values.assign(singular.begin(), singular.end());
  if (result.rank == result.unknowns)
    result.condition_number = result.singular_values.front() / result.singular_values.back();
  result.open = open_directions(coordinates, geometry, spread.fitted, singular, spread.plain.right,
                                spread.rank, result.derived);
  return result;
}

}  // namespace plenolab
