#pragma once

#include <span>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace plenolab {

/// The command line as typed, for provenance.
struct Invocation {
  std::vector<std::string> arguments;
};

/// One subcommand: `add` declares its options on `app` and what runs when it is chosen.
struct Command {
  const char* name;
  const char* summary;
  void (*add)(CLI::App& app, const Invocation& invocation);
};

/// All subcommands in the order of --help. Adding one = one file command_NAME.cpp + one line in commands.cpp.
std::span<const Command> commands();

}  // namespace plenolab
