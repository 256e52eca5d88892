#include "experiments/cli/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/io/bytes.h"
#include "core/io/image_file.h"
#include "core/lightfield/hci.h"
#include "core/lightfield/light_field_folder.h"
#include "experiments/cli/checks.h"

namespace plenolab {
namespace fs = std::filesystem;

AnyLightField open_any_light_field(const fs::path& folder, int memory_mib) {
  PLENOLAB_CHECK(memory_mib > 0, fmt::format("{}", memory_mib));
  const std::size_t bound = static_cast<std::size_t>(memory_mib) << 20;
  if (!fs::exists(folder)) throw InputError(fmt::format("{} does not exist", folder.string()));
  if (!fs::is_directory(folder))
    throw InputError(
        fmt::format("{} is not a folder: give the folder that holds lightfield.json", folder.string()));
  if (is_light_field_folder(folder)) {
    if (light_field_kind(folder) == RadianceKind::kDisplayReferred)
      return open_display_light_field(folder, {.memory_bound_bytes = bound});
    return open_light_field(folder, {.memory_bound_bytes = bound});
  }
  if (is_hci_folder(folder)) return import_hci(folder, {.memory_bound_bytes = bound});
  throw InputError(
      fmt::format("{} holds neither lightfield.json nor an HCI parameters.cfg: a bare folder of EXRs becomes "
                  "a light field with "
                  "'plenolab convert'",
                  folder.string()));
}

LightField open_radiance(const fs::path& folder, int memory_mib) {
  const AnyLightField any = open_any_light_field(folder, memory_mib);
  if (const auto* field = std::get_if<LightField>(&any)) return *field;
  throw InputError(
      fmt::format("{} is display-referred, but radiance is needed here (convert HCI folders with --linear)",
                  folder.string()));
}

const ViewGrid& grid_of(const AnyLightField& light_field) {
  return std::visit([](const auto& field) -> const ViewGrid& { return field.grid(); }, light_field);
}

void require_extension(const fs::path& path, const std::string& extension) {
  if (lower_extension(path) != extension)
    throw UsageError(
        fmt::format("{} cannot be written: give a name that ends in {}", path.string(), extension));
}

void require_on_grid(CameraPosition position, const ViewGrid& grid, const std::string& option) {
  if (!grid.contains(position))
    throw UsageError(
        fmt::format("{}: {:g},{:g} is outside the {}×{} grid: S goes from 0 to {}, T from 0 to {}", option,
                    position.s, position.t, grid.columns, grid.rows, grid.columns - 1, grid.rows - 1));
}

void add_memory_option(CLI::App& app, int& memory_mib) {
  constexpr int kMost_mib = 1 << 22;
  app.add_option("--memory", memory_mib, "Memory for loaded views in MiB")
      ->check(whole_number(1, kMost_mib))
      ->capture_default_str();
}

bool is_exr_file(const fs::path& path) {
  return lower_extension(path) == ".exr";
}

bool is_display_file(const fs::path& path) {
  return lower_extension(path) == ".png";
}

AnyImage read_any_image(const fs::path& path) {
  if (is_display_file(path)) return read_display_image(path);
  const std::string extension = lower_extension(path);
  if (extension != ".exr" && extension != ".hdr" && extension != ".pfm")
    throw InputError(
        fmt::format("{} is no image that is read here: pictures are .png, radiance is .exr, .hdr or .pfm",
                    path.string()));
  return read_scene_image(path);
}

std::vector<fs::path> image_files(const fs::path& folder) {
  static constexpr std::array kExtensions{".exr", ".hdr", ".pfm", ".png"};
  if (!fs::is_directory(folder))
    throw InputError(fmt::format("{} is not a folder of frames", folder.string()));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = lower_extension(entry.path());
    const bool hidden = entry.path().filename().string().starts_with('.');  // e.g. left by a killed process
    if (!hidden && std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end())
      files.push_back(entry.path());
  }
  if (files.empty())
    throw InputError(fmt::format("{} holds no .exr, .hdr, .pfm or .png frames", folder.string()));
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace plenolab
