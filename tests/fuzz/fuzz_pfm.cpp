#include <cstdint>
#include <span>

#include "core/base/error.h"
#include "core/io/pfm.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    plenolab::parse_pfm(std::as_bytes(std::span(data, size)), "fuzz");
  } catch (const plenolab::InputError&) {
  }
  return 0;
}
