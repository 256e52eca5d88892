#include "experiments/session/bids.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/provenance.h"
#include "core/base/file.h"

namespace plenolab {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* kNoValue = "n/a";

std::string label_of(const std::string& participant) {
  std::string label;
  for (const char c : participant)
    if (c != '-') label += c;
  return "sub-" + label;
}

/// A field of a TSV file: tabs and line breaks would tear it.
std::string tsv_field(std::string text) {
  for (char& c : text)
    if (c == '\t' || c == '\n' || c == '\r') c = ' ';
  return text.empty() ? kNoValue : text;
}

void write_json(const fs::path& file, const Json& json) {
  write_text_file(file, json.dump(2) + "\n");
}

void write_description(const StudyDefinition& study, const fs::path& out) {
  write_json(out / "dataset_description.json",
             {{"Name", study.title},
              {"BIDSVersion", "1.8.0"},
              {"DatasetType", "raw"},
              {"GeneratedBy", Json::array({{{"Name", "plenolab"}, {"Version", build_info().version}}})}});
  write_text_file(out / ".bidsignore", "trials.csv\nevents.csv\nleft_out.csv\nstudy.json\nrun.json\n");
  write_text_file(
      out / "README",
      fmt::format("{}\n\nDelayed matching to sample with two intervals: which of two images is equal to "
                  "the reference?\nOne run for each block, in the order in which participants had them. "
                  "trials.csv and events.csv hold the same\ntrials and all events in one table each; "
                  "left_out.csv names the sessions that gave none; study.json is the study that was run.\n",
                  study.title));
}

std::vector<std::string> question_ids(const StudyDefinition& study) {
  std::vector<std::string> ids;
  if (study.demographics.age) ids.push_back("age");
  if (study.demographics.sex) ids.push_back("sex");
  if (study.demographics.vision) ids.push_back("vision");
  for (const StudyQuestion& question : study.questionnaire) ids.push_back(question.id);
  return ids;
}

void write_participants(std::span<const ExportedSession> sessions, const StudyDefinition& study,
                        const fs::path& out) {
  const std::vector<std::string> ids = question_ids(study);
  std::string text = "participant_id\tmode\torder\tstate\truns";
  for (const std::string& id : ids) text += fmt::format("\t{}", id);
  text += "\n";
  for (const ExportedSession& s : sessions) {
    const std::string order = s.summary.trials.empty() ? kNoValue : s.summary.trials.front().order;
    text += fmt::format("{}\t{}\t{}\t{}\t{}", label_of(s.stored.identity.participant),
                        name_of(s.stored.identity.mode), order, name_of(s.summary.state), s.summary.runs);
    for (const std::string& id : ids) {
      const auto& answers = s.summary.answers;
      const auto found = std::find_if(answers.begin(), answers.end(),
                                      [&](const SessionAnswer& a) { return a.question == id; });
      text += fmt::format("\t{}", tsv_field(found == answers.end() ? "" : found->answer));
    }
    text += "\n";
  }
  write_text_file(out / "participants.tsv", text);
  Json json{{"mode", {{"Description", "real, pilot or simulated participant"}}},
            {"order", {{"Description", "name of the order of blocks"}}},
            {"state", {{"Description", "done or interrupted"}}},
            {"runs", {{"Description", "times the session was started; more than 1: it was resumed"}}}};
  if (study.demographics.age) json["age"] = {{"Description", "age; n/a: not said"}, {"Units", "years"}};
  if (study.demographics.sex) json["sex"] = {{"Description", "as answered"}};
  if (study.demographics.vision)
    json["vision"] = {{"Description", "as answered; far-sighted people are excluded"}};
  for (const StudyQuestion& question : study.questionnaire)
    json[question.id] = {{"Description", question.text}};
  write_json(out / "participants.json", json);
}

void write_sidecars(const fs::path& out) {
  const auto described = [](const char* text) { return Json{{"Description", text}}; };
  const auto seconds = [](const char* text) { return Json{{"Description", text}, {"Units", "s"}}; };
  write_json(
      out / "task-matching_beh.json",
      {{"TaskName", "matching"},
       {"TaskDescription", "Choose which of two images is equal to the reference"},
       {"block", described("id of the block")},
       {"display", described("light-field or monitor")},
       {"trial", described("1-based in the block")},
       {"image", described("id of the image")},
       {"catch", described("1: the test image is plainly different")},
       {"test_first", described("1: the left trigger showed the test image")},
       {"chose_test", described("1: took the test image for the reference (wrong)")},
       {"response_time", seconds("from the first black frame of the trial to the choice, without pauses")},
       {"views_reference", described("times the reference was shown")},
       {"views_a", described("times the image of the left trigger was shown")},
       {"views_b", described("times the image of the right trigger was shown")},
       {"refused", described("choices that were refused")},
       {"attempt", described("more than 1: the trial was interrupted and repeated")},
       {"paused", seconds("pad unplugged, or asked whether to stop; not in response_time")},
       {"dropped_frames", described("frames that took more than one and a half display intervals")},
       {"longest_frame", seconds("longest time between two flips")}});
  write_json(out / "task-matching_events.json",
             {{"TaskName", "matching"},
              {"onset", seconds("from the first event of the run of the program in this block")},
              {"duration", described("n/a: an event has none of its own")},
              {"trial_type", described("kind of event")},
              {"what", described("button, image or answer")},
              {"outcome", described("what came of it")},
              {"trial", described("1-based in the block")},
              {"attempt", described("of the trial")},
              {"program_run", described("1: first start of the session; onset counts anew in each")},
              {"onset_low", seconds("the event happened after this time and not after onset")}});
}

std::string beh_tsv(const ExportedSession& session, int position) {
  std::string text =
      "block\tdisplay\ttrial\timage\tcatch\ttest_first\tchose_test\tresponse_time\tviews_reference\tviews_"
      "a\tviews_b\t"
      "refused\tattempt\tpaused\tdropped_frames\tlongest_frame\n";
  for (const TrialRecord& t : session.summary.trials)
    if (t.position == position)
      text +=
          fmt::format("{}\t{}\t{}\t{}\t{:d}\t{:d}\t{:d}\t{:.6f}\t{}\t{}\t{}\t{}\t{}\t{:.6f}\t{}\t{:.6f}\n",
                      t.block, name_of(t.display), t.trial, t.image, t.catch_trial, t.test_first,
                      t.chose_test, t.response_s, t.views_reference, t.views_a, t.views_b, t.refused,
                      t.attempt, static_cast<double>(t.paused_us) * 1e-6, t.dropped_frames,
                      static_cast<double>(t.longest_frame_us) * 1e-6);
  return text;
}

std::string events_tsv(const ExportedSession& session, int position) {
  std::string text = "onset\tduration\ttrial_type\twhat\toutcome\ttrial\tattempt\tprogram_run\tonset_low\n";
  std::map<int, std::int64_t> zero_us;  // of each run of the program
  for (const SessionEvent& e : session.stored.events) {
    if (e.position != position) continue;
    const std::int64_t zero = zero_us.try_emplace(e.run, e.t_us).first->second;
    const auto seconds = [&](std::int64_t t_us) { return static_cast<double>(t_us - zero) * 1e-6; };
    text +=
        fmt::format("{:.6f}\tn/a\t{}\t{}\t{}\t{}\t{}\t{}\t{:.6f}\n", seconds(e.t_us), e.kind,
                    tsv_field(e.what), tsv_field(e.outcome), e.trial, e.attempt, e.run, seconds(e.t_low_us));
  }
  return text;
}

}  // namespace

void write_bids(std::span<const ExportedSession> sessions, const fs::path& out) {
  const StudyDefinition& study = sessions.front().study;
  write_description(study, out);
  write_participants(sessions, study, out);
  write_sidecars(out);
  for (const ExportedSession& session : sessions) {
    const std::string label = label_of(session.stored.identity.participant);
    int last = 0;
    for (const SessionEvent& event : session.stored.events) last = std::max(last, event.position);
    for (int position = 1; position <= last; ++position) {
      const fs::path stem = out / label / "beh" / fmt::format("{}_task-matching_run-{}", label, position);
      write_text_file(stem.string() + "_beh.tsv", beh_tsv(session, position));
      write_text_file(stem.string() + "_events.tsv", events_tsv(session, position));
    }
  }
}

}  // namespace plenolab
