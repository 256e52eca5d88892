#include "analysis/memory.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <vector>

namespace plenolab {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

/// Takes, fills and frees memory in blocks; returns a byte of it.
char touch(std::size_t bytes, std::size_t block_bytes) {
  std::vector<std::unique_ptr<char[]>> blocks;
  for (std::size_t i = 0; i < bytes / block_bytes; ++i) {
    blocks.push_back(std::make_unique_for_overwrite<char[]>(block_bytes));
    std::memset(blocks.back().get(), 1, block_bytes);
  }
  return blocks.back()[block_bytes / 2];
}

TEST(PeakMemory, SeesWhatTheWorkTouchesThoughItFreesIt) {
  volatile char sink = 0;
  const auto peak = peak_memory_mib([&] { sink = touch(64 * kMiB, 64 * kMiB); });
  if (!peak) GTEST_SKIP() << "the system does not reset the peak";
  EXPECT_GT(*peak, 60);
  EXPECT_LT(*peak, 80);
}

TEST(PeakMemory, ChargesMemoryThatTheAllocatorKeptFromEarlierWork) {
  volatile char sink = touch(48 * kMiB, 32 * 1024);
  for (int run = 0; run < 2; ++run) {
    const auto peak = peak_memory_mib([&] { sink = touch(48 * kMiB, 32 * 1024); });
    if (!peak) GTEST_SKIP() << "the system does not reset the peak";
    EXPECT_GT(*peak, 44) << run;
  }
}

TEST(PeakMemory, ForgetsEarlierPeaks) {
  volatile char sink = touch(64 * kMiB, 64 * kMiB);
  const auto peak = peak_memory_mib([&] { sink = touch(kMiB, kMiB); });
  if (!peak) GTEST_SKIP() << "the system does not reset the peak";
  EXPECT_LT(*peak, 16);
  EXPECT_GT(peak_resident_mib().value_or(0), 64) << "the peak of the process is forgotten";
}

}  // namespace
}  // namespace plenolab
