#include "experiments/session/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/io/json_reader.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kFormatName = "plenolab-study";
constexpr int kFormatVersion = 1;
constexpr int kLeastBlank_ms = 250, kMostBlank_ms = 10000;
constexpr int kMostScreens = 16, kMostZoom = 64;
constexpr std::size_t kMostEntries = 1000, kLongestText = 8000;

/// An id becomes part of file names and of tables.
std::string checked_id(const JsonReader& reader, const std::string& key, const std::string& id) {
  const bool plain = !id.empty() && id.size() <= 32 && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (!plain) reader.wrong(key, "must be 1 to 32 letters, digits, '-' or '_'");
  return id;
}

std::string id_of(const JsonReader& reader, std::set<std::string>& used) {
  const std::string id = checked_id(reader, "id", reader.text("id"));
  if (!used.insert(id).second) reader.wrong("id", fmt::format("\"{}\" is used twice", id));
  return id;
}

/// A list of ids, none empty of entries, each of them known and named once.
std::vector<std::string> known_ids(const JsonReader& reader, const std::string& key,
                                   const std::set<std::string>& known) {
  const std::vector<std::string> ids = reader.texts(key, kMostEntries);
  if (ids.empty()) reader.wrong(key, "must name at least one");
  std::set<std::string> seen;
  for (const std::string& id : ids) {
    if (!known.contains(id))
      reader.wrong(key, fmt::format("names \"{}\", which is not there", id.substr(0, 40)));
    if (!seen.insert(id).second) reader.wrong(key, fmt::format("names \"{}\" twice", id));
  }
  return ids;
}

/// An image is a PNG in the study's folder or below.
std::string image_file(const JsonReader& reader, const std::string& key) {
  const std::string name = reader.text(key);
  const fs::path path(name);
  bool inside = path.is_relative() && path.has_filename() && path.extension() == ".png";
  for (const auto& part : path) inside = inside && part != ".." && part != ".";
  if (!inside) reader.wrong(key, fmt::format("must be a .png in the study's folder, not \"{}\"", name));
  return name;
}

StimulusFiles files_of(const JsonReader& reader) {
  return {image_file(reader, "reference"), image_file(reader, "test")};
}

StudyImage read_image(const JsonReader& reader, std::set<std::string>& used) {
  reader.allow_only({"id", "catch", "identical", "reference", "test", "light-field", "monitor"});
  StudyImage image{.id = id_of(reader, used)};
  image.identical = reader.has("identical") && reader.boolean("identical");
  image.catch_trial = reader.has("catch") && reader.boolean("catch");
  const bool shared = reader.has("reference") || reader.has("test");
  if (shared == (reader.has("light-field") || reader.has("monitor")))
    reader.wrong("reference",
                 "and \"test\" must be given, or else \"light-field\" and \"monitor\" with their own");
  if (shared) {
    image.light_field = image.monitor = files_of(reader);
    return image;
  }
  for (const char* display : {"light-field", "monitor"}) {
    if (!reader.has(display)) continue;
    const JsonReader own = reader.object(display);
    own.allow_only({"reference", "test"});
    (std::string(display) == "monitor" ? image.monitor : image.light_field) = files_of(own);
  }
  return image;
}

DisplayKind display_of(const JsonReader& reader) {
  const std::string display = reader.text("display");
  if (display == "light-field") return DisplayKind::kLightField;
  if (display != "monitor")
    reader.wrong("display", fmt::format("must be \"light-field\" or \"monitor\", not \"{}\"", display));
  return DisplayKind::kMonitor;
}

void read_images(const JsonReader& root, StudyDefinition& study, std::set<std::string>& ids) {
  for (const JsonReader& reader : root.objects("images", kMostEntries))
    study.images.push_back(read_image(reader, ids));
  if (study.images.empty()) root.wrong("images", "must hold at least one");
}

void read_blocks(const JsonReader& root, StudyDefinition& study, const std::set<std::string>& images,
                 std::set<std::string>& ids) {
  for (const JsonReader& reader : root.objects("blocks", kMostEntries)) {
    reader.allow_only({"id", "display", "screen", "zoom", "images"});
    StudyBlock block{.id = id_of(reader, ids), .display = display_of(reader)};
    if (reader.has("screen")) block.screen = reader.integer("screen", 0, kMostScreens - 1);
    if (reader.has("zoom")) block.zoom = reader.integer("zoom", 1, kMostZoom);
    block.images = known_ids(reader, "images", images);
    for (const std::string& id : block.images)
      if (study.image(id).on(block.display).reference.empty())
        reader.wrong("images", fmt::format("names \"{}\", which has no files for the display {}", id,
                                           name_of(block.display)));
    study.blocks.push_back(block);
  }
  if (study.blocks.empty()) root.wrong("blocks", "must hold at least one");
}

