#include "experiments/session/observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {

namespace {

constexpr std::uint64_t kTrialPurpose = 0x6f62732d7472696cull;
constexpr std::uint64_t kTraitPurpose = 0x6f62732d74726169ull;
constexpr std::int64_t kTap_us = 60'000;  // how long a button is held
constexpr std::int64_t kRetry_us = 1'500'000;

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0;
  for (const char c : text) hash = mix64(hash ^ static_cast<unsigned char>(c));
  return hash;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

const std::vector<std::string>& observer_names() {
  static const std::vector<std::string> names{"ideal",           "guessing",  "lapsing",
                                              "position-biased", "impatient", "unplugging"};
  return names;
}

ObserverKind observer_named(const std::string& name) {
  const auto found = std::find(observer_names().begin(), observer_names().end(), name);
  PLENOLAB_CHECK(found != observer_names().end(), name);
  return static_cast<ObserverKind>(found - observer_names().begin());
}

double default_rate(ObserverKind kind) {
  switch (kind) {
    case ObserverKind::kLapsing:
      return 0.1;
    case ObserverKind::kPositionBiased:
      return 0.8;
    case ObserverKind::kImpatient:
    case ObserverKind::kUnplugging:
      return 0.5;
    default:
      return 0;
  }
}

WrongProbabilities read_wrong_probabilities(const std::filesystem::path& file) {
  std::istringstream in(read_text_file(file, 1u << 20));
  WrongProbabilities result;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (++number == 1 && line != "block,image,wrong")
      throw InputError(fmt::format("{}: the first line must be \"block,image,wrong\"", file.string()));
    if (number == 1 || line.empty()) continue;
    const std::vector<std::string> fields = fields_of(line);
    double wrong = -1;
    if (fields.size() == 3) std::from_chars(fields[2].data(), fields[2].data() + fields[2].size(), wrong);
    if (!(wrong >= 0 && wrong <= 1))
      throw InputError(
          fmt::format("{}: line {} must be block,image,probability from 0 to 1", file.string(), number));
    result[fields[0].empty() ? fields[1] : fields[0] + "/" + fields[1]] = wrong;
  }
  return result;
}

Observer::Observer(ObserverOptions options) : options_(std::move(options)), random_(0, 0, 0) {}

/// A number in [0, 1) that is this participant's for this matter.
double Observer::uniform(const std::string& what) const {
  return unit_double(random_u64(options_.seed, kTraitPurpose,
                                hash_of(what) ^ mix64(static_cast<std::uint64_t>(options_.number))));
}

void Observer::add(PadAction action) {
  const auto later = [&](const PadAction& a) { return a.t_us > action.t_us; };
  actions_.insert(std::find_if(actions_.begin(), actions_.end(), later), action);
}

void Observer::tap(const std::string& button, std::int64_t t_us) {
  add({t_us, PadAction::Kind::kButton, button, true});
  add({t_us + kTap_us, PadAction::Kind::kButton, button, false});
}

void Observer::push(const std::string& trigger, std::int64_t t_us) {
  add({t_us, PadAction::Kind::kTrigger, trigger, true});
  add({t_us + kTap_us, PadAction::Kind::kTrigger, trigger, false});
}

