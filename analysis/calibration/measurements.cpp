#include "analysis/calibration/measurements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/calibration/model.h"
#include "analysis/calibration/record_fields.h"
#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr int kLargestLensNumber = 10000;

[[noreturn]] void wrong(const std::string& name, const std::string& what) {
  throw InputError(fmt::format("{}: {}", name, what));
}

void check_number(const std::string& name, const std::string& place, double value, double low, double high) {
  if (!(value >= low && value <= high))
    wrong(name, fmt::format("{} must lie in [{}, {}], not {}", place, low, high, value));
}

/// Virtual depth of a target whose sharpness is judged.
std::optional<double> sharpness_depth(const CalibrationRecord& record) {
  if (const auto* r = std::get_if<SharpnessRecord>(&record)) return r->virtual_depth_mm;
  if (const auto* r = std::get_if<SharpestScaleRecord>(&record)) return r->virtual_depth_mm;
  return std::nullopt;
}

void check_record(const std::string& name, const std::string& place, const CalibrationRecord& record,
                  const CalibrationInstrument& instrument) {
  std::visit(
      [&](const auto& r) {
        for_each_number(r, [&](const RecordField& field, double value) {
          check_number(name, place + "." + field.name, value, field.low, field.high);
        });
      },
      record);
  if (const auto* edge = std::get_if<EdgeRecord>(&record); edge && edge->side != 1 && edge->side != -1)
    wrong(name, fmt::format("{}.side must be 1 or -1, not {}", place, edge->side));
  if (const auto* grid = std::get_if<GridRecord>(&record)) {
    check_number(name, place + ".column", grid->column, -kLargestLensNumber, kLargestLensNumber);
    check_number(name, place + ".row", grid->row, -kLargestLensNumber, kLargestLensNumber);
  }
  if (const auto depth = sharpness_depth(record); depth && !(subimage_shift(instrument, *depth) < 1))
    wrong(name, fmt::format("{}.virtual_depth_mm is {}, so near that the target is in no two neighbouring "
                            "subimages: measure beyond {:.3g}",
                            place, *depth, subimage_shift(instrument, 1.0)));
}

void check_parameter(const std::string& name, const ParameterTraits& traits,
                     const ParameterSetting& setting) {
  const std::string place = fmt::format("parameters.{}", traits.name);
  check_number(name, place + ".nominal", setting.nominal, traits.positive ? 1e-9 : -1e6, 1e6);
  if (setting.role == ParameterSetting::Role::kAnchored)
    check_number(name, place + ".sd", setting.sd, 1e-12, 1e6);
}

}  // namespace

const char* kind_of(const CalibrationRecord& record) {
  static constexpr std::array kNames{"edge", "field-of-view", "target",        "focus",
                                     "grid", "sharpness",     "sharpest-scale"};
  static_assert(kNames.size() == std::variant_size_v<CalibrationRecord>);
  return kNames[record.index()];
}

int readings_in(const CalibrationRecord& record) {
  return std::holds_alternative<GridRecord>(record) ? 2 : 1;
}

void CalibrationMeasurements::validate(const std::string& name) const {
  check_number(name, "instrument.subimage_px", instrument.subimage_px, 1e-3, 1e6);
  check_number(name, "instrument.camera_spacing_mm", instrument.camera_spacing_mm, 1e-6, 1e6);
  check_number(name, "instrument.render_fov_deg", instrument.render_fov_deg, 0.01, 170);
  bool fitted = false;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    check_parameter(name, traits_of(i), parameters[i]);
    fitted = fitted || parameters[i].role != ParameterSetting::Role::kFixed;
  }
  if (!fitted) wrong(name, "every parameter is fixed, so there is nothing to fit: free or anchor one");
  if (records.empty()) wrong(name, "there are no records, so there is nothing to fit to");
  for (std::size_t i = 0; i < records.size(); ++i)
    check_record(name, fmt::format("records[{}]", i), records[i], instrument);
}

}  // namespace plenolab
