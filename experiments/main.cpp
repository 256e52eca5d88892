#include <fmt/format.h>
#include <glog/logging.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <functional>
#include <new>

#include "core/base/error.h"
#include "experiments/cli/standard_streams.h"
#include "experiments/cli/stop_signals.h"
#include "experiments/cli/usage.h"
#include "experiments/commands.h"

namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

void run(int argc, char** argv) {
  const plenolab::Invocation invocation{{argv, argv + argc}};
  require_known_command(invocation, plenolab::commands());
  CLI::App app{"plenolab: a laboratory for HDR light fields", "plenolab"};
  app.require_subcommand(1);
  app.set_version_flag("--version", PLENOLAB_VERSION);
  app.footer("'plenolab COMMAND --help' explains a command and gives an example.");
  for (const plenolab::Command& command : plenolab::commands()) {
    CLI::App* subcommand = app.add_subcommand(command.name, command.summary);
    command.add(*subcommand, invocation);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    throw plenolab::UsageError(plenolab::explain(app, error));
  }
}

/// Runs `action` and says on stderr what went wrong.
int status_of(const std::function<void()>& action) {
  const auto failed = [](const std::string& message, int status) {
    fmt::print(stderr, "plenolab: {}\n", message);
    return status;
  };
  try {
    action();
    return kDone;
  } catch (const plenolab::UsageError& error) {
    return failed(error.what(), kWrongUse);
  } catch (const std::bad_alloc&) {
    return failed("out of memory: use a smaller image, fewer views or a lower memory bound", kFailed);
  } catch (const std::exception& error) {
    return failed(error.what(), kFailed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  plenolab::reserve_standard_streams();
  plenolab::clean_up_on_stop_signals();
  FLAGS_minloglevel = google::GLOG_ERROR;  // what Ceres remarks on a line search is no message to users
  ::signal(SIGXFSZ, SIG_IGN);              // a limit on file sizes is then an error like a full disk
  return status_of([&] { plenolab::print_whole([&] { run(argc, argv); }); });
}
