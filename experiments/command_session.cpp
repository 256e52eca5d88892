#include <CLI/CLI.hpp>

#include "experiments/session/commands.h"

namespace plenolab {

void add_session_command(CLI::App& app, const Invocation& invocation) {
  app.require_subcommand(1);
  add_session_new(app, invocation);
  add_session_run(app);
  add_session_resume(app);
  add_session_withdraw(app);
  add_session_simulate(app, invocation);
  add_session_list(app, invocation);
  add_session_export(app, invocation);
  app.footer(
      "Delayed matching to sample with two intervals: which of two images is equal to the reference?\n"
      "Examples: plenolab session new study\n"
      "          plenolab session run study --pilot --keyboard\n"
      "          plenolab session export study -o exported --mode pilot\n"
      "'plenolab session run --help' explains a command; experiments/session/README.md is the guide.");
}

}  // namespace plenolab
