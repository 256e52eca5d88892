#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plenolab {

/// What a program left behind.
struct ProcessResult {
  int exit_code = 0;   ///< 128 + signal if a signal ended it
  std::string output;  ///< standard output and error together
};

/// Runs a program (found on PATH) with its arguments in `folder` and waits for it. No shell is involved:
/// arguments are passed as they are. Standard input is empty. Throws InputError if the program is not there
/// or cannot be started.
ProcessResult run_process(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

}  // namespace plenolab
