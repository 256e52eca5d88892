#include "experiments/cli/checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/io/bytes.h"
#include "experiments/cli/suggest.h"

namespace plenolab {

namespace {

/// The whole text as a number; nothing if it is none or does not fit.
template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A check that takes what `accepts` does and asks for `wanted` otherwise. `help` stands behind the option in
/// --help.
template <class Accepts>
CLI::Validator check(const std::string& wanted, const std::string& help, const Accepts& accepts) {
  CLI::Validator validator(help);
  validator.operation([wanted, accepts](std::string& text) {
    return accepts(text) ? std::string() : fmt::format("give {}, not '{}'", wanted, text);
  });
  return validator;
}

}  // namespace

CLI::Validator number_between(double low, double high) {
  return check(fmt::format("a number from {} to {}", low, high), fmt::format("{} to {}", low, high),
               [=](const std::string& text) {
                 const auto value = parse<double>(text);
                 return value && *value >= low && *value <= high;
               });
}

CLI::Validator positive_number() {
  return check("a number above 0", "above 0", [](const std::string& text) {
    const auto value = parse<double>(text);
    return value && *value > 0 && std::isfinite(*value);
  });
}

CLI::Validator positive_or_infinite() {
  return check("a number above 0, or inf", "above 0, or inf", [](const std::string& text) {
    const auto value = parse<double>(text);
    return value && *value > 0;
  });
}

CLI::Validator whole_number(long long low, long long high) {
  return check(fmt::format("a whole number from {} to {}", low, high), fmt::format("{} to {}", low, high),
               [=](const std::string& text) {
                 const auto value = parse<long long>(text);
                 return value && *value >= low && *value <= high;
               });
}

CLI::Validator seed_number() {
  return check("a whole number of 0 or more that fits 64 bits", "0 or more",
               [](const std::string& text) { return parse<std::uint64_t>(text).has_value(); });
}

CLI::Validator multiple_of(int step, int high) {
  return check(fmt::format("a multiple of {} from {} to {}", step, step, high),
               fmt::format("{} to {}", step, high), [=](const std::string& text) {
                 const auto value = parse<int>(text);
                 return value && *value >= step && *value <= high && *value % step == 0;
               });
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  CLI::Validator validator(fmt::format("{}", fmt::join(words, "|")));
  validator.operation([words](std::string& text) {
    if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
    return fmt::format("give {}, not '{}'{}", fmt::join(words, " or "), text, did_you_mean(text, words));
  });
  return validator;
}

CLI::Validator file_ending_in(const std::vector<std::string>& extensions) {
  const std::string list = fmt::format("{}", fmt::join(extensions, " or "));
  return check("a file name that ends in " + list, list, [extensions](const std::string& text) {
    return std::find(extensions.begin(), extensions.end(), lower_extension(text)) != extensions.end();
  });
}

CLI::Validator not_empty() {
  return check("a name", "", [](const std::string& text) { return !text.empty(); });
}

}  // namespace plenolab
