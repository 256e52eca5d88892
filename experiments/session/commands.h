#pragma once

#include <filesystem>
#include <string>

#include "experiments/commands.h"

namespace plenolab {

/// Below `plenolab session`: each declares its options on `session` and what runs.
void add_session_new(CLI::App& session, const Invocation& invocation);
void add_session_run(CLI::App& session);
void add_session_resume(CLI::App& session);
void add_session_withdraw(CLI::App& session);
void add_session_simulate(CLI::App& session, const Invocation& invocation);
void add_session_list(CLI::App& session, const Invocation& invocation);
void add_session_export(CLI::App& session, const Invocation& invocation);

/// Where sessions of a study are: `option`, or the folder "sessions" beside the study file.
std::filesystem::path sessions_folder(const std::string& option, const std::filesystem::path& study);

/// A folder of sessions, given as itself or as the study's folder that has it.
std::filesystem::path existing_sessions_folder(const std::filesystem::path& given);

}  // namespace plenolab
