#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/session/store.h"

namespace plenolab {

/// A new session's identity with this number of its mode.
SessionIdentity new_identity(const StudyDefinition& study, SessionMode mode, int number);

/// Creates the next session of this mode. Stations that start at the same time get numbers of their own.
SessionStore create_next_session(const std::filesystem::path& sessions, const StudyDefinition& study,
                                 SessionMode mode, Durability durability);

/// What is different between the study that a session ran and this one, in words ("ran another version of the
/// study", "saw another image in images/near-test.png"); empty if nothing is.
std::string difference(const SessionIdentity& identity, const StudyDefinition& study);

/// Throws InputError if a session of this mode below `sessions` ran another version of the study or with
/// other images, or sessions of people would be mixed with simulated ones. Pilots of earlier versions do not
/// matter to real sessions. Sessions that another station is just running are taken on trust, and so are
/// those that cannot be read or lie in a folder of another name: one of them does not stop a study. What they
/// are is returned, a sentence each.
std::vector<std::string> require_same_study(const std::filesystem::path& sessions,
                                            const StudyDefinition& study, SessionMode mode);

}  // namespace plenolab