void read_orders(const JsonReader& root, StudyDefinition& study, const std::set<std::string>& blocks) {
  if (!root.has("orders")) {
    study.orders = {{"as-listed", {}}};
    for (const StudyBlock& block : study.blocks) study.orders[0].blocks.push_back(block.id);
    return;
  }
  std::set<std::string> names;
  for (const JsonReader& reader : root.objects("orders", kMostEntries)) {
    reader.allow_only({"name", "blocks"});
    const std::string name = checked_id(reader, "name", reader.text("name"));
    if (!names.insert(name).second) reader.wrong("name", fmt::format("\"{}\" is used twice", name));
    study.orders.push_back({name, known_ids(reader, "blocks", blocks)});
  }
  if (study.orders.empty()) root.wrong("orders", "must hold at least one");
}

ConsentText read_consent(const JsonReader& reader) {
  reader.allow_only({"text", "guardian_text", "adult_age", "signature"});
  ConsentText consent{reader.text("text", kLongestText), reader.text("guardian_text", kLongestText)};
  if (reader.has("adult_age")) consent.adult_age = reader.integer("adult_age", 1, 99);
  if (reader.has("signature")) consent.signature = reader.boolean("signature");
  return consent;
}

Demographics read_demographics(const JsonReader& reader) {
  reader.allow_only({"age", "sex", "vision"});
  Demographics asked;
  if (reader.has("age")) asked.age = reader.boolean("age");
  if (reader.has("sex")) asked.sex = reader.boolean("sex");
  if (reader.has("vision")) asked.vision = reader.boolean("vision");
  return asked;
}

std::vector<StudyQuestion> read_questionnaire(const JsonReader& root) {
  std::vector<StudyQuestion> questions;
  // Ids that the questions about the person have.
  std::set<std::string> ids{"age", "sex", "vision", "adult"};
  for (const JsonReader& reader : root.objects("questionnaire", 100)) {
    reader.allow_only({"id", "text", "choices"});
    StudyQuestion question{id_of(reader, ids), reader.text("text", 1000), {}};
    if (reader.has("choices")) {
      question.choices = reader.texts("choices", 12, 200);
      if (question.choices.size() < 2) reader.wrong("choices", "must hold at least two");
    }
    questions.push_back(question);
  }
  return questions;
}

SessionMode mode_of(const JsonReader& root) {
  const std::string mode = root.text("mode");
  if (mode == "real") return SessionMode::kReal;
  if (mode != "pilot") root.wrong("mode", fmt::format("must be \"real\" or \"pilot\", not \"{}\"", mode));
  return SessionMode::kPilot;
}

void read_settings(const JsonReader& root, StudyDefinition& study) {
  study.title = root.text("title");
  study.mode = mode_of(root);
  study.seed = static_cast<std::uint64_t>(root.integer("seed", 0, std::numeric_limits<int>::max()));
  if (root.has("blank_ms")) study.blank_ms = root.integer("blank_ms", kLeastBlank_ms, kMostBlank_ms);
  if (root.has("return_to_reference")) study.return_to_reference = root.boolean("return_to_reference");
  if (root.has("text_screen")) study.text_screen = root.integer("text_screen", 0, kMostScreens - 1);
  if (root.has("instructions")) study.instructions = root.texts("instructions", 12, 1000);
}

nlohmann::ordered_json image_json(const StudyImage& image) {
  nlohmann::ordered_json json{{"id", image.id}};
  if (image.catch_trial) json["catch"] = true;
  if (image.identical) json["identical"] = true;
  const auto files = [](const StimulusFiles& f) {
    return nlohmann::ordered_json{{"reference", f.reference}, {"test", f.test}};
  };
  if (image.light_field == image.monitor) {
    json["reference"] = image.monitor.reference;
    json["test"] = image.monitor.test;
    return json;
  }
  if (!image.light_field.reference.empty()) json["light-field"] = files(image.light_field);
  if (!image.monitor.reference.empty()) json["monitor"] = files(image.monitor);
  return json;
}

