#include "experiments/cli/usage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "core/base/error.h"
#include "experiments/cli/suggest.h"

namespace plenolab {

namespace {

bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-';
}

/// "--option=value" without its value.
std::string option_name(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// A command as it was typed: of a command with subcommands, the chosen one.
struct ChosenCommand {
  const CLI::App* app = nullptr;
  std::string name;  ///< e.g. "analyse table"
};

ChosenCommand chosen_command(const CLI::App& program) {
  ChosenCommand chosen{&program, ""};
  for (auto next = program.get_subcommands(); !next.empty(); next = chosen.app->get_subcommands())
    chosen = {next.front(), chosen.name + (chosen.name.empty() ? "" : " ") + next.front()->get_name()};
  return chosen;
}

std::vector<std::string> subcommand_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(subcommand->get_name());
  return names;
}

/// What the command was given but does not know; empty if it knows everything.
std::string explain_unknown(const ChosenCommand& chosen) {
  const std::vector<std::string> unknown = chosen.app->remaining();
  const auto option = std::find_if(unknown.begin(), unknown.end(), is_option);
  if (option != unknown.end())
    return fmt::format("'plenolab {}' has no option {}{}", chosen.name, option_name(*option),
                       did_you_mean(option_name(*option), option_names(*chosen.app)));
  const std::vector<std::string> subcommands = subcommand_names(*chosen.app);
  if (!subcommands.empty())
    return unknown.empty()
               ? fmt::format("'plenolab {}': give one of {}", chosen.name, fmt::join(subcommands, ", "))
               : fmt::format("'plenolab {}' has no '{}'{}", chosen.name, unknown.front(),
                             did_you_mean(unknown.front(), subcommands));
  if (!unknown.empty())
    return fmt::format("'plenolab {}' does not take a further argument '{}'", chosen.name, unknown.front());
  return "";
}

/// CLI11's words, but where they are unclear.
std::string explain_known(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string option = text.substr(0, text.find(':'));
  if (error.get_name() != "ArgumentMismatch") return text;
  if (text.ends_with("missing")) return option + " needs a value";
  return text.find("At Most 1 ") == std::string::npos ? text : option + " can be given only once";
}

}  // namespace

void require_known_command(const Invocation& invocation, std::span<const Command> known) {
  std::vector<std::string> names;
  for (const Command& command : known) names.push_back(command.name);
  if (invocation.arguments.size() < 2)
    throw UsageError(fmt::format("give a command: {} (see 'plenolab --help')", fmt::join(names, ", ")));
  const std::string& first = invocation.arguments[1];
  std::vector<std::string> own_options{"--help", "-h", "--version"};
  const std::vector<std::string>& allowed = is_option(first) ? own_options : names;
  if (std::find(allowed.begin(), allowed.end(), first) == allowed.end())
    throw UsageError(fmt::format("there is no {} '{}'{} (see 'plenolab --help')",
                                 is_option(first) ? "option" : "command", first,
                                 did_you_mean(first, allowed)));
}

std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  const ChosenCommand chosen = chosen_command(program);
  if (chosen.app == &program) return error.what();
  std::string sentence = explain_unknown(chosen);
  if (sentence.empty()) sentence = explain_known(error);
  return fmt::format("{} (see 'plenolab {} --help')", sentence, chosen.name);
}

}  // namespace plenolab
