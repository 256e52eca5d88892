#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/tonemap/operators/entries.h"

namespace plenolab {

namespace {

template <class Item>
const Item& find_item(const std::vector<Item>& items, std::string_view id, std::string_view what) {
  std::vector<std::string> ids;
  for (const Item& item : items) {
    if (item.id == id) return item;
    ids.push_back(item.id);
  }
  throw InputError(fmt::format("there is no {} \"{}\"; choose one of {}", what, id, fmt::join(ids, ", ")));
}

}  // namespace

const std::vector<OperatorInfo>& tone_mapping_operators() {
  static const std::vector<OperatorInfo> table{
      bilateral_entry(),
      histogram_entry(),
      reinhard_devlin_entry(),
      reinhard_global_entry(),
      robust_adaptive_entry(),
      generic_entry(),
      pq_entry(),
      content_adaptive_entry(),
  };
  return table;
}

const OperatorInfo& find_operator(std::string_view id) {
  return find_item(tone_mapping_operators(), id, "tone mapping operator");
}

const OperatorVariant& find_variant(const OperatorInfo& info, std::string_view id) {
  return find_item(info.variants, id, fmt::format("variant of operator {}", info.id));
}

FitScope scope_of_image(const OperatorView& image, int threads, std::optional<double> cd_m2_per_unit) {
  const ViewStatistics statistics = measure_view(*image.colour, threads);
  FitScope scope;
  scope.load = [&image](int) { return image; };
  scope.floor = log_floor(statistics);
  scope.statistics = evaluate(statistics, scope.floor);
  scope.threads = threads;
  scope.scale = {cd_m2_per_unit, scope.statistics.log_robust_average};
  return scope;
}

ToneMapped tone_map(const OperatorInfo& info, std::string_view variant, const SettingValues& values,
                    const OperatorView& image, int threads) {
  if (find_variant(info, variant).scope == OperatorScope::kFrame)
    throw InputError(fmt::format(
        "variant {} of operator {} maps frames of a video; a single image needs another", variant, info.id));
  return info.fit(variant, values, scope_of_image(image, threads)).apply(image, threads);
}

}  // namespace plenolab
