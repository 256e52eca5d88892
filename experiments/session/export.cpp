#include "experiments/session/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/result_table.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/session/bids.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

std::string events_csv(std::span<const ExportedSession> sessions) {
  std::string text =
      "participant,mode,sequence,run,t_us,t_low_us,utc,position,block,trial,attempt,image,kind,what,outcome,"
      "detail\r\n";
  for (const ExportedSession& session : sessions)
    for (const SessionEvent& e : session.stored.events)
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n",
                          session.stored.identity.participant, name_of(session.stored.identity.mode),
                          e.sequence, e.run, e.t_us, e.t_low_us, e.utc, e.position, e.block, e.trial,
                          e.attempt, e.image, e.kind, csv_field(e.what), e.outcome, csv_field(e.detail));
  return text;
}

/// Sessions of the mode that can be read and gave data, with the reasons for the others.
std::vector<ExportedSession> collect(const fs::path& sessions, SessionMode mode, ExportCounts& counts) {
  std::vector<ExportedSession> collected;
  std::string mistaken;
  int of_mode = 0;
  for (const fs::path& folder : session_folders(sessions)) {
    if (!folder.filename().string().starts_with(std::string(name_of(mode)) + "-")) continue;
    ++of_mode;
    try {
      StoredSession stored = read_session(folder);
      if (stored.identity.participant != folder.filename().string() || stored.identity.mode != mode)
        mistaken = fmt::format(
            "{} holds the {} session {}: a copy or a folder that was renamed, so nothing is exported",
            folder.string(), name_of(stored.identity.mode), stored.identity.participant);
      if (!mistaken.empty()) break;
      const StudyDefinition study = study_of(stored.identity);
      SessionSummary summary = summarise(stored.identity, study, stored.events);
      if (summary.state == SessionState::kDeclined || summary.state == SessionState::kExcluded)
        counts.left_out.push_back(fmt::format("{}: {}", stored.identity.participant, name_of(summary.state)));
      else
        collected.push_back({std::move(stored), study, std::move(summary)});
    } catch (const InputError& error) {
      counts.left_out.push_back(error.what());
    }
  }
  if (!mistaken.empty()) throw InputError(mistaken);
  if (of_mode == 0)
    throw InputError(fmt::format("{} holds no {} sessions (--mode chooses which are exported)",
                                 sessions.string(), name_of(mode)));
  return collected;
}

}  // namespace

std::string trials_csv(std::span<const TrialRecord> trials) {
  std::string text =
      "participant,mode,block,position,display,order,trial,image,catch,test_first,chose_test,response_s,"
      "views_reference,views_a,views_b,refused,attempt,paused_s,dropped_frames,session_state\r\n";
  for (const TrialRecord& t : trials)
    text += fmt::format("{},{},{},{},{},{},{},{},{:d},{:d},{:d},{:.6f},{},{},{},{},{},{:.6f},{},{}\r\n",
                        t.participant, name_of(t.mode), t.block, t.position, name_of(t.display), t.order,
                        t.trial, t.image, t.catch_trial, t.test_first, t.chose_test, t.response_s,
                        t.views_reference, t.views_a, t.views_b, t.refused, t.attempt,
                        static_cast<double>(t.paused_us) * 1e-6, t.dropped_frames, name_of(t.session_state));
  return text;
}

ExportCounts export_sessions(const fs::path& sessions, SessionMode mode, const fs::path& out) {
  ExportCounts counts;
  const std::vector<ExportedSession> collected = collect(sessions, mode, counts);
  std::vector<TrialRecord> trials;
  for (const ExportedSession& session : collected) {
    if (session.stored.identity.study_hash != collected.front().stored.identity.study_hash)
      throw InputError(
          fmt::format("{} and {} ran different versions of the study: they cannot stand in one table",
                      collected.front().stored.identity.participant, session.stored.identity.participant));
    trials.insert(trials.end(), session.summary.trials.begin(), session.summary.trials.end());
    counts.done += session.summary.state == SessionState::kDone ? 1 : 0;
    counts.events += static_cast<int>(session.stored.events.size());
  }
  counts.sessions = static_cast<int>(collected.size());
  counts.trials = static_cast<int>(trials.size());
  write_text_file(out / "trials.csv", trials_csv(trials));
  write_text_file(out / "events.csv", events_csv(collected));
  if (!collected.empty()) write_text_file(out / "study.json", format_study(collected.front().study));
  write_bids(collected, out);
  return counts;
}

}  // namespace plenolab
