#include "experiments/batch/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include <method_sources.h>
#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// Settings that differ from the defaults.
std::string changed_settings(const OperatorChoice& choice) {
  const SettingValues defaults = default_values(choice.info->settings);
  std::string text;
  for (const Setting& setting : choice.info->settings) {
    const SettingValue& value = choice.values.at(setting.name);
    if (value == defaults.at(setting.name)) continue;
    text += (text.empty() ? "" : " ") + setting.name + "=" + to_text(setting, value);
  }
  return text;
}

/// What is wrong with an operator, without the option of a command line that it would be wrong with.
std::string without_option(const std::string& message) {
  const std::size_t colon = message.find(": ");
  return message.starts_with("--") && colon != std::string::npos ? message.substr(colon + 2) : message;
}

BatchOperator resolve(const BatchOperatorChoice& wanted) {
  try {
    BatchOperator op{choose_operator({wanted.name, wanted.variant, wanted.settings}), {}};
    require_view_variant(op.choice);
    op.settings = changed_settings(op.choice);
    return op;
  } catch (const UsageError& error) {
    throw InputError(without_option(error.what()));
  }
}

std::vector<BatchOperator> resolve_operators(const BatchStudy& study, const std::string& file) {
  std::vector<BatchOperator> operators;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < study.operators.size(); ++i) try {
      operators.push_back(resolve(study.operators[i]));
      if (!seen.insert(operators.back().title()).second)
        throw InputError(fmt::format("\"{}\" is there twice", operators.back().title()));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: \"operators[{}]\": {}", file, i, error.what()));
    }
  return operators;
}

/// By its own name or that of its family.
bool is_named(const Metric& metric, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), metric.name) != names.end() ||
         std::find(names.begin(), names.end(), metric.family) != names.end();
}

