#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace plenolab {

/// Bad input: a file, an option or data from outside is not what it must be. The message is one sentence that
/// says what is wrong, which value, which file, and what to do; the program prints it and exits with 1.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Wrong use of the command line; the program prints the message and exits with 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {
/// Reports a broken internal invariant (a bug, never bad input) and throws std::logic_error.
[[noreturn]] void check_failed(const char* condition, const char* file, int line, const std::string& values);
}  // namespace detail

}  // namespace plenolab

/// Checks an internal invariant in every build type. `values` is text (or fmt::format(...)) with the
/// offending values.
#define PLENOLAB_CHECK(condition, values)                                                       \
  do {                                                                                          \
    if (!(condition)) ::plenolab::detail::check_failed(#condition, __FILE__, __LINE__, values); \
  } while (false)
