#include <algorithm>
#include <cmath>

#include "core/tonemap/adjustment/adjustment_view.h"
#include "core/tonemap/adjustment/key_view_adjustment.h"

namespace plenolab {
namespace {

double gaussian(double difference, double sigma) {
  return std::exp(-difference * difference / (2 * sigma * sigma));
}

/// Index of the nearest pixel, with the roundings of single precision: at the middle between two pixels both
/// versions take the same one.
float nearest_pixel(int p, float step, float disparity) {
  const float moved = static_cast<float>(p) + step * disparity;
  return std::floor(moved + 0.5f);
}

class LiteralAdjustment {
 public:
  LiteralAdjustment(const LightField& hdr, const DisplayLightField& tone_mapped,
                    const KeyViewAdjustmentOptions& options, int column, int row)
      : hdr_(hdr),
        tone_mapped_(tone_mapped),
        options_(options),
        column_(column),
        row_(row),
        floor_(smallest_luminance(hdr, 1)),
        view_(read(column, row)),
        weight_(view_.luma.width(), view_.luma.height()),
        luma_(weight_) {}

  const AdjustmentView& view() const { return view_; }

  Plane<float> factors() {
    for (int row = 0; row < hdr_.grid().rows; ++row)
      for (int column = 0; column < hdr_.grid().columns; ++column)
        if (std::hypot(column - column_, row - row_) <= options_.support_views) add(column, row);
    Plane<float> result(weight_.width(), weight_.height(), 1.0f);
    for (std::size_t i = 0; i < result.size(); ++i)
      if (const float own = view_.luma.pixels()[i]; own >= kDarkestLuma)
        result.pixels()[i] =
            static_cast<float>(luma_.pixels()[i] / weight_.pixels()[i] / static_cast<double>(own));
    return result;
  }

 private:
  AdjustmentView read(int column, int row) const {
    KeyViewAdjustmentCounts counts;
    return read_adjustment_view(hdr_, tone_mapped_, column, row, floor_, 1, counts);
  }

  void add(int column, int row) {
    const AdjustmentView other = read(column, row);
    const ViewStep step = step_between(hdr_.grid(), column_, row_, column, row);
    const double distance_weight = gaussian(std::hypot(column - column_, row - row_), options_.sigma_views);
    for (int y = 0; y < luma_.height(); ++y)
      for (int x = 0; x < luma_.width(); ++x) {
        const float disparity = view_.disparity.at(x, y);
        const float qx = nearest_pixel(x, step.x, disparity), qy = nearest_pixel(y, step.y, disparity);
        const bool inside = qx >= 0 && qy >= 0 && qx < static_cast<float>(luma_.width()) &&
                            qy < static_cast<float>(luma_.height());
        if (inside) add_pixel(x, y, other, static_cast<int>(qx), static_cast<int>(qy), distance_weight);
      }
  }

  void add_pixel(int x, int y, const AdjustmentView& other, int qx, int qy, double distance_weight) {
    const auto difference = [&](const Plane<float>& p, const Plane<float>& q) {
      return static_cast<double>(p.at(x, y)) - static_cast<double>(q.at(qx, qy));
    };
    const double weight =
        distance_weight * gaussian(difference(view_.disparity, other.disparity), options_.sigma_d_px) *
        gaussian(difference(view_.log_luminance, other.log_luminance), options_.sigma_log_luminance);
    weight_.at(x, y) += weight;
    luma_.at(x, y) += weight * static_cast<double>(other.luma.at(qx, qy));
  }

  const LightField& hdr_;
  const DisplayLightField& tone_mapped_;
  const KeyViewAdjustmentOptions& options_;
  int column_, row_;
  float floor_;
  AdjustmentView view_;
  Plane<double> weight_, luma_;
};

}  // namespace

Plane<float> literal_adjustment_factors(const LightField& hdr, const DisplayLightField& tone_mapped,
                                        const KeyViewAdjustmentOptions& options, int column, int row) {
  options.validate();
  require_same_grid(hdr, tone_mapped);
  return LiteralAdjustment(hdr, tone_mapped, options, column, row).factors();
}

DisplayImage adjust_key_view_literally(const LightField& hdr, const DisplayLightField& tone_mapped,
                                       const KeyViewAdjustmentOptions& options, int column, int row) {
  options.validate();
  require_same_grid(hdr, tone_mapped);
  LiteralAdjustment adjustment(hdr, tone_mapped, options, column, row);
  KeyViewAdjustmentCounts counts;
  const Plane<float> smooth = smooth_factors(adjustment.factors(), adjustment.view(), options, true, 1);
  return apply_factors(tone_mapped.view(column, row)->colour, smooth, counts);
}

}  // namespace plenolab
