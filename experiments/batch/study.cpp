#include "experiments/batch/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.h"
#include "core/io/json_reader.h"

namespace plenolab {

namespace {

constexpr const char* kFormatName = "plenolab-batch";
constexpr int kFormatVersion = 1;
constexpr std::size_t kMostInputs = 10'000, kMostViews = 10'000, kMostOperators = 1000, kMostMetrics = 100;
constexpr int kMostRepeats = 1000, kMostColumns = 10'000;

using Json = nlohmann::json;

BatchView view_of(const JsonReader& reader, const Json& json) {
  const auto whole = [](const Json& number) {
    return number.is_number_integer() && number.get<double>() >= 0 && number.get<double>() < kMostColumns;
  };
  if (!json.is_array() || json.size() != 2 || !whole(json[0]) || !whole(json[1]))
    reader.wrong("views", fmt::format("must hold key views as [column, row], from [0, 0] at the top left, "
                                      "not {}",
                                      json.dump(-1, ' ', true).substr(0, 40)));
  return {json[0].get<int>(), json[1].get<int>()};
}

BatchViews views_of(const JsonReader& reader) {
  const Json& json = reader.value("views");
  if (json == "centre") return {};
  if (json == "all") return {BatchViews::Which::kAll, {}};
  if (!json.is_array() || json.empty() || json.size() > kMostViews)
    reader.wrong("views", fmt::format(R"(must be "centre", "all" or a list of 1 to {} views)", kMostViews));
  BatchViews views{BatchViews::Which::kListed, {}};
  std::set<BatchView> seen;
  for (const Json& entry : json) {
    const BatchView view = view_of(reader, entry);
    if (!seen.insert(view).second)
      reader.wrong("views", fmt::format("names [{}, {}] twice", view.column, view.row));
    views.listed.push_back(view);
  }
  return views;
}

/// Which of the keys that say what an input is was given.
BatchInputChoice::Kind kind_of(const JsonReader& reader, std::string& key) {
  using Kind = BatchInputChoice::Kind;
  static constexpr std::array<std::pair<const char*, Kind>, 3> kKinds{
      {{"scene", Kind::kScene}, {"light_field", Kind::kLightField}, {"image", Kind::kImage}}};
  std::optional<Kind> found;
  for (const auto& [name, kind] : kKinds) {
    if (!reader.has(name)) continue;
    if (found) reader.wrong(name, fmt::format("and \"{}\" cannot both be given", key));
    found = kind;
    key = name;
  }
  if (!found) reader.wrong("scene", "is missing, and so are \"light_field\" and \"image\": give one of them");
  return *found;
}

std::string preset_of(const JsonReader& reader) {
  if (!reader.has("preset")) return "quick";
  const std::string preset = reader.text("preset");
  if (preset != "tiny" && preset != "quick" && preset != "paper")
    reader.wrong("preset", fmt::format("must be tiny, quick or paper, not \"{}\"", preset));
  return preset;
}

BatchInputChoice input_of(const JsonReader& reader, const BatchViews& views) {
  reader.allow_only({"scene", "light_field", "image", "name", "preset", "views", "cd_m2_per_unit"});
  BatchInputChoice input{.views = views};
  std::string key;
  input.kind = kind_of(reader, key);
  const bool scene = input.kind == BatchInputChoice::Kind::kScene;
  const bool image = input.kind == BatchInputChoice::Kind::kImage;
  input.source = reader.text(key, 4000);
  if (reader.has("name")) input.name = reader.text("name");
  if (scene) input.preset = preset_of(reader);
  if (!scene && reader.has("preset")) reader.wrong("preset", "is for scenes only");
  if (scene && input.source == "all" && !input.name.empty())
    reader.wrong("name", "is for one input, not for all scenes");
  if (image && reader.has("views")) reader.wrong("views", "is not for single images");
  if (image) input.views = {};
  if (reader.has("views")) input.views = views_of(reader);
  if (scene && reader.has("cd_m2_per_unit"))
    reader.wrong("cd_m2_per_unit", "is not for scenes, which are in cd/m² already");
  if (reader.has("cd_m2_per_unit")) input.cd_m2_per_unit = reader.positive("cd_m2_per_unit");
  return input;
}

std::string assignment(const JsonReader& settings, const std::string& key, const Json& value) {
  if (value.is_string()) return key + "=" + settings.text(key, 100);
  if (!value.is_number()) settings.wrong(key, "must be a number or a text");
  return key + "=" + value.dump();
}

BatchOperatorChoice operator_of(const JsonReader& reader) {
  reader.allow_only({"name", "variant", "settings"});
  BatchOperatorChoice choice{reader.text("name"), {}, {}};
  if (reader.has("variant")) choice.variant = reader.text("variant");
  if (!reader.has("settings")) return choice;
  const JsonReader settings = reader.object("settings");
  for (const auto& entry : reader.value("settings").items()) {
    if (entry.key().empty() || entry.key().size() > 100 || entry.key().find('=') != std::string::npos)
      settings.wrong(entry.key().substr(0, 80), "is no setting: check its spelling");
    choice.settings.push_back(assignment(settings, entry.key(), entry.value()));
  }
  return choice;
}

ViewingConditions viewing_of(const JsonReader& reader) {
  reader.allow_only({"pixels_per_degree", "distance_m", "display_peak_cd_m2", "display_black_cd_m2"});
  ViewingConditions viewing;
  const auto read = [&](const char* key, double& value) {
    if (!reader.has(key)) return;
    const Json& json = reader.value(key);
    if (!json.is_number()) reader.wrong(key, fmt::format("must be a number, not {}", json.type_name()));
    value = json.get<double>();
  };
  read("pixels_per_degree", viewing.pixels_per_degree);
  read("distance_m", viewing.distance_m);
  read("display_peak_cd_m2", viewing.display_peak_cd_m2);
  read("display_black_cd_m2", viewing.display_black_cd_m2);
  return viewing;
}

void check_head(const JsonReader& root) {
  if (root.text("format") != kFormatName) root.wrong("format", fmt::format("must be \"{}\"", kFormatName));
  if (root.integer("version", 0, std::numeric_limits<int>::max()) != kFormatVersion)
    root.wrong("version", fmt::format("must be {}: this program knows no other", kFormatVersion));
  root.allow_only({"format", "version", "comment", "title", "inputs", "views", "operators", "metrics",
                   "viewing", "repeat", "seed", "keep_images"});
}

void read_viewing(const JsonReader& root, BatchStudy& study) {
  if (!root.has("viewing")) return;
  study.viewing = viewing_of(root.object("viewing"));
  try {
    study.viewing.validate();
  } catch (const InputError& error) {
    root.wrong("viewing", fmt::format("is out of range: {}", error.what()));
  }
}

}  // namespace

BatchStudy parse_batch_study(std::string_view json, const std::string& name) {
  const Json document = parse_json(json, name, 6);
  const JsonReader root(document, name, "");
  check_head(root);
  BatchStudy study;
  study.title = root.has("title") ? root.text("title") : "Batch of tone mapping";
  const BatchViews views = root.has("views") ? views_of(root) : BatchViews{};
  for (const JsonReader& reader : root.objects("inputs", kMostInputs))
    study.inputs.push_back(input_of(reader, views));
  if (study.inputs.empty()) root.wrong("inputs", "must hold at least one");
  for (const JsonReader& reader : root.objects("operators", kMostOperators))
    study.operators.push_back(operator_of(reader));
  if (study.operators.empty()) root.wrong("operators", "must hold at least one");
  if (root.has("metrics")) study.metrics = root.texts("metrics", kMostMetrics);
  if (study.metrics.empty()) root.wrong("metrics", "must name at least one");
  read_viewing(root, study);
  if (root.has("repeat")) study.repeat = root.integer("repeat", 1, kMostRepeats);
  if (root.has("keep_images")) {
    if (!root.value("keep_images").is_boolean()) root.wrong("keep_images", "must be true or false");
    study.keep_images = root.value("keep_images").get<bool>();
  }
  if (root.has("seed"))
    study.seed = static_cast<std::uint64_t>(root.integer("seed", 0, std::numeric_limits<int>::max()));
  return study;
}

}  // namespace plenolab
