#include "experiments/session/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "experiments/session/plan.h"

namespace plenolab {

namespace {

/// A number of an event's detail, 0 where there is none.
std::int64_t detail_number(const SessionEvent& event, const char* key) {
  if (event.detail.empty()) return 0;
  const auto json = nlohmann::json::parse(event.detail, nullptr, false);
  if (!json.is_object()) return 0;
  const auto found = json.find(key);
  return found != json.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
}

/// Follows the events of one trial after the other.
class TrialCollector {
 public:
  TrialCollector(const SessionIdentity& identity, const StudyDefinition& study, SessionSummary& summary)
      : identity_(identity), study_(study), plan_(plan_session(study, identity.number)), summary_(summary) {
    for (const PlannedBlock& block : plan_.blocks)
      summary_.trials_planned += static_cast<int>(block.trials.size());
  }

  void take(const SessionEvent& event) {
    if (event.kind == "trial_started") begin(event);
    if (event.kind == "shown" || event.kind == "shown_again") see(event);
    if (event.kind == "press" && event.outcome.starts_with("refused_")) ++record_.refused;
    record_.dropped_frames += detail_number(event, "dropped");
    record_.longest_frame_us = std::max(record_.longest_frame_us, detail_number(event, "longest_us"));
    if (event.kind == "choice") end(event);
  }

 private:
  void require(bool sound, const SessionEvent& event, const char* otherwise) const {
    if (!sound)
      throw InputError(fmt::format("session {} holds {} (event {}): it is damaged", identity_.participant,
                                   otherwise, event.sequence));
  }

  void begin(const SessionEvent& event) {
    constexpr const char* kUnplanned = "a trial that its study does not plan";
    const auto place = static_cast<std::size_t>(event.position - 1),
               index = static_cast<std::size_t>(event.trial - 1);
    require(place < plan_.blocks.size() && index < plan_.blocks[place].trials.size(), event, kUnplanned);
    const PlannedTrial& planned = plan_.blocks[place].trials[index];
    require(event.block == plan_.blocks[place].block && event.image == planned.image &&
                event.what == (planned.catch_trial ? "catch" : "") &&
                event.outcome == (planned.test_first ? "test_left" : "test_right"),
            event, kUnplanned);
    require(!summary_.completed(event.position, event.trial), event, "a trial after its choice");
    on_.clear();
    in_trial_ = true;
    record_ = {};
    record_.participant = identity_.participant;
    record_.mode = identity_.mode;
    record_.block = plan_.blocks[place].block;
    record_.position = event.position;
    record_.display = study_.block(record_.block).display;
    record_.order = plan_.order;
    record_.trial = event.trial;
    record_.image = planned.image;
    record_.catch_trial = planned.catch_trial;
    record_.test_first = planned.test_first;
    record_.attempt = event.attempt;
    record_.run = event.run;
    record_.began_us = -1;
  }

  /// What is behind a comparison by the plan: "test" or "reference".
  std::string behind(const std::string& comparison) const {
    return (comparison == "left") == record_.test_first ? "test" : "reference";
  }

  void see(const SessionEvent& event) {
    require_in_trial(event);
    const bool comparison = event.what == "left" || event.what == "right";
    require(comparison || event.what == "reference" || event.what == "black", event, "an unknown picture");
    require(!comparison || event.outcome == behind(event.what), event,
            "a picture that is not the planned one");
    on_ = event.what;
    if (event.what == "black" && record_.began_us < 0) record_.began_us = event.t_us;
    if (event.kind == "shown_again") return;  // after a pause: no new view
    if (event.what == "reference") ++record_.views_reference;
    if (event.what == "left") ++record_.views_a;
    if (event.what == "right") ++record_.views_b;
  }

  void require_in_trial(const SessionEvent& event) const {
    require(in_trial_ && event.position == record_.position && event.trial == record_.trial &&
                event.attempt == record_.attempt && event.run == record_.run &&
                event.block == record_.block && event.image == record_.image,
            event, "an event of a trial that had not begun");
  }

  /// The choice as it was stored; that it agrees with what was on and with the plan shows that it is whole.
  void end(const SessionEvent& event) {
    require_in_trial(event);
    require((event.what == "left" || event.what == "right") && event.what == on_, event,
            "a choice of what was not on");
    require(event.outcome == behind(event.what), event, "a choice that contradicts itself");
    record_.chose_test = event.outcome == "test";
    record_.paused_us = detail_number(event, "paused_us");
    record_.response_s = static_cast<double>(event.t_us - record_.began_us - record_.paused_us) * 1e-6;
    summary_.trials.push_back(record_);
    in_trial_ = false;
  }

  const SessionIdentity& identity_;
  const StudyDefinition& study_;
  SessionPlan plan_;
  SessionSummary& summary_;
  TrialRecord record_;
  std::string on_;         // what is on the display: "black", "reference", "left", "right"
  bool in_trial_ = false;  // begun and not chosen
};

}  // namespace

const char* name_of(SessionState state) {
  static constexpr std::array kNames{"interrupted", "done", "declined", "excluded"};
  return kNames[static_cast<std::size_t>(state)];
}

bool SessionSummary::completed(int position, int trial) const {
  return std::any_of(trials.begin(), trials.end(), [&](const TrialRecord& record) {
    return record.position == position && record.trial == trial;
  });
}

SessionSummary summarise(const SessionIdentity& identity, const StudyDefinition& study,
                         std::span<const SessionEvent> events) {
  SessionSummary summary;
  TrialCollector trials(identity, study, summary);
  for (const SessionEvent& event : events) {
    summary.runs = std::max(summary.runs, event.run);
    if (event.kind == "answer") summary.answers.push_back({event.what, event.detail});
    if (event.kind == "consent") summary.consented = event.outcome == "given";
    if (event.kind == "consent" && !summary.consented) summary.state = SessionState::kDeclined;
    if (event.kind == "excluded") summary.state = SessionState::kExcluded;
    if (event.kind == "session_done") summary.state = SessionState::kDone;
    trials.take(event);
  }
  for (TrialRecord& trial : summary.trials) trial.session_state = summary.state;
  return summary;
}

StudyDefinition study_of(const SessionIdentity& identity) {
  StudyDefinition study = parse_study(identity.study_json, "the study of session " + identity.participant);
  study.image_hashes = identity.image_hashes;
  return study;
}

}  // namespace plenolab
