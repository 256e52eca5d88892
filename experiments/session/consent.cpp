#include "experiments/session/consent.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/session/session_folders.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostBytes = 4u << 20;

/// Why a file is no consent to this session; empty if it is one.
std::string fault_of(const fs::path& file, const SessionIdentity& identity, const ConsentText& asked) {
  const auto json = nlohmann::json::parse(read_text_file(file, kMostBytes), nullptr, false);
  const auto holds = [&](const char* key, const std::string& value) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() && found->get<std::string>() == value;
  };
  if (!json.is_object()) return "is damaged";
  if (!holds("participant", identity.participant) || !holds("session_created_utc", identity.created_utc))
    return "was given for another session";
  if (!holds("text", asked.text)) return "was given to another text";
  if (json.contains("guardian_text") && !holds("guardian_text", asked.guardian_text))
    return "was given to another text for the guardian";
  return "";
}

}  // namespace

bool consent_exists(const fs::path& sessions, const SessionIdentity& identity, const ConsentText& asked) {
  const fs::path file = consent_file(sessions, identity.participant);
  if (!fs::exists(file)) return false;
  const std::string fault = fault_of(file, identity, asked);
  if (!fault.empty())
    throw InputError(
        fmt::format("the consent {} {}: move it away, and consent is asked again", file.string(), fault));
  return true;
}

void require_consent(const fs::path& sessions, const SessionIdentity& identity, const ConsentText& asked) {
  const fs::path file = consent_file(sessions, identity.participant);
  const std::string fault = fs::exists(file) ? fault_of(file, identity, asked) : "is no longer there";
  if (!fault.empty())
    throw InputError(
        fmt::format("the consent {} {}, although {} had consented: put back the one that was "
                    "given, or begin a new session",
                    file.string(), fault, identity.participant));
}

void store_consent(const fs::path& sessions, const ConsentRecord& consent, Durability durability) {
  nlohmann::ordered_json json{{"participant", consent.participant},
                              {"session_created_utc", consent.session_created_utc},
                              {"given_utc", consent.given_utc},
                              {"text", consent.text}};
  if (!consent.guardian_text.empty()) json["guardian_text"] = consent.guardian_text;
  if (!consent.name.empty()) json["name"] = consent.name;
  if (!consent.guardian_name.empty()) json["guardian_name"] = consent.guardian_name;
  create_private_folder(sessions / "consent");
  const fs::path file = consent_file(sessions, consent.participant);
  create_private_file(file, json.dump(2) + "\n", durability);
  remove_partial_files(file);
}

}  // namespace plenolab
