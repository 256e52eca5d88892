#pragma once

#include <filesystem>
#include <string>

#include "experiments/batch/item_result.h"
#include "experiments/cli/output.h"

namespace plenolab {

/// Below `plenolab batch`: each declares its options on `batch` and what runs.
void add_batch_plan(CLI::App& batch, const Invocation& invocation);
void add_batch_run(CLI::App& batch, const Invocation& invocation);
void add_batch_merge(CLI::App& batch, const Invocation& invocation);

/// What the subcommands share.
struct BatchOptions {
  CommonOptions common;
  std::string study;
  bool force = false;  ///< take over the folder of another study; not of plan
};

/// Declares the study file and the common options.
void add_batch_options(CLI::App& app, BatchOptions& options);

/// Plans the study of the options. Throws UsageError if --seed was given beside the study's own.
BatchPlan plan_of(const BatchOptions& options, const CLI::App& app);

/// Starts the provenance of a command on a plan, with the hashes of the study and of its inputs.
Provenance begin_batch(const Invocation& invocation, const BatchOptions& options, const BatchPlan& plan);

/// Takes tables and report of an earlier plan out of a folder where items of this one are open, and says so:
/// at the start, since whoever finds no open items at its end writes them anew.
void remove_outdated_outputs(const BatchPlan& plan, const std::filesystem::path& folder,
                             const CommonOptions& options);

/// Writes all that a complete batch leaves behind (outputs.h), prints the means of each operator and the rows
/// asked for. Throws InputError that names the items that failed, if any did.
void finish_batch(const BatchPlan& plan, const std::vector<StoredItem>& stored,
                  const std::filesystem::path& folder, Provenance& provenance, const CommonOptions& options);

}  // namespace plenolab
