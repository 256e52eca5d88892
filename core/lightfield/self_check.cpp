#include "core/lightfield/self_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/lightfield/self_check_verdict.h"

namespace plenolab {
namespace {

// A view and its neighbour to the right or below.
struct Pair {
  int column = 0, row = 0;
  bool vertical = false;
};

std::vector<Pair> choose_pairs(const ViewGrid& grid, int max_per_axis) {
  std::vector<Pair> pairs;
  for (const bool vertical : {false, true}) {
    const int columns = grid.columns - (vertical ? 0 : 1), rows = grid.rows - (vertical ? 1 : 0);
    const int all = columns * rows, count = std::min(all, max_per_axis);
    for (int i = 0; i < count; ++i) {
      const int index = static_cast<int>((2 * std::int64_t{i} + 1) * all / (2 * count));
      pairs.push_back({index % columns, index / columns, vertical});
    }
  }
  return pairs;
}

template <class Referral>
std::vector<PairErrors> compare_pairs(const BasicLightField<Referral>& light_field,
                                      const std::vector<Pair>& pairs, const SelfCheckOptions& options,
                                      const Progress& progress) {
  const ViewGrid& grid = light_field.grid();
  std::vector<PairErrors> errors(pairs.size());
  std::mutex progress_mutex;
  std::size_t done = 0;
  parallel_for(static_cast<int>(pairs.size()), 1, options.threads, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Pair& pair = pairs[static_cast<std::size_t>(i)];
      const auto p = light_field.view(pair.column, pair.row);
      const auto q =
          light_field.view(pair.column + (pair.vertical ? 0 : 1), pair.row + (pair.vertical ? 1 : 0));
      errors[static_cast<std::size_t>(i)] =
          compare_neighbours(*p, *q, pair.vertical, grid.vertical_ratio(), options.max_samples);
      const std::lock_guard lock(progress_mutex);
      ++done;
      if (progress) progress(static_cast<double>(done) / static_cast<double>(pairs.size()));
    }
  });
  return errors;
}

template <class Referral>
SelfCheckResult check_any(const BasicLightField<Referral>& light_field, const SelfCheckOptions& options,
                          const Progress& progress) {
  options.validate();
  const std::vector<Pair> pairs = choose_pairs(light_field.grid(), options.max_pairs_per_axis);
  AxisErrors x, y;
  for (const PairErrors& pair : compare_pairs(light_field, pairs, options, progress))
    if (pair.usable) (pair.vertical ? y : x).add(pair);
  return judge(x, y);
}

}  // namespace

void SelfCheckOptions::validate() const {
  if (max_pairs_per_axis < 1)
    throw InputError(
        fmt::format("the self-check needs at least one pair an axis, not {}", max_pairs_per_axis));
  if (max_samples < kMinSamples)
    throw InputError(
        fmt::format("the self-check needs at least {} samples, not {}", kMinSamples, max_samples));
  resolve_threads(threads);
}

SelfCheckResult self_check(const LightField& light_field, const SelfCheckOptions& options,
                           const Progress& progress) {
  return check_any(light_field, options, progress);
}

SelfCheckResult self_check(const DisplayLightField& light_field, const SelfCheckOptions& options,
                           const Progress& progress) {
  return check_any(light_field, options, progress);
}

}  // namespace plenolab
