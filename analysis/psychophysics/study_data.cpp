#include "analysis/psychophysics/study_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "analysis/psychophysics/binomial.h"
#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr std::int64_t kMany = 1'000'000;
constexpr double kLongest_s = 86'400;

const std::string& one_of(const CsvTable& table, const CsvRow& row, std::string_view column,
                          const std::vector<std::string>& words) {
  const std::string& field = table.text(row, column);
  if (std::find(words.begin(), words.end(), field) == words.end())
    throw InputError(fmt::format("{}, line {}: '{}' must be one of {}, not '{}'", table.name, row.line,
                                 column, fmt::join(words, ", "), field));
  return field;
}

int small_whole(const CsvTable& table, const CsvRow& row, std::string_view column, int low) {
  return static_cast<int>(table.whole(row, column, low, kMany));
}

StudyTrial parse_trial(const CsvTable& table, const CsvRow& row) {
  StudyTrial trial;
  trial.participant = table.text(row, "participant");
  trial.mode = one_of(table, row, "mode", {"real", "pilot", "simulated"});
  trial.block = table.text(row, "block");
  trial.position = small_whole(table, row, "position", 1);
  trial.display = table.text(row, "display");
  trial.order = table.text(row, "order");
  trial.trial = small_whole(table, row, "trial", 1);
  trial.image = table.text(row, "image");
  trial.is_catch = table.flag(row, "catch");
  trial.test_first = table.flag(row, "test_first");
  trial.chose_test = table.flag(row, "chose_test");
  trial.response_s = table.number(row, "response_s", 0, kLongest_s);
  trial.views_reference = small_whole(table, row, "views_reference", 0);
  trial.views_a = small_whole(table, row, "views_a", 0);
  trial.views_b = small_whole(table, row, "views_b", 0);
  trial.refused = small_whole(table, row, "refused", 0);
  return trial;
}

std::string name_of(TrialMode mode) {
  switch (mode) {
    case TrialMode::kReal:
      return "real";
    case TrialMode::kPilot:
      return "pilot";
    case TrialMode::kSimulated:
      return "simulated";
    case TrialMode::kAll:
      break;
  }
  return "";
}

/// Whether `a` comes before `b` where runs of digits compare by value. Leading zeros decide last.
bool before_by_value(std::string_view a, std::string_view b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](std::string_view text, std::size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const std::size_t start = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      return text.substr(start, at - start);
    };
    const std::string_view left = number(a, i), right = number(b, j);
    if (left.size() != right.size()) return left.size() < right.size();
    if (left != right) return left < right;
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;
}

void sort_by_name(std::vector<StudyCount>& counts) {
  std::ranges::stable_sort(counts, [](const StudyCount& a, const StudyCount& b) {
    return a.display == b.display ? before_by_value(a.image, b.image) : before_by_value(a.display, b.display);
  });
}

}  // namespace

bool holds_trials(const CsvTable& table) {
  return table.has_column("chose_test");
}

std::vector<StudyTrial> parse_study_trials(const CsvTable& table) {
  std::vector<StudyTrial> trials;
  std::map<std::tuple<std::string, std::string, int>, int> line_of;
  for (const CsvRow& row : table.rows) {
    StudyTrial trial = parse_trial(table, row);
    const auto [seen, is_new] = line_of.try_emplace({trial.participant, trial.block, trial.trial}, row.line);
    if (!is_new)
      throw InputError(
          fmt::format("{}, line {}: participant '{}' has trial {} of block '{}' already in line {}",
                      table.name, row.line, trial.participant, trial.trial, trial.block, seen->second));
    trials.push_back(std::move(trial));
  }
  return trials;
}

std::vector<StudyCount> parse_study_counts(const CsvTable& table) {
  std::vector<StudyCount> counts;
  std::map<std::pair<std::string, std::string>, int> line_of;
  for (const CsvRow& row : table.rows) {
    StudyCount count;
    count.display = table.text(row, "display");
    count.image = table.text(row, "image");
    count.chose_test.trials = table.whole(row, "n", 1, kMostTrials);
    count.chose_test.hits = table.whole(row, "k", 0, count.chose_test.trials);
    if (table.has_column("verdict"))
      count.printed_verdict = one_of(table, row, "verdict", {"PASSED", "FAILED"});
    const auto [seen, is_new] = line_of.try_emplace({count.display, count.image}, row.line);
    if (!is_new)
      throw InputError(fmt::format("{}, line {}: image '{}' on '{}' stands already in line {}", table.name,
                                   row.line, count.image, count.display, seen->second));
    counts.push_back(std::move(count));
  }
  return counts;
}

std::vector<StudyTrial> trials_of_mode(const std::vector<StudyTrial>& trials, TrialMode mode) {
  if (mode == TrialMode::kAll) return trials;
  const std::string wanted = name_of(mode);
  std::vector<StudyTrial> chosen;
  std::set<std::string> found;
  for (const StudyTrial& trial : trials) {
    found.insert(trial.mode);
    if (trial.mode == wanted) chosen.push_back(trial);
  }
  if (chosen.empty())
    throw InputError(
        fmt::format("no trial is of mode '{}': there are trials of mode {}", wanted, fmt::join(found, ", ")));
  return chosen;
}

std::vector<StudyCount> count_choices(const std::vector<StudyTrial>& trials) {
  std::vector<StudyCount> counts;
  std::map<std::pair<std::string, std::string>, std::size_t> index;
  std::vector<std::set<std::string>> participants;
  for (const StudyTrial& trial : trials) {
    if (trial.is_catch) continue;
    const auto [entry, is_new] = index.try_emplace({trial.display, trial.image}, counts.size());
    if (is_new) {
      counts.push_back({trial.display, trial.image, {}, 0, ""});
      participants.emplace_back();
    }
    StudyCount& count = counts[entry->second];
    ++count.chose_test.trials;
    count.chose_test.hits += trial.chose_test ? 1 : 0;
    participants[entry->second].insert(trial.participant);
  }
  for (std::size_t i = 0; i < counts.size(); ++i)
    counts[i].participants = static_cast<std::int64_t>(participants[i].size());
  sort_by_name(counts);
  return counts;
}

}  // namespace plenolab
