#include "experiments/session/trial_runner.h"

#include <fmt/format.h>

namespace plenolab {

namespace {

constexpr const char* kStopText =
    "Stop the session here?\n\nEverything so far is stored; it can be resumed later with this trial.";
constexpr const char* kUnpluggedText =
    "The controller is unplugged.\n\nPlug it in again: the trial goes on where it was. Return: go on with "
    "the keyboard.";

bool is_key(const RawInput& input, const char* name) {
  return input.kind == RawInput::Kind::kKey && input.down && input.name == name;
}

Picture page_picture(FormPage page) {
  Picture picture{.kind = Picture::Kind::kPage};
  picture.page = std::move(page);
  return picture;
}

Picture form_picture(const FormMachine& form, const std::string& banner) {
  Picture picture = page_picture(form.page());
  picture.question = form.question().id;
  picture.question_kind = form.question().kind;
  picture.banner = banner;
  return picture;
}

/// Asks whether to stop; returns if the session goes on.
void confirm_stop(Stage& stage, Recorder& recorder) {
  recorder.write("paused", "stop_asked");
  stage.draw(page_picture({kStopText, {}, -1, "Return: stop     Esc: go on"}));
  for (;;) {
    stage.flip();
    for (const RawInput& input : stage.poll()) {
      recorder.at(input.t_low_us, input.t_us);
      const bool stop = is_key(input, "Return") || input.kind == RawInput::Kind::kClose;
      if (stop) recorder.write("stopped");
      if (stop) throw SessionStopped{};
      if (is_key(input, "Escape")) return recorder.write("continued");
    }
  }
}

/// The loop of one trial.
class TrialLoop {
 public:
  TrialLoop(const TrialContext& context, const TrialScene& scene)
      : context_(context), scene_(scene), machine_(context.options), meter_(context.interval_ms) {}

  void run() {
    context_.stage.draw(scene_.black);
    while (!machine_.done()) {
      const std::int64_t t_us = context_.stage.flip();
      meter_.flipped(t_us);
      context_.recorder.at(t_us, t_us);
      react(machine_.flipped(t_us));
      for (const RawInput& input : context_.stage.poll()) {
        if (machine_.done()) break;
        context_.recorder.at(input.t_low_us, input.t_us);
        take(input);
      }
    }
    store_choice();
  }

 private:
  void take(const RawInput& input) {
    if (input.kind == RawInput::Kind::kDisconnected) return unplugged(input);
    if (input.kind == RawInput::Kind::kClose) return stop();
    if (is_key(input, "Escape")) return ask_to_stop();
    const bool plugged = input.kind == RawInput::Kind::kConnected;
    if (plugged) context_.recorder.write("plugged");
    if (machine_.paused() && (plugged || is_key(input, "Return"))) return go_on();
    if (const auto press = decoder_.decode(input))
      react(machine_.pressed(*press, input.t_us), *press, input.name);
  }

  void unplugged(const RawInput& input) {
    decoder_.decode(input);
    context_.recorder.write("unplugged");
    machine_.pause();
    context_.stage.draw(page_picture({kUnpluggedText, {}, -1, ""}));
  }

  void stop() {
    context_.recorder.write("stopped");
    throw SessionStopped{};
  }

  void ask_to_stop() {
    machine_.pause();
    confirm_stop(context_.stage, context_.recorder);
    go_on();
  }

  void go_on() {
    context_.recorder.write("continued");
    again_ = true;
    react(machine_.resume());
  }

  void react(const TrialReaction& reaction) {
    if (reaction.onset) store_onset(*reaction.onset);
    if (reaction.show) context_.stage.draw(scene_.of(*reaction.show));
  }

  void react(const TrialReaction& reaction, Press press, const std::string& input) {
    if (reaction.press)
      context_.recorder.write("press", name_of(press), name_of(*reaction.press),
                              fmt::format(R"({{"input":"{}"}})", input));
    if (reaction.tone) context_.stage.tone();
    if (reaction.vibrate) context_.stage.vibrate();
    react(reaction);
  }

  // With what was measured while the thing before was on the display.
  void store_onset(const Onset& shown) {
    const bool black = shown.stimulus == Stimulus::kBlack;
    const std::string more = black ? "" : fmt::format(R"("black_us":{})", shown.black_before_us);
    const std::string which = black                                    ? ""
                              : shown.stimulus == Stimulus::kReference ? "reference"
                              : scene_.of(shown.stimulus).shows_test   ? "test"
                                                                       : "reference";
    context_.recorder.write(again_ && !black ? "shown_again" : "shown", name_of(shown.stimulus), which,
                            meter_.take(more));
    if (!black) again_ = false;
  }

  void store_choice() {
    const bool test = scene_.of(machine_.choice()).shows_test;
    const std::int64_t response_us = machine_.chosen_at_us() - machine_.began_at_us();
    context_.recorder.write("choice", name_of(machine_.choice()), test ? "test" : "reference",
                            meter_.take(fmt::format(R"("response_us":{})", response_us)));
  }

  const TrialContext& context_;
  const TrialScene& scene_;
  TrialMachine machine_;
  PressDecoder decoder_;
  FlipMeter meter_;
  bool again_ = false;  // the next image was on before a pause: no new view
};

}  // namespace

const Picture& TrialScene::of(Stimulus stimulus) const {
  return stimulus == Stimulus::kBlack       ? black
         : stimulus == Stimulus::kReference ? reference
         : stimulus == Stimulus::kLeft      ? left
                                            : right;
}

TrialScene trial_scene(const StudyDefinition& study, const std::filesystem::path& images,
                       const StudyBlock& block, const PlannedTrial& trial) {
  const StimulusFiles& files = study.image(trial.image).on(block.display);
  TrialScene scene;
  scene.black.block = block.id;
  scene.black.image = trial.image;
  const auto picture = [&](Stimulus stimulus, bool test) {
    Picture p{.kind = Picture::Kind::kImage, .file = images / (test ? files.test : files.reference)};
    p.zoom = block.zoom;
    p.stimulus = stimulus;
    p.shows_test = test;
    p.block = block.id;
    p.image = trial.image;
    p.catch_trial = trial.catch_trial;
    return p;
  };
  scene.reference = picture(Stimulus::kReference, false);
  scene.left = picture(Stimulus::kLeft, trial.test_first);
  scene.right = picture(Stimulus::kRight, !trial.test_first);
  return scene;
}

void run_trial(const TrialContext& context, const TrialScene& scene) {
  TrialLoop(context, scene).run();
}

std::string ask(Stage& stage, Recorder& recorder, const FormQuestion& question, const std::string& banner) {
  FormMachine form(question);
  const auto draw = [&] { stage.draw(form_picture(form, banner)); };
  draw();
  while (!form.done()) {
    const std::int64_t t_us = stage.flip();
    recorder.at(t_us, t_us);
    for (const RawInput& input : stage.poll()) {
      recorder.at(input.t_low_us, input.t_us);
      if (input.kind == RawInput::Kind::kClose) recorder.write("stopped");
      if (input.kind == RawInput::Kind::kClose) throw SessionStopped{};
      const bool escape = is_key(input, "Escape"), text = input.kind == RawInput::Kind::kText;
      const auto press = form_press(input);
      if (escape) confirm_stop(stage, recorder);
      if (text) form.type(input.name);
      if (press) form.press(*press);
      if (escape || text || press) draw();
      if (form.done()) break;
    }
  }
  return form.answer();
}

}  // namespace plenolab
