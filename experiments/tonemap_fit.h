#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/result_table.h"
#include "experiments/cli/operator_options.h"
#include "experiments/score.h"

namespace plenolab {

/// Channel of a light field's views that holds disparity.
inline constexpr const char* kDisparityChannel = "disparity";

/// Reads an image with radiance (.exr .hdr .pfm). An .exr that has the channel `disparity` gives that, too;
/// if `required` it must have it. Throws InputError as the readers do.
OperatorView read_operator_view(const std::filesystem::path& path,
                                const std::string& disparity = kDisparityChannel, bool required = false);

/// Luminance of radiance 1 in cd/m² as declared: by the .exr's attribute whiteLuminance, else by the light
/// field whose folder the image lies in. Nothing if neither says so. Throws InputError as the readers do.
std::optional<double> declared_cd_m2_per_unit(const std::filesystem::path& path);

/// Fits a variant for views or light fields to one image, which counts as the whole light field.
FittedOperator fit_image(const OperatorChoice& choice, const OperatorView& image,
                         std::optional<double> cd_m2_per_unit, int threads);

/// One row for each fitted value and one for each note, with the columns given.
void add_fit_rows(ResultTable& table, const std::vector<FittedValue>& values,
                  const std::vector<std::string>& notes, const Columns& columns);
/// Rows repaired_nan, repaired_infinite, repaired_negative, clipped_high, clipped_low (values) and
/// floored_pixels.
void add_count_rows(ResultTable& table, const MappingCounts& counts, const Columns& columns);

}  // namespace plenolab
