#include "core/lightfield/light_field_folder.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/lightfield/description.h"
#include "core/lightfield/folder_views.h"
#include "core/lightfield/new_folder.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMaxDescriptionBytes = 1u << 20;

LightFieldDescription read_description(const fs::path& folder) {
  const fs::path file = folder / kDescriptionFile;
  if (!fs::exists(file))
    throw InputError(fmt::format(
        "{} is not a light field folder: it has no {} (import other layouts with \"plenolab convert\")",
        folder.string(), kDescriptionFile));
  return parse_description(read_text_file(file, kMaxDescriptionBytes), file.string());
}

template <class Referral>
BasicLightField<Referral> open_any(const fs::path& folder, const LightFieldDescription& description,
                                   const OpenLightFieldOptions& options) {
  check_view_files(folder, description);
  const auto load = [folder, description](int column, int row) {
    return read_view_file<Referral>(view_path(folder, description, column, row), description);
  };
  return BasicLightField<Referral>(description.grid, description.unit, folder.string(), load,
                                   options.memory_bound_bytes);
}

template <class Referral>
LightFieldDescription description_of(const BasicLightField<Referral>& light_field) {
  LightFieldDescription description;
  description.grid = light_field.grid();
  description.display_referred = std::is_same_v<Referral, DisplayReferred>;
  description.unit = light_field.unit();
  description.view_pattern = "view_{row:02}_{column:02}.exr";
  return description;
}

template <class Referral>
void write_views(const fs::path& folder, const BasicLightField<Referral>& light_field,
                 const LightFieldDescription& description, const WriteLightFieldOptions& options,
                 const Progress& progress) {
  ExrWriteOptions exr;
  exr.colour_type = options.colour_type;
  exr.compression = options.compression;
  const ViewGrid& grid = light_field.grid();
  for (int i = 0; i < grid.rows * grid.columns; ++i) {
    const int row = i / grid.columns, column = i % grid.columns;
    const auto view = light_field.view(column, row);
    const std::string name = expand_view_pattern(description.view_pattern, column, row, folder.string());
    check_disparity(view->disparity,
                    fmt::format("view (column {}, row {}) of {}", column, row, light_field.name()));
    write_exr(folder / name, view->colour, {{description.geometry, &view->disparity}}, exr);
    if (progress) progress((i + 1.0) / (grid.rows * grid.columns));
  }
}

template <class Referral>
void write_any(const fs::path& folder, const BasicLightField<Referral>& light_field,
               const WriteLightFieldOptions& options, const Progress& progress) {
  const LightFieldDescription description = description_of(light_field);
  write_folder_atomically(folder, [&](const fs::path& temporary) {
    write_views(temporary, light_field, description, options, progress);
    write_text_file(temporary / kDescriptionFile, format_description(description));
  });
}

}  // namespace

bool is_light_field_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / kDescriptionFile, error);
}

RadianceKind light_field_kind(const fs::path& folder) {
  return read_description(folder).display_referred ? RadianceKind::kDisplayReferred
                                                   : RadianceKind::kSceneReferred;
}

LightField open_light_field(const fs::path& folder, const OpenLightFieldOptions& options) {
  const LightFieldDescription description = read_description(folder);
  if (description.display_referred)
    throw InputError(fmt::format(
        "{} holds display values (\"radiance\": \"display\"), but radiance is needed here", folder.string()));
  return open_any<SceneReferred>(folder, description, options);
}

DisplayLightField open_display_light_field(const fs::path& folder, const OpenLightFieldOptions& options) {
  const LightFieldDescription description = read_description(folder);
  if (!description.display_referred)
    throw InputError(fmt::format(
        "{} holds scene radiance, but display values are needed here: tone map it first", folder.string()));
  return open_any<DisplayReferred>(folder, description, options);
}

void write_light_field(const fs::path& folder, const LightField& light_field,
                       const WriteLightFieldOptions& options, const Progress& progress) {
  write_any(folder, light_field, options, progress);
}

void write_light_field(const fs::path& folder, const DisplayLightField& light_field,
                       const WriteLightFieldOptions& options, const Progress& progress) {
  write_any(folder, light_field, options, progress);
}

}  // namespace plenolab
