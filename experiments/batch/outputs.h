#pragma once

#include <filesystem>
#include <vector>

#include "analysis/provenance.h"
#include "experiments/batch/item_result.h"

namespace plenolab {

/// Rows of all items in the order of the plan: what is the same at every run. An item that failed has one row
/// `failed`, and so has each metric that failed, with the reason in the column "note", which is empty else.
ResultTable batch_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored);

/// Run times of all items in the order of the plan.
ResultTable batch_timing_rows(const BatchPlan& plan, const std::vector<StoredItem>& stored);

/// Writes results.csv, timings.csv, report.html with plots/, and run.json into the folder of a batch all of
/// whose items are done or failed. Plots of an earlier study go.
void write_batch_outputs(const BatchPlan& plan, const std::vector<StoredItem>& stored,
                         const std::filesystem::path& folder, Provenance& provenance);

/// Takes away what write_batch_outputs wrote, for a plan some of whose items are open: it is of an earlier
/// plan, and nobody may take it for this one. Results of items stay, and so does everything else. Returns the
/// names of what went, as one text; empty if there was nothing. Throws InputError if it cannot be removed.
std::string remove_earlier_outputs(const std::filesystem::path& folder);

/// Whether an item is neither done nor failed.
bool is_open(const StoredItem& item);

/// The items that failed, each with its reason, as one text: the first few, then how many more there are.
std::string failures_text(const BatchPlan& plan, const std::vector<StoredItem>& stored);

}  // namespace plenolab
