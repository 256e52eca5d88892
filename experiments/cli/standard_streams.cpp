#include "experiments/cli/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>
#include <system_error>

#include "core/base/error.h"

namespace plenolab {

namespace {
[[noreturn]] void lost(const std::string& reason) {
  throw InputError(fmt::format("cannot write to standard output: {}", reason));
}
}  // namespace

void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", O_RDONLY);  // takes the lowest free number, which is this one
}

void print_whole(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::system_error& error) {  // fmt says only "cannot write to file"
    if (std::ferror(stdout) == 0) throw;
    lost(error.code().message());
  }
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::ferror(stdout) == 0 && std::cout.good()) return;
  // The first failure may be long past; one more byte fails for the same reason, if that still holds.
  lost(::write(STDOUT_FILENO, "\n", 1) < 0 ? std::strerror(errno) : "some of it was lost");
}

}  // namespace plenolab
