// View synthesis: linear against fast search, novel views a second with their stages, and how far from the
// machine's limits. Labels and counters carry the units; run with --benchmark_repetitions=5 for medians.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "core/base/random.h"
#include "core/synthesis/key_views.h"
#include "core/synthesis/search.h"
#include "core/synthesis/synthesizer.h"

namespace plenolab {
namespace {

constexpr int kWidth = 960, kHeight = 540;
constexpr CameraPosition kPosition{0.43, 0.58};

ViewGrid bench_grid() {
  ViewGrid grid;
  grid.columns = grid.rows = 2;
  grid.spacing_x_m = grid.spacing_y_m = 0.1;
  grid.width = kWidth;
  grid.height = kHeight;
  return grid;
}

/// Ground that rises towards the camera, and discs in front of it, largest disparity `d_max`.
float scene_disparity(double u, double v, double d_max) {
  double disparity = d_max * (0.05 + 0.4 * std::max(0.0, v / kHeight - 0.4));
  for (std::uint64_t n = 0; n < 40; ++n) {
    const double x = kWidth * unit_double(random_u64(1, 2, n)),
                 y = kHeight * unit_double(random_u64(1, 3, n));
    const double radius = 10 + 40 * unit_double(random_u64(1, 4, n));
    const double front = d_max * (0.3 + 0.7 * unit_double(random_u64(1, 5, n)));
    if (std::hypot(u - x, v - y) < radius) disparity = std::max(disparity, front);
  }
  return static_cast<float>(disparity);
}

const LightField& bench_field(int d_max) {
  static std::vector<std::pair<int, LightField>> fields;
  for (const auto& [key, field] : fields)
    if (key == d_max) return field;
  std::vector<KeyView<SceneReferred>> views(4);
  for (std::size_t n = 0; n < views.size(); ++n) {
    views[n] = {SceneImage(kWidth, kHeight), DisparityMap(kWidth, kHeight)};
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double shift_x = 0.4 * d_max * static_cast<double>(n % 2),
                     shift_y = 0.4 * d_max * static_cast<double>(n / 2);
        views[n].disparity.at(x, y) = scene_disparity(x + shift_x, y + shift_y, d_max);
        const auto index = static_cast<std::uint64_t>(y * kWidth + x);
        views[n].colour.at(x, y) = {unit_float(random_u64(9, n, 3 * index)),
                                    unit_float(random_u64(9, n, 3 * index + 1)),
                                    unit_float(random_u64(9, n, 3 * index + 2))};
      }
  }
  fields.emplace_back(
      d_max, LightField::from_views(bench_grid(), RadianceUnit::kRelative, "bench", std::move(views)));
  return fields.back().second;
}

/// Rule 1 for all pixels of all four key views, one thread; the fast search includes building the occupancy.
void BM_Search(benchmark::State& state, SearchKind kind) {
  const LightField& field = bench_field(static_cast<int>(state.range(0)));
  std::vector<PreparedView> views;
  std::vector<EpipolarPath> paths;
  for (const UsedView& used : select_key_views(field.grid(), kPosition)) {
    views.push_back(prepare_view(*field.view(used.column, used.row), 1));
    paths.push_back(
        make_path(field.grid(), kPosition, used, static_cast<double>(field.max_disparity_px()), {}));
  }
  auto hits = std::make_unique<PatchHits>();
  SearchCounts counts;
  for (auto _ : state)
    for (std::size_t v = 0; v < views.size(); ++v) {
      TileOccupancy occupancy;
      if (kind == SearchKind::kFast) occupancy = build_occupancy(views[v], paths[v], 1);
      for (int y = 0; y < kHeight; y += TileOccupancy::kTileHeight)
        for (int x = 0; x < kWidth; x += Patch::kMaxWidth) {
          const Patch patch{x, y, std::min(Patch::kMaxWidth, kWidth - x),
                            std::min(TileOccupancy::kTileHeight, kHeight - y)};
          if (kind == SearchKind::kFast) {
            counts += search_patch(views[v], paths[v], occupancy, patch, *hits);
            continue;
          }
          for (int j = 0; j < patch.height; ++j)
            for (int i = 0; i < patch.width; ++i)
              hits->set(j * Patch::kMaxWidth + i, search_pixel(views[v], paths[v], {}, x + i, y + j, counts));
        }
      benchmark::DoNotOptimize(hits->i);
    }
  const double searches = 4.0 * kWidth * kHeight * static_cast<double>(state.iterations());
  state.counters["samples_per_search"] = static_cast<double>(counts.samples) / searches;
  state.counters["searches_per_s"] = benchmark::Counter(searches, benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(BM_Search, linear, SearchKind::kLinear)
    ->Arg(10)
    ->Arg(35)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Search, fast, SearchKind::kFast)
    ->Arg(10)
    ->Arg(35)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);

/// A 960 × 540 view from four prepared key views. Arguments: d_max in px, threads.
void BM_NovelView(benchmark::State& state) {
  const Synthesizer synthesizer(bench_field(static_cast<int>(state.range(0))));
  SynthesisOptions options;
  options.threads = static_cast<int>(state.range(1));
  synthesizer.synthesize(kPosition, options);
  SynthesisTimings sum;
  for (auto _ : state) {
    const auto view = synthesizer.synthesize(kPosition, options);
    sum.occupancy_s += view.timings.occupancy_s;
    sum.search_s += view.timings.search_s;
    sum.lookup_s += view.timings.lookup_s;
    sum.blend_s += view.timings.blend_s;
  }
  const auto per_view_ms = [&](double seconds) {
    return 1e3 * seconds / static_cast<double>(state.iterations());
  };
  state.counters["occupancy_ms"] = per_view_ms(sum.occupancy_s);
  state.counters["search_thread_ms"] = per_view_ms(sum.search_s);
  state.counters["lookup_thread_ms"] = per_view_ms(sum.lookup_s);
  state.counters["blend_thread_ms"] = per_view_ms(sum.blend_s);
  state.counters["views_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(BM_NovelView)->ArgsProduct({{10, 35, 100}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);

/// Preparing one key view (encoding, padding, block ranges).
void BM_Prepare(benchmark::State& state) {
  const LightField& field = bench_field(35);
  for (auto _ : state) benchmark::DoNotOptimize(prepare_view(*field.view(0, 0), 1));
}
BENCHMARK(BM_Prepare)->Unit(benchmark::kMillisecond);

/// The machine's limits: copying as many bytes as one novel view must at least read and write (four prepared
/// views once, the image once), and fetching four 16-byte corners for every pixel of every key view.
void BM_LimitCopy(benchmark::State& state) {
  constexpr std::size_t kBytes = static_cast<std::size_t>(kWidth) * kHeight * (4 * 20 + 12) / 2;
  std::vector<char> from(kBytes, 1), to(kBytes);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), kBytes);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  state.counters["GB_per_s"] =
      benchmark::Counter(2e-9 * static_cast<double>(kBytes) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}
BENCHMARK(BM_LimitCopy)->Unit(benchmark::kMillisecond);

void BM_LimitGather(benchmark::State& state) {
  const std::vector<ColourDisparity> pixels(static_cast<std::size_t>(kWidth) * (kHeight + 2));
  for (auto _ : state)
    for (int view = 0; view < 4; ++view) {
      float sum = 0;
      for (std::size_t n = 0; n < static_cast<std::size_t>(kWidth) * kHeight; ++n) {
        const ColourDisparity* corner = pixels.data() + n;
        sum += corner[0].r + corner[1].g + corner[kWidth].b + corner[kWidth + 1].disparity;
      }
      benchmark::DoNotOptimize(sum);
    }
}
BENCHMARK(BM_LimitGather)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plenolab
