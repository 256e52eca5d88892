// Beyond the thesis: its study with simulated participants, through the program that runs real ones.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/timing.h"
#include "core/base/file.h"
#include "core/io/image_file.h"
#include "experiments/reproduce/study/published.h"
#include "experiments/reproduce/study/study_item.h"
#include "experiments/session/export.h"
#include "experiments/session/session_folders.h"
#include "experiments/session/simulate.h"

namespace plenolab {
namespace fs = std::filesystem;

ReproductionResult reproduce_simulated_study(Laboratory& laboratory);

namespace {

constexpr int kParticipants = 34;  // as in the thesis
constexpr const char* kCatchImage = "Catch";

/// True rates of choosing the test image: the shares of table 5.1, by "display/image".
WrongProbabilities published_rates() {
  WrongProbabilities rates;
  for (const StudyCount& count : published_main_study())
    rates[count.display + "/" + count.image] =
        static_cast<double>(count.chose_test.hits) / static_cast<double>(count.chose_test.trials);
  return rates;
}

std::string id_of(std::string image) {
  std::replace(image.begin(), image.end(), ' ', '-');
  return image;
}

/// The thesis' study: five images and a catch trial on both displays; blocks are named after their displays,
/// and orders are counterbalanced. Simulated participants look at file names alone: the pictures are single
/// pixels.
StudyDefinition study_of_thesis(const fs::path& folder) {
  StudyDefinition study;
  study.title = "The study of Hansen and Klein, simulated";
  study.consent = {"Do you agree?", "Do you agree?", 18, false};
  const StimulusFiles files{"reference.png", "test.png"};
  write_display_image(folder / files.reference, DisplayImage(1, 1));
  write_display_image(folder / files.test, DisplayImage(1, 1, Rgb{1, 1, 1}));
  std::vector<std::string> ids;
  for (const StudyCount& count : published_main_study())
    if (std::find(ids.begin(), ids.end(), id_of(count.image)) == ids.end()) ids.push_back(id_of(count.image));
  ids.push_back(kCatchImage);
  for (const std::string& id : ids) study.images.push_back({id, id == kCatchImage, files, files});
  study.blocks = {{name_of(DisplayKind::kLightField), DisplayKind::kLightField, 0, 1, ids},
                  {name_of(DisplayKind::kMonitor), DisplayKind::kMonitor, 0, 8, ids}};
  study.orders = {{"display-first", {study.blocks[0].id, study.blocks[1].id}},
                  {"monitor-first", {study.blocks[1].id, study.blocks[0].id}}};
  write_text_file(folder / "study.json", format_study(study));
  return study;
}

/// What the sessions came to.
struct SimulatedStudy {
  Study analysed;
  WrongProbabilities rates;  ///< true ones, by "display/image" as analysed
  ExportCounts counts;
  double seconds = 0;
  std::int64_t shortest_black_us = 0;
  int images_shown = 0;
};

/// The shortest black before an image, over all events of all sessions.
void measure_black(const fs::path& sessions, SimulatedStudy& result) {
  for (const fs::path& folder : session_folders(sessions)) {
    std::int64_t black_since_us = 0;
    for (const SessionEvent& event : read_session(folder).events) {
      if (event.kind != "shown" && event.kind != "shown_again") continue;
      if (event.what == name_of(Stimulus::kBlack)) {
        black_since_us = event.t_us;
        continue;
      }
      const std::int64_t black_us = event.t_us - black_since_us;
      result.shortest_black_us =
          result.images_shown == 0 ? black_us : std::min(result.shortest_black_us, black_us);
      ++result.images_shown;
    }
  }
}

SimulatedStudy simulate(std::uint64_t seed) {
  const TemporaryFolder folder;
  SimulatedStudy result;
  study_of_thesis(folder.path());
  for (const auto& entry : published_rates()) result.rates[id_of(entry.first)] = entry.second;
  SimulationOptions options;
  options.participants = kParticipants;
  options.observer.wrong = result.rates;
  options.observer.seed = seed;
  const fs::path sessions = folder.path() / "sessions", out = folder.path() / "exported";
  const Stopwatch watch;
  simulate_study(folder.path(), sessions, options);
  result.seconds = watch.seconds();
  result.counts = export_sessions(sessions, SessionMode::kSimulated, out);
  measure_black(sessions, result);
  const CsvTable table = parse_csv(read_text_file(out / "trials.csv"), "trials.csv");
  StudyOptions study = published_options();
  study.seed = seed;
  result.analysed = analyse_trials(parse_study_trials(table), study);
  return result;
}

struct Recovery {
  int rows = 0, within = 0;  ///< true rate inside the exact interval
  int right = 0;             ///< verdict that the true rate deserves
  std::string undeserved;    ///< the others, e.g. "Image-3 on monitor (failed with 9 of 34, true rate 0.324)"
};

Recovery recovery_of(const SimulatedStudy& simulated) {
  Recovery recovery;
  for (const StudyRow& row : simulated.analysed.rows) {
    const double rate = simulated.rates.at(row.count.display + "/" + row.count.image);
    ++recovery.rows;
    recovery.within += row.rate.low <= rate && rate <= row.rate.high ? 1 : 0;
    const bool right = row.passed == (rate > simulated.analysed.options.p_null);
    recovery.right += right ? 1 : 0;
    if (!right)
      recovery.undeserved +=
          fmt::format("{}{} on {} ({} with {} of {}, true rate {:.3f})",
                      recovery.undeserved.empty() ? "" : ", ", row.count.image, row.count.display,
                      verdict_word(row), row.count.chose_test.hits, row.count.chose_test.trials, rate);
  }
  return recovery;
}

void add_rows(ReproductionResult& result, const SimulatedStudy& simulated, const Recovery& recovery) {
  const auto add = [&](const char* quantity, double value, const char* unit) {
    result.rows.add({quantity, value, unit, {}});
  };
  add("sessions_done", simulated.counts.done, "sessions");
  add("trials_completed", simulated.counts.trials, "trials");
  add("events_stored", simulated.counts.events, "events");
  add("shortest_black", static_cast<double>(simulated.shortest_black_us) * 1e-6, "s");
  add("true_rates_in_interval", recovery.within, "rows");
  add("verdicts_deserved", recovery.right, "rows");
  add("seconds", simulated.seconds, "s");
  for (const auto& entry : simulated.rates)
    result.rows.add({"true_rate", entry.second, "1", {{"image", entry.first}}});
}

}  // namespace

ReproductionResult reproduce_simulated_study(Laboratory& laboratory) {
  ReproductionResult result;
  const SimulatedStudy simulated = simulate(laboratory.options().seed);
  const Recovery recovery = recovery_of(simulated);
  result.paper_shows =
      "Section 4 and table 5.1: 34 participants matched five pairs of images on the light-field display and "
      "then on "
      "a monitor with an Xbox pad; their choices are the only data of the study that are left.";
  result.ours_shows = fmt::format(
      "{} simulated participants whose true rates are the shares of table 5.1 went through the whole session "
      "on a "
      "virtual pad, from consent to questionnaire: {} trials and {} stored events in {:.1f} s. Exported and "
      "analysed, "
      "{} of {} true rates lie in their exact 95 % intervals, and {} of {} images get the verdict that their "
      "true "
      "rate deserves{}. The display was black for at least {:.0f} ms before each of the {} images.",
      simulated.counts.done, simulated.counts.trials, simulated.counts.events, simulated.seconds,
      recovery.within, recovery.rows, recovery.right, recovery.rows,
      recovery.undeserved.empty() ? "" : ", all but " + recovery.undeserved,
      static_cast<double>(simulated.shortest_black_us) * 1e-3, simulated.images_shown);
  result.differs = fmt::format(
      "{} Orders of blocks take turns here, where the thesis always began with the light-field display; a "
      "catch trial "
      "a block tells who does not attend. Simulated participants test the procedure, the storage and the "
      "analysis, "
      "and say nothing about what people see.",
      recovery.within == recovery.rows
          ? "Storage and analysis give back what was put in."
          : fmt::format("{} of {} intervals miss their true rate; about one in twenty is expected to.",
                        recovery.rows - recovery.within, recovery.rows));
  add_study(result, simulated.analysed,
            "Choices of the test image by simulated participants with the rates of table 5.1");
  result.add_plot(
      "choices",
      {study_plot(simulated.analysed, true),
       "Choices of the test image by 34 simulated participants, with exact 95 % intervals",
       "Bars for five images on two displays with error bars, and lines at the critical number and at "
       "half of the participants"});
  add_rows(result, simulated, recovery);
  return result;
}

}  // namespace plenolab
