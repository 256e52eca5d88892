#include "core/lightfield/bare_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "core/base/error.h"
#include "core/io/bytes.h"
#include "core/io/exr.h"
#include "core/lightfield/description.h"
#include "core/lightfield/folder_views.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// Files of the views, row by row.
struct ViewFiles {
  int columns = 0, rows = 0;
  std::vector<fs::path> paths;
};

// A file name cut into text and numbers: "view_03_11.exr" gives "view_#_#.exr" and {3, 11}.
struct NumberedName {
  std::string shape;
  std::vector<int> numbers;
};

NumberedName parse_name(const std::string& name) {
  constexpr std::size_t kMaxDigits = 9;
  NumberedName result;
  for (std::size_t i = 0; i < name.size();) {
    std::size_t end = i;
    while (end < name.size() && end - i < kMaxDigits && name[end] >= '0' && name[end] <= '9') ++end;
    if (end == i) {
      result.shape += name[i++];
      continue;
    }
    result.shape += '#';
    result.numbers.push_back(std::stoi(name.substr(i, end - i)));
    i = end;
  }
  return result;
}

std::vector<fs::path> exr_files(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    // Hidden files are no views: file managers and interrupted copies leave some beside them.
    const bool hidden = entry.path().filename().native().front() == '.';
    if (!hidden && entry.is_regular_file() && lower_extension(entry.path()) == ".exr")
      files.push_back(entry.path());
  }
  if (error) throw InputError(fmt::format("cannot read the folder {}: {}", folder.string(), error.message()));
  if (files.empty()) throw InputError(fmt::format("{} holds no .exr files", folder.string()));
  std::sort(files.begin(), files.end());
  return files;
}

[[noreturn]] void no_pattern(const fs::path& folder, const std::string& why) {
  throw InputError(
      fmt::format("cannot tell the views' rows and columns in {}: {}; give the file-name pattern, e.g. "
                  "view_{{row}}_{{column}}.exr",
                  folder.string(), why));
}

// Positions of the numbers that are not the same in all names.
std::vector<std::size_t> varying_numbers(const std::vector<NumberedName>& names) {
  std::vector<std::size_t> varying;
  for (std::size_t i = 0; i < names[0].numbers.size(); ++i)
    if (std::any_of(names.begin(), names.end(),
                    [&](const NumberedName& n) { return n.numbers[i] != names[0].numbers[i]; }))
      varying.push_back(i);
  return varying;
}

bool evenly_spaced(const std::set<int>& values) {
  const int step = values.size() > 1 ? *std::next(values.begin()) - *values.begin() : 1;
  int expected = *values.begin();
  for (const int v : values) {
    if (v != expected) return false;
    expected += step;
  }
  return true;
}

ViewFiles from_two_numbers(const fs::path& folder, const std::map<std::pair<int, int>, fs::path>& files) {
  std::set<int> rows, columns;
  for (const auto& [position, path] : files) {
    rows.insert(position.first);
    columns.insert(position.second);
  }
  if (rows.size() * columns.size() != files.size() || !evenly_spaced(rows) || !evenly_spaced(columns))
    no_pattern(folder, fmt::format("{} files do not fill a grid of {} × {}", files.size(), columns.size(),
                                   rows.size()));
  ViewFiles result{static_cast<int>(columns.size()), static_cast<int>(rows.size()), {}};
  for (const auto& [position, path] : files) result.paths.push_back(path);
  return result;
}

ViewFiles from_one_number(const fs::path& folder, const std::map<std::pair<int, int>, fs::path>& files,
                          int columns) {
  const int count = static_cast<int>(files.size());
  if (columns < 1 || count % columns != 0)
    throw InputError(
        fmt::format("the {} files of {} are numbered in one sequence: say how many columns they have, a "
                    "divisor of {}{}",
                    count, folder.string(), count, columns == 0 ? "" : fmt::format(", not {}", columns)));
  ViewFiles result{columns, count / columns, {}};
  for (const auto& [position, path] : files) result.paths.push_back(path);
  return result;
}

ViewFiles find_by_names(const fs::path& folder, const BareFolderOptions& options) {
  const std::vector<fs::path> paths = exr_files(folder);
  std::vector<NumberedName> names;
  for (const fs::path& path : paths) names.push_back(parse_name(path.filename().string()));
  for (std::size_t i = 1; i < names.size(); ++i)
    if (names[i].shape != names[0].shape)
      no_pattern(folder, fmt::format("{} and {} are named differently", paths[0].filename().string(),
                                     paths[i].filename().string()));
  const std::vector<std::size_t> varying = varying_numbers(names);
  if (varying.size() > 2) no_pattern(folder, fmt::format("{} numbers vary in the names", varying.size()));
  if (varying.empty()) return {1, 1, paths};
  std::map<std::pair<int, int>, fs::path> files;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int first = names[i].numbers[varying.front()], second = names[i].numbers[varying.back()];
    const bool swap = options.column_first && varying.size() == 2;
    files.emplace(swap ? std::pair(second, first) : std::pair(first, second), paths[i]);
  }
  if (files.size() != names.size()) no_pattern(folder, "two names hold the same numbers");
  return varying.size() == 2 ? from_two_numbers(folder, files)
                             : from_one_number(folder, files, options.columns);
}

