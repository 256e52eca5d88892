#include "experiments/batch/measure.h"

#include <fmt/format.h>

#include <exception>
#include <functional>

#include "analysis/statistics.h"
#include "analysis/timing.h"
#include "core/base/error.h"
#include "experiments/tonemap_fit.h"
#include "metrics/consistency.h"

namespace plenolab {

namespace {

/// Runs one stage of an item; what it throws becomes the item's failure.
void guard(ItemResult& result, const std::function<void()>& stage) {
  const Stopwatch watch;
  try {
    stage();
  } catch (const std::bad_alloc&) {
    result = failed_result("out of memory");
  } catch (const std::exception& error) {
    result = failed_result(error.what());
  }
  result.seconds += watch.seconds();
}

void require_disparity(const OperatorChoice& choice, const OperatorView& view) {
  if (choice.variant.needs_disparity && !view.disparity)
    throw InputError(
        fmt::format("variant {} of {} needs disparity, which the image has not: its .exr needs a channel {}",
                    choice.variant.id, choice.info->id, kDisparityChannel));
}

std::vector<Measurement> measurements_of(const ResultTable& table) {
  std::vector<Measurement> measurements;
  for (const ResultRow& row : table.rows()) measurements.push_back({row.quantity, row.value, row.unit});
  return measurements;
}

std::vector<Measurement> mapping_values(const ToneMapped& mapped) {
  ResultTable table;
  table.add({"mean_luma", mean_luma(mapped.image), "luma", {}});
  add_count_rows(table, mapped.counts, {});
  return measurements_of(table);
}

std::vector<Measurement> timings_of(const std::vector<double>& fits, const std::vector<double>& maps) {
  std::vector<double> both;
  for (std::size_t i = 0; i < fits.size(); ++i) both.push_back(fits[i] + maps[i]);
  ResultTable table;
  add_timing_rows(table, summarise_times(both), {});
  table.add({"seconds_fit", median(fits), "s", {}});
  table.add({"seconds_map", median(maps), "s", {}});
  return measurements_of(table);
}

/// Fits and maps again and again; every time gives the same image.
void map_repeatedly(const OperatorChoice& choice, const FitScope& scope, int repeat, int threads,
                    MappedItem& item) {
  const int warm_up = repeat > 1 ? 1 : 0;
  std::vector<double> fits, maps;
  ToneMapped mapped;
  for (int run = -warm_up; run < repeat; ++run) {
    const Stopwatch fit_watch;
    const FittedOperator fitted = choice.info->fit(choice.variant.id, choice.values, scope);
    const double fit_s = fit_watch.seconds();
    const Stopwatch map_watch;
    mapped = fitted.apply(item.view, threads);
    if (run < 0) continue;
    fits.push_back(fit_s);
    maps.push_back(map_watch.seconds());
  }
  item.result.values = mapping_values(mapped);
  item.result.timings = timings_of(fits, maps);
  item.image = std::move(mapped.image);
}

ComparisonConditions conditions_for(const BatchPlan& plan, const BatchInput& input, int threads) {
  ComparisonConditions conditions;
  conditions.cd_m2_per_unit = input.cd_m2_per_unit.value_or(1);
  conditions.viewing = plan.study.viewing;
  conditions.threads = threads;
  return conditions;
}

}  // namespace

MappedItem map_item(const BatchPlan& plan, const BatchItem& item, const LoadedInput& input, int threads) {
  const OperatorChoice& choice = plan.operators[item.op].choice;
  MappedItem mapped;
  guard(mapped.result, [&] {
    if (!item.problem.empty()) throw InputError(item.problem);
    mapped.view = input.view(item.view);
    require_disparity(choice, mapped.view);
    mapped.result.width = mapped.view.colour->width();
    mapped.result.height = mapped.view.colour->height();
    map_repeatedly(choice, input.scope(choice.variant.scope, item.view, threads), plan.study.repeat, threads,
                   mapped);
  });
  return mapped;
}

void measure_item(const BatchPlan& plan, const BatchItem& item, MappedItem& mapped, int threads) {
  if (mapped.result.failed()) return;
  guard(mapped.result, [&] {
    const BatchInput& input = plan.inputs[item.input];
    const std::vector<Measurement> measured = measure(
        mapped.image, *mapped.view.colour, plan.metrics_for(input), conditions_for(plan, input, threads));
    mapped.result.values.insert(mapped.result.values.end(), measured.begin(), measured.end());
  });
}

ItemResult failed_result(const std::string& failure) {
  ItemResult result;
  result.failure = failure;
  return result;
}

}  // namespace plenolab
