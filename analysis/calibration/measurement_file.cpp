#include "analysis/calibration/measurement_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/calibration/json_node.h"
#include "analysis/calibration/record_fields.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/json_reader.h"

namespace plenolab {

namespace {

/// The format has four levels.
constexpr int kMaxNesting = 8;

using Ordered = nlohmann::ordered_json;

constexpr const char* kMeasurementFormat = "plenolab-calibration";
constexpr const char* kRigFormat = "plenolab-calibration-rig";
constexpr int kVersion = 1;

void require_format(const JsonNode& root, const std::string& format) {
  root.require_object();
  if (root.at("format").text() != format) root.at("format").wrong(fmt::format("must be \"{}\"", format));
  if (root.at("version").number() != kVersion)
    root.at("version").wrong(fmt::format("must be {}: this program knows no other", kVersion));
}

CalibrationInstrument read_instrument(const JsonNode& node) {
  node.allow_only({"subimage_px", "camera_spacing_mm", "render_fov_deg"});
  return {node.at("subimage_px").number(), node.at("camera_spacing_mm").number(),
          node.at("render_fov_deg").number()};
}

CalibrationParameter parameter_at(const JsonNode& node, const std::string& key) {
  if (const auto parameter = parameter_named(key)) return *parameter;
  std::string known;
  for (std::size_t i = 0; i < kCalibrationParameters; ++i)
    known += (i ? ", " : "") + std::string(traits_of(i).name);
  node.at(key).wrong("is not a parameter: there are " + known);
}

ParameterSetting read_setting(const JsonNode& node) {
  node.allow_only({"nominal", "sd", "fixed"});
  ParameterSetting setting;
  setting.nominal = node.at("nominal").number();
  const bool fixed = node.has("fixed") && node.at("fixed").truth();
  if (fixed && node.has("sd"))
    node.wrong("is fixed, so it cannot have a standard deviation: give one of the two");
  setting.role = ParameterSetting::Role::kFree;
  if (fixed) setting.role = ParameterSetting::Role::kFixed;
  if (node.has("sd")) {
    setting.role = ParameterSetting::Role::kAnchored;
    setting.sd = node.at("sd").number();
  }
  return setting;
}

/// Keys and values that are no plain numbers.
std::vector<std::string> read_words(const JsonNode& node, EdgeRecord& record) {
  record.axis = node.at("axis").one_of({"x", "y"}) == 0 ? CalibrationAxis::kX : CalibrationAxis::kY;
  record.side = node.at("side").one_of({"positive", "negative"}) == 0 ? 1 : -1;
  return {"axis", "side"};
}
std::vector<std::string> read_words(const JsonNode& node, GridRecord& record) {
  record.column = node.at("column").integer();
  record.row = node.at("row").integer();
  return {"column", "row"};
}
template <class Record>
std::vector<std::string> read_words(const JsonNode&, Record&) {
  return {};
}

void write_words(Ordered& json, const EdgeRecord& record) {
  json["axis"] = record.axis == CalibrationAxis::kX ? "x" : "y";
  json["side"] = record.side > 0 ? "positive" : "negative";
}
void write_words(Ordered& json, const GridRecord& record) {
  json["column"] = record.column;
  json["row"] = record.row;
}
template <class Record>
void write_words(Ordered&, const Record&) {}

/// A record of the kind with this number; readings only where the file has them.
template <std::size_t... kKinds>
CalibrationRecord empty_record(std::size_t kind, std::index_sequence<kKinds...>) {
  CalibrationRecord record;
  ((kKinds == kind ? void(record.emplace<kKinds>()) : void()), ...);
  return record;
}

using AllKinds = std::make_index_sequence<std::variant_size_v<CalibrationRecord>>;

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < std::variant_size_v<CalibrationRecord>; ++i)
      all.emplace_back(kind_of(empty_record(i, AllKinds{})));
    return all;
  }();
  return names;
}

CalibrationRecord read_record(const JsonNode& node, bool with_readings) {
  CalibrationRecord record = empty_record(node.at("kind").one_of(kinds()), AllKinds{});
  std::visit(
      [&](auto& r) {
        std::vector<std::string> known = read_words(node, r);
        known.emplace_back("kind");
        for_each_number(r, [&](const RecordField& field, double& value) {
          if (field.role == RecordField::Role::kReading && !with_readings) return;
          value = node.at(field.name).number();
          known.emplace_back(field.name);
        });
        node.allow_only(known);
      },
      record);
  return record;
}

Ordered write_record(const CalibrationRecord& record, bool with_readings) {
  Ordered json;
  json["kind"] = kind_of(record);
  std::visit(
      [&](const auto& r) {
        write_words(json, r);
        for_each_number(r, [&](const RecordField& field, double value) {
          if (field.role != RecordField::Role::kReading || with_readings) json[field.name] = value;
        });
      },
      record);
  return json;
}

CalibrationMeasurements read_body(const JsonNode& root, bool with_readings) {
  CalibrationMeasurements measurements;
  if (root.has("comment")) measurements.comment = root.at("comment").text();
  measurements.instrument = read_instrument(root.at("instrument"));
  const JsonNode parameters = root.at("parameters");
  for (const std::string& key : parameters.keys())
    measurements.parameters[index_of(parameter_at(parameters, key))] = read_setting(parameters.at(key));
  for (const JsonNode& record : root.at("records").elements())
    measurements.records.push_back(read_record(record, with_readings));
  return measurements;
}

