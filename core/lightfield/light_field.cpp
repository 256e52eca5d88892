#include "core/lightfield/light_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/error.h"

namespace plenolab {

template <class Referral>
struct BasicLightField<Referral>::State {
  using View = std::shared_ptr<const KeyView<Referral>>;

  struct Slot {
    View view;             ///< null while not in memory
    bool loading = false;  ///< a thread is loading it; the others wait
    std::uint64_t last_use = 0;
  };

  ViewGrid grid;
  RadianceUnit unit = RadianceUnit::kRelative;
  std::string name;
  ViewLoader<Referral> load;
  std::size_t kept_views = 1;  ///< how many views the memory bound allows, at least one

  std::mutex mutex;
  std::condition_variable loaded;
  std::vector<Slot> slots;
  std::uint64_t clock = 0;
  std::optional<float> max_disparity;

  std::string view_name(int column, int row) const {
    return fmt::format("view (column {}, row {}) of {}", column, row, name);
  }

  View load_checked(int column, int row) const {
    KeyView<Referral> view = load(column, row);
    const auto fits = [&](const auto& plane) {
      return plane.width() == grid.width && plane.height() == grid.height;
    };
    if (!fits(view.colour) || !fits(view.disparity))
      throw InputError(
          fmt::format("{} has {} × {} pixels and a disparity map of {} × {}, but the grid says {} × {}",
                      view_name(column, row), view.colour.width(), view.colour.height(),
                      view.disparity.width(), view.disparity.height(), grid.width, grid.height));
    return std::make_shared<const KeyView<Referral>>(std::move(view));
  }

  void drop_oldest() {
    const auto in_memory =
        std::count_if(slots.begin(), slots.end(), [](const Slot& s) { return s.view != nullptr; });
    if (static_cast<std::size_t>(in_memory) <= kept_views) return;
    const auto oldest = std::min_element(slots.begin(), slots.end(), [](const Slot& a, const Slot& b) {
      return std::pair(a.view == nullptr, a.last_use) < std::pair(b.view == nullptr, b.last_use);
    });
    oldest->view = nullptr;
  }

  View get(int column, int row) {
    Slot& slot = slots[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                       static_cast<std::size_t>(column)];
    std::unique_lock lock(mutex);
    loaded.wait(lock, [&] { return !slot.loading; });
    slot.last_use = ++clock;
    if (slot.view) return slot.view;
    slot.loading = true;
    lock.unlock();
    View view;
    try {
      view = load_checked(column, row);
    } catch (...) {
      lock.lock();
      slot.loading = false;
      loaded.notify_all();
      throw;
    }
    lock.lock();
    slot.loading = false;
    slot.view = view;
    drop_oldest();
    loaded.notify_all();
    return view;
  }
};

namespace {
template <class Referral>
std::size_t view_bytes(const ViewGrid& grid) {
  return static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height) *
         (sizeof(Rgb) + sizeof(float));
}
}  // namespace

template <class Referral>
BasicLightField<Referral>::BasicLightField(ViewGrid grid, RadianceUnit unit, std::string name,
                                           ViewLoader<Referral> load, std::size_t memory_bound_bytes)
    : state_(std::make_shared<State>()) {
  grid.validate();
  state_->grid = grid;
  state_->unit = unit;
  state_->name = std::move(name);
  state_->load = std::move(load);
  state_->kept_views = std::max<std::size_t>(1, memory_bound_bytes / view_bytes<Referral>(grid));
  state_->slots.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
}

template <class Referral>
BasicLightField<Referral> BasicLightField<Referral>::from_views(ViewGrid grid, RadianceUnit unit,
                                                                std::string name,
                                                                std::vector<KeyView<Referral>> views) {
  grid.validate();
  const std::size_t expected = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  if (views.size() != expected)
    throw InputError(fmt::format("{} has {} views, but its grid of {} × {} needs {}", name, views.size(),
                                 grid.columns, grid.rows, expected));
  BasicLightField light_field(
      grid, unit, std::move(name), [](int, int) -> KeyView<Referral> { return {}; }, 0);
  State& state = *light_field.state_;
  state.kept_views = expected;
  state.load = [&state, source = std::make_shared<std::vector<KeyView<Referral>>>(std::move(views))](int c,
                                                                                                     int r) {
    return std::move((*source)[static_cast<std::size_t>(r) * static_cast<std::size_t>(state.grid.columns) +
                               static_cast<std::size_t>(c)]);
  };
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) light_field.view(column, row);
  state.load = nullptr;
  return light_field;
}

template <class Referral>
const ViewGrid& BasicLightField<Referral>::grid() const {
  return state_->grid;
}

template <class Referral>
RadianceUnit BasicLightField<Referral>::unit() const {
  return state_->unit;
}

template <class Referral>
const std::string& BasicLightField<Referral>::name() const {
  return state_->name;
}

template <class Referral>
std::shared_ptr<const KeyView<Referral>> BasicLightField<Referral>::view(int column, int row) const {
  PLENOLAB_CHECK(column >= 0 && row >= 0 && column < state_->grid.columns && row < state_->grid.rows,
                 fmt::format("view ({}, {}) of a grid of {} × {}", column, row, state_->grid.columns,
                             state_->grid.rows));
  return state_->get(column, row);
}

template <class Referral>
float BasicLightField<Referral>::max_disparity_px() const {
  {
    const std::lock_guard lock(state_->mutex);
    if (state_->max_disparity) return *state_->max_disparity;
  }
  float largest = 0;
  for (int row = 0; row < state_->grid.rows; ++row)
    for (int column = 0; column < state_->grid.columns; ++column) {
      const auto key_view = view(column, row);
      const auto pixels = key_view->disparity.pixels();
      largest = std::max(largest, *std::max_element(pixels.begin(), pixels.end()));
    }
  const std::lock_guard lock(state_->mutex);
  state_->max_disparity = largest;
  return largest;
}

template class BasicLightField<SceneReferred>;
template class BasicLightField<DisplayReferred>;

}  // namespace plenolab