nlohmann::ordered_json blocks_json(const StudyDefinition& study) {
  auto blocks = nlohmann::ordered_json::array();
  for (const StudyBlock& block : study.blocks)
    blocks.push_back({{"id", block.id},
                      {"display", name_of(block.display)},
                      {"screen", block.screen},
                      {"zoom", block.zoom},
                      {"images", block.images}});
  return blocks;
}

nlohmann::ordered_json questionnaire_json(const StudyDefinition& study) {
  auto questions = nlohmann::ordered_json::array();
  for (const StudyQuestion& question : study.questionnaire) {
    questions.push_back({{"id", question.id}, {"text", question.text}});
    if (!question.choices.empty()) questions.back()["choices"] = question.choices;
  }
  return questions;
}

}  // namespace

const char* name_of(SessionMode mode) {
  return mode == SessionMode::kReal ? "real" : mode == SessionMode::kPilot ? "pilot" : "simulated";
}

const char* name_of(DisplayKind display) {
  return display == DisplayKind::kLightField ? "light-field" : "monitor";
}

const StudyImage& StudyDefinition::image(const std::string& id) const {
  const auto found =
      std::find_if(images.begin(), images.end(), [&](const StudyImage& i) { return i.id == id; });
  PLENOLAB_CHECK(found != images.end(), id);
  return *found;
}

const StudyBlock& StudyDefinition::block(const std::string& id) const {
  const auto found =
      std::find_if(blocks.begin(), blocks.end(), [&](const StudyBlock& b) { return b.id == id; });
  PLENOLAB_CHECK(found != blocks.end(), id);
  return *found;
}

StudyDefinition parse_study(std::string_view json, const std::string& name) {
  const nlohmann::json document = parse_json(json, name, 8);
  const JsonReader root(document, name, "");
  if (root.text("format") != kFormatName) root.wrong("format", fmt::format("must be \"{}\"", kFormatName));
  if (root.integer("version", 0, std::numeric_limits<int>::max()) != kFormatVersion)
    root.wrong("version", fmt::format("must be {}: this program knows no other", kFormatVersion));
  root.allow_only({"format", "version", "comment", "title", "mode", "seed", "blank_ms", "return_to_reference",
                   "text_screen", "instructions", "consent", "demographics", "images", "blocks", "orders",
                   "questionnaire"});
  StudyDefinition study;
  read_settings(root, study);
  study.consent = read_consent(root.object("consent"));
  if (root.has("demographics")) study.demographics = read_demographics(root.object("demographics"));
  std::set<std::string> images, blocks;
  read_images(root, study, images);
  read_blocks(root, study, images, blocks);
  read_orders(root, study, blocks);
  if (root.has("questionnaire")) study.questionnaire = read_questionnaire(root);
  return study;
}

std::string format_study(const StudyDefinition& study) {
  nlohmann::ordered_json json{{"format", kFormatName},
                              {"version", kFormatVersion},
                              {"title", study.title},
                              {"mode", name_of(study.mode)},
                              {"seed", study.seed},
                              {"blank_ms", study.blank_ms},
                              {"return_to_reference", study.return_to_reference},
                              {"text_screen", study.text_screen},
                              {"instructions", study.instructions}};
  json["consent"] = {{"text", study.consent.text},
                     {"guardian_text", study.consent.guardian_text},
                     {"adult_age", study.consent.adult_age},
                     {"signature", study.consent.signature}};
  json["demographics"] = {{"age", study.demographics.age},
                          {"sex", study.demographics.sex},
                          {"vision", study.demographics.vision}};
  json["images"] = nlohmann::ordered_json::array();
  for (const StudyImage& image : study.images) json["images"].push_back(image_json(image));
  json["blocks"] = blocks_json(study);
  json["orders"] = nlohmann::ordered_json::array();
  for (const BlockOrder& order : study.orders)
    json["orders"].push_back({{"name", order.name}, {"blocks", order.blocks}});
  json["questionnaire"] = questionnaire_json(study);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string study_hash(const StudyDefinition& study) {
  ContentHash hash;
  hash.add(format_study(study));
  for (const auto& [file, content] : study.image_hashes) {
    hash.add(file);
    hash.add(content);
  }
  return hash.hex();
}

bool is_placeholder(const ConsentText& consent) {
  const auto holds = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text.find("placeholder") != std::string::npos;
  };
  return holds(consent.text) || holds(consent.guardian_text);
}

}  // namespace plenolab
