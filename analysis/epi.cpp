#include "analysis/epi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
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

using Field = Plane<double>;

std::vector<double> gaussian(double sigma) {
  const int radius = std::max(1, static_cast<int>(std::ceil(3 * sigma)));
  std::vector<double> kernel;
  double sum = 0;
  for (int i = -radius; i <= radius; ++i)
    sum += kernel.emplace_back(std::exp(-0.5 * i * i / (sigma * sigma)));
  for (double& k : kernel) k /= sum;
  return kernel;
}

/// Separable correlation with an odd kernel; pixels beyond the border repeat the border.
Field filtered(const Field& field, const std::vector<double>& kernel_x, const std::vector<double>& kernel_y) {
  const auto pass = [](const Field& in, const std::vector<double>& kernel, bool along_x) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Field out(in.width(), in.height(), 0.0);
    for (int y = 0; y < in.height(); ++y) {
      for (int x = 0; x < in.width(); ++x) {
        for (int i = -radius; i <= radius; ++i) {
          const int px = along_x ? std::clamp(x + i, 0, in.width() - 1) : x;
          const int py = along_x ? y : std::clamp(y + i, 0, in.height() - 1);
          out.at(x, y) += kernel[static_cast<std::size_t>(i + radius)] * in.at(px, py);
        }
      }
    }
    return out;
  };
  return pass(pass(field, kernel_x, true), kernel_y, false);
}

/// Mean of channels with the position along x and the frame along y, whatever the direction.
Field brightness(const DisplayImage& image, EpiDirection direction) {
  const bool row = direction == EpiDirection::kRow;
  Field field(row ? image.width() : image.height(), row ? image.height() : image.width());
  for (int y = 0; y < field.height(); ++y) {
    for (int x = 0; x < field.width(); ++x) {
      const Rgb c = row ? image.at(x, y) : image.at(y, x);
      field.at(x, y) = static_cast<double>(c.r + c.g + c.b) / 3;
    }
  }
  return field;
}

Field product(const Field& a, const Field& b) {
  Field out(a.width(), a.height());
  std::transform(a.pixels().begin(), a.pixels().end(), b.pixels().begin(), out.pixels().begin(),
                 [](double p, double q) { return p * q; });
  return out;
}

/// Slope and coherence of one tensor [xx xt; xt tt]. A line of slope m satisfies I_x·m + I_t = 0; the
/// direction of least change is the eigenvector (m, 1) of the smaller eigenvalue.
std::pair<float, float> tensor_direction(double xx, double xt, double tt) {
  const double trace = xx + tt, spread = std::hypot(xx - tt, 2 * xt);
  if (trace < 1e-12) return {0.0f, 0.0f};
  const double along_x = -2 * xt, along_t = xx - tt + spread;
  // Nearly horizontal lines (no motion of the frame axis resolvable) have no finite slope.
  if (along_t < 1e-9 * trace) return {0.0f, 0.0f};
  const double coherence = spread / trace;
  return {static_cast<float>(along_x / along_t), static_cast<float>(coherence * coherence)};
}

std::pair<double, double> on_image(EpiDirection direction, double position, double frame) {
  return direction == EpiDirection::kRow ? std::pair{position, frame} : std::pair{frame, position};
}

void check_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw InputError(fmt::format("{} of the EPI slope estimate is {} but must be positive", name, value));
  }
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

void EpiSlopeOptions::validate() const {
  check_positive(inner_sigma_px, "inner_sigma_px");
  check_positive(outer_sigma_px, "outer_sigma_px");
}

EpiSlopes epi_slopes(const DisplayImage& image, EpiDirection direction, const EpiSlopeOptions& options) {
  options.validate();
  const Field field = brightness(image, direction);
  // Scharr's smoothing (3, 10, 3)/16 across a central difference keeps the direction of gradients best
  // (Scharr 2000).
  const std::vector<double> difference{-0.5, 0, 0.5}, smooth{3.0 / 16, 10.0 / 16, 3.0 / 16};
  const Field inner = filtered(field, gaussian(options.inner_sigma_px), gaussian(options.inner_sigma_px));
  const Field dx = filtered(inner, difference, smooth), dt = filtered(inner, smooth, difference);
  const std::vector<double> outer = gaussian(options.outer_sigma_px);
  const Field xx = filtered(product(dx, dx), outer, outer), xt = filtered(product(dx, dt), outer, outer);
  const Field tt = filtered(product(dt, dt), outer, outer);
  EpiSlopes slopes{Plane<float>(image.width(), image.height()), Plane<float>(image.width(), image.height())};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const int position = direction == EpiDirection::kRow ? x : y,
                frame = direction == EpiDirection::kRow ? y : x;
      std::tie(slopes.pixels_per_frame.at(x, y), slopes.coherence.at(x, y)) =
          tensor_direction(xx.at(position, frame), xt.at(position, frame), tt.at(position, frame));
    }
  }
  return slopes;
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
