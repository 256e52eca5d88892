#pragma once

#include <chrono>
#include <string>

#include "core/base/progress.h"

namespace plenolab {

/// One line on stderr with share done and time left, redrawn in place; silent when stderr is not a terminal,
/// so logs and pipes stay clean. The line disappears with the object.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Shows the share done, at most ten times a second.
  void update(double share_done);
  /// Redraws at the last share with a remark behind it, e.g. what was done last.
  void remark(const std::string& text);
  /// Removes the line, e.g. before something else is printed; a later update draws it again.
  void clear();
  /// A callback for long work. The bar must outlive it.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;
  void draw();

  std::string label_, remark_;
  double share_done_ = 0;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_;
  Clock::time_point last_draw_{};
};

/// "12 s", "3 min 05 s", "2 h 10 min".
std::string format_duration(double seconds);

}  // namespace plenolab
