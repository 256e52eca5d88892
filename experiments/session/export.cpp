#include "experiments/session/export.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/result_table.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "experiments/session/bids.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/sqlite.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

std::string events_csv(std::span<const ExportedSession> sessions, bool wall_clock) {
  std::string text =
      "participant,mode,sequence,run,t_us,t_low_us,since_start_s,position,block,trial,attempt,image,kind,"
      "what,"
      "outcome,detail";
  text += wall_clock ? ",utc\r\n" : "\r\n";
  for (const ExportedSession& session : sessions) {
    const auto& events = session.stored.events;
    for (const SessionEvent& e : events) {
      text += fmt::format("{},{},{},{},{},{},{:.3f},{},{},{},{},{},{},{},{},{}",
                          session.stored.identity.participant, name_of(session.stored.identity.mode),
                          e.sequence, e.run, e.t_us, e.t_low_us, seconds_between(events.front().utc, e.utc),
                          e.position, e.block, e.trial, e.attempt, e.image, e.kind, csv_field(e.what),
                          e.outcome, csv_field(e.detail));
      text += wall_clock ? fmt::format(",{}\r\n", e.utc) : "\r\n";
    }
  }
  return text;
}

std::string left_out_csv(std::span<const LeftOutSession> sessions) {
  std::string text = "session,reason\r\n";
  for (const LeftOutSession& session : sessions)
    text += fmt::format("{},{}\r\n", csv_field(session.session), session.reason);
  return text;
}

/// Sessions of one mode: those that give rows, and why the others do not.
class Collector {
 public:
  Collector(SessionMode mode, bool leave_out_damaged) : mode_(mode), leave_out_damaged_(leave_out_damaged) {}

  void take(const fs::path& folder) {
    const std::string name = folder.filename().string();
    if (!name.starts_with(std::string(name_of(mode_)) + "-")) return;
    ExportedSession session;
    try {
      if (!holds_session(folder)) return leave_out(name, "cut off while it was created");
      session.stored = read_session(folder);
      session.study = study_of(session.stored.identity);
      session.summary = summarise(session.stored.identity, session.study, session.stored.events);
    } catch (const DatabaseInUse&) {
      return leave_out(name, "in use");
    } catch (const InputError& error) {
      if (leave_out_damaged_) return leave_out(name, "damaged");
      throw InputError(
          fmt::format("{}; nothing is exported (--leave-out-damaged goes on without it)", error.what()));
    }
    require_own_folder(session.stored.identity, folder);
    const SessionState state = session.summary.state;
    if (state == SessionState::kDeclined || state == SessionState::kExcluded)
      return leave_out(name, name_of(state));
    if (!session.summary.consented) return leave_out(name, "no consent");
    collected.push_back(std::move(session));
  }

  std::vector<ExportedSession> collected;
  std::vector<LeftOutSession> left_out;

 private:
  void leave_out(const std::string& name, const char* reason) { left_out.push_back({name, reason}); }

  SessionMode mode_;
  bool leave_out_damaged_;
};

void require_something(const Collector& found, const fs::path& sessions, SessionMode mode) {
  if (!found.collected.empty()) return;
  if (found.left_out.empty())
    throw InputError(fmt::format("{} holds no {} sessions (--mode chooses which are exported)",
                                 sessions.string(), name_of(mode)));
  std::string list;
  for (const LeftOutSession& left : found.left_out)
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", left.session, left.reason);
  throw InputError(fmt::format("nothing to export from {}: {}", sessions.string(), list));
}

void require_one_study(std::span<const ExportedSession> sessions) {
  for (const ExportedSession& session : sessions)
    if (session.stored.identity.study_hash != sessions.front().stored.identity.study_hash)
      throw InputError(
          fmt::format("{} and {} ran different versions of the study: they cannot stand in one table",
                      sessions.front().stored.identity.participant, session.stored.identity.participant));
}

void make_private(const fs::path& out) {
  for (const auto& entry : fs::recursive_directory_iterator(out))
    fs::permissions(entry.path(), entry.is_directory() ? fs::perms::owner_all
                                                       : fs::perms::owner_read | fs::perms::owner_write);
  fs::permissions(out, fs::perms::owner_all);
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

ExportCounts export_sessions(const fs::path& sessions, SessionMode mode, const fs::path& out,
                             const ExportOptions& options) {
  Collector found(mode, options.leave_out_damaged);
  for (const fs::path& folder : session_folders(sessions)) found.take(folder);
  require_something(found, sessions, mode);
  require_one_study(found.collected);
  ExportCounts counts{.sessions = static_cast<int>(found.collected.size()), .left_out = found.left_out};
  std::vector<TrialRecord> trials;
  for (const ExportedSession& session : found.collected) {
    trials.insert(trials.end(), session.summary.trials.begin(), session.summary.trials.end());
    counts.done += session.summary.state == SessionState::kDone ? 1 : 0;
    counts.events += static_cast<int>(session.stored.events.size());
    if (!session.summary.trials.empty()) ++counts.orders[session.summary.trials.front().order];
  }
  counts.trials = static_cast<int>(trials.size());
  write_text_file(out / "trials.csv", trials_csv(trials));
  write_text_file(out / "events.csv", events_csv(found.collected, options.wall_clock));
  write_text_file(out / "left_out.csv", left_out_csv(found.left_out));
  write_text_file(out / "study.json", format_study(found.collected.front().study));
  write_bids(found.collected, out);
  make_private(out);
  return counts;
}

}  // namespace plenolab
