#include "experiments/session/runner.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/base/content_hash.h"
#include "core/base/error.h"
#include "experiments/session/consent.h"
#include "experiments/session/plan.h"
#include "experiments/session/questions.h"
#include "experiments/session/recorder.h"
#include "experiments/session/trial_runner.h"

namespace plenolab {

namespace {

constexpr double kIntervalTolerance = 0.1;  // measured against stated interval of a display

/// Whether the black between images can be trusted on this display, in words if not.
std::string timing_fault(const DisplayReport& display) {
  if (!display.vsync) return "its flips do not wait for the display";
  if (display.refresh_hz <= 0) return "the rate it keeps is unknown";
  const double stated_ms = 1000 / display.refresh_hz;
  if (std::abs(display.interval_ms / stated_ms - 1) <= kIntervalTolerance) return "";
  return fmt::format("it states {:.2f} ms a frame, but flips take {:.2f} ms", stated_ms, display.interval_ms);
}

void require_timing(const DisplayReport& display, SessionMode mode, bool any_timing) {
  const std::string fault = timing_fault(display);
  if (!fault.empty() && mode == SessionMode::kReal && !any_timing)
    throw InputError(
        fmt::format("display {} ({}) cannot be trusted with time: {}; use another, or --any-timing to go "
                    "on and have it stored",
                    display.screen, display.name, fault));
}

/// Every picture that a block can show.
std::vector<Picture> pictures_of(const StudyDefinition& study, const std::filesystem::path& images,
                                 const StudyBlock& block) {
  std::vector<Picture> pictures;
  for (const std::string& id : block.images) {
    const StimulusFiles& files = study.image(id).on(block.display);
    for (const std::string& file : {files.reference, files.test})
      pictures.push_back({.kind = Picture::Kind::kImage, .file = images / file, .zoom = block.zoom});
  }
  return pictures;
}

class Session {
 public:
  Session(SessionStore& store, Stage& stage, const RunnerOptions& options)
      : store_(store),
        stage_(stage),
        options_(options),
        study_(study_of(store.identity())),
        plan_(plan_session(study_, store.identity().number)),
        events_(store.events()),
        so_far_(summarise(store.identity(), study_, events_)),
        recorder_(store, so_far_.runs + 1, options.on_event),
        inputs_(stage, recorder_) {
    if (store.identity().mode != SessionMode::kReal)
      banner_ = store.identity().mode == SessionMode::kPilot ? "PILOT: answers do not count" : "SIMULATED";
    for (const SessionEvent& event : events_)
      if (event.kind == "trial_started") ++attempts_[{event.position, event.trial}];
  }

  SessionState run() {
    if (so_far_.state != SessionState::kInterrupted) return so_far_.state;
    store_.require_space();
    tell_time();
    recorder_.write("run_started", name_of(store_.identity().mode), so_far_.runs > 0 ? "resumed" : "new",
                    circumstances());
    try {
      through();
    } catch (const SessionStopped&) {  // on the last page, too: the state stays what it has come to
    }
    return state_;
  }

 private:
  /// Times the next event, which no flip or input brings.
  void tell_time() { recorder_.at(stage_.now_us(), stage_.now_us()); }

  /// What cannot be known later about this run, as JSON.
  std::string circumstances() {
    const StageEquipment equipment = stage_.equipment();
    const nlohmann::ordered_json json{{"study", store_.identity().study_hash},
                                      {"order", plan_.order},
                                      {"pad", equipment.pad.empty() ? "none" : equipment.pad},
                                      {"keyboard", options_.keyboard},
                                      {"audio", equipment.audio ? "yes" : "none"},
                                      {"any_timing", options_.any_timing},
                                      {"note", options_.note}};
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }

  void through() {
    open(study_.text_screen);
    if (!consent() || !person()) return;
    if (so_far_.trials.empty()) read(instruction_page(study_));
    for (std::size_t i = 0; i < plan_.blocks.size(); ++i) block(static_cast<int>(i) + 1);
    open(study_.text_screen);
    for (const FormQuestion& question : closing_questions(study_)) answer(question);
    recorder_.write("session_done");
    state_ = SessionState::kDone;
    read(message("end", "Thank you.\n\nThat was all. Please tell the experimenter."));
  }

  std::string read(const FormQuestion& page) { return ask(stage_, recorder_, inputs_, page, banner_); }

  /// The answer of a question, asked unless it was answered in an earlier run.
  std::string answer(const FormQuestion& question) {
    for (const SessionAnswer& given : so_far_.answers)
      if (given.question == question.id) return given.answer;
    const std::string text = read(question);
    recorder_.write("answer", question.id, "", text);
    return text;
  }

  bool consent() {
    const SessionIdentity& who = store_.identity();
    const std::filesystem::path sessions = store_.folder().parent_path();
    if (so_far_.consented) return require_consent(sessions, who, study_.consent), true;
    if (!consent_exists(sessions, who, study_.consent)) {
      const bool minor = answers_minor(study_.consent, answer(adult_question(study_.consent)));
      ConsentRecord record{.participant = who.participant,
                           .session_created_utc = who.created_utc,
                           .text = study_.consent.text};
      if (!agrees("consent", "participant", record.text, record.name)) return declined();
      if (minor) record.guardian_text = study_.consent.guardian_text;
      if (minor && !agrees("guardian_consent", "guardian", record.guardian_text, record.guardian_name))
        return declined();
      record.given_utc = utc_now();
      store_consent(sessions, record, store_.durability());
    }
    recorder_.write("consent", "", "given");
    return true;
  }

