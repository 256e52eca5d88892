#pragma once

#include <filesystem>
#include <string>

#include "experiments/session/store.h"

namespace plenolab {

/// A consent that was given. It is kept apart from all answers, in SESSIONS/consent/PSEUDONYM.json (0600),
/// because it may hold names: whoever shares a session or its export shares no name.
struct ConsentRecord {
  std::string participant;          ///< pseudonym
  std::string session_created_utc;  ///< of the session it was given for
  std::string given_utc;
  std::string text, guardian_text;  ///< as shown; the guardian's is empty for adults
  std::string name, guardian_name;  ///< as typed; empty where no signature is asked
};

/// Whether one was stored already for this session: then it is neither asked for again nor touched. Throws
/// InputError if there is one that cannot be read, or is of another session or to another text: it is no
/// consent to this session, and a person has to see to it.
bool consent_exists(const std::filesystem::path& sessions, const SessionIdentity& identity,
                    const ConsentText& asked);

/// Throws InputError unless the consent of a session whose participant has consented is still there,
/// readable, and for this session and text.
void require_consent(const std::filesystem::path& sessions, const SessionIdentity& identity,
                     const ConsentText& asked);

/// Stores a consent, as durable when it returns as asked. Throws InputError if there is one or the folder
/// cannot be written.
void store_consent(const std::filesystem::path& sessions, const ConsentRecord& consent,
                   Durability durability);

}  // namespace plenolab
