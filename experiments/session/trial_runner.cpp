#include "experiments/session/trial_runner.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

[[noreturn]] void stop(Recorder& recorder) {
  recorder.write("stopped");
  throw SessionStopped{};
}

/// Asks whether to stop; returns if the session is to go on.
void confirm_stop(Stage& stage, Recorder& recorder, SessionInputs& inputs) {
  recorder.write("paused", "stop_asked");
  stage.draw(page_picture({kStopText, {}, -1, "Return: stop     Esc: go on"}));
  for (;;) {
    stage.flip();
    inputs.poll();
    while (const auto input = inputs.next()) {
      if (is_key(*input, "Return") || input->kind == RawInput::Kind::kClose) stop(recorder);
      if (is_key(*input, "Escape")) return;
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
    if (context_.inputs.pad_is_missing()) pause_for_pad(0);
    while (!machine_.done()) {
      const std::int64_t t_us = context_.stage.flip();
      if (!machine_.paused()) meter_.flipped(t_us);
      context_.recorder.at(t_us, t_us);
      react(machine_.flipped(t_us));
      context_.inputs.poll();
      while (!machine_.done()) {
        const auto input = context_.inputs.next();
        if (!input) break;
        take(*input);
      }
    }
    store_choice();
    context_.inputs.drop_presses();
  }

 private:
  void take(const RawInput& input) {
    if (input.kind == RawInput::Kind::kClose) stop(context_.recorder);
    if (is_key(input, "Escape")) return ask_to_stop(input.t_us);
    const auto press = decoder_.decode(input);
    if (context_.inputs.pad_is_missing() && is_key(input, "Return")) context_.inputs.go_on_with_keyboard();
    if (input.kind == RawInput::Kind::kDisconnected) return pause_for_pad(input.t_us);
    if (machine_.paused() && !context_.inputs.pad_is_missing()) return go_on();
    if (press) react(machine_.pressed(*press, input.t_us), *press, input.name);
  }

  void pause(std::int64_t t_us) {
    machine_.pause(t_us);
    meter_.interrupt();
  }

  void pause_for_pad(std::int64_t t_us) {
    pause(t_us);
    context_.stage.draw(page_picture({kUnpluggedText, {}, -1, ""}));
  }

  void ask_to_stop(std::int64_t t_us) {
    pause(t_us);
    confirm_stop(context_.stage, context_.recorder, context_.inputs);
    // Nothing is known of what was pressed and released while the page was on.
    decoder_ = PressDecoder();
    if (context_.inputs.pad_is_missing()) return pause_for_pad(t_us);
    go_on();
  }

  void go_on() {
    context_.recorder.write("continued");
    react(machine_.resume());
  }

  void react(const TrialReaction& reaction) {
    if (reaction.onset) store_onset(*reaction.onset);
    if (reaction.show) context_.stage.draw(scene_.of(*reaction.show));
  }

  void react(const TrialReaction& reaction, Press press, const std::string& input) {
    nlohmann::ordered_json detail{{"input", input}};
    if (reaction.tone) detail["tone"] = context_.stage.tone();
    if (reaction.vibrate) detail["vibration"] = context_.stage.vibrate();
    if (reaction.press)
      context_.recorder.write("press", name_of(press), name_of(*reaction.press), detail.dump());
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
    context_.recorder.write(shown.again ? "shown_again" : "shown", name_of(shown.stimulus), which,
                            meter_.take(more));
  }

  void store_choice() {
    const bool test = scene_.of(machine_.choice()).shows_test;
    const std::int64_t paused_us = machine_.paused_us();
    const std::int64_t response_us = machine_.chosen_at_us() - machine_.began_at_us() - paused_us;
    context_.recorder.write(
        "choice", name_of(machine_.choice()), test ? "test" : "reference",
        meter_.take(fmt::format(R"("response_us":{},"paused_us":{})", response_us, paused_us)));
  }

  const TrialContext& context_;
  const TrialScene& scene_;
  TrialMachine machine_;
  PressDecoder decoder_;
  FlipMeter meter_;
};

}  // namespace

void SessionInputs::poll() {
  for (RawInput& input : stage_.poll()) waiting_.push_back(std::move(input));
}

std::optional<RawInput> SessionInputs::next() {
  if (waiting_.empty()) return std::nullopt;
  const RawInput input = std::move(waiting_.front());
  waiting_.pop_front();
  recorder_.at(input.t_low_us, input.t_us);
  const bool plugged = input.kind == RawInput::Kind::kConnected;
  const bool unplugged = input.kind == RawInput::Kind::kDisconnected;
  if (plugged) recorder_.write("plugged", input.name);
  if (unplugged) recorder_.write("unplugged");
  if (plugged || unplugged) pad_is_missing_ = unplugged;
  return input;
}

void SessionInputs::drop_presses() {
  std::erase_if(waiting_, [](const RawInput& input) {
    const bool pad = input.kind == RawInput::Kind::kPadButton || input.kind == RawInput::Kind::kTrigger;
    const bool key = input.kind == RawInput::Kind::kKey || input.kind == RawInput::Kind::kText;
    return pad || (key && !is_key(input, "Escape"));
  });
}

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

std::string ask(Stage& stage, Recorder& recorder, SessionInputs& inputs, const FormQuestion& question,
                const std::string& banner) {
  FormMachine form(question);
  const auto draw = [&] { stage.draw(form_picture(form, banner)); };
  draw();
  while (!form.done()) {
    const std::int64_t t_us = stage.flip();
    recorder.at(t_us, t_us);
    inputs.poll();
    while (!form.done()) {
      const auto input = inputs.next();
      if (!input) break;
      if (input->kind == RawInput::Kind::kClose) stop(recorder);
      const bool escape = is_key(*input, "Escape"), text = input->kind == RawInput::Kind::kText;
      const auto press = form_press(*input);
      if (escape) confirm_stop(stage, recorder, inputs);
      if (escape) recorder.write("continued");
      if (text) form.type(input->name);
      if (press) form.press(*press);
      if (escape || text || press) draw();
    }
  }
  inputs.drop_presses();
  return form.answer();
}

}  // namespace plenolab
