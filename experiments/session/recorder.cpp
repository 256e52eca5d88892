#include "experiments/session/recorder.h"

#include <fmt/format.h>

#include <algorithm>

namespace plenolab {

Recorder::Recorder(SessionStore& store, int run, std::function<void(const SessionEvent&)> on_event)
    : store_(store), run_(run), on_event_(std::move(on_event)) {}

void Recorder::at(std::int64_t t_low_us, std::int64_t t_us) {
  t_low_us_ = t_low_us;
  t_us_ = t_us;
}

void Recorder::write(const std::string& kind, const std::string& what, const std::string& outcome,
                     const std::string& detail) {
  SessionEvent event;
  event.run = run_;
  event.t_us = t_us_;
  event.t_low_us = t_low_us_;
  event.position = place_.position;
  event.trial = place_.trial;
  event.attempt = place_.attempt;
  event.block = place_.block;
  event.image = place_.image;
  event.kind = kind;
  event.what = what;
  event.outcome = outcome;
  event.detail = detail;
  store_.append(event);
  if (on_event_) on_event_(event);
}

void FlipMeter::flipped(std::int64_t t_us) {
  if (last_us_ >= 0) {
    const std::int64_t interval_us = t_us - last_us_;
    longest_us_ = std::max(longest_us_, interval_us);
    dropped_ += interval_us > limit_us_ ? 1 : 0;
  }
  ++frames_;
  last_us_ = t_us;
}

std::string FlipMeter::take(const std::string& more) {
  const std::string text = fmt::format(R"({{{}{}"frames":{},"longest_us":{},"dropped":{}}})", more,
                                       more.empty() ? "" : ",", frames_, longest_us_, dropped_);
  frames_ = dropped_ = 0;
  longest_us_ = 0;
  return text;
}

}  // namespace plenolab
