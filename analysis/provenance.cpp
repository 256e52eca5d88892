#include "analysis/provenance.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <thread>

#include "analysis/library_versions.h"
#include "analysis/memory.h"
#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "plenolab_build.h"
#include "plenolab_revision.h"

namespace plenolab {
namespace {

/// Text behind the first "key<separator>" of a system file's lines; empty if there is none.
std::string value_of_line(const char* file, const std::string& key, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = line.find(separator);
    if (line.compare(0, key.size(), key) != 0 || at == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
    if (begin == std::string::npos) return "";
    return line.substr(begin, line.find_last_not_of(" \t\"") + 1 - begin);
  }
  return "";
}

std::string operating_system() {
  const std::string name = value_of_line("/etc/os-release", "PRETTY_NAME", '=');
  utsname system{};
  if (uname(&system) != 0) return name.empty() ? "unknown" : name;
  return fmt::format("{}, {} {}", name.empty() ? "unknown" : name, system.sysname, system.release);
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

std::string hash_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  ContentHash hash;
  for (const auto& file : files) {
    hash.add(file.filename().string());
    hash.add(hash_file(file));
  }
  return hash.hex();
}

nlohmann::ordered_json build_to_json(const BuildInfo& build) {
  return {{"version", build.version},   {"revision", build.revision},     {"dirty", build.dirty},
          {"compiler", build.compiler}, {"build_type", build.build_type}, {"flags", build.flags}};
}

nlohmann::ordered_json machine_to_json(const MachineInfo& machine) {
  return {
      {"cpu", machine.cpu}, {"cores", machine.cores}, {"memory_gib", machine.memory_gib}, {"os", machine.os}};
}

}  // namespace

Cell& ParameterList::operator[](const std::string& name) {
  const auto found =
      std::find_if(items_.begin(), items_.end(), [&](const auto& item) { return item.first == name; });
  return found != items_.end() ? found->second : items_.emplace_back(name, Cell{}).second;
}

MachineInfo machine_info() {
  MachineInfo info;
  info.cpu = value_of_line("/proc/cpuinfo", "model name", ':');
  if (info.cpu.empty()) info.cpu = "unknown";
  info.cores = static_cast<int>(std::thread::hardware_concurrency());
  info.memory_gib =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE)) / 0x1p30;
  info.os = operating_system();
  return info;
}

BuildInfo build_info() {
  return {PLENOLAB_VERSION,  PLENOLAB_REVISION,   PLENOLAB_REVISION_DIRTY,
          PLENOLAB_COMPILER, PLENOLAB_BUILD_TYPE, PLENOLAB_BUILD_FLAGS};
}

Provenance start_provenance(std::vector<std::string> command_line) {
  Provenance provenance;
  provenance.start = std::chrono::steady_clock::now();
  provenance.started_utc = utc_now();
  provenance.command_line = std::move(command_line);
  provenance.build = build_info();
  provenance.machine = machine_info();
  provenance.libraries = library_versions();
  return provenance;
}

Provenance start_provenance(int argc, const char* const* argv) {
  return start_provenance(std::vector<std::string>(argv, argv + argc));
}

void add_input(Provenance& provenance, const std::filesystem::path& path) {
  try {
    const bool folder = std::filesystem::is_directory(path);
    provenance.inputs.push_back({path.string(), folder ? hash_folder(path) : hash_file(path)});
  } catch (const std::filesystem::filesystem_error& error) {
    throw InputError(fmt::format("cannot read {}: {}", path.string(), error.code().message()));
  }
}

void finish_provenance(Provenance& provenance) {
  provenance.duration_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - provenance.start).count();
  provenance.peak_memory_mib = peak_resident_mib().value_or(0);
}

nlohmann::ordered_json provenance_to_json(const Provenance& provenance) {
  nlohmann::ordered_json json;
  json["program"] = "plenolab";
  json["command_line"] = provenance.command_line;
  json["seed"] = nullptr;
  if (provenance.seed) json["seed"] = *provenance.seed;
  json["parameters"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : provenance.parameters.items())
    std::visit([&, key = name](const auto& v) { json["parameters"][key] = v; }, value);
  json["inputs"] = nlohmann::ordered_json::array();
  for (const InputFile& input : provenance.inputs) {
    json["inputs"].push_back({{"path", input.path}, {"xxh3_128", input.hash}});
  }
  json["build"] = build_to_json(provenance.build);
  json["libraries"] = provenance.libraries;
  json["machine"] = machine_to_json(provenance.machine);
  json["started_utc"] = provenance.started_utc;
  json["duration_s"] = provenance.duration_s;
  json["peak_memory_mib"] = provenance.peak_memory_mib;
  return json;
}

void write_run_json(const Provenance& provenance, const std::filesystem::path& folder) {
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_text_file(folder / "run.json", provenance_to_json(provenance).dump(2, ' ', false, replace) + "\n");
}

}  // namespace plenolab
