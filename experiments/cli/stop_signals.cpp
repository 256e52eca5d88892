#include "experiments/cli/stop_signals.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

#include "core/base/partial_output.h"

namespace plenolab {

namespace {

/// Signals are the process's, and so is this: what its signal thread shares with the others.
struct StopState {
  std::mutex mutex;
  std::string kept = "nothing unfinished was left behind";
  bool asks_first = false;  // a StopRequest exists
  int requested = 0;        // the signal that it was told
};

StopState& state() {
  static StopState* const state = new StopState;  // never gone: the signal thread outlives main
  return *state;
}

bool is_ignored(int number) {
  struct sigaction action {};
  return ::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Whether a StopRequest takes the signal.
bool taken_as_request(int number) {
  const std::lock_guard lock(state().mutex);
  if (!state().asks_first || state().requested != 0) return false;
  state().requested = number;
  return true;
}

/// Ends the process as the signal would have.
void end_by(int number) {
  ::signal(number, SIG_DFL);
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, number);
  ::raise(number);  // to this thread: another one waits for those of the process
  ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

/// Waits for one of the blocked signals in an ordinary thread, where everything may be done that a signal
/// handler may not.
void wait_and_stop(sigset_t signals) {
  int number = 0;
  do {
    if (::sigwait(&signals, &number) != 0) return;
  } while (taken_as_request(number));
  remove_partial_outputs();
  const char* erase_line = ::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "";  // that of a progress bar
  {
    const std::lock_guard lock(state().mutex);
    fmt::print(stderr, "{}plenolab: stopped ({}), {}\n", erase_line, ::strsignal(number), state().kept);
  }
  std::fflush(stderr);
  end_by(number);
}

}  // namespace

void clean_up_on_stop_signals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (!is_ignored(number)) ::sigaddset(&signals, number);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(wait_and_stop, signals).detach();
}

void say_on_stop(std::string what_is_kept) {
  const std::lock_guard lock(state().mutex);
  state().kept = std::move(what_is_kept);
}

StopRequest::StopRequest() {
  const std::lock_guard lock(state().mutex);
  state().asks_first = true;
  state().requested = 0;
}

StopRequest::~StopRequest() {
  const std::lock_guard lock(state().mutex);
  state().asks_first = false;
}

bool StopRequest::requested() const {
  const std::lock_guard lock(state().mutex);
  return state().requested != 0;
}

void StopRequest::end_if_requested() const {
  if (!requested()) return;
  std::fflush(stdout);
  end_by(state().requested);
}

}  // namespace plenolab
