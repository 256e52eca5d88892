#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/base/error.h"
#include "experiments/session/plan.h"
#include "experiments/session/study.h"

// What is accepted can be planned, and survives being written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plenolab::StudyDefinition study;
  try {
    study = plenolab::parse_study({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const plenolab::InputError&) {
    return 0;
  }
  plenolab::plan_session(study, 1);
  if (!(plenolab::parse_study(plenolab::format_study(study), "again") == study)) std::abort();
  return 0;
}
