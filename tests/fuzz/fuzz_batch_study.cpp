#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "experiments/batch/study.h"

// What is accepted has something to do, all of it within bounds.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const plenolab::BatchStudy study =
        plenolab::parse_batch_study({reinterpret_cast<const char*>(data), size}, "fuzz");
    study.viewing.validate();
    if (study.inputs.empty() || study.operators.empty() || study.metrics.empty() || study.repeat < 1)
      std::abort();
  } catch (const plenolab::InputError&) {
    return 0;
  }
  return 0;
}
