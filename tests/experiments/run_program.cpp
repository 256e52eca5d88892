#include "tests/experiments/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/error.h"

namespace plenolab {

namespace {

[[noreturn]] void become_program(char* const* argv, const char* out, const char* err,
                                 const std::function<void()>& prepare) {
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(::open(out, O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
  ::dup2(::open(err, O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
  ::alarm(60);
  if (prepare) prepare();
  ::execv(PLENOLAB_PROGRAM, argv);
  ::_exit(127);
}

}  // namespace

RunningProgram::RunningProgram(std::vector<std::string> arguments, const std::function<void()>& prepare) {
  const std::string out = folder_.path() / "out", err = folder_.path() / "err";
  std::vector<char*> argv{const_cast<char*>(PLENOLAB_PROGRAM)};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  child_ = ::fork();
  PLENOLAB_CHECK(child_ >= 0, "fork");
  if (child_ == 0) become_program(argv.data(), out.c_str(), err.c_str(), prepare);
}

RunningProgram::~RunningProgram() {
  if (child_ < 0) return;
  ::kill(child_, SIGKILL);
  ::waitpid(child_, nullptr, 0);
}

void RunningProgram::send(int signal) const {
  PLENOLAB_CHECK(::kill(child_, signal) == 0, "kill");
}

ProgramResult RunningProgram::wait() {
  int status = 0;
  rusage usage{};
  PLENOLAB_CHECK(::wait4(child_, &status, 0, &usage) == child_, "wait4");
  child_ = -1;
  ProgramResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  result.out = read_text_file(folder_.path() / "out");
  result.err = read_text_file(folder_.path() / "err");
  result.peak_mib = static_cast<double>(usage.ru_maxrss) / 1024;
  return result;
}

ProgramResult run_program(const std::vector<std::string>& arguments, const std::function<void()>& prepare) {
  return RunningProgram(arguments, prepare).wait();
}

}  // namespace plenolab
