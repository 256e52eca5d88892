#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/luminance/display_folder.h"

// What is accepted survives being written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plenolab::DisplayDescription description;
  try {
    description = plenolab::parse_display_description({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const plenolab::InputError&) {
    return 0;
  }
  const auto again =
      plenolab::parse_display_description(plenolab::format_display_description(description), "again");
  if (again.images != description.images || again.display.projectors != description.display.projectors ||
      again.display.space.width_m != description.display.space.width_m)
    std::abort();
  return 0;
}
