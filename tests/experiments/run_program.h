#pragma once

#include <string>
#include <vector>

namespace plenolab {

/// What a run of the program `plenolab` left behind.
struct ProgramResult {
  int status = -1;  ///< exit status, or −signal
  std::string out, err;
  double peak_mib = 0;  ///< largest resident set
};

/// Runs the program with these arguments and no standard input; kills it after a minute.
ProgramResult run_program(const std::vector<std::string>& arguments);

}  // namespace plenolab
