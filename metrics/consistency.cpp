#include "metrics/consistency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"

namespace plenolab {

namespace {

constexpr int kRows = 16;  // of an image in one piece of work

/// Luma, log luminance and disparity of every pixel; log luminance NaN where the pixel takes no part.
struct Planes {
  Plane<float> luma, log_luminance;
  const DisparityMap& disparity;
};

float log_luminance(Rgb c) {
  const float y = luminance(c);
  return y > 0 && std::isfinite(y) ? std::log10(y) : std::numeric_limits<float>::quiet_NaN();
}

Planes planes_of(const ConsistencyView& view, int threads) {
  const int width = view.hdr.width(), height = view.hdr.height();
  const auto same_size = [&](const auto& plane) {
    return plane.width() == width && plane.height() == height;
  };
  if (!same_size(view.mapped) || !same_size(view.disparity_px))
    throw InputError(fmt::format(
        "the tone mapped view is {} × {} pixels, the HDR view {} × {}, the disparity map {} × {}; "
        "they must be equal",
        view.mapped.width(), view.mapped.height(), width, height, view.disparity_px.width(),
        view.disparity_px.height()));
  Planes planes{Plane<float>(width, height), Plane<float>(width, height), view.disparity_px};
  parallel_for(height, kRows, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        planes.luma.at(x, y) = luminance(view.mapped.at(x, y));
        planes.log_luminance.at(x, y) = log_luminance(view.hdr.at(x, y));
      }
  });
  return planes;
}

/// The four pixels around a point and how far it lies between them.
struct Cell {
  int left, top, right, bottom;
  float u, v;
};

/// Nothing for points outside of the outermost pixel centres.
std::optional<Cell> cell_at(const Plane<float>& plane, double x, double y) {
  const double column = x - 0.5, row = y - 0.5;
  if (!(column >= 0 && row >= 0 && column <= plane.width() - 1 && row <= plane.height() - 1))
    return std::nullopt;
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  return Cell{left,
              top,
              std::min(left + 1, plane.width() - 1),
              std::min(top + 1, plane.height() - 1),
              static_cast<float>(column - left),
              static_cast<float>(row - top)};
}

float bilinear(const Plane<float>& plane, const Cell& c) {
  const float upper = plane.at(c.left, c.top) * (1 - c.u) + plane.at(c.right, c.top) * c.u;
  const float lower = plane.at(c.left, c.bottom) * (1 - c.u) + plane.at(c.right, c.bottom) * c.u;
  return upper * (1 - c.v) + lower * c.v;
}

struct Sums {
  std::int64_t pixels = 0;
  double change = 0, square = 0;
};

/// The change of one pixel; nothing if it does not take part.
std::optional<double> change_at(const Planes& from, const Planes& to, const ViewMotion& motion, int x, int y,
                                const ConsistencyOptions& options) {
  const auto disparity = static_cast<double>(from.disparity.at(x, y));
  const double shift = disparity - motion.screen_px;
  const auto cell = cell_at(to.luma, x + 0.5 - motion.x * shift, y + 0.5 - motion.y * shift);
  if (!cell) return std::nullopt;
  for (const int row : {cell->top, cell->bottom})
    for (const int column : {cell->left, cell->right})
      if (!(std::abs(static_cast<double>(to.disparity.at(column, row)) - disparity) <=
            options.same_surface_px))
        return std::nullopt;
  const auto light = static_cast<double>(bilinear(to.log_luminance, *cell) - from.log_luminance.at(x, y));
  if (!(std::abs(light) <= options.same_light_log10)) return std::nullopt;
  return static_cast<double>(bilinear(to.luma, *cell) - from.luma.at(x, y));
}

/// Of two views of equal size.
std::pair<Planes, Planes> planes_of_pair(const ConsistencyView& from, const ConsistencyView& to,
                                         const ConsistencyOptions& options) {
  options.validate();
  std::pair<Planes, Planes> planes{planes_of(from, options.threads), planes_of(to, options.threads)};
  const auto& [a, b] = planes;
  if (a.luma.width() != b.luma.width() || a.luma.height() != b.luma.height())
    throw InputError(fmt::format("the views are {} × {} and {} × {} pixels; they must be equal",
                                 a.luma.width(), a.luma.height(), b.luma.width(), b.luma.height()));
  return planes;
}

/// Sums of absolute differences between neighbours.
struct PairSums {
  std::int64_t pairs = 0;
  double luma = 0, log = 0;
  void add(double luma_difference, double log_difference) {
    ++pairs;
    luma += luma_difference;
    log += log_difference;
  }
};

struct BorderSums {
  PairSums border, inside;
};

void add_pair(BorderSums& sums, const Planes& planes, const Plane<std::uint8_t>& contributors, int x, int y,
              int next_x, int next_y, double same_surface_px) {
  const std::uint8_t here = contributors.at(x, y), next = contributors.at(next_x, next_y);
  if (here == 0 || next == 0) return;
  const auto difference = [&](const Plane<float>& plane) {
    return std::abs(static_cast<double>(plane.at(next_x, next_y)) - static_cast<double>(plane.at(x, y)));
  };
  if (!(difference(planes.disparity) <= same_surface_px)) return;
  const double log = difference(planes.log_luminance);
  if (std::isnan(log)) return;
  (here != next ? sums.border : sums.inside).add(difference(planes.luma), log);
}

/// Ranks from 1; values that are equal but for rounding share their mean rank.
std::vector<double> ranks_of(const std::vector<double>& values) {
  constexpr double kTie = 1e-6;
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    double below = 0, equal = 0;
    for (const double v : values) {
      below += v < values[i] - kTie ? 1 : 0;
      equal += std::abs(v - values[i]) <= kTie ? 1 : 0;
    }
    ranks[i] = below + (equal + 1) / 2;
  }
  return ranks;
}