void Observer::choose(std::int64_t t_us) {
  tap("leftshoulder", t_us);
  tap("rightshoulder", t_us + 20'000);
}

void Observer::pull_plug(std::int64_t t_us) {
  add({t_us, PadAction::Kind::kButton, "leftshoulder", true});
  add({t_us, PadAction::Kind::kButton, "rightshoulder", true});
  add({t_us + 100'000, PadAction::Kind::kUnplug, "", false});
  add({t_us + 900'000, PadAction::Kind::kPlug, "", false});
}

void Observer::press(Stimulus stimulus, std::int64_t t_us) {
  static constexpr const char* kFace[] = {"a", "b", "x", "y"};
  if (stimulus == Stimulus::kReference)
    tap(kFace[random_.next_u64() % 4], t_us);
  else
    push(stimulus == Stimulus::kLeft ? "lefttrigger" : "righttrigger", t_us);
  retry_us_ = t_us + kRetry_us;
}

std::int64_t Observer::dwell_us() {
  return 600'000 + static_cast<std::int64_t>(random_.next_double() * 900'000);
}

std::optional<PadAction> Observer::next(std::int64_t until_us) {
  if (actions_.empty() && retry_us_ >= 0 && retry_us_ < until_us) act(retry_us_);
  if (actions_.empty() || actions_.front().t_us >= until_us) return std::nullopt;
  const PadAction action = actions_.front();
  actions_.pop_front();
  return action;
}

void Observer::sees(const Picture& picture, std::int64_t t_us) {
  present_ = picture;
  if (picture.kind == Picture::Kind::kPage) return see_page(picture, t_us);
  if (picture.block + "/" + picture.image != trial_) begin_trial(picture);
  if (picture.kind == Picture::Kind::kBlack) return see_black(picture, t_us);
  see_image(picture, t_us);
}

void Observer::see_page(const Picture& picture, std::int64_t t_us) {
  retry_us_ = -1;
  if (picture.question.empty() || picture.question == page_) return;  // the first: it is about its own doings
  page_ = picture.question;
  std::int64_t at_us = t_us + 700'000;
  const auto times = [&](const char* button, int count) {
    for (int i = 0; i < count; ++i, at_us += 150'000) tap(button, at_us);
  };
  const auto among = [&](std::size_t count) {
    return static_cast<int>(uniform(page_) * static_cast<double>(count));
  };
  // Takes part: of age, consents, sees well.
  const bool first = page_ == "adult" || page_ == "vision" || page_.find("consent") != std::string::npos;
  if (picture.question_kind == FormQuestion::Kind::kChoice)
    times("dpdown", first ? 1 : 1 + among(picture.page.lines.size()));
  if (picture.question_kind == FormQuestion::Kind::kNumber) times("dpup", 1 + among(20));
  if (picture.question_kind == FormQuestion::Kind::kText)
    add({at_us, PadAction::Kind::kType, fmt::format("Simulated {}", options_.number), true});
  tap("a", at_us + 150'000);
}

void Observer::begin_trial(const Picture& picture) {
  trial_ = picture.block + "/" + picture.image;
  page_.clear();
  step_ = 0;
  wrong_.reset();
  random_ = RandomStream(options_.seed, kTrialPurpose,
                         hash_of(trial_) ^ mix64(static_cast<std::uint64_t>(options_.number)));
  const bool rate_hits = random_.next_double() < options_.rate;
  misbehaves_ =
      rate_hits && (options_.kind == ObserverKind::kImpatient || options_.kind == ObserverKind::kUnplugging);
  takes_left_ = rate_hits && options_.kind == ObserverKind::kPositionBiased;
  const bool left_first = random_.next_double() < 0.5;
  looks_ = {Stimulus::kReference, left_first ? Stimulus::kLeft : Stimulus::kRight,
            left_first ? Stimulus::kRight : Stimulus::kLeft};
  if (random_.next_double() < 0.4) looks_.push_back(Stimulus::kReference);
}

void Observer::see_black(const Picture& picture, std::int64_t t_us) {
  if (step_ > 0) return;  // between two images: the next one comes by itself
  misbehave(picture, t_us);
  press(looks_[0], t_us + dwell_us());
}

double Observer::wrong_probability(const Picture& picture) const {
  if (options_.kind == ObserverKind::kGuessing) return 0.5;
  for (const std::string& key : {picture.block + "/" + picture.image, picture.image}) {
    const auto found = options_.wrong.find(key);
    if (found != options_.wrong.end()) return found->second;
  }
  return 0;
}

void Observer::see_image(const Picture& picture, std::int64_t t_us) {
  if (picture.stimulus == Stimulus::kLeft) test_is_left_ = picture.shows_test;
  if (picture.stimulus == Stimulus::kRight) test_is_left_ = !picture.shows_test;
  const bool wanted = step_ < looks_.size() && picture.stimulus == looks_[step_];
  const bool first_reference = step_ == 0;
  if (wanted) ++step_;
  if (step_ == looks_.size() && !wrong_) {
    const double lapse = options_.kind == ObserverKind::kLapsing ? random_.next_double() : 1;
    const double probability = lapse < options_.rate ? 0.5 : wrong_probability(picture);
    wrong_ = random_.next_double() < probability;
    const bool left = takes_left_ || *wrong_ == test_is_left_;
    looks_.push_back(left ? Stimulus::kLeft : Stimulus::kRight);
    if (looks_.back() == picture.stimulus) ++step_;
  }
  if (misbehaves_ && first_reference) {
    misbehave(picture, t_us);
    if (options_.kind == ObserverKind::kUnplugging) return;  // goes on when the image is back
  }
  act(t_us + dwell_us());
}

/// Presses for the next image it wants, or chooses when there is none.
void Observer::act(std::int64_t t_us) {
  if (step_ < looks_.size()) return press(looks_[step_], t_us);
  if (present_.stimulus != looks_.back()) return press(looks_.back(), t_us);
  choose(t_us);
  retry_us_ = t_us + kRetry_us;
}

void Observer::misbehave(const Picture& picture, std::int64_t t_us) {
  if (!misbehaves_) return;
  const bool black = picture.kind == Picture::Kind::kBlack;
  if (options_.kind == ObserverKind::kUnplugging) {
    if (!black) pull_plug(t_us + 400'000);
    return;
  }
  if (black) {  // before the trial has begun
    choose(t_us + 50'000);
    push("lefttrigger", t_us + 330'000);
    return;
  }
  push("righttrigger", t_us + 40'000);  // too soon
  tap("a", t_us + 320'000);             // the same image again
  choose(t_us + 420'000);               // the reference
}

}  // namespace plenolab
