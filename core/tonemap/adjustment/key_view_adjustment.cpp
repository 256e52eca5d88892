#include "core/tonemap/adjustment/key_view_adjustment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/tonemap/adjustment/accumulate_luma.h"
#include "core/tonemap/adjustment/adjustment_view.h"
#include "core/tonemap/filters/gaussian.h"

namespace plenolab {
namespace {

/// Rows that one task accumulates.
constexpr int kBandRows = 32;

void require_within(double value, double min, double max, const char* what) {
  if (!(value >= min && value <= max))
    throw InputError(
        fmt::format("the key-view adjustment's {} must be between {} and {}, not {}", what, min, max, value));
}

/// Views [begin, end) in row-major order, as they are adjusted at one time.
struct Batch {
  int begin = 0, end = 0;
  std::vector<AdjustmentView> views;
  std::vector<LumaSums> sums;
  int size() const { return end - begin; }
};

class Adjustment {
 public:
  Adjustment(const LightField& hdr, const DisplayLightField& tone_mapped,
             const KeyViewAdjustmentOptions& options, const KeyViewAdjustmentRun& run)
      : hdr_(hdr),
        tone_mapped_(tone_mapped),
        options_(options),
        run_(run),
        views_(hdr.grid().columns * hdr.grid().rows),
        floor_(smallest_luminance(hdr, run.threads)),
        exponents_{static_cast<float>(gaussian_exponent(options.sigma_d_px)),
                   static_cast<float>(gaussian_exponent(options.sigma_log_luminance))} {}

  KeyViewAdjustmentCounts adjust(const AdjustedViewSink& sink) {
    const int at_once = views_at_once();
    for (int begin = 0; begin < views_; begin += at_once) {
      Batch batch = start(begin, std::min(views_, begin + at_once));
      for (int source = 0; source < views_; ++source) {
        if (within_support(batch, source)) add_source(batch, source);
        report(begin + 0.5 * batch.size() * (source + 1) / views_);
      }
      for (int i = 0; i < batch.size(); ++i) {
        finish(batch, i, sink);
        report(begin + 0.5 * (batch.size() + i + 1));
      }
    }
    return counts_;
  }

 private:
  int column(int view) const { return view % hdr_.grid().columns; }
  int row(int view) const { return view / hdr_.grid().columns; }

  double distance(int a, int b) const { return std::hypot(column(a) - column(b), row(a) - row(b)); }
  bool takes_from(int target, int source) const { return distance(target, source) <= options_.support_views; }

  int views_at_once() const {
    const double pixels = static_cast<double>(hdr_.grid().width) * hdr_.grid().height;
    constexpr double kFloats = 5;  // three planes of a view, two of sums
    const double fit = static_cast<double>(run_.memory_bound_bytes) / (pixels * kFloats * sizeof(float));
    return static_cast<int>(std::clamp<double>(fit, 1, views_));
  }

  Batch start(int begin, int end) {
    Batch batch{begin, end, {}, {}};
    for (int view = begin; view < end; ++view) {
      batch.views.push_back(
          read_adjustment_view(hdr_, tone_mapped_, column(view), row(view), floor_, run_.threads, counts_));
      const int width = batch.views.back().luma.width(), height = batch.views.back().luma.height();
      batch.sums.push_back({Plane<float>(width, height), Plane<float>(width, height)});
    }
    return batch;
  }

  bool within_support(const Batch& batch, int source) const {
    for (int target = batch.begin; target < batch.end; ++target)
      if (takes_from(target, source)) return true;
    return false;
  }

  void add_source(Batch& batch, int source) {
    if (source >= batch.begin && source < batch.end)
      return add_source(batch, source, batch.views[static_cast<std::size_t>(source - batch.begin)]);
    KeyViewAdjustmentCounts counted_when_adjusted;
    add_source(batch, source,
               read_adjustment_view(hdr_, tone_mapped_, column(source), row(source), floor_, run_.threads,
                                    counted_when_adjusted));
  }

