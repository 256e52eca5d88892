#include "experiments/cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace plenolab {

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), terminal_(::isatty(STDERR_FILENO) == 1), start_(Clock::now()) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

void ProgressBar::update(double share_done) {
  share_done_ = std::clamp(share_done, 0.0, 1.0);
  draw();
}

void ProgressBar::remark(const std::string& text) {
  remark_ = text;
  draw();
}

void ProgressBar::draw() {
  if (!terminal_) return;
  const auto now = Clock::now();
  if (drawn_ && now - last_draw_ < std::chrono::milliseconds(100)) return;
  last_draw_ = now;
  drawn_ = true;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  constexpr int kWidth = 24;
  const auto filled = static_cast<std::size_t>(share_done_ * kWidth);
  const std::string left = share_done_ > 0.01
                               ? format_duration(elapsed_s * (1 - share_done_) / share_done_) + " left"
                               : std::string("estimating");
  fmt::print(stderr, "\r\033[K{} [{}{}] {:3.0f} %  {}{}", label_, std::string(filled, '#'),
             std::string(kWidth - filled, '.'), share_done_ * 100, left,
             remark_.empty() ? "" : ", " + remark_);
  std::fflush(stderr);
}

Progress ProgressBar::callback() {
  return [this](double share_done) { update(share_done); };
}

std::string format_duration(double seconds) {
  const long total = std::lround(std::max(seconds, 0.0));
  if (total < 60) return fmt::format("{} s", total);
  if (total < 3600) return fmt::format("{} min {:02} s", total / 60, total % 60);
  return fmt::format("{} h {:02} min", total / 3600, total % 3600 / 60);
}

}  // namespace plenolab
