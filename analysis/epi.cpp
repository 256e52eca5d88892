#include "analysis/epi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"

namespace plenolab {
namespace {

template <class Image>
void check_frames(std::span<const Image> frames, EpiDirection direction, int line) {
  if (frames.empty()) throw InputError("an EPI needs at least one frame");
  const Image& first = frames.front();
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (frames[i].width() != first.width() || frames[i].height() != first.height()) {
      throw InputError(
          fmt::format("frame {} has {}×{} pixels but frame 0 has {}×{}; frames must be of equal size", i,
                      frames[i].width(), frames[i].height(), first.width(), first.height()));
    }
  }
  const bool row = direction == EpiDirection::kRow;
  const int lines = row ? first.height() : first.width();
  if (line < 0 || line >= lines) {
    throw InputError(
        fmt::format("{} {} lies outside the frames, which have {}", row ? "row" : "column", line, lines));
  }
}

template <class Image>
Image slice(std::span<const Image> frames, EpiDirection direction, int line) {
  check_frames(frames, direction, line);
  const int count = static_cast<int>(frames.size());
  const bool row = direction == EpiDirection::kRow;
  Image out(row ? frames[0].width() : count, row ? count : frames[0].height());
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const Image& frame = frames[static_cast<std::size_t>(row ? y : x)];
      out.at(x, y) = row ? frame.at(x, line) : frame.at(line, y);
    }
  }
  return out;
}

std::pair<double, double> on_image(EpiDirection direction, double position, double frame) {
  return direction == EpiDirection::kRow ? std::pair{position, frame} : std::pair{frame, position};
}

}  // namespace

SceneImage epi(std::span<const SceneImage> frames, EpiDirection direction, int line) {
  return slice(frames, direction, line);
}

DisplayImage epi(std::span<const DisplayImage> frames, EpiDirection direction, int line) {
  return slice(frames, direction, line);
}

DisplayImage stretch_epi(const DisplayImage& image, EpiDirection direction, int factor) {
  if (factor < 1) throw InputError(fmt::format("an EPI cannot be stretched by {}; use 1 or more", factor));
  const bool row = direction == EpiDirection::kRow;
  DisplayImage out(image.width() * (row ? 1 : factor), image.height() * (row ? factor : 1));
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x)
      out.at(x, y) = row ? image.at(x, y / factor) : image.at(x / factor, y);
  }
  return out;
}

double expected_epi_slope(double disparity_px, double step_in_spacings, double vertical_ratio) {
  return -disparity_px * step_in_spacings * vertical_ratio;
}

DisplayImage draw_epi_lines(DisplayImage image, EpiDirection direction, std::span<const EpiLine> lines) {
  const bool row = direction == EpiDirection::kRow;
  const int frames = row ? image.height() : image.width(), positions = row ? image.width() : image.height();
  for (const EpiLine& line : lines) {
    // Steps of at most a quarter of a frame and of a pixel leave no gaps.
    const double slope = std::min(1e3, std::abs(line.slope_px_per_frame));
    const int steps = 4 * std::max(1, static_cast<int>(std::ceil(slope)));
    for (int i = 0; i < frames * steps; ++i) {
      const double frame = static_cast<double>(i) / steps;
      const double position = line.position_px + line.slope_px_per_frame * (frame - (line.frame + 0.5));
      if (!(position >= 0 && position < positions)) continue;
      const auto [x, y] = on_image(direction, position, frame);
      image.at(static_cast<int>(x), static_cast<int>(y)) = line.colour;
    }
  }
  return image;
}

}  // namespace plenolab