  bool agrees(const std::string& id, const std::string& whose, const std::string& text, std::string& name) {
    if (!answers_agreed(read(consent_question(id, text)))) return false;
    if (study_.consent.signature) name = read(signature_question(id + "_name", whose));
    return true;
  }

  bool declined() {
    recorder_.write("consent", "", "declined");
    state_ = SessionState::kDeclined;
    read(message("declined", "Thank you for your time.\n\nNothing further is asked or stored."));
    return false;
  }

  bool person() {
    for (const FormQuestion& question : person_questions(study_.demographics)) {
      if (!answers_far_sighted(answer(question))) continue;
      recorder_.write("excluded", "vision", "far-sighted");
      state_ = SessionState::kExcluded;
      read(message(
          "excluded",
          "Thank you for your interest.\n\nThe images hold things too near to be seen sharply by far-sighted "
          "eyes, so the test ends here for you."));
      return false;
    }
    return true;
  }

  void open(int screen) {
    if (screen == display_.screen && opened_) return;
    const bool is_open = !opened_ && options_.display && options_.display->screen == screen;
    display_ = is_open ? *options_.display : stage_.open_display(screen);
    opened_ = true;
    tell_time();
    recorder_.write(
        "display", display_.name, display_.vsync ? "vsync" : "no_vsync",
        fmt::format(
            R"({{"screen":{},"width_px":{},"height_px":{},"refresh_hz":{:.3f},"interval_ms":{:.3f}}})",
            display_.screen, display_.width_px, display_.height_px, display_.refresh_hz,
            display_.interval_ms));
    require_timing(display_, store_.identity().mode, options_.any_timing);
  }

  bool block_complete(int position) const {
    const int trials = static_cast<int>(plan_.blocks[static_cast<std::size_t>(position - 1)].trials.size());
    for (int trial = 1; trial <= trials; ++trial)
      if (!so_far_.completed(position, trial)) return false;
    return true;
  }

  void block(int position) {
    if (block_complete(position)) return;
    const PlannedBlock& planned = plan_.blocks[static_cast<std::size_t>(position - 1)];
    const StudyBlock& block = study_.block(planned.block);
    recorder_.go_to({.position = position, .block = block.id});
    recorder_.write("block_started", name_of(block.display));
    open(study_.text_screen);
    read(block_page(study_, block, position, static_cast<int>(plan_.blocks.size())));
    open(block.screen);
    load(planned, block);
    for (std::size_t i = 0; i < planned.trials.size(); ++i)
      trial(position, static_cast<int>(i) + 1, planned.trials[i], block);
    recorder_.go_to({.position = position, .block = block.id});
    recorder_.write("block_done");
    recorder_.go_to({});
  }

  /// Images are read when their block begins, and must be those the session was created with.
  void require_unchanged(const StimulusFiles& files) const {
    for (const std::string& file : {files.reference, files.test}) {
      const auto before = study_.image_hashes.find(file);
      if (before != study_.image_hashes.end() && hash_file(options_.images / file) != before->second)
        throw InputError(
            fmt::format("the image {} has changed since session {} began: put back the one it began "
                        "with, then resume the session",
                        (options_.images / file).string(), store_.identity().participant));
    }
  }

  void load(const PlannedBlock& planned, const StudyBlock& block) {
    std::vector<Picture> pictures;
    for (const PlannedTrial& trial : planned.trials) {
      const TrialScene scene = trial_scene(study_, options_.images, block, trial);
      pictures.insert(pictures.end(), {scene.left, scene.right});
    }
    for (const PlannedTrial& trial : planned.trials)
      require_unchanged(study_.image(trial.image).on(block.display));
    stage_.load(pictures);
  }

  void trial(int position, int number, const PlannedTrial& planned, const StudyBlock& block) {
    if (so_far_.completed(position, number)) return;
    store_.require_space();
    const int attempt = ++attempts_[{position, number}];
    recorder_.go_to({position, number, attempt, block.id, planned.image});
    recorder_.write("trial_started", planned.catch_trial ? "catch" : "",
                    planned.test_first ? "test_left" : "test_right");
    const TrialOptions options{static_cast<std::int64_t>(study_.blank_ms) * 1000, study_.return_to_reference};
    run_trial({stage_, recorder_, inputs_, options, display_.interval_ms},
              trial_scene(study_, options_.images, block, planned));
  }

  SessionStore& store_;
  Stage& stage_;
  const RunnerOptions& options_;
  StudyDefinition study_;
  SessionPlan plan_;
  std::vector<SessionEvent> events_;
  SessionSummary so_far_;
  Recorder recorder_;
  SessionInputs inputs_;
  std::map<std::pair<int, int>, int> attempts_;
  std::string banner_;
  DisplayReport display_;
  bool opened_ = false;
  SessionState state_ = SessionState::kInterrupted;
};

}  // namespace

DisplayReport require_displays(Stage& stage, const StudyDefinition& study,
                               const std::filesystem::path& images, SessionMode mode, bool any_timing) {
  std::set<int> screens;
  for (const StudyBlock& block : study.blocks) screens.insert(block.screen);
  screens.erase(study.text_screen);
  const auto require = [&](int screen) {
    const DisplayReport display = stage.open_display(screen);
    require_timing(display, mode, any_timing);
    for (const StudyBlock& block : study.blocks)
      if (block.screen == screen) stage.load(pictures_of(study, images, block));
    return display;
  };
  for (const int screen : screens) require(screen);
  return require(study.text_screen);  // last: the session begins on it
}

SessionState run_session(SessionStore& store, Stage& stage, const RunnerOptions& options) {
  return Session(store, stage, options).run();
}

}  // namespace plenolab
