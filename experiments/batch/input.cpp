#include "experiments/batch/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

#include "analysis/provenance.h"
#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/lightfield/description.h"
#include "core/lightfield/folder_views.h"
#include "core/lightfield/light_field_folder.h"
#include "experiments/cli/inputs.h"
#include "experiments/cli/suggest.h"
#include "experiments/tonemap_fit.h"
#include "stimuli/scenes/table.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

using Kind = BatchInputChoice::Kind;

Effort effort_named(const std::string& preset) {
  for (const Effort effort : {Effort::kTiny, Effort::kPaper})
    if (preset == name_of(effort)) return effort;
  return Effort::kQuick;
}

std::vector<std::string> scene_ids() {
  std::vector<std::string> ids;
  for (const std::span<const SceneEntry> table : {scenes(), near_eye_scenes()})
    for (const SceneEntry& entry : table) ids.emplace_back(entry.id);
  return ids;
}

/// The study's inputs with one for each scene in place of "all".
std::vector<BatchInputChoice> one_by_one(const BatchStudy& study, const std::string& file) {
  const std::vector<std::string> ids = scene_ids();
  std::vector<BatchInputChoice> choices;
  for (const BatchInputChoice& choice : study.inputs) {
    const bool scene = choice.kind == Kind::kScene;
    for (const LitSceneEntry& lit : display_scenes())
      if (scene && choice.source == lit.id)
        throw InputError(
            fmt::format("{}: \"inputs\" names the scene \"{}\", which is for luminance displays "
                        "('plenolab luminance'): a batch maps the scenes {}",
                        file, choice.source, fmt::join(ids, ", ")));
    if (scene && choice.source != "all" && std::find(ids.begin(), ids.end(), choice.source) == ids.end())
      throw InputError(fmt::format("{}: \"inputs\" names the scene \"{}\", which there is not{}", file,
                                   choice.source, did_you_mean(choice.source, ids)));
    if (!scene || choice.source != "all") {
      choices.push_back(choice);
      continue;
    }
    for (const std::string& id : ids) {
      choices.push_back(choice);
      choices.back().source = id;
    }
  }
  return choices;
}

/// Notes the grid and the views asked for, in their order; those that the grid has not stay among them.
void choose_views(BatchInput& input, const ViewGrid& grid) {
  input.columns = grid.columns;
  input.rows = grid.rows;
  const BatchViews& wanted = input.choice.views;
  if (wanted.which == BatchViews::Which::kCentre) input.views = {{grid.columns / 2, grid.rows / 2}};
  if (wanted.which == BatchViews::Which::kListed) input.views = wanted.listed;
  if (wanted.which == BatchViews::Which::kAll)
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) input.views.push_back({column, row});
}

/// A scene is known by the cache keys of its views: they hold all that decides a rendering.
void identify_scene(BatchInput& input, std::uint64_t seed) {
  const std::string& id = input.choice.source;
  Laboratory laboratory(
      {.effort = effort_named(input.choice.preset), .cache = {}, .seed = seed, .on_view = {}});
  const ViewGrid grid = laboratory.grid(id);
  RenderSettings settings;
  settings.paths_per_pixel = laboratory.paths_per_pixel(id);
  settings.seed = seed;
  ContentHash hash;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      hash.add(render_cache_key(laboratory.scene(id), grid,
                                {static_cast<double>(column), static_cast<double>(row)}, settings));
  input.content = hash.hex();
  choose_views(input, grid);
  input.cd_m2_per_unit = 1;
}

/// Of the description and the views of a light field folder; of all files of another layout.
std::string hash_light_field(const fs::path& folder) {
  if (!is_light_field_folder(folder)) {
    Provenance inputs;
    add_input(inputs, folder);
    return inputs.inputs.front().hash;
  }
  const std::string text = read_text_file(folder / kDescriptionFile);
  const LightFieldDescription description = parse_description(text, (folder / kDescriptionFile).string());
  ContentHash hash;
  hash.add(text);
  for (int row = 0; row < description.grid.rows; ++row)
    for (int column = 0; column < description.grid.columns; ++column)
      hash.add(hash_file(view_path(folder, description, column, row)));
  return hash.hex();
}

void identify_light_field(BatchInput& input) {
  const LightField field = open_radiance(input.path);
  choose_views(input, field.grid());
  if (field.unit() == RadianceUnit::kCdM2) input.cd_m2_per_unit = 1;
  input.content = hash_light_field(input.path);
}