// An explicit pattern counts from 0; the grid ends where files end.
ViewFiles find_by_pattern(const fs::path& folder, const std::string& pattern) {
  const auto path = [&](int column, int row) {
    return folder / expand_view_pattern(pattern, column, row, "the pattern");
  };
  ViewFiles result;
  while (fs::is_regular_file(path(result.columns, 0))) ++result.columns;
  while (fs::is_regular_file(path(0, result.rows))) ++result.rows;
  if (result.columns == 0) throw InputError(fmt::format("{} does not exist", path(0, 0).string()));
  for (int row = 0; row < result.rows; ++row)
    for (int column = 0; column < result.columns; ++column) result.paths.push_back(path(column, row));
  return result;
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

std::string only_one(const std::vector<std::string>& found, const fs::path& file, const char* what) {
  if (found.empty())
    throw InputError(fmt::format("{} has no channel that looks like {}: name it", file.string(), what));
  if (found.size() > 1)
    throw InputError(fmt::format("{} has several channels that could be {} ({}): name one", file.string(),
                                 what, fmt::join(found, ", ")));
  return found[0];
}

void choose_colour(const ExrPartInfo& part, const fs::path& file, LightFieldDescription& d) {
  if (part.has_channel("R") && part.has_channel("G") && part.has_channel("B")) return;
  std::vector<std::string> layers;
  for (const ExrChannelInfo& channel : part.channels) {
    if (!channel.name.ends_with(".R")) continue;
    const std::string layer = channel.name.substr(0, channel.name.size() - 1);
    if (part.has_channel(layer + "G") && part.has_channel(layer + "B")) layers.push_back(layer);
  }
  const std::string layer = only_one(layers, file, "colour");
  d.r = layer + "R";
  d.g = layer + "G";
  d.b = layer + "B";
}

void choose_depth(const ExrPartInfo& part, const fs::path& file, LightFieldDescription& d) {
  std::vector<std::string> found;
  for (const ExrChannelInfo& channel : part.channels) {
    const std::string name = lower(channel.name);
    if (name == "z" || name == "depth" || name.ends_with(".z") || name.ends_with(".depth"))
      found.push_back(channel.name);
  }
  d.geometry = only_one(found, file, "planar depth");
}

LightFieldDescription describe(const ViewFiles& files, const BareFolderOptions& options) {
  const fs::path& first = files.paths.front();
  const std::vector<ExrPartInfo> parts = read_exr_header(first);
  LightFieldDescription d;
  d.grid = {.columns = files.columns,
            .rows = files.rows,
            .spacing_x_m = options.spacing_x_m,
            .spacing_y_m = options.spacing_y_m,
            .width = parts[0].width,
            .height = parts[0].height,
            .fov_h_deg = options.fov_h_deg};
  d.unit = options.unit;
  d.geometry_kind = GeometryChannel::kDepth_m;
  if (options.r.empty()) {
    choose_colour(parts[0], first, d);
  } else {
    d.r = options.r;
    d.g = options.g;
    d.b = options.b;
  }
  d.geometry = options.depth;
  if (options.depth.empty()) choose_depth(parts[0], first, d);
  return d;
}

}  // namespace

void BareFolderOptions::validate() const {
  ViewGrid grid{.spacing_x_m = spacing_x_m, .spacing_y_m = spacing_y_m, .fov_h_deg = fov_h_deg};
  grid.validate();
  if (r.empty() != g.empty() || r.empty() != b.empty())
    throw InputError("name all three colour channels or none of them");
  if (columns < 0) throw InputError(fmt::format("the number of columns must be positive, not {}", columns));
}

LightField import_bare_folder(const fs::path& folder, const BareFolderOptions& options) {
  options.validate();
  const ViewFiles files =
      options.pattern.empty() ? find_by_names(folder, options) : find_by_pattern(folder, options.pattern);
  const LightFieldDescription d = describe(files, options);
  for (const fs::path& path : files.paths) check_view_file(path, d);
  const auto load = [d, paths = files.paths](int column, int row) {
    return read_view_file<SceneReferred>(paths[static_cast<std::size_t>(row * d.grid.columns + column)], d);
  };
  return LightField(d.grid, d.unit, folder.string(), load, options.memory_bound_bytes);
}

}  // namespace plenolab
