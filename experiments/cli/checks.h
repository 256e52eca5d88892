#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace plenolab {

/// Checks of option values for CLI::Option::check. What they refuse is wrong use: the program names the
/// option as it was typed, says what it takes and what was given instead, and exits with 2.
/// E.g. "--step: give a number from 0.25 to 4, not '0'".

/// A finite number in [low, high].
CLI::Validator number_between(double low, double high);
/// A finite number > 0.
CLI::Validator positive_number();
/// A number > 0, or "inf".
CLI::Validator positive_or_infinite();
/// A whole number in [low, high].
CLI::Validator whole_number(long long low, long long high);
/// A whole number ≥ 0 that fits 64 bits.
CLI::Validator seed_number();
/// A whole number in [step, high] that `step` divides.
CLI::Validator multiple_of(int step, int high);
/// One of the words.
CLI::Validator one_of(const std::vector<std::string>& words);
/// A file name that ends in one of the extensions (with dots), in upper or lower case.
CLI::Validator file_ending_in(const std::vector<std::string>& extensions);
/// Any text that is not empty.
CLI::Validator not_empty();

}  // namespace plenolab
