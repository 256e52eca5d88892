#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "core/base/error.h"
#include "core/io/radiance_hdr.h"

// What is read is never NaN or negative: RGBE cannot say either.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const plenolab::SceneImage image =
        plenolab::parse_radiance_hdr(std::as_bytes(std::span(data, size)), "fuzz");
    for (const plenolab::Rgb& c : image.pixels())
      if (!(c.r >= 0 && c.g >= 0 && c.b >= 0)) std::abort();
  } catch (const plenolab::InputError&) {
  }
  return 0;
}
