#include "experiments/batch/outputs.h"

#include <fmt/format.h>

#include <set>

#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/batch/report.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr const char* kResults = "results.csv";
constexpr const char* kTimings = "timings.csv";
constexpr const char* kReport = "report.html";
constexpr const char* kRun = "run.json";  // write_run_json
constexpr const char* kPlots = "plots";

/// Whether it was there.
bool remove_output(const fs::path& file) {
  std::error_code error;
  const bool was_there = fs::remove(file, error);
  if (error) throw InputError(fmt::format("cannot remove {}: {}", file.string(), error.message()));
  return was_there;
}

/// The plots that a report has filed, without those named; other files in their folder are not ours.
void remove_plots(const fs::path& folder, const std::set<std::string>& but = {}) {
  const std::string dark = "-dark";
  std::error_code error;
  std::vector<fs::path> plots;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::string name = entry.path().stem().string();
    if (name.ends_with(dark)) name.resize(name.size() - dark.size());
    if (name.ends_with(kOverTime) && but.count(name) == 0) plots.push_back(entry.path());
  }
  for (const fs::path& plot : plots) remove_output(plot);
  fs::remove(folder, error);  // stays if it is not empty
}

}  // namespace

ResultTable batch_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  ResultTable table;
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    const ItemResult& result = stored[i].result;
    Columns columns = plan.columns(plan.items[i]);
    columns.emplace_back("note", "");
    const auto add_failure = [&](const std::string& why) {
      Columns with_note = columns;
      with_note.back().second = why;
      table.add({"failed", 1, "1", with_note});
    };
    if (is_open(stored[i])) continue;
    if (result.failed()) add_failure(result.failure);
    add_measurement_rows(table, result.values, columns);
    for (const MetricResult& metric : result.metrics) {
      add_measurement_rows(table, metric.values, columns);
      if (!metric.failure.empty()) add_failure(metric.name + ": " + metric.failure);
    }
  }
  return table;
}

ResultTable batch_timing_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  ResultTable table;
  for (std::size_t i = 0; i < plan.items.size(); ++i)
    if (!is_open(stored[i]))
      add_measurement_rows(table, stored[i].result.timings, plan.columns(plan.items[i]));
  return table;
}

void write_batch_outputs(const BatchPlan& plan, const std::vector<StoredItem>& stored, const fs::path& folder,
                         Provenance& provenance) {
  write_text_file(folder / kResults, to_csv(batch_rows(plan, stored)));
  write_text_file(folder / kTimings, to_csv(batch_timing_rows(plan, stored)));
  finish_provenance(provenance);
  const BatchReport report = batch_report(plan, stored, folder, provenance);
  std::set<std::string> names;
  for (const auto& entry : report.plots) {
    write_plot(entry.second, folder / kPlots / entry.first);
    names.insert(entry.first);
  }
  remove_plots(folder / kPlots, names);
  write_report(report.page, folder / kReport);
  write_run_json(provenance, folder);
}

std::string remove_earlier_outputs(const fs::path& folder) {
  std::string removed;
  for (const char* name : {kResults, kTimings, kReport, kRun})
    if (remove_output(folder / name)) removed += (removed.empty() ? "" : ", ") + std::string(name);
  remove_plots(folder / kPlots);
  return removed;
}

bool is_open(const StoredItem& item) {
  return item.state < ItemState::kFailed;
}

std::string failures_text(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  constexpr int kMostNamed = 3;
  std::string text;
  int failed = 0;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (stored[i].state != ItemState::kFailed || ++failed > kMostNamed) continue;
    text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", plan.title(plan.items[i]),
                        stored[i].result.failures());
  }
  if (failed > kMostNamed) text += fmt::format("; and {} more", failed - kMostNamed);
  return text;
}

}  // namespace plenolab