  /// Every pixel adds up its sources in the order of the views, whatever the batch and the threads.
  void add_source(Batch& batch, int source, const AdjustmentView& view) {
    const int height = hdr_.grid().height, bands = (height + kBandRows - 1) / kBandRows;
    std::vector<std::int64_t> found(static_cast<std::size_t>(batch.size() * bands), 0);
    parallel_for(batch.size() * bands, 1, run_.threads, [&](int begin, int end) {
      for (int task = begin; task < end; ++task) {
        const int target = batch.begin + task / bands, first = task % bands * kBandRows;
        if (!takes_from(target, source)) continue;
        for (int y = first; y < std::min(height, first + kBandRows); ++y)
          found[static_cast<std::size_t>(task)] += add_row(batch, target, source, view, y);
      }
    });
    for (std::size_t task = 0; task < found.size(); ++task)
      if (batch.begin + static_cast<int>(task) / bands != source) counts_.correspondences += found[task];
  }

  std::int64_t add_row(Batch& batch, int target, int source, const AdjustmentView& view, int y) const {
    const std::size_t i = static_cast<std::size_t>(target - batch.begin);
    const double views_apart = distance(target, source);
    const LumaSource from{
        view, step_between(hdr_.grid(), column(target), row(target), column(source), row(source)),
        static_cast<float>(gaussian_exponent(options_.sigma_views) * views_apart * views_apart)};
    return accumulate_row(batch.views[i], from, exponents_, y, batch.sums[i]);
  }

  void finish(Batch& batch, int i, const AdjustedViewSink& sink) {
    const std::size_t n = static_cast<std::size_t>(i);
    const AdjustmentView& view = batch.views[n];
    Plane<float> factors(view.luma.width(), view.luma.height(), 1.0f);
    for (std::size_t p = 0; p < factors.size(); ++p) {
      const float luma = view.luma.pixels()[p];
      const float difference = batch.sums[n].difference.pixels()[p] / batch.sums[n].weight.pixels()[p];
      if (luma >= kDarkestLuma)
        factors.pixels()[p] = (luma + difference) / luma;
      else
        ++counts_.kept_dark;
    }
    const Plane<float> smooth = smooth_factors(factors, view, options_, false, run_.threads);
    const int index = batch.begin + i;
    sink(column(index), row(index),
         apply_factors(tone_mapped_.view(column(index), row(index))->colour, smooth, counts_));
  }

  void report(double views_done) const {
    if (run_.progress) run_.progress(views_done / views_);
  }

  const LightField& hdr_;
  const DisplayLightField& tone_mapped_;
  const KeyViewAdjustmentOptions& options_;
  const KeyViewAdjustmentRun& run_;
  int views_;
  float floor_;
  LumaExponents exponents_;
  KeyViewAdjustmentCounts counts_;
};

}  // namespace

void KeyViewAdjustmentOptions::validate() const {
  require_within(sigma_views, 1e-3, 1e3, "sigma in key views");
  require_within(support_views, 0, 1e9, "support in key views");
  require_within(sigma_d_px, 1e-6, 1e6, "sigma of the disparity");
  require_within(sigma_log_luminance, 1e-6, 1e6, "sigma of the log luminance");
  require_within(smoothing_share, 1e-6, 10, "share of the view's side for smoothing");
  require_within(smoothing_sigma_d_px, 1e-6, 1e6, "smoothing sigma of the disparity");
  require_within(smoothing_sigma_log_luminance, 1e-6, 1e6, "smoothing sigma of the log luminance");
}

KeyViewAdjustmentCounts adjust_key_views(const LightField& hdr, const DisplayLightField& tone_mapped,
                                         const KeyViewAdjustmentOptions& options,
                                         const AdjustedViewSink& sink, const KeyViewAdjustmentRun& run) {
  options.validate();
  require_same_grid(hdr, tone_mapped);
  return Adjustment(hdr, tone_mapped, options, run).adjust(sink);
}

}  // namespace plenolab
