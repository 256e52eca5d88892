#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "core/lut/cube_file.h"

// What is accepted is a valid table that survives being written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plenolab;
  try {
    const CubeContent content = parse_cube_content({reinterpret_cast<const char*>(data), size}, "fuzz");
    // Curves become a small lattice: their number of nodes is up to the caller.
    const Lut lut = lut_of_content(content, content.curves ? 3 : 0);
    lut.validate();
    if (parse_cube(cube_text(lut), "fuzz").nodes != lut.nodes) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
