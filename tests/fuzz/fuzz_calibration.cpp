#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "analysis/calibration/fit.h"
#include "analysis/calibration/measurement_file.h"
#include "core/base/error.h"

// What is accepted survives being written and read again, and a fit to it ends with finite numbers or says
// that it did not converge.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plenolab;
  CalibrationMeasurements measurements;
  try {
    measurements = parse_measurements({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const InputError&) {
    return 0;
  }
  const std::string text = format_measurements(measurements);
  if (format_measurements(parse_measurements(text, "again")) != text) std::abort();
  if (measurements.records.size() > 50) return 0;
  fit_calibration(measurements, {.starts = 1, .max_iterations = 5});
  return 0;
}
