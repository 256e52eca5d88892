#include "experiments/cli/stop_signals.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <thread>

#include "core/base/partial_output.h"

namespace plenolab {

namespace {

bool is_ignored(int number) {
  struct sigaction action {};
  return ::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Waits for one of the blocked signals in an ordinary thread, where everything may be done that a signal
/// handler may not.
void wait_and_stop(sigset_t signals) {
  int number = 0;
  if (::sigwait(&signals, &number) != 0) return;
  remove_partial_outputs();
  const char* erase_line = ::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "";  // that of a progress bar
  fmt::print(stderr, "{}plenolab: stopped ({}), nothing unfinished was left behind\n", erase_line,
             ::strsignal(number));
  std::fflush(stderr);
  ::signal(number, SIG_DFL);
  ::kill(::getpid(), number);
  ::pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
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

}  // namespace plenolab
