#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/lightfield/description.h"

// What is accepted survives being written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plenolab::LightFieldDescription description;
  try {
    description = plenolab::parse_description({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const plenolab::InputError&) {
    return 0;
  }
  const auto again = plenolab::parse_description(plenolab::format_description(description), "again");
  if (!(again.grid == description.grid) || again.view_pattern != description.view_pattern) std::abort();
  return 0;
}
