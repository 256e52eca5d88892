#include "experiments/tonemap_fit.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "core/io/white_luminance.h"
#include "core/lightfield/description.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/output.h"

namespace plenolab {

OperatorView read_operator_view(const std::filesystem::path& path, const std::string& disparity,
                                bool required) {
  OperatorView view{std::make_shared<const SceneImage>(read_scene_image(path)), nullptr};
  if (!is_exr_file(path)) return view;
  const std::vector<ExrPartInfo> parts = read_exr_header(path);
  const bool there = std::any_of(parts.begin(), parts.end(),
                                 [&](const ExrPartInfo& part) { return part.has_channel(disparity); });
  if (there || required)
    view.disparity =
        std::make_shared<const DisparityMap>(std::move(read_exr_channels(path, {disparity}).front()));
  return view;
}

std::optional<double> declared_cd_m2_per_unit(const std::filesystem::path& path) {
  if (const auto white = white_luminance(path)) return white;
  const std::filesystem::path description = path.parent_path() / kDescriptionFile;
  if (!std::filesystem::exists(description)) return std::nullopt;
  const LightFieldDescription field = parse_description(read_text_file(description), description.string());
  if (field.display_referred || field.unit != RadianceUnit::kCdM2) return std::nullopt;
  return 1;
}

FittedOperator fit_image(const OperatorChoice& choice, const OperatorView& image,
                         std::optional<double> cd_m2_per_unit, int threads) {
  return choice.info->fit(choice.variant.id, choice.values, scope_of_image(image, threads, cd_m2_per_unit));
}

void add_fit_rows(ResultTable& table, const std::vector<FittedValue>& values,
                  const std::vector<std::string>& notes, const Columns& columns) {
  for (const FittedValue& value : values)
    table.add({value.name, value.value, value.unit.empty() ? "1" : value.unit, columns});
  for (const std::string& note : notes) {
    Columns with_note = columns;
    with_note.emplace_back("note", note);
    table.add({kNoteQuantity, 1, "1", with_note});
  }
}

void add_count_rows(ResultTable& table, const MappingCounts& counts, const Columns& columns) {
  const auto add = [&](const char* quantity, std::int64_t count, const char* unit) {
    table.add({quantity, static_cast<double>(count), unit, columns});
  };
  add("repaired_nan", counts.repairs.nan, "values");
  add("repaired_infinite", counts.repairs.positive_infinity, "values");
  add("repaired_negative", counts.repairs.negative, "values");
  add("floored_pixels", counts.floored_pixels, "px");
  add("clipped_high", counts.clipped_high, "values");
  add("clipped_low", counts.clipped_low, "values");
}

}  // namespace plenolab
