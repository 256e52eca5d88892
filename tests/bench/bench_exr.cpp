// Reading one 960 × 540 key view (half radiance, float disparity) from the page cache, beside a plain read of
// the same file's bytes: the ratio says what decoding costs over the disk's limit.
#include <benchmark/benchmark.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "core/base/file.h"
#include "core/base/random.h"
#include "core/io/bytes.h"
#include "core/io/exr.h"

namespace plenolab {
namespace {

constexpr int kWidth = 960, kHeight = 540;

// Smooth gradients with noise in the last bits, as rendered radiance has.
void write_view(const std::filesystem::path& path, ExrCompression compression) {
  SceneImage image(kWidth, kHeight);
  Plane<float> disparity(kWidth, kHeight);
  RandomStream random(1, 1, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float level = (1.0f + static_cast<float>(x) / 100) * (1 + 0.02f * random.next_float());
      image.at(x, y) = {level, level * 0.7f, level * 0.4f};
      disparity.at(x, y) = 3.0f + static_cast<float>(y) / 100;
    }
  ExrWriteOptions options;
  options.compression = compression;
  write_exr(path, image, {{"disparity", &disparity}}, options);
}

double seconds_of_plain_read(const std::filesystem::path& path, std::uint64_t size) {
  constexpr int kRuns = 20;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kRuns; ++i) benchmark::DoNotOptimize(read_bytes(path, size));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kRuns;
}

void read_view(benchmark::State& state, ExrCompression compression) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "view.exr";
  write_view(path, compression);
  const std::uint64_t size = std::filesystem::file_size(path);
  const double plain_s = seconds_of_plain_read(path, size);
  double seconds = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(read_exr_channels(path, {"R", "G", "B", "disparity"}));
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  const double mean_s = seconds / static_cast<double>(state.iterations());
  state.counters["file_MB"] = static_cast<double>(size) / 1e6;
  state.counters["file_MB_per_s"] = static_cast<double>(size) / 1e6 / mean_s;
  state.counters["over_plain_read"] = mean_s / plain_s;
}

BENCHMARK_CAPTURE(read_view, uncompressed, ExrCompression::kNone)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_view, zip, ExrCompression::kZip)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_view, piz, ExrCompression::kPiz)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plenolab
