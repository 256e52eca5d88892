#include "experiments/score.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"

namespace plenolab {

float common_exposure(const LightField& field, double requested) {
  if (requested > 0) return static_cast<float>(requested);
  return exposure_from(field.view(field.grid().columns / 2, field.grid().rows / 2)->colour);
}

namespace {

template <class Compare>
std::vector<Measurement> measure_with(const std::vector<const Metric*>& chosen, const Compare& compare) {
  std::vector<Measurement> all;
  for (const Metric* metric : chosen)
    for (Measurement& m : compare(*metric)) all.push_back(std::move(m));
  return all;
}

std::vector<Measurement> judged(const Metric& metric, const DisplayImage& test,
                                const ComparisonConditions& conditions) {
  return metric.judge ? metric.judge(test, conditions) : std::vector<Measurement>{};
}

}  // namespace

std::vector<Measurement> measure(const SceneImage& test, const SceneImage& reference,
                                 const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions) {
  return measure_with(chosen, [&](const Metric& metric) {
    return metric.compare_scene ? metric.compare_scene(test, reference, conditions)
                                : std::vector<Measurement>{};
  });
}

std::vector<Measurement> measure(const DisplayImage& test, const DisplayImage& reference,
                                 const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions) {
  return measure_with(chosen, [&](const Metric& metric) {
    return metric.compare_display ? metric.compare_display(test, reference, conditions)
                                  : judged(metric, test, conditions);
  });
}

std::vector<Measurement> measure(const DisplayImage& test, const SceneImage& reference,
                                 const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions) {
  return measure_with(chosen, [&](const Metric& metric) {
    return metric.compare_mapped ? metric.compare_mapped(test, reference, conditions)
                                 : judged(metric, test, conditions);
  });
}

std::vector<Measurement> measure(const DisplayImage& test, const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions) {
  return measure_with(chosen, [&](const Metric& metric) { return judged(metric, test, conditions); });
}

void add_measurement_rows(ResultTable& table, const std::vector<Measurement>& measurements,
                          const Columns& columns) {
  for (const Measurement& m : measurements) table.add({m.quantity, m.value, m.unit, columns});
}

double value_of(const std::vector<Measurement>& measurements, const std::string& quantity) {
  const auto found = std::find_if(measurements.begin(), measurements.end(),
                                  [&](const Measurement& m) { return m.quantity == quantity; });
  PLENOLAB_CHECK(found != measurements.end(), quantity);
  return found->value;
}

double pooled_psnr_db(const std::vector<double>& psnrs_db) {
  PLENOLAB_CHECK(!psnrs_db.empty(), "no values");
  double relative_error = 0;
  for (const double psnr : psnrs_db) relative_error += std::pow(10.0, -psnr / 10);
  return -10 * std::log10(relative_error / static_cast<double>(psnrs_db.size()));
}

}  // namespace plenolab