/// What is no file (a folder, a pipe that nobody fills) must not be read.
void identify_image(BatchInput& input) {
  std::error_code error;
  const fs::file_status status = fs::status(input.path, error);
  if (!fs::exists(status)) throw InputError(fmt::format("{} does not exist", input.path.string()));
  if (is_display_file(input.path))
    throw InputError(
        fmt::format("{} holds display values, not radiance: give .exr, .hdr or .pfm", input.path.string()));
  if (!fs::is_regular_file(status)) throw InputError(fmt::format("{} is not a file", input.path.string()));
  input.content = hash_file(input.path);
  input.cd_m2_per_unit = declared_cd_m2_per_unit(input.path);
}

void find_content(BatchInput& input, std::uint64_t seed) {
  if (input.choice.kind == Kind::kScene) identify_scene(input, seed);
  if (input.choice.kind == Kind::kLightField) identify_light_field(input);
  if (input.choice.kind == Kind::kImage) identify_image(input);
}

/// Why an input cannot be opened; empty if it can. Whatever it is, it must not end a batch of other inputs.
std::string problem_of(BatchInput& input, std::uint64_t seed) {
  try {
    find_content(input, seed);
    return "";
  } catch (const fs::filesystem_error& error) {
    return fmt::format("{} cannot be opened: {}", input.path.string(), error.code().message());
  } catch (const std::bad_alloc&) {
    return fmt::format("{} needs more memory than there is: its header may be damaged", input.path.string());
  } catch (const std::exception& error) {
    return error.what();
  }
}

BatchInput identify(const BatchInputChoice& choice, const fs::path& folder, std::uint64_t seed) {
  BatchInput input{.choice = choice};
  if (choice.kind != Kind::kScene) input.path = folder / choice.source;
  if (const std::string problem = problem_of(input, seed); !problem.empty()) {
    input.problem = input.as_spelled(problem);
    input.content.clear();
    input.views.clear();
  }
  if (choice.cd_m2_per_unit) input.cd_m2_per_unit = choice.cd_m2_per_unit;
  return input;
}

}  // namespace

std::string BatchInput::as_spelled(std::string message) const {
  const std::string found = path.string();
  if (found.empty()) return message;
  for (std::size_t at = 0; (at = message.find(found, at)) != std::string::npos; at += choice.source.size())
    message.replace(at, found.size(), choice.source);
  return message;
}

std::string BatchInput::problem_with(const BatchView& view) const {
  if (!problem.empty()) return problem;
  if (columns == 0 || (view.column < columns && view.row < rows)) return "";
  return fmt::format("there is no view [{}, {}] among its {} × {}", view.column, view.row, columns, rows);
}

std::vector<BatchInput> identify_inputs(const BatchStudy& study, const fs::path& folder, std::uint64_t seed,
                                        const std::string& file) {
  std::vector<BatchInput> inputs;
  std::set<std::pair<std::string, std::string>> seen;
  for (const BatchInputChoice& choice : one_by_one(study, file)) {
    if (!seen.emplace(choice.title(), choice.preset).second)
      throw InputError(fmt::format("{}: \"inputs\" holds \"{}\" twice: give one of them another \"name\"",
                                   file, choice.title()));
    inputs.push_back(identify(choice, folder, seed));
  }
  return inputs;
}

LoadedInput::LoadedInput(const BatchInput& input, const LoadInputOptions& options) {
  if (input.choice.kind == Kind::kImage) {
    image_ = read_operator_view(input.path);
    image_scope_ = scope_of_image(image_, options.threads, input.cd_m2_per_unit);
    return;
  }
  if (input.choice.kind == Kind::kScene) {
    laboratory_ = std::make_unique<Laboratory>(LaboratoryOptions{.effort = effort_named(input.choice.preset),
                                                                 .cache = options.cache,
                                                                 .seed = options.seed,
                                                                 .threads = options.threads,
                                                                 .on_view = options.on_view});
    field_ = laboratory_->light_field(input.choice.source);
  } else {
    field_ = open_radiance(input.path);
  }
  statistics_ = measure_light_field(*field_, options.threads);
  if (input.choice.cd_m2_per_unit) statistics_.scale.cd_m2_per_unit = input.choice.cd_m2_per_unit;
}

OperatorView LoadedInput::view(const BatchView& place) const {
  return field_ ? operator_view(*field_, place.column, place.row) : image_;
}

FitScope LoadedInput::scope(OperatorScope scope, const BatchView& place, int threads) const {
  if (!field_) {
    FitScope own = image_scope_;
    own.threads = threads;
    return own;
  }
  return scope == OperatorScope::kView ? scope_of_view(*field_, statistics_, place.column, place.row, threads)
                                       : scope_of_light_field(*field_, statistics_, threads);
}

}  // namespace plenolab
