#pragma once

#include <limits>

#include "analysis/calibration/measurements.h"

namespace plenolab {

/// What a number of a record is, with the range it must lie in.
struct RecordField {
  enum class Role { kSetting, kReading, kDeviation };
  const char* name;
  Role role;
  double low, high;  ///< both allowed
};

namespace detail {
inline constexpr double kLargest = 1e6, kSmallest = 1e-12;
inline constexpr RecordField positive(const char* name) {
  return {name, RecordField::Role::kSetting, kSmallest, kLargest};
}
inline constexpr RecordField angle(const char* name) {
  return {name, RecordField::Role::kSetting, -80, 80};
}
inline constexpr RecordField reading(const char* name, double low = -kLargest, double high = kLargest) {
  return {name, RecordField::Role::kReading, low, high};
}
inline constexpr RecordField deviation(const char* name) {
  return {name, RecordField::Role::kDeviation, kSmallest, kLargest};
}
}  // namespace detail

/// Calls visit(field, number) for every number of a record, in the order of files: the one place that says
/// what is in a record, for reading, writing, checking and simulating. `Record` may be const.
template <class Record, class Visit>
void for_each_number(Record& record, const Visit& visit) {
  using Plain = std::remove_const_t<Record>;
  using namespace detail;
  if constexpr (std::is_same_v<Plain, EdgeRecord>) {
    visit(positive("camera_height_mm"), record.camera_height_mm);
    visit(reading("displacement_mm"), record.displacement_mm);
    visit(deviation("sd_mm"), record.sd_mm);
  } else if constexpr (std::is_same_v<Plain, FieldOfViewRecord>) {
    visit(reading("fov_deg", kSmallest, 179), record.fov_deg);
    visit(deviation("sd_deg"), record.sd_deg);
  } else if constexpr (std::is_same_v<Plain, TargetRecord>) {
    visit(positive("virtual_depth_mm"), record.virtual_depth_mm);
    visit(angle("target_angle_deg"), record.target_angle_deg);
    visit(angle("camera_angle_deg"), record.camera_angle_deg);
    visit(positive("camera_height_mm"), record.camera_height_mm);
    visit(reading("position_mm"), record.position_mm);
    visit(deviation("sd_mm"), record.sd_mm);
  } else if constexpr (std::is_same_v<Plain, FocusRecord>) {
    visit(reading("vergence_dpt"), record.vergence_dpt);
    visit(deviation("sd_dpt"), record.sd_dpt);
  } else if constexpr (std::is_same_v<Plain, GridRecord>) {
    visit(reading("x_px"), record.x_px);
    visit(reading("y_px"), record.y_px);
    visit(deviation("sd_px"), record.sd_px);
  } else if constexpr (std::is_same_v<Plain, SharpestScaleRecord>) {
    visit(positive("virtual_depth_mm"), record.virtual_depth_mm);
    visit(reading("scale", kSmallest), record.scale);
    visit(deviation("sd"), record.sd);
  } else {
    static_assert(std::is_same_v<Plain, SharpnessRecord>);
    visit(positive("scale"), record.scale);
    visit(positive("virtual_depth_mm"), record.virtual_depth_mm);
    visit(reading("sharpness"), record.sharpness);
    visit(deviation("sd"), record.sd);
  }
}

}  // namespace plenolab
