#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/lightfield/hci.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto parameters =
        plenolab::parse_hci_parameters({reinterpret_cast<const char*>(data), size}, "fuzz");
    if (!std::isfinite(parameters.focus_disparity_px())) std::abort();
  } catch (const plenolab::InputError&) {
  }
  return 0;
}
