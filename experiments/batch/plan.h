#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/batch/input.h"
#include "experiments/cli/operator_options.h"
#include "experiments/score.h"

namespace plenolab {

/// An operator of the study as the tables name it.
struct BatchOperator {
  OperatorChoice choice;
  std::string settings;  ///< "name=value …" of those that differ from the defaults

  std::string title() const;  ///< operator, variant and settings in one
};

/// One view of one input, mapped by one operator and measured by all metrics.
struct BatchItem {
  std::size_t input = 0, op = 0;  ///< of the plan
  BatchView view;                 ///< unused for images
  std::string key;                ///< hash of everything that decides its mapping: its name on disk
  std::string problem;            ///< why it cannot be mapped; empty if nothing is known
};

/// A study with all that it names found.
struct BatchPlan {
  BatchStudy study;
  std::uint64_t seed = 1;
  std::vector<BatchInput> inputs;
  std::vector<BatchOperator> operators;
  std::vector<const Metric*> metrics;     ///< those that take a tone mapped image, in the order of the table
  std::vector<const Metric*> unscalable;  ///< of these, left out where an input does not say its unit
  std::vector<BatchItem> items;           ///< input by input, view by view, in the order of the operators

  /// What identifies an item in tables: input, preset, view, operator, variant and settings.
  Columns columns(const BatchItem& item) const;
  /// The same as one text, e.g. "cellar tiny 1,1 bilateral naive contrast=50".
  std::string title(const BatchItem& item) const;
  /// The metrics that an input is measured with.
  std::vector<const Metric*> metrics_for(const BatchInput& input) const;
  /// Hash of what decides a metric's values beside the item's key: its name and the viewing conditions.
  std::string metric_key(const Metric& metric) const;
  /// Why a metric will fail on an input; empty if nothing is known.
  std::string problem_of(const Metric& metric, const BatchInput& input) const;
  /// Why an item, or some of its metrics, will fail; empty if nothing is known.
  std::string problems_of(const BatchItem& item) const;
};

/// Adds a word of a title, with a space before all but the first; nothing if it is empty.
void add_word(std::string& title, const std::string& word);

/// Reads a study file and finds its inputs, operators and metrics. `seed` is used if the study has none. An
/// input that cannot be opened, or is no light field where an operator needs one, gives items with a problem.
/// Throws InputError, naming file and key, for everything else.
BatchPlan plan_batch(const std::filesystem::path& study_file, std::uint64_t seed);

/// Which part of the items one process computes: part `index` of `count`, 1-based; neighbours in the plan
/// stay together, since they share their input.
struct BatchShard {
  int index = 1, count = 1;
  bool whole() const { return count == 1; }
};

/// Reads "i/n" with 1 ≤ i ≤ n ≤ 10 000. Throws UsageError.
BatchShard parse_shard(const std::string& text);

/// Indices of the items of a shard: every item is in exactly one of them.
std::vector<std::size_t> items_of(const BatchShard& shard, std::size_t items);

}  // namespace plenolab