Ordered write_setting(const ParameterSetting& setting) {
  Ordered json{{"nominal", setting.nominal}};
  if (setting.role == ParameterSetting::Role::kFixed) json["fixed"] = true;
  if (setting.role == ParameterSetting::Role::kAnchored) json["sd"] = setting.sd;
  return json;
}

Ordered write_head(const char* format, const CalibrationMeasurements& measurements) {
  Ordered json;
  json["format"] = format;
  json["version"] = kVersion;
  if (!measurements.comment.empty()) json["comment"] = measurements.comment;
  const CalibrationInstrument& instrument = measurements.instrument;
  json["instrument"] = {{"subimage_px", instrument.subimage_px},
                        {"camera_spacing_mm", instrument.camera_spacing_mm},
                        {"render_fov_deg", instrument.render_fov_deg}};
  const ParameterSettings defaults = nominal_settings();
  json["parameters"] = Ordered::object();
  for (std::size_t i = 0; i < defaults.size(); ++i) {
    const ParameterSetting& p = measurements.parameters[i];
    if (p.role != defaults[i].role || p.nominal != defaults[i].nominal)
      json["parameters"][traits_of(i).name] = write_setting(p);
  }
  return json;
}

void write_records(Ordered& json, const CalibrationMeasurements& measurements, bool with_readings) {
  json["records"] = Ordered::array();
  for (const CalibrationRecord& record : measurements.records)
    json["records"].push_back(write_record(record, with_readings));
}

/// Two spaces of indentation; one record or parameter a line.
std::string layout(const Ordered& json) {
  std::string text = "{\n";
  std::size_t left = json.size();
  for (const auto& item : json.items()) {
    text += fmt::format("  {}: ", Ordered(item.key()).dump());
    const bool lines = item.key() == "records" || item.key() == "parameters";
    if (!lines || item.value().empty()) {
      text += item.value().dump();
    } else {
      const bool list = item.value().is_array();
      text += list ? "[\n" : "{\n";
      std::size_t inner = item.value().size();
      for (const auto& part : item.value().items())
        text += fmt::format("    {}{}{}\n", list ? "" : Ordered(part.key()).dump() + ": ",
                            part.value().dump(), --inner ? "," : "");
      text += list ? "  ]" : "  }";
    }
    text += --left ? ",\n" : "\n";
  }
  return text + "}\n";
}

}  // namespace

CalibrationMeasurements parse_measurements(std::string_view json, const std::string& name) {
  const nlohmann::json document = parse_json(json, name, kMaxNesting);
  const JsonNode root(document, name, "");
  require_format(root, kMeasurementFormat);
  root.allow_only({"format", "version", "comment", "instrument", "parameters", "records"});
  CalibrationMeasurements measurements = read_body(root, true);
  measurements.validate(name);
  return measurements;
}

std::string format_measurements(const CalibrationMeasurements& measurements) {
  Ordered json = write_head(kMeasurementFormat, measurements);
  write_records(json, measurements, true);
  return layout(json);
}

CalibrationMeasurements read_measurements(const std::filesystem::path& file) {
  return parse_measurements(read_text_file(file), file.string());
}

CalibrationRig parse_rig(std::string_view json, const std::string& name) {
  const nlohmann::json document = parse_json(json, name, kMaxNesting);
  const JsonNode root(document, name, "");
  require_format(root, kRigFormat);
  root.allow_only(
      {"format", "version", "comment", "instrument", "parameters", "truth", "outliers", "records"});
  CalibrationRig rig;
  rig.plan = read_body(root, false);
  const JsonNode truth = root.at("truth");
  for (std::size_t i = 0; i < rig.truth.size(); ++i) rig.truth[i] = rig.plan.parameters[i].nominal;
  for (const std::string& key : truth.keys())
    rig.truth[index_of(parameter_at(truth, key))] = truth.at(key).number();
  if (root.has("outliers")) {
    const JsonNode outliers = root.at("outliers");
    outliers.allow_only({"share", "deviations"});
    rig.outlier_share = outliers.at("share").number();
    rig.outlier_deviations = outliers.at("deviations").number();
  }
  rig.validate(name);
  return rig;
}

std::string format_rig(const CalibrationRig& rig) {
  Ordered json = write_head(kRigFormat, rig.plan);
  json["truth"] = Ordered::object();
  for (std::size_t i = 0; i < rig.truth.size(); ++i)
    if (rig.truth[i] != rig.plan.parameters[i].nominal) json["truth"][traits_of(i).name] = rig.truth[i];
  if (rig.outlier_share > 0)
    json["outliers"] = {{"share", rig.outlier_share}, {"deviations", rig.outlier_deviations}};
  write_records(json, rig.plan, false);
  return layout(json);
}

CalibrationRig read_rig(const std::filesystem::path& file) {
  return parse_rig(read_text_file(file), file.string());
}

}  // namespace plenolab
