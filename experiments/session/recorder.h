#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "experiments/session/store.h"

namespace plenolab {

/// Writes the events of one run of a session, each with the place in the session where it happened.
class Recorder {
 public:
  Recorder(SessionStore& store, int run, std::function<void(const SessionEvent&)> on_event);

  /// Where the session is from now on; zero and empty outside.
  struct Place {
    int position = 0, trial = 0, attempt = 0;
    std::string block, image;
  };
  void go_to(Place place) { place_ = std::move(place); }

  /// Times the next events: between the two.
  void at(std::int64_t t_low_us, std::int64_t t_us);
  /// The time of the next event.
  std::int64_t t_us() const { return t_us_; }
  /// Stores an event; on return it is on the disk.
  void write(const std::string& kind, const std::string& what = {}, const std::string& outcome = {},
             const std::string& detail = {});

 private:
  SessionStore& store_;
  int run_;
  std::function<void(const SessionEvent&)> on_event_;
  Place place_;
  std::int64_t t_low_us_ = 0, t_us_ = 0;
};

/// Measures the flips while one thing is on the display. A frame counts as dropped when it took more than one
/// and a half times the display's interval.
class FlipMeter {
 public:
  explicit FlipMeter(double interval_ms) : limit_us_(static_cast<std::int64_t>(1500 * interval_ms)) {}

  void flipped(std::int64_t t_us);
  /// What lies between the flips before and after is a pause, no frame.
  void interrupt() { last_us_ = -1; }
  /// What was measured since the last call as JSON: {"frames":…,"longest_us":…,"dropped":…} with `more`
  /// (members of an object, or empty) in front.
  std::string take(const std::string& more = {});

 private:
  std::int64_t limit_us_, last_us_ = -1, longest_us_ = 0;
  int frames_ = 0, dropped_ = 0;
};

}  // namespace plenolab
