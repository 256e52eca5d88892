#include "core/synthesis/synthesis_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <type_traits>
#include <utility>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/synthesis/synthesis_plan.h"

namespace plenolab {
namespace {

class Stopwatch {
 public:
  /// Seconds since the start or the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Hands work space for one patch to each worker and takes it back.
class WorkSpaces {
 public:
  std::unique_ptr<PatchViews> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique_for_overwrite<PatchViews>();
    auto space = std::move(free_.back());
    free_.pop_back();
    return space;
  }
  void give_back(std::unique_ptr<PatchViews> space) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(space));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<PatchViews>> free_;
};

struct PatchResult {
  SynthesisStatistics statistics;
  SynthesisTimings timings;
};

void add(SynthesisStatistics& sum, const SynthesisStatistics& part) {
  sum.searches += part.searches;
  sum.search_samples += part.search_samples;
  sum.refine_samples += part.refine_samples;
  sum.used += part.used;
  sum.out_of_frustum += part.out_of_frustum;
  sum.disoccluded += part.disoccluded;
  sum.occluded += part.occluded;
  sum.restored += part.restored;
  sum.weight_zero += part.weight_zero;
  sum.thin += part.thin;
}

template <class Referral>
class Run {
 public:
  Run(const SynthesisInput<Referral>& input, const SynthesisOptions& options)
      : input_(input), options_(options) {
    check_input();
    out_.position = input.position;
    out_.views = input.views;
    out_.d_max_px = input.d_max_px;
    for (const auto& prepared : input.prepared) out_.repaired_values += prepared->repaired_values;
  }

  NovelView<Referral> run() {
    Stopwatch watch;
    allocate();
    plan_.paths = make_paths();
    if (options_.prune && is_copy()) {
      copy_key_view();
    } else {
      complete_plan();
      work_on_patches();
      if (input_.exact) insert_exact_values();
    }
    for (unsigned char flag : out_.unseen.pixels()) out_.unseen_pixels += flag;
    for (unsigned char flag : out_.restored.pixels()) out_.restored_pixels += flag;
    out_.timings.total_s = watch.lap();
    return std::move(out_);
  }

 private:
  int width() const { return input_.grid.width; }
  int height() const { return input_.grid.height; }
  int count() const { return static_cast<int>(input_.views.size()); }

  void check_input() const {
    PLENOLAB_CHECK(count() >= 1 && count() <= kMaxViews && input_.views.size() == input_.prepared.size(),
                   fmt::format("{} views, {} prepared", count(), input_.prepared.size()));
    for (const auto& prepared : input_.prepared) {
      PLENOLAB_CHECK(prepared->width == width() && prepared->height == height(),
                     fmt::format("prepared view of {} × {}", prepared->width, prepared->height));
      PLENOLAB_CHECK(prepared->max_disparity <= input_.d_max_px,
                     fmt::format("d_max {} below {}", input_.d_max_px, prepared->max_disparity));
    }
  }

  void allocate() {
    out_.image = RgbImage<Referral>(width(), height());
    out_.visible_views = Plane<std::uint8_t>(width(), height());
    out_.unseen = Mask(width(), height());
    out_.restored = Mask(width(), height());
    if (options_.record_provenance) out_.provenance = Plane<PixelProvenance>(width(), height());
  }

  std::vector<EpipolarPath> make_paths() const {
    std::vector<EpipolarPath> paths;
    for (const UsedView& view : input_.views)
      paths.push_back(
          make_path(input_.grid, input_.position, view, static_cast<double>(input_.d_max_px), options_));
    return paths;
  }

  /// Whether every pixel's A is the same pixel of a single key view.
  bool is_copy() const {
    const EpipolarPath& path = plan_.paths.front();
    return count() == 1 && path.is_key_view() && path.sx == 0 && path.sy == 0;
  }

  void complete_plan() {
    Stopwatch watch;
    plan_ = make_plan(input_.views, input_.prepared, std::move(plan_.paths), input_.d_max_px, options_);
    plan_.blend.decode = std::is_same_v<Referral, SceneReferred>;
    out_.pruned = std::move(plan_.pruned);
    out_.timings.occupancy_s = watch.lap();
  }

  void copy_key_view() {
    const UsedView& view = input_.views.front();
    out_.pruned.push_back({"search, visibility tests and blending",
                           fmt::format("the position is that of key view ({}, {})", view.column, view.row)});
    insert_exact_values();
    std::fill_n(out_.visible_views.pixels().data(), out_.visible_views.size(), std::uint8_t{1});
    out_.statistics.searches = out_.statistics.used = out_.image.size();
    if (!options_.record_provenance) return;
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x) {
        const float disparity = input_.prepared.front()->disparity_row(y)[x];
        out_.provenance.at(x, y)[0] = {
            CorrespondenceState::kUsed,   false,     0, static_cast<float>(x) + 0.5f,
            static_cast<float>(y) + 0.5f, disparity, 1};
      }
  }

