#include <cstdint>
#include <span>
#include <string>

#include "core/base/error.h"
#include "core/io/exr.h"

// Any bytes give an image or an InputError, for every channel the header names.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  const plenolab::ExrLimits limits{.max_pixels = 1 << 20};
  try {
    for (const plenolab::ExrPartInfo& part : plenolab::parse_exr_header(bytes, "fuzz", limits))
      for (const plenolab::ExrChannelInfo& channel : part.channels)
        plenolab::parse_exr_channels(bytes, "fuzz", {channel.name}, limits);
  } catch (const plenolab::InputError&) {
  }
  return 0;
}
