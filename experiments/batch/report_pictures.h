#pragma once

#include <filesystem>
#include <vector>

#include "analysis/report/report.h"
#include "experiments/batch/item_result.h"

namespace plenolab {

/// The small pictures of `folder` (picture.h) of the middle view of each input, as all operators map it. Of
/// many inputs those that are too much for a page are counted instead.
ReportSection picture_section(const BatchPlan& plan, const std::vector<StoredItem>& stored,
                              const std::filesystem::path& folder);

}  // namespace plenolab
