#include "core/lightfield/light_field_folder.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/lightfield/description.h"
#include "core/lightfield/folder_views.h"
#include "core/lightfield/new_folder.h"
#include "core/lightfield/view_writer.h"

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
void write_views(ViewWriter<Referral>& writer, const BasicLightField<Referral>& light_field,
                 const Progress& progress) {
  const ViewGrid& grid = light_field.grid();
  for (int i = 0; i < grid.rows * grid.columns; ++i) {
    const int row = i / grid.columns, column = i % grid.columns;
    const auto view = light_field.view(column, row);
    writer.write(column, row, view->colour, view->disparity);
    if (progress) progress((i + 1.0) / (grid.rows * grid.columns));
  }
}

template <class Referral>
void write_any(const fs::path& folder, const BasicLightField<Referral>& light_field,
               const WriteLightFieldOptions& options, const Progress& progress) {
  write_folder_atomically(folder, [&](const fs::path& temporary) {
    ViewWriter<Referral> writer(temporary, light_field.grid(), light_field.unit(), light_field.name(),
                                options);
    write_views(writer, light_field, progress);
    writer.finish();
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
