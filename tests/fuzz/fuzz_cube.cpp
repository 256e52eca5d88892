#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/lut/cube_file.h"

// What is accepted is a valid table that survives being written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plenolab;
  try {
    const Lut lut = parse_cube({reinterpret_cast<const char*>(data), size}, "fuzz");
    lut.validate();
    if (parse_cube(cube_text(lut), "fuzz").nodes != lut.nodes) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
