#include "core/synthesis/synthesis_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <type_traits>
#include <utility>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/synthesis/epipolar_path.h"
#include "core/synthesis/patch_blend.h"
#include "core/synthesis/search.h"
#include "core/synthesis/thin_structures.h"

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
    make_paths();
    if (options_.prune && is_copy()) {
      copy_key_view();
    } else {
      set_up_blend();
      build_occupancies();
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

  void make_paths() {
    for (const UsedView& view : input_.views)
      paths_.push_back(
          make_path(input_.grid, input_.position, view, static_cast<double>(input_.d_max_px), options_));
  }

  /// Whether every pixel's A is the same pixel of a single key view.
  bool is_copy() const {
    const EpipolarPath& path = paths_.front();
    return count() == 1 && path.is_key_view() && path.sx == 0 && path.sy == 0;
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
    const EpipolarPath& path = paths_.front();
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

  void prune(const char* stage, const std::string& reason) { out_.pruned.push_back({stage, reason}); }

  void set_up_blend() {
    setup_.count = count();
    setup_.options = options_;
    setup_.decode = std::is_same_v<Referral, SceneReferred>;
    setup_.record = options_.record_provenance;
    float nearest = 0, farthest = input_.d_max_px, quad_range = 0;
    for (std::size_t v = 0; v < input_.views.size(); ++v) {
      setup_.prepared[v] = input_.prepared[v].get();
      setup_.used[v] = input_.views[v];
      nearest = std::max(nearest, input_.prepared[v]->max_disparity);
      farthest = std::min(farthest, input_.prepared[v]->min_disparity);
      quad_range = std::max(quad_range, input_.prepared[v]->max_quad_range);
    }
    if (!options_.prune) return;
    if (quad_range <= static_cast<float>(options_.disocclusion_px)) {
      setup_.test_disocclusion = false;
      prune("disocclusion test and restoration",
            fmt::format("neighbouring pixels differ by at most {} px of disparity, rule 2 allows {}",
                        quad_range, options_.disocclusion_px));
    }
    if (count() == 1) {
      setup_.test_occlusion = false;
      prune("occlusion test", "a single key view takes part");
    } else if (nearest <= farthest + static_cast<float>(options_.occlusion_margin_px)) {
      setup_.test_occlusion = false;
      prune("occlusion test", fmt::format("disparities lie in [{}, {}] px, which is within δ_occ = {} px",
                                          farthest, nearest, options_.occlusion_margin_px));
    }
  }

  void build_occupancies() {
    Stopwatch watch;
    for (std::size_t v = 0; v < paths_.size(); ++v) {
      const EpipolarPath& path = paths_[v];
      const bool below_step = path.d_max < path.step || path.is_key_view();
      if (options_.prune && below_step) {
        prune("first pass of the search",
              path.is_key_view()
                  ? std::string("the position is that of the key view")
                  : fmt::format("in key view ({}, {}) the largest disparity of {} px is below one step "
                                "of {} px",
                                input_.views[v].column, input_.views[v].row, path.d_max, path.step));
        occupancies_[v] = last_sample_only(path);
      } else if (options_.search == SearchKind::kFast) {
        occupancies_[v] = build_occupancy(*input_.prepared[v], path, options_.threads);
      }
      if (options_.keep_thin && setup_.test_disocclusion)
        splats_[v] = std::make_unique<ThinSplats>(
            splat_edge_pixels(*input_.prepared[v], path, options_.disocclusion_px));
    }
    out_.timings.occupancy_s = watch.lap();
  }

  void work_on_patches() {
    const int across = (width() + Patch::kMaxWidth - 1) / Patch::kMaxWidth;
    const int down = (height() + TileOccupancy::kTileHeight - 1) / TileOccupancy::kTileHeight;
    std::vector<PatchResult> results(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    WorkSpaces spaces;
    parallel_for(across * down, 1, options_.threads, [&](int begin, int end) {
      auto space = spaces.take();
      for (int n = begin; n < end; ++n) {
        const int x = n % across * Patch::kMaxWidth, y = n / across * TileOccupancy::kTileHeight;
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
    for (std::size_t v = 0; v < paths_.size(); ++v) counts += search(v, patch, space.views[v].hits);
    result.timings.search_s = watch.lap();
    for (std::size_t v = 0; v < paths_.size(); ++v) look_up_patch(*input_.prepared[v], patch, space.views[v]);
    const std::uint64_t thin = splats_[0] ? keep_thin(patch, space) : 0;
    result.timings.lookup_s = watch.lap();
    result.statistics =
        blend_patch(setup_, patch, space, {&out_.image, &out_.visible_views, &out_.unseen, &out_.restored});
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
    const std::uint64_t kept = keep_edge_pixels(setup_, splats_, patch, space);
    if (kept == 0) return 0;
    for (std::size_t v = 0; v < paths_.size(); ++v) look_up_patch(*input_.prepared[v], patch, space.views[v]);
    return kept;
  }

  std::span<const std::uint64_t> candidates(std::size_t v, int x, int y) const {
    if (occupancies_[v].bits.empty()) return {};
    return occupancies_[v].tile_of_pixel(x, y);
  }

  SearchCounts search(std::size_t v, const Patch& patch, PatchHits& hits) {
    const PreparedView& prepared = *input_.prepared[v];
    SearchCounts counts;
    if (options_.search == SearchKind::kFast && !options_.record_provenance)
      return search_patch(prepared, paths_[v], occupancies_[v], patch, hits);
    for (int y = patch.y; y < patch.y + patch.height; ++y)
      for (int x = patch.x; x < patch.x + patch.width; ++x) {
        SearchCounts pixel;
        const Hit hit = search_pixel(prepared, paths_[v], candidates(v, x, y), x, y, pixel);
        hits.set((y - patch.y) * Patch::kMaxWidth + x - patch.x, hit);
        counts += pixel;
        if (options_.record_provenance)
          out_.provenance.at(x, y)[v].probes =
              static_cast<std::uint16_t>(std::min<std::uint64_t>(pixel.samples + pixel.refine, 65535));
      }
    return counts;
  }

  void record(const Patch& patch, const PatchViews& space) {
    for (int y = 0; y < patch.height; ++y)
      for (int x = 0; x < patch.width; ++x)
        for (std::size_t v = 0; v < paths_.size(); ++v) {
          const PatchView& view = space.views[v];
          const int n = y * Patch::kMaxWidth + x;
          Correspondence& c = out_.provenance.at(patch.x + x, patch.y + y)[v];
          c.state = static_cast<CorrespondenceState>(view.state[n]);
          if (c.state == CorrespondenceState::kOutOfFrustum) continue;
          c.thin = splats_[v] && view.thin[n] != 0;
          c.x = static_cast<float>(view.hits.i[n]) + view.hits.fx[n] + 0.5f;
          c.y = static_cast<float>(view.hits.j[n]) + view.hits.fy[n] + 0.5f;
          c.disparity_px = view.colour_disparity[4 * n + 3];
          c.weight = view.share[n];
        }
  }

  const SynthesisInput<Referral>& input_;
  const SynthesisOptions& options_;
  NovelView<Referral> out_;
  std::vector<EpipolarPath> paths_;
  std::array<TileOccupancy, kMaxViews> occupancies_;
  std::array<std::unique_ptr<ThinSplats>, kMaxViews> splats_;
  BlendSetup setup_;
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
