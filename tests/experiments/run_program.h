#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "core/base/file.h"

namespace plenolab {

/// What a run of the program `plenolab` left behind.
struct ProgramResult {
  int status = -1;  ///< exit status, or −signal
  std::string out, err;
  double peak_mib = 0;  ///< largest resident set
};

/// A run of the program with these arguments and no standard input; killed after a minute. `prepare` is
/// called in the new process before the program begins, e.g. to set limits; it must not allocate.
class RunningProgram {
 public:
  explicit RunningProgram(std::vector<std::string> arguments, const std::function<void()>& prepare = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  ProgramResult wait();

 private:
  TemporaryFolder folder_;
  pid_t child_ = -1;
};

/// Starts the program and waits for its end.
ProgramResult run_program(const std::vector<std::string>& arguments,
                          const std::function<void()>& prepare = {});

}  // namespace plenolab
