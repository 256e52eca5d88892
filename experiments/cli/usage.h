#pragma once

#include <span>
#include <string>

#include "experiments/commands.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace plenolab {

/// Throws UsageError unless the first argument is a command or an option of the program itself; the message
/// names the word and the nearest command.
void require_known_command(const Invocation& invocation, std::span<const Command> known);

/// What was wrong with the arguments of a command, in one sentence: an option or word it does not know (with
/// the nearest one it does) before anything that is missing, since one may be the other misspelt.
std::string explain(const CLI::App& program, const CLI::ParseError& error);

}  // namespace plenolab