  /// On a key view no interpolation takes place: the radiance itself, not its encoded and decoded value. With
  /// a fixed screen this holds where pixels of the screen fall on pixel centres of the key view.
  void insert_exact_values() {
    const EpipolarPath& path = plan_.paths.front();
    const PathSample offset = path.samples.front();
    if (!path.is_key_view() || offset.fx != 0 || offset.fy != 0) return;
    const float largest = input_.prepared.front()->largest_finite;
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x) {
        const int i = x + offset.ox, j = y + offset.oy;
        if (i < 0 || i >= width() || j < 0 || j >= height()) continue;
        out_.image.at(x, y) = repaired_colour(input_.exact->colour.at(i, j), largest, Referral{});
      }
  }

  void work_on_patches() {
    const int across = (width() + Patch::kMaxWidth - 1) / Patch::kMaxWidth;
    const int down = (height() + TileOccupancy::kTileHeight - 1) / TileOccupancy::kTileHeight;
    std::vector<PatchResult> results(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    WorkSpaces spaces;
    parallel_for(across * down, 1, options_.threads, [&](int begin, int end) {
      auto space = spaces.take();
      for (int n = begin; n < end; ++n) {
        // Down the columns: the next patch reads most of the same rows of the key views.
        const int x = n / down * Patch::kMaxWidth, y = n % down * TileOccupancy::kTileHeight;
        const Patch patch{x, y, std::min(Patch::kMaxWidth, width() - x),
                          std::min(TileOccupancy::kTileHeight, height() - y)};
        results[static_cast<std::size_t>(n)] = work_on(patch, *space);
      }
      spaces.give_back(std::move(space));
    });
    for (const PatchResult& result : results) {
      add(out_.statistics, result.statistics);
      out_.timings.search_s += result.timings.search_s;
      out_.timings.lookup_s += result.timings.lookup_s;
      out_.timings.blend_s += result.timings.blend_s;
    }
  }

  PatchResult work_on(const Patch& patch, PatchViews& space) {
    PatchResult result;
    Stopwatch watch;
    SearchCounts counts;
    for (std::size_t v = 0; v < plan_.paths.size(); ++v) counts += search(v, patch, space.views[v].hits);
    result.timings.search_s = watch.lap();
    for (std::size_t v = 0; v < plan_.paths.size(); ++v)
      look_up_patch(*input_.prepared[v], patch, space.views[v]);
    const std::uint64_t thin = plan_.splats[0] ? keep_thin(patch, space) : 0;
    result.timings.lookup_s = watch.lap();
    result.statistics = blend_patch(plan_.blend, patch, space,
                                    {&out_.image, &out_.visible_views, &out_.unseen, &out_.restored});
    result.timings.blend_s = watch.lap();
    if (options_.record_provenance) record(patch, space);
    result.statistics.thin = thin;
    result.statistics.searches = static_cast<std::uint64_t>(patch.width) *
                                 static_cast<std::uint64_t>(patch.height) *
                                 static_cast<std::uint64_t>(count());
    result.statistics.search_samples = counts.samples;
    result.statistics.refine_samples = counts.refine;
    return result;
  }

  std::uint64_t keep_thin(const Patch& patch, PatchViews& space) const {
    const std::uint64_t kept = keep_edge_pixels(plan_.blend, plan_.splats, patch, space);
    if (kept == 0) return 0;
    for (std::size_t v = 0; v < plan_.paths.size(); ++v)
      look_up_patch(*input_.prepared[v], patch, space.views[v]);
    return kept;
  }

  std::span<const std::uint64_t> candidates(std::size_t v, int x, int y) const {
    if (plan_.occupancies[v].bits.empty()) return {};
    return plan_.occupancies[v].tile_of_pixel(x, y);
  }

  SearchCounts search(std::size_t v, const Patch& patch, PatchHits& hits) {
    const PreparedView& prepared = *input_.prepared[v];
    SearchCounts counts;
    const bool count_probes = options_.record_provenance && options_.count_probes;
    if (options_.search == SearchKind::kFast && !count_probes)
      return search_patch(prepared, plan_.paths[v], plan_.occupancies[v], patch, hits);
    for (int y = patch.y; y < patch.y + patch.height; ++y)
      for (int x = patch.x; x < patch.x + patch.width; ++x) {
        SearchCounts pixel;
        const Hit hit = search_pixel(prepared, plan_.paths[v], candidates(v, x, y), x, y, pixel);
        hits.set((y - patch.y) * Patch::kMaxWidth + x - patch.x, hit);
        counts += pixel;
        if (count_probes)
          out_.provenance.at(x, y)[v].probes =
              static_cast<std::uint16_t>(std::min<std::uint64_t>(pixel.samples + pixel.refine, 65535));
      }
    return counts;
  }

  void record(const Patch& patch, const PatchViews& space) {
    for (int y = 0; y < patch.height; ++y)
      for (int x = 0; x < patch.width; ++x)
        for (std::size_t v = 0; v < plan_.paths.size(); ++v) {
          const PatchView& view = space.views[v];
          const int n = y * Patch::kMaxWidth + x;
          Correspondence& c = out_.provenance.at(patch.x + x, patch.y + y)[v];
          c.state = static_cast<CorrespondenceState>(view.state[n]);
          if (c.state == CorrespondenceState::kOutOfFrustum) continue;
          c.thin = plan_.splats[v] && view.thin[n] != 0;
          c.x = static_cast<float>(view.hits.i[n]) + view.hits.fx[n] + 0.5f;
          c.y = static_cast<float>(view.hits.j[n]) + view.hits.fy[n] + 0.5f;
          c.disparity_px = view.colour_disparity[4 * n + 3];
          c.weight = view.share[n];
        }
  }

  const SynthesisInput<Referral>& input_;
  const SynthesisOptions& options_;
  NovelView<Referral> out_;
  SynthesisPlan plan_;
};

}  // namespace

template <class Referral>
NovelView<Referral> run_synthesis(const SynthesisInput<Referral>& input, const SynthesisOptions& options) {
  return Run<Referral>(input, options).run();
}

template NovelView<SceneReferred> run_synthesis(const SynthesisInput<SceneReferred>&,
                                                const SynthesisOptions&);
template NovelView<DisplayReferred> run_synthesis(const SynthesisInput<DisplayReferred>&,
                                                  const SynthesisOptions&);

}  // namespace plenolab
