#include "experiments/session/same_study.h"

#include <fmt/format.h>

#include "analysis/provenance.h"
#include "core/base/error.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/sqlite.h"

namespace plenolab {
namespace fs = std::filesystem;

SessionIdentity new_identity(const StudyDefinition& study, SessionMode mode, int number) {
  const BuildInfo build = build_info();
  return {.participant = pseudonym(mode, number),
          .number = number,
          .mode = mode,
          .study_json = format_study(study),
          .study_hash = study_hash(study),
          .image_hashes = study.image_hashes,
          .created_utc = utc_now(),
          .program = fmt::format("plenolab {} {}{}", build.version, build.revision,
                                 build.dirty ? " (changed)" : "")};
}

SessionStore create_next_session(const fs::path& sessions, const StudyDefinition& study, SessionMode mode,
                                 Durability durability) {
  constexpr int kStations = 1000;  // more do not start at once
  for (int attempt = 0; attempt < kStations; ++attempt) {
    const int number = next_number(sessions, mode);
    try {
      return SessionStore::create(sessions, new_identity(study, mode, number), durability,
                                  SessionStore::CutOff::kRefuse);
    } catch (const SessionExists&) {  // another station was faster
    }
  }
  throw InputError(fmt::format("{} has no pseudonym left that is free", sessions.string()));
}

std::string difference(const SessionIdentity& identity, const StudyDefinition& study) {
  if (identity.study_hash == study_hash(study)) return "";
  if (identity.study_json != format_study(study)) return "ran another version of the study";
  for (const auto& entry : study.image_hashes) {
    const auto seen = identity.image_hashes.find(entry.first);
    if (seen == identity.image_hashes.end() || seen->second != entry.second)
      return fmt::format("saw another image in {}", entry.first);
  }
  return "saw other images";
}

std::vector<std::string> require_same_study(const fs::path& sessions, const StudyDefinition& study,
                                            SessionMode mode) {
  std::vector<std::string> unread;
  if (!fs::is_directory(sessions)) return unread;
  for (const fs::path& folder : session_folders(sessions)) {
    const std::string name = folder.filename().string();
    const bool simulated = name.starts_with(name_of(SessionMode::kSimulated));
    if (simulated != (mode == SessionMode::kSimulated))
      throw InputError(fmt::format("{} holds {} sessions: keep {} ones in a folder of their own (-o)",
                                   sessions.string(), simulated ? "simulated" : "real or pilot",
                                   name_of(mode)));
    if (!name.starts_with(name_of(mode))) continue;  // pilots of earlier versions harm nobody
    std::string different;
    try {
      if (holds_session(folder)) {
        const SessionIdentity identity = read_session(folder).identity;
        require_own_folder(identity, folder);
        different = difference(identity, study);
      }
    } catch (const DatabaseInUse&) {
    } catch (const InputError& error) {
      unread.push_back(error.what());
    }
    if (!different.empty())
      throw InputError(fmt::format("{} {}: keep sessions of this one in a folder of their own (-o)",
                                   folder.string(), different));
  }
  return unread;
}

}  // namespace plenolab
