#include "experiments/reproduce/calibration/naive_focus.h"

#include <ceres/ceres.h>

#include <numbers>

#include "analysis/calibration/model.h"

namespace plenolab {

namespace {

struct AngleResidual {
  FieldOfViewRecord reading;
  double subimage_mm;
  template <class T>
  bool operator()(const T* x, T* residual) const {
    using std::atan;
    residual[0] = (2.0 * atan(subimage_mm / (2.0 * x[0])) * (180 / std::numbers::pi) - reading.fov_deg) /
                  reading.sd_deg;
    return true;
  }
};

struct ImageDistanceResidual {
  double distance_mm, sd_mm;
  template <class T>
  bool operator()(const T* x, T* residual) const {
    const T gap = x[1] - x[0];
    if (gap == T(0)) return false;
    residual[0] = (x[0] * x[1] / gap - distance_mm) / sd_mm;
    return true;
  }
};

}  // namespace

NaiveFocusFit fit_naive_focus(const FieldOfViewRecord& angle, const FocusRecord& focus, double subimage_mm,
                              double start_lens_distance_mm, double start_focal_length_mm,
                              int max_iterations) {
  double x[2] = {start_lens_distance_mm, start_focal_length_mm};
  const double distance_mm = kDioptresPerMm / focus.vergence_dpt;
  const double sd_mm = distance_mm * distance_mm * focus.sd_dpt / kDioptresPerMm;
  ceres::Problem problem;
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<AngleResidual, 1, 2>(new AngleResidual{angle, subimage_mm}), nullptr,
      x);
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ImageDistanceResidual, 1, 2>(
                               new ImageDistanceResidual{distance_mm, sd_mm}),
                           nullptr, x);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-13;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return {x[0], x[1], static_cast<int>(summary.iterations.size()),
          summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace plenolab
