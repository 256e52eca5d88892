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

template <class Image, class Select>
std::vector<Measurement> measure_with(const Image& test, const Image& reference,
                                      const std::vector<const Metric*>& chosen,
                                      const ComparisonConditions& conditions, const Select& select) {
  std::vector<Measurement> all;
  for (const Metric* metric : chosen) {
    const auto& compare = select(*metric);
    if (!compare) continue;
    for (Measurement& m : compare(test, reference, conditions)) all.push_back(std::move(m));
  }
  return all;
}

}  // namespace

std::vector<Measurement> measure(const SceneImage& test, const SceneImage& reference,
                                 const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions) {
  return measure_with(
      test, reference, chosen, conditions,
      [](const Metric& metric) -> const auto& { return metric.compare_scene; });
}

std::vector<Measurement> measure(const DisplayImage& test, const DisplayImage& reference,
                                 const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions) {
  return measure_with(
      test, reference, chosen, conditions,
      [](const Metric& metric) -> const auto& { return metric.compare_display; });
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
