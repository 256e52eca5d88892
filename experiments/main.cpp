#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "core/base/error.h"
#include "experiments/commands.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUse = 2;

void say(const std::string& message) {
  fmt::print(stderr, "plenolab: {}\n", message);
}

int run(int argc, char** argv) {
  plenolab::Invocation invocation{{argv, argv + argc}};
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
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    say(fmt::format("{} (see 'plenolab {}--help')", error.what(),
                    app.get_subcommands().empty() ? "" : app.get_subcommands().front()->get_name() + " "));
    return kWrongUse;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const plenolab::UsageError& error) {
    say(error.what());
    return kWrongUse;
  } catch (const std::bad_alloc&) {
    say("out of memory: use a smaller image, fewer views or a lower memory bound");
  } catch (const std::exception& error) {
    say(error.what());
  }
  return kFailed;
}