/// Names of metrics and families that a study may ask for, each once.
std::vector<std::string> metric_names() {
  std::vector<std::string> names{"all"};
  for (const Metric& metric : metrics()) {
    if (!metric.compare_mapped && !metric.judge) continue;
    for (const std::string& name : {std::string(metric.family), std::string(metric.name)})
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

void require_known(const std::vector<std::string>& names, const std::string& file) {
  for (const std::string& name : names)
    if (name != "all" && std::none_of(metrics().begin(), metrics().end(), [&](const Metric& metric) {
          return name == metric.name || name == metric.family;
        }))
      throw InputError(fmt::format("{}: \"metrics\": there is no metric \"{}\"; choose from {}", file, name,
                                   fmt::join(metric_names(), ", ")));
}

/// All that were asked for and take a tone mapped image; asked for by name, all must.
void resolve_metrics(BatchPlan& plan, const std::string& file) {
  const std::vector<std::string>& names = plan.study.metrics;
  require_known(names, file);
  plan.metrics = select_metrics(names);
  for (const Metric* metric : plan.metrics) {
    if (is_named(*metric, names) && !metric->compare_mapped && !metric->judge)
      throw InputError(fmt::format("{}: \"metrics\": {} does not compare a tone mapped image with its scene",
                                   file, metric->name));
  }
  std::erase_if(plan.metrics, [](const Metric* metric) { return !metric->compare_mapped && !metric->judge; });
  for (const Metric* metric : plan.metrics)
    if (metric->absolute_luminance && !is_named(*metric, names)) plan.unscalable.push_back(metric);
}

/// Why an operator cannot map a view of an input; empty if nothing is known.
std::string problem_of(const BatchOperator& op, const BatchInput& input, const BatchView& view) {
  if (std::string problem = input.problem_with(view); !problem.empty()) return problem;
  if (op.choice.adjusted && input.choice.kind == BatchInputChoice::Kind::kImage)
    return "key-view adjustment is for light fields, not for single images";
  return "";
}

/// What stands for the pixels of an input that cannot be opened: the input as the study spells it. Neither
/// where the study lies nor what is wrong counts, since machines differ in both.
std::string content_of(const BatchInput& input) {
  if (!input.content.empty()) return input.content;
  return fmt::format("cannot be opened: {} {} {}", static_cast<int>(input.choice.kind), input.choice.source,
                     input.choice.preset);
}

/// Everything that decides the mapping of an item.
std::string key_of(const BatchPlan& plan, const BatchItem& item) {
  const BatchInput& input = plan.inputs[item.input];
  const OperatorChoice& choice = plan.operators[item.op].choice;
  ContentHash hash;
  hash.add(method_sources::kHash);
  hash.add(content_of(input));
  hash.add(input.cd_m2_per_unit.value_or(0));
  hash.add(static_cast<double>(item.view.column));
  hash.add(static_cast<double>(item.view.row));
  hash.add(choice.info->id);
  hash.add(choice.variant_name());
  hash.add(settings_text(choice));
  hash.add(static_cast<double>(plan.study.repeat));
  return hash.hex();
}

void add_items(BatchPlan& plan, std::size_t input) {
  std::vector<BatchView> views = plan.inputs[input].views;
  if (views.empty()) views.emplace_back();
  for (const BatchView& view : views)
    for (std::size_t op = 0; op < plan.operators.size(); ++op) {
      BatchItem item{.input = input, .op = op, .view = view, .key = {}, .problem = {}};
      item.problem = problem_of(plan.operators[op], plan.inputs[input], view);
      item.key = key_of(plan, item);
      plan.items.push_back(std::move(item));
    }
}

std::string view_text(const BatchInput& input, const BatchItem& item) {
  return input.views.empty() ? "" : fmt::format("{},{}", item.view.column, item.view.row);
}

}  // namespace

std::string BatchOperator::title() const {
  return fmt::format("{} {}{}{}", choice.info->id, choice.variant_name(), settings.empty() ? "" : " ",
                     settings);
}

Columns BatchPlan::columns(const BatchItem& item) const {
  const BatchInput& input = inputs[item.input];
  const BatchOperator& op = operators[item.op];
  return {{"input", input.choice.title()},       {"preset", input.choice.preset},
          {"view", view_text(input, item)},      {"operator", op.choice.info->id},
          {"variant", op.choice.variant_name()}, {"settings", op.settings}};
}

std::string BatchPlan::title(const BatchItem& item) const {
  std::string text;
  for (const auto& column : columns(item)) add_word(text, std::get<std::string>(column.second));
  return text;
}

void add_word(std::string& title, const std::string& word) {
  title += (title.empty() || word.empty() ? "" : " ") + word;
}

std::vector<const Metric*> BatchPlan::metrics_for(const BatchInput& input) const {
  std::vector<const Metric*> chosen = metrics;
  if (!input.cd_m2_per_unit)
    std::erase_if(chosen, [&](const Metric* metric) {
      return std::find(unscalable.begin(), unscalable.end(), metric) != unscalable.end();
    });
  return chosen;
}

std::string BatchPlan::metric_key(const Metric& metric) const {
  const ViewingConditions& viewing = study.viewing;
  ContentHash hash;
  hash.add(metric.name);
  for (const double value : {viewing.pixels_per_degree, viewing.distance_m, viewing.display_peak_cd_m2,
                             viewing.display_black_cd_m2})
    hash.add(value);
  return hash.hex();
}

std::string BatchPlan::problem_of(const Metric& metric, const BatchInput& input) const {
  if (!metric.absolute_luminance || input.cd_m2_per_unit) return "";
  return fmt::format("it needs the luminance of a value of 1, which {} does not say: give \"cd_m2_per_unit\"",
                     input.choice.title());
}

std::string BatchPlan::problems_of(const BatchItem& item) const {
  if (!item.problem.empty()) return item.problem;
  std::string text;
  for (const Metric* metric : metrics_for(inputs[item.input]))
    if (const std::string problem = problem_of(*metric, inputs[item.input]); !problem.empty())
      text += (text.empty() ? "" : "; ") + metric->name + ": " + problem;
  return text;
}

BatchPlan plan_batch(const fs::path& study_file, std::uint64_t seed) {
  BatchPlan plan;
  const std::string file = study_file.string();
  plan.study = parse_batch_study(read_text_file(study_file), file);
  plan.seed = plan.study.seed.value_or(seed);
  plan.operators = resolve_operators(plan.study, file);
  resolve_metrics(plan, file);
  plan.inputs = identify_inputs(plan.study, study_file.parent_path(), plan.seed, file);
  for (std::size_t i = 0; i < plan.inputs.size(); ++i) add_items(plan, i);
  return plan;
}

BatchShard parse_shard(const std::string& text) {
  constexpr int kMostShards = 10'000;
  BatchShard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  if (first.ptr != end && *first.ptr == '/') {
    const auto second = std::from_chars(first.ptr + 1, end, shard.count);
    if (second.ptr == end && shard.index >= 1 && shard.index <= shard.count && shard.count <= kMostShards)
      return shard;
  }
  throw UsageError(
      fmt::format("--shard: give I/N with 1 ≤ I ≤ N ≤ {}, e.g. 1/4, not '{}'", kMostShards, text));
}

std::vector<std::size_t> items_of(const BatchShard& shard, std::size_t items) {
  const auto border = [&](int index) {
    return items * static_cast<std::size_t>(index) / static_cast<std::size_t>(shard.count);
  };
  std::vector<std::size_t> own;
  for (std::size_t i = border(shard.index - 1); i < border(shard.index); ++i) own.push_back(i);
  return own;
}

}  // namespace plenolab
