#include "core/synthesis/synthesizer.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <list>
#include <mutex>

#include "core/base/error.h"
#include "core/synthesis/epipolar_path.h"
#include "core/synthesis/key_views.h"
#include "core/synthesis/synthesis_run.h"

namespace plenolab {
namespace {

float checked_d_max(float d_max, const std::string& name) {
  if (!(d_max >= 0) || d_max > static_cast<float>(kMaxDisparity_px))
    throw InputError(
        fmt::format("the largest disparity of the light field {} is {} px, it must be between 0 and {} px: "
                    "repair its disparity maps",
                    name, d_max, kMaxDisparity_px));
  return d_max;
}

}  // namespace

template <class Referral>
struct BasicSynthesizer<Referral>::State {
  struct Entry {
    int column, row;
    std::shared_ptr<const PreparedView> view;
  };

  State(BasicLightField<Referral> f, std::size_t bound) : field(std::move(f)), memory_bound(bound) {}

  std::shared_ptr<const PreparedView> find(int column, int row) {
    const std::lock_guard lock(mutex);
    for (auto entry = entries.begin(); entry != entries.end(); ++entry)
      if (entry->column == column && entry->row == row) {
        entries.splice(entries.begin(), entries, entry);
        return entry->view;
      }
    return nullptr;
  }

  /// Keeps a view unless another thread has prepared the same one in the meantime.
  void keep(int column, int row, std::shared_ptr<const PreparedView> view) {
    const std::lock_guard lock(mutex);
    const auto same = [&](const Entry& entry) { return entry.column == column && entry.row == row; };
    if (std::any_of(entries.begin(), entries.end(), same)) return;
    bytes += view->memory_bytes();
    entries.push_front({column, row, std::move(view)});
    while (bytes > memory_bound && entries.size() > kMaxViews) {
      bytes -= entries.back().view->memory_bytes();
      entries.pop_back();
    }
  }

  std::shared_ptr<const PreparedView> prepared(const UsedView& view, int threads) {
    if (auto found = find(view.column, view.row)) return found;
    auto made =
        std::make_shared<const PreparedView>(prepare_view(*field.view(view.column, view.row), threads));
    keep(view.column, view.row, made);
    return made;
  }

  BasicLightField<Referral> field;
  std::size_t memory_bound;
  std::mutex mutex;
  std::list<Entry> entries;  ///< most recently used first
  std::size_t bytes = 0;
};

template <class Referral>
BasicSynthesizer<Referral>::BasicSynthesizer(BasicLightField<Referral> field, std::size_t memory_bound_bytes)
    : state_(std::make_shared<State>(std::move(field), memory_bound_bytes)) {}

template <class Referral>
NovelView<Referral> BasicSynthesizer<Referral>::synthesize(CameraPosition position,
                                                           const SynthesisOptions& options) const {
  options.validate();
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  SynthesisInput<Referral> input;
  input.grid = state_->field.grid();
  input.position = position;
  input.views = select_key_views(input.grid, position, options.key_views);
  input.d_max_px = checked_d_max(state_->field.max_disparity_px(), state_->field.name());
  for (const UsedView& view : input.views) input.prepared.push_back(state_->prepared(view, options.threads));
  const UsedView& nearest = input.views.front();
  if (nearest.b_x == 0 && nearest.b_y == 0) input.exact = state_->field.view(nearest.column, nearest.row);
  const double prepare_s = seconds();
  NovelView<Referral> view = run_synthesis(input, options);
  view.timings.prepare_s = prepare_s;
  view.timings.total_s = seconds();
  return view;
}

template <class Referral>
void BasicSynthesizer<Referral>::synthesize_sequence(
    std::span<const CameraPosition> positions, const SynthesisOptions& options,
    const std::function<void(std::size_t, NovelView<Referral>&&)>& receive) const {
  for (std::size_t n = 0; n < positions.size(); ++n) receive(n, synthesize(positions[n], options));
}

template <class Referral>
const BasicLightField<Referral>& BasicSynthesizer<Referral>::field() const {
  return state_->field;
}

template <class Referral>
std::size_t BasicSynthesizer<Referral>::prepared_bytes() const {
  const std::lock_guard lock(state_->mutex);
  return state_->bytes;
}

template class BasicSynthesizer<SceneReferred>;
template class BasicSynthesizer<DisplayReferred>;

std::vector<CameraPosition> straight_path(CameraPosition from, CameraPosition to, int count) {
  if (count < 1) throw InputError(fmt::format("a path needs 1 position or more, not {}", count));
  std::vector<CameraPosition> positions;
  for (int n = 0; n < count; ++n) {
    const double share = count == 1 ? 0 : static_cast<double>(n) / (count - 1);
    positions.push_back({from.s + (to.s - from.s) * share, from.t + (to.t - from.t) * share});
  }
  return positions;
}

}  // namespace plenolab
