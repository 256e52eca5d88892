#include "analysis/memory.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <sstream>
#include <string>

namespace plenolab {
namespace {

/// A "Key:  123 kB" line of /proc/self/status in MiB.
std::optional<double> status_mib(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    std::istringstream fields(line.substr(key.size() + 1));
    double kib = 0;
    if (fields >> kib) return kib / 1024;
  }
  return std::nullopt;
}

/// The process' peak before its last reset, which the kernel forgets. A fact about the process, as VmHWM is.
std::atomic<double> peak_before_reset_mib = 0;

/// Sets the kernel's peak to the present resident set; false where the system does not allow it.
bool reset_peak() {
  peak_before_reset_mib = peak_resident_mib().value_or(0);
  // "5" resets the peak resident set (proc(5), /proc/pid/clear_refs).
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace

std::optional<double> peak_resident_mib() {
  const std::optional<double> since_reset = status_mib("VmHWM");
  if (!since_reset) return std::nullopt;
  return std::max(*since_reset, peak_before_reset_mib.load());
}

std::optional<double> peak_memory_mib(const std::function<void()>& work) {
  // Freed memory that the allocator keeps would be taken again without the resident set growing.
  malloc_trim(0);
  const bool peak_known = reset_peak();
  const std::optional<double> before = status_mib("VmRSS");
  work();
  const std::optional<double> peak = status_mib("VmHWM");
  if (!peak_known || !before || !peak) return std::nullopt;
  return std::max(0.0, *peak - *before);
}

}  // namespace plenolab
