#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/result_table.h"
#include "core/lightfield/light_field.h"
#include "metrics/table.h"

namespace plenolab {

/// One exposure for all views of a light field: the requested one, or, if that is 0, the one that suits the
/// middle key view (exposure_from).
float common_exposure(const LightField& field, double requested);

/// Identifying columns of a row.
using Columns = std::vector<std::pair<std::string, Cell>>;

/// Runs the metrics that take this kind of image, in order; of display images also those that judge the test
/// image alone.
std::vector<Measurement> measure(const SceneImage& test, const SceneImage& reference,
                                 const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions);
std::vector<Measurement> measure(const DisplayImage& test, const DisplayImage& reference,
                                 const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions);

/// Metrics that take a tone mapped image with its scene, and those that judge it alone.
std::vector<Measurement> measure(const DisplayImage& test, const SceneImage& reference,
                                 const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions);
/// Metrics that judge an image alone.
std::vector<Measurement> measure(const DisplayImage& test, const std::vector<const Metric*>& chosen,
                                 const ComparisonConditions& conditions);

/// One row per measurement, all with the same identifying columns.
void add_measurement_rows(ResultTable& table, const std::vector<Measurement>& measurements,
                          const Columns& columns);

/// The value of a quantity. Throws std::logic_error if it was not measured.
double value_of(const std::vector<Measurement>& measurements, const std::string& quantity);

/// PSNR of the mean squared error over several images of equal peak and size, from their PSNRs in dB: what
/// one PSNR over all of them would be. +∞ only if all are.
double pooled_psnr_db(const std::vector<double>& psnrs_db);

}  // namespace plenolab
