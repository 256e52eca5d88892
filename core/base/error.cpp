#include "core/base/error.h"

#include <fmt/format.h>

namespace plenolab::detail {

void check_failed(const char* condition, const char* file, int line, const std::string& values) {
  throw std::logic_error(
      fmt::format("internal check failed: {} ({}) at {}:{}", condition, values, file, line));
}

}  // namespace plenolab::detail
