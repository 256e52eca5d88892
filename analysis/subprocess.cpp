#include "analysis/subprocess.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/base/file.h"

extern char** environ;  // POSIX: declared by no header

namespace plenolab {
namespace {

/// What a child starts with: empty input, both outputs into one file, its own folder, and no signal blocked,
/// so that it ends when the user stops the program.
class ChildSetup {
 public:
  ChildSetup(const std::filesystem::path& log, const std::filesystem::path& folder) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions_, 1, 2);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK);
  }
  ~ChildSetup() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }
  ChildSetup(const ChildSetup&) = delete;
  ChildSetup& operator=(const ChildSetup&) = delete;
  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR)
      throw InputError(fmt::format("cannot wait for a started program: {}", std::strerror(errno)));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  PLENOLAB_CHECK(!arguments.empty(), "no program to run");
  const TemporaryFolder scratch;
  const std::filesystem::path log = scratch.path() / "output.txt";
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const ChildSetup setup(log, folder);
  pid_t child = 0;
  const int error = posix_spawnp(&child, argv[0], setup.actions(), setup.attributes(), argv.data(), environ);
  if (error != 0) {
    throw InputError(fmt::format("cannot start {}: {}; install it or add its folder to PATH", arguments[0],
                                 std::strerror(error)));
  }
  const int exit_code = wait_for(child);
  return {exit_code, read_text_file(log)};
}

}  // namespace plenolab
