#include "core/lightfield/hci_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/base/error.h"
#include "core/io/pfm.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

constexpr float kHole = -std::numeric_limits<float>::infinity();
constexpr float kCrack_px = 1.0f;

void check_finite(const Plane<float>& plane, const fs::path& file) {
  for (const float v : plane.pixels())
    if (!std::isfinite(v))
      throw InputError(
          fmt::format("{} holds the value {}, but ground truth must be finite", file.string(), v));
}

Plane<float> read_disparity(const fs::path& file, const HciParameters& p) {
  Plane<float> plane = read_pfm_plane(file);
  if (plane.width() != p.width || plane.height() != p.height)
    throw InputError(fmt::format("{} has {} × {} pixels, but parameters.cfg says {} × {}", file.string(),
                                 plane.width(), plane.height(), p.width, p.height));
  check_finite(plane, file);
  return plane;
}

Plane<float> read_depth(const fs::path& file, const HciParameters& p) {
  Plane<float> plane = read_disparity(file, p);
  const double at_one_metre = p.baseline_mm * 1e-3 * p.focal_length_px();
  for (float& v : plane.pixels()) {
    if (!(v > 0))
      throw InputError(fmt::format("{} holds the depth {}, but depth must be positive", file.string(), v));
    v = static_cast<float>(at_one_metre / v - p.focus_disparity_px());
  }
  return plane;
}

Plane<float> read_highres(const fs::path& file, const HciParameters& p) {
  const Plane<float> fine = read_pfm_plane(file);
  const int factor = fine.width() / p.width;
  if (factor < 1 || fine.width() != factor * p.width || fine.height() != factor * p.height)
    throw InputError(fmt::format("{} has {} × {} pixels, which is no multiple of {} × {}", file.string(),
                                 fine.width(), fine.height(), p.width, p.height));
  check_finite(fine, file);
  Plane<float> plane(p.width, p.height);
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x)
      plane.at(x, y) = fine.at(x * factor + factor / 2, y * factor + factor / 2);
  return plane;
}

using Reader = Plane<float> (*)(const fs::path&, const HciParameters&);

// A surface that is stretched leaves single pixels open through which what is behind it shows.
void close_cracks(Plane<float>& d) {
  const Plane<float> before = d;
  const auto closed = [](float value, float a, float b) {
    const float farther = std::min(a, b);
    return farther - value > kCrack_px && std::abs(a - b) < kCrack_px ? farther : value;
  };
  for (int y = 0; y < d.height(); ++y)
    for (int x = 0; x < d.width(); ++x) {
      if (x > 0 && x + 1 < d.width())
        d.at(x, y) = closed(d.at(x, y), before.at(x - 1, y), before.at(x + 1, y));
      if (y > 0 && y + 1 < d.height())
        d.at(x, y) = closed(d.at(x, y), before.at(x, y - 1), before.at(x, y + 1));
    }
}

void fill_row(float* row, int width, float otherwise) {
  for (int x = 0; x < width; ++x) {
    if (row[x] != kHole) continue;
    int end = x;
    while (end < width && row[end] == kHole) ++end;
    const float left = x > 0 ? row[x - 1] : kHole, right = end < width ? row[end] : kHole;
    const float fill = left == kHole && right == kHole ? otherwise
                       : left == kHole                 ? right
                       : right == kHole                ? left
                                                       : std::min(left, right);
    std::fill(row + x, row + end, fill);
    x = end;
  }
}

}  // namespace

Plane<float> spread_disparity(const Plane<float>& centre, double columns_away, double rows_away) {
  Plane<float> out(centre.width(), centre.height(), kHole);
  for (int y = 0; y < centre.height(); ++y)
    for (int x = 0; x < centre.width(); ++x) {
      const float d = centre.at(x, y);
      const double u = std::floor(x + 0.5 - columns_away * d), v = std::floor(y + 0.5 - rows_away * d);
      if (!(u >= 0 && v >= 0 && u < out.width() && v < out.height())) continue;
      float& there = out.at(static_cast<int>(u), static_cast<int>(v));
      there = std::max(there, d);
    }
  close_cracks(out);
  const float farthest = *std::min_element(centre.pixels().begin(), centre.pixels().end());
  for (int y = 0; y < out.height(); ++y) fill_row(out.row(y), out.width(), farthest);
  return out;
}

HciTruth find_hci_truth(const fs::path& folder, const HciParameters& p) {
  for (const auto& [name, read] :
       {std::pair<const char*, Reader>{"gt_disp_lowres", read_disparity}, {"gt_depth_lowres", read_depth}})
    if (fs::exists(folder / fmt::format("{}_Cam000.pfm", name)))
      return [=, name = name, read = read](int column, int row) {
        return read(folder / fmt::format("{}_Cam{:03}.pfm", name, row * p.columns + column), p);
      };
  for (const auto& [name, read] : {std::pair<const char*, Reader>{"gt_disp_lowres.pfm", read_disparity},
                                   {"gt_depth_lowres.pfm", read_depth},
                                   {"gt_disp_highres.pfm", read_highres}})
    if (fs::exists(folder / name))
      return [centre = std::make_shared<const Plane<float>>(read(folder / name, p)), p](int column, int row) {
        return spread_disparity(*centre, column - (p.columns - 1) / 2.0, row - (p.rows - 1) / 2.0);
      };
  throw InputError(
      fmt::format("{} has no ground truth (gt_disp_lowres.pfm or one of its variants)", folder.string()));
}

}  // namespace plenolab
