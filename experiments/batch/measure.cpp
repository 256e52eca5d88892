#include "experiments/batch/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>

#include "analysis/statistics.h"
#include "analysis/timing.h"
#include "core/base/error.h"
#include "experiments/tonemap_field.h"
#include "experiments/tonemap_fit.h"
#include "metrics/consistency.h"

namespace plenolab {

namespace {

/// What a stage throws, as a text; empty if all went well.
std::string failure_of(const std::function<void()>& stage) {
  try {
    stage();
    return "";
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();
  }
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

std::vector<Measurement> mapping_values(const ToneMapped& mapped, const TimedFit& fit) {
  ResultTable table;
  table.add({"mean_luma", mean_luma(mapped.image), "luma", {}});
  add_count_rows(table, mapped.counts, {});
  if (fit.adjusted) add_adjustment_rows(table, fit.adjusted->counts, {});
  return measurements_of(table);
}

std::vector<Measurement> timings_of(const TimedFit& fit, const std::vector<double>& maps,
                                    double statistics_s) {
  std::vector<double> both;
  for (std::size_t i = 0; i < maps.size(); ++i) both.push_back(fit.seconds[i] + maps[i]);
  ResultTable table;
  add_timing_rows(table, summarise_times(both), {});
  table.add({"seconds_fit", median(fit.seconds), "s", {}});
  table.add({"seconds_map", median(maps), "s", {}});
  table.add({"seconds_statistics", statistics_s, "s", {}});
  table.add({"fit_views", static_cast<double>(fit.views), "views", {}});
  return measurements_of(table);
}

/// Seconds of each run but the first, or of the only one.
std::vector<double> seconds_of(int repeat, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int run = repeat > 1 ? -1 : 0; run < repeat; ++run) {
    const Stopwatch watch;
    work();
    if (run >= 0) seconds.push_back(watch.seconds());
  }
  return seconds;
}

TimedFit timed_fit(const BatchPlan& plan, const BatchItem& item, const LoadedInput& input, int repeat,
                   int threads) {
  const OperatorChoice& choice = plan.operators[item.op].choice;
  const FitScope scope = input.scope(choice.variant.scope, item.view, threads);
  TimedFit fit{.views = scope.views};
  fit.seconds =
      seconds_of(repeat, [&] { fit.fitted = choice.info->fit(choice.variant.id, choice.values, scope); });
  return fit;
}

TimedFit timed_adjustment(const BatchPlan& plan, const BatchItem& item, const LoadedInput& input,
                          int threads) {
  TimedFit fit;
  fit.seconds = seconds_of(1, [&] {
    fit.adjusted =
        adjusted_field(plan.operators[item.op].choice, input, plan.inputs[item.input].views, threads);
  });
  const ViewGrid& grid = input.light_field()->grid();
  fit.views = grid.columns * grid.rows;
  return fit;
}

/// The fit of an item: that of all views, if its variant has one, else its own.
std::shared_ptr<const TimedFit> fit_of(const BatchPlan& plan, const BatchItem& item, const LoadedInput& input,
                                       SharedWork& shared, int threads) {
  if (const auto found = shared.fits.find(item.op); found != shared.fits.end()) return found->second;
  const OperatorChoice& choice = plan.operators[item.op].choice;
  const auto fit = std::make_shared<const TimedFit>(
      choice.adjusted ? timed_adjustment(plan, item, input, threads)
                      : timed_fit(plan, item, input, shared.repeat, threads));
  if (choice.adjusted || choice.variant.scope == OperatorScope::kLightField)
    shared.fits.emplace(item.op, fit);
  return fit;
}

/// What LoadedInput did for this view before any operator was fitted, timed as often as fits are.
double statistics_seconds(const BatchItem& item, const OperatorView& view, SharedWork& shared, int threads) {
  const auto [entry, is_new] = shared.statistics_s.try_emplace(item.view, 0.0);
  if (is_new)
    entry->second = median(seconds_of(shared.repeat, [&] {
      const ViewStatistics statistics = measure_view(*view.colour, threads);
      evaluate(statistics, log_floor(statistics));
    }));
  return entry->second;
}

/// As often as the fit was made; every time gives the same image.
void map_repeatedly(const TimedFit& fit, const BatchView& place, double statistics_s, int threads,
                    MappedItem& item) {
  ToneMapped mapped;
  const std::vector<double> seconds = seconds_of(static_cast<int>(fit.seconds.size()), [&] {
    mapped = fit.adjusted ? fit.adjusted->views.at(place) : fit.fitted.apply(item.view, threads);
  });
  item.result.values = mapping_values(mapped, fit);
  item.result.timings = timings_of(fit, seconds, statistics_s);
  item.image = std::move(mapped.image);
}

ComparisonConditions conditions_for(const BatchPlan& plan, const BatchInput& input, int threads) {
  ComparisonConditions conditions;
  conditions.cd_m2_per_unit = input.cd_m2_per_unit.value_or(1);
  conditions.viewing = plan.study.viewing;
  conditions.threads = threads;
  return conditions;
}

/// NaN or infinite: operators repair such pixels, and metrics have nothing to compare them with.
double left_out_pixels(const SceneImage& scene) {
  const Mask finite = mask_of_finite(scene);
  return static_cast<double>(std::count(finite.pixels().begin(), finite.pixels().end(), 0));
}

MetricResult measured(const Metric& metric, const MappedItem& mapped,
                      const ComparisonConditions& conditions) {
  MetricResult result{.name = metric.name, .key = {}, .failure = {}, .values = {}};
  const Stopwatch watch;
  result.failure = failure_of([&] {
    result.values = measure(mapped.image, *mapped.view.colour, {&metric}, conditions);
    for (const Measurement& m : result.values)
      if (std::isnan(m.value)) throw InputError(fmt::format("{} came out as no number", m.quantity));
  });
  if (!result.failure.empty()) result.values.clear();
  result.seconds = watch.seconds();
  return result;
}

}  // namespace

bool reads_statistics(const OperatorChoice& choice, bool unit_is_known) {
  // All operators of the table do, but one that is a fixed curve over cd/m².
  return choice.info->id != "pq" || (!unit_is_known && choice.values.at("unit").automatic);
}

MappedItem map_item(const BatchPlan& plan, const BatchItem& item, const LoadedInput& input,
                    SharedWork& shared, int threads) {
  MappedItem mapped;
  const Stopwatch watch;
  const std::string failure = failure_of([&] {
    const OperatorChoice& choice = plan.operators[item.op].choice;
    if (!item.problem.empty()) throw InputError(item.problem);
    mapped.view = input.view(item.view);
    require_disparity(choice, mapped.view);
    mapped.result.width = mapped.view.colour->width();
    mapped.result.height = mapped.view.colour->height();
    const bool timed = reads_statistics(choice, plan.inputs[item.input].cd_m2_per_unit.has_value());
    const double statistics_s = timed ? statistics_seconds(item, mapped.view, shared, threads) : 0;
    map_repeatedly(*fit_of(plan, item, input, shared, threads), item.view, statistics_s, threads, mapped);
    mapped.result.values.push_back({"left_out_pixels", left_out_pixels(*mapped.view.colour), "px"});
  });
  if (!failure.empty()) mapped.result = failed_result(failure);
  mapped.result.seconds = watch.seconds();
  return mapped;
}

void measure_item(const BatchPlan& plan, const BatchItem& item, MappedItem& mapped, int threads) {
  if (mapped.result.failed()) return;
  const BatchInput& input = plan.inputs[item.input];
  ComparisonConditions conditions = conditions_for(plan, input, threads);
  const Mask finite = mask_of_finite(*mapped.view.colour);
  if (std::count(finite.pixels().begin(), finite.pixels().end(), 0) > 0) conditions.valid = &finite;
  std::vector<MetricResult> known = std::move(mapped.result.metrics), results;
  for (const Metric* metric : plan.metrics_for(input)) {
    const std::string key = plan.metric_key(*metric);
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const MetricResult& entry) { return entry.key == key; });
    if (found != known.end() && found->failure.empty()) {
      results.push_back(std::move(*found));
      continue;
    }
    const std::string problem = plan.problem_of(*metric, input);
    results.push_back(problem.empty() ? measured(*metric, mapped, conditions)
                                      : MetricResult{.name = metric->name, .failure = problem});
    results.back().key = key;
  }
  mapped.result.metrics = std::move(results);
}

ItemResult failed_result(const std::string& failure) {
  ItemResult result;
  result.failure = failure;
  return result;
}

}  // namespace plenolab
