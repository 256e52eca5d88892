#include "experiments/batch/outputs.h"

#include <fmt/format.h>

#include "core/base/file.h"
#include "experiments/batch/report.h"

namespace plenolab {
namespace fs = std::filesystem;

ResultTable batch_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  ResultTable table;
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    Columns columns = plan.columns(plan.items[i]);
    if (stored[i].state == ItemState::kDone) add_measurement_rows(table, stored[i].result.values, columns);
    if (stored[i].state != ItemState::kFailed) continue;
    columns.emplace_back("note", stored[i].result.failure);
    table.add({"failed", 1, "1", columns});
  }
  return table;
}

ResultTable batch_timing_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  ResultTable table;
  for (std::size_t i = 0; i < plan.items.size(); ++i)
    if (stored[i].state == ItemState::kDone)
      add_measurement_rows(table, stored[i].result.timings, plan.columns(plan.items[i]));
  return table;
}

void write_batch_outputs(const BatchPlan& plan, const std::vector<StoredItem>& stored, const fs::path& folder,
                         Provenance& provenance) {
  write_text_file(folder / "results.csv", to_csv(batch_rows(plan, stored)));
  write_text_file(folder / "timings.csv", to_csv(batch_timing_rows(plan, stored)));
  finish_provenance(provenance);
  const BatchReport report = batch_report(plan, stored, provenance);
  for (const auto& [name, plot] : report.plots) write_plot(plot, folder / "plots" / name);
  write_report(report.page, folder / "report.html");
  write_run_json(provenance, folder);
}

std::string failures_text(const BatchPlan& plan, const std::vector<StoredItem>& stored) {
  constexpr int kMostNamed = 3;
  std::string text;
  int failed = 0;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (stored[i].state != ItemState::kFailed || ++failed > kMostNamed) continue;
    text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", plan.title(plan.items[i]),
                        stored[i].result.failure);
  }
  if (failed > kMostNamed) text += fmt::format("; and {} more", failed - kMostNamed);
  return text;
}

}  // namespace plenolab