double largest_step(const std::vector<double>& track) {
  double largest = 0;
  for (std::size_t i = 1; i < track.size(); ++i)
    largest = std::max(largest, std::abs(track[i] - track[i - 1]));
  return largest;
}

}  // namespace

void ConsistencyOptions::validate() const {
  if (!(same_surface_px > 0 && std::isfinite(same_surface_px)))
    throw InputError(fmt::format("same_surface_px is {} but must be a positive number", same_surface_px));
  if (!(same_light_log10 > 0 && std::isfinite(same_light_log10)))
    throw InputError(fmt::format("same_light_log10 is {} but must be a positive number", same_light_log10));
}

Plane<float> change_map_along_lines(const ConsistencyView& from, const ConsistencyView& to,
                                    const ViewMotion& motion, const ConsistencyOptions& options) {
  const auto [a, b] = planes_of_pair(from, to, options);
  Plane<float> changes(a.luma.width(), a.luma.height());
  parallel_for(a.luma.height(), kRows, options.threads, [&, &a = a, &b = b](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < a.luma.width(); ++x)
        changes.at(x, y) = static_cast<float>(
            change_at(a, b, motion, x, y, options).value_or(std::numeric_limits<double>::quiet_NaN()));
  });
  return changes;
}

LineChange change_along_lines(const ConsistencyView& from, const ConsistencyView& to,
                              const ViewMotion& motion, const ConsistencyOptions& options) {
  const auto [a, b] = planes_of_pair(from, to, options);
  std::vector<Sums> rows(static_cast<std::size_t>(a.luma.height()));
  parallel_for(a.luma.height(), kRows, options.threads, [&, &a = a, &b = b](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < a.luma.width(); ++x) {
        const std::optional<double> change = change_at(a, b, motion, x, y, options);
        if (!change) continue;
        Sums& row = rows[static_cast<std::size_t>(y)];
        ++row.pixels;
        row.change += *change;
        row.square += *change * *change;
      }
  });
  Sums all;
  for (const Sums& row : rows) all.pixels += row.pixels, all.change += row.change, all.square += row.square;
  if (all.pixels == 0) return {};
  const auto n = static_cast<double>(all.pixels);
  return {all.pixels, all.change / n, std::sqrt(all.square / n), n / static_cast<double>(a.luma.size())};
}

std::optional<double> BorderChange::excess() const {
  if (!(luma_inside > 0 && log_inside > 0 && log_border > 0)) return std::nullopt;
  return luma_border / luma_inside / (log_border / log_inside);
}

BorderChange change_across_borders(const ConsistencyView& view, const Plane<std::uint8_t>& contributors,
                                   const ConsistencyOptions& options) {
  options.validate();
  const Planes planes = planes_of(view, options.threads);
  const int width = planes.luma.width(), height = planes.luma.height();
  if (contributors.width() != width || contributors.height() != height)
    throw InputError(
        fmt::format("the map of contributing key views is {} × {} pixels, the view {} × {}; they "
                    "must be equal",
                    contributors.width(), contributors.height(), width, height));
  std::vector<BorderSums> rows(static_cast<std::size_t>(height));
  parallel_for(height, kRows, options.threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        BorderSums& row = rows[static_cast<std::size_t>(y)];
        if (x + 1 < width) add_pair(row, planes, contributors, x, y, x + 1, y, options.same_surface_px);
        if (y + 1 < height) add_pair(row, planes, contributors, x, y, x, y + 1, options.same_surface_px);
      }
  });
  PairSums border, inside;
  for (const BorderSums& row : rows)
    for (const auto& [sum, part] : {std::pair{&border, &row.border}, {&inside, &row.inside}})
      sum->pairs += part->pairs, sum->luma += part->luma, sum->log += part->log;
  const auto mean = [](double sum, std::int64_t count) {
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
  };
  return {border.pairs,
          inside.pairs,
          mean(border.luma, border.pairs),
          mean(inside.luma, inside.pairs),
          mean(border.log, border.pairs),
          mean(inside.log, inside.pairs)};
}

double LumaTrack::largest_luma_step() const {
  return largest_step(mean_luma);
}

double LumaTrack::largest_log_step() const {
  return largest_step(mean_log_luminance);
}

std::optional<double> LumaTrack::agreement() const {
  if (mean_luma.size() < 3) return std::nullopt;
  const std::vector<double> a = ranks_of(mean_luma), b = ranks_of(mean_log_luminance);
  const double middle = (static_cast<double>(a.size()) + 1) / 2;
  double products = 0, squares_a = 0, squares_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    products += (a[i] - middle) * (b[i] - middle);
    squares_a += (a[i] - middle) * (a[i] - middle);
    squares_b += (b[i] - middle) * (b[i] - middle);
  }
  if (!(squares_a > 0 && squares_b > 0)) return std::nullopt;
  return products / std::sqrt(squares_a * squares_b);
}

double mean_luma(const DisplayImage& image) {
  PLENOLAB_CHECK(!image.empty(), "no pixels");
  double sum = 0;
  for (const Rgb& c : image.pixels()) sum += static_cast<double>(luminance(c));
  return sum / static_cast<double>(image.size());
}

void append_frame(LumaTrack& track, const DisplayImage& mapped, const SceneImage& hdr) {
  double log = 0;
  std::int64_t lit = 0;
  for (const Rgb& c : hdr.pixels()) {
    const float l = log_luminance(c);
    if (std::isnan(l)) continue;
    log += static_cast<double>(l);
    ++lit;
  }
  if (lit == 0) return;
  track.mean_luma.push_back(mean_luma(mapped));
  track.mean_log_luminance.push_back(log / static_cast<double>(lit));
}

}  // namespace plenolab
