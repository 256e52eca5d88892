#include "experiments/session/consent.h"

#include <nlohmann/json.hpp>

namespace plenolab {
namespace fs = std::filesystem;

namespace {

fs::path consent_file(const fs::path& sessions, const std::string& participant) {
  return sessions / "consent" / (participant + ".json");
}

}  // namespace

bool consent_exists(const fs::path& sessions, const std::string& participant) {
  return fs::exists(consent_file(sessions, participant));
}

void store_consent(const fs::path& sessions, const ConsentRecord& consent, Durability durability) {
  nlohmann::ordered_json json{
      {"participant", consent.participant}, {"given_utc", consent.given_utc}, {"text", consent.text}};
  if (!consent.guardian_text.empty()) json["guardian_text"] = consent.guardian_text;
  if (!consent.name.empty()) json["name"] = consent.name;
  if (!consent.guardian_name.empty()) json["guardian_name"] = consent.guardian_name;
  create_private_folder(sessions / "consent");
  create_private_file(consent_file(sessions, consent.participant), json.dump(2) + "\n", durability);
}

}  // namespace plenolab
