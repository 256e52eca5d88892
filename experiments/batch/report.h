#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/report/report.h"
#include "experiments/batch/item_result.h"

namespace plenolab {

/// How names of plots end; before it stands the metric's.
inline constexpr const char* kOverTime = "-over-time";

/// The page of a batch, and its plots to be filed by name.
struct BatchReport {
  Report page;
  std::vector<std::pair<std::string, Plot>> plots;
};

/// What failed, what was left out, means of each operator, what was mapped (the small pictures of `folder`,
/// of the middle view of each input), and for each metric its tables and its first quantity over run time.
BatchReport batch_report(const BatchPlan& plan, const std::vector<StoredItem>& stored,
                         const std::filesystem::path& folder, const Provenance& provenance);

}  // namespace plenolab
