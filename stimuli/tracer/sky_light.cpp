#include "stimuli/tracer/sky_light.h"

#include <algorithm>

namespace plenolab::tracer {

namespace {

double row_cosine(int row, int rows) {
  return std::cos(std::numbers::pi * row / rows);
}

Vec3 direction_of(double cos_zenith, double phi) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cos_zenith * cos_zenith));
  return Vec3(static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
              static_cast<float>(cos_zenith));
}

// Index of the bin of a normalised CDF that holds u, and the position in it.
struct Bin {
  int index;
  float inside;
  float probability;
};
Bin find_bin(const float* cdf, int bins, float u) {
  const float* above = std::upper_bound(cdf + 1, cdf + bins, u);
  const int index = static_cast<int>(above - cdf) - 1;
  const float probability = cdf[index + 1] - cdf[index];
  return {index, probability > 0 ? std::clamp((u - cdf[index]) / probability, 0.0f, 1.0f) : 0.5f,
          probability};
}

void normalise(float* cdf, int bins, const std::vector<double>& weights) {
  double total = 0;
  for (const double w : weights) total += w;
  double sum = 0;
  cdf[0] = 0;
  for (int i = 0; i < bins; ++i) {
    sum += weights[static_cast<std::size_t>(i)];
    cdf[i + 1] = static_cast<float>(sum / total);
  }
  cdf[bins] = 1;
}

}  // namespace

SkyLight::SkyLight(const Scene& scene) : sky_(scene.sky) {
  if (scene.sun) sun_direction_ = scene.sun->direction;
  if (sky_.kind == Sky::Kind::kDaylight)
    daylight_.emplace(std::acos(std::clamp(static_cast<double>(sun_direction_.z()), -1.0, 1.0)),
                      static_cast<double>(sky_.turbidity));
  build_table();
}

Rgb SkyLight::radiance(const Vec3& direction) const {
  if (sky_.kind == Sky::Kind::kNone) return {};
  const float height = direction.z();
  if (height < 0) return sky_.ground_cd_m2;
  if (sky_.kind == Sky::Kind::kUniform) return sky_.zenith_cd_m2;
  if (sky_.kind == Sky::Kind::kGradient)
    return sky_.horizon_cd_m2 * (1.0f - std::min(1.0f, height)) + sky_.zenith_cd_m2 * std::min(1.0f, height);
  return daylight_->radiance(height, direction.dot(sun_direction_));
}

// Brightest of five points times the solid angle: an estimate that is not 0 where the cell has light.
double SkyLight::cell_weight(int row, int column) const {
  const double top = row_cosine(row, kRows), bottom = row_cosine(row + 1, kRows);
  const double step = 2 * std::numbers::pi / kColumns;
  float brightest = 0;
  for (const auto& [down, right] :
       {std::array{0.5, 0.5}, {0.01, 0.01}, {0.01, 0.99}, {0.99, 0.01}, {0.99, 0.99}})
    brightest = std::max(
        brightest, luminance(radiance(direction_of(top + (bottom - top) * down, (column + right) * step))));
  return static_cast<double>(brightest) * (top - bottom);
}

void SkyLight::build_table() {
  std::vector<std::vector<double>> weights(kRows, std::vector<double>(kColumns, 0.0));
  double total = 0;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      auto& w = weights[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      w = sky_.kind == Sky::Kind::kNone ? 0.0 : cell_weight(y, x);
      total += w;
    }
  shines_ = total > 0;
  // A thousandth of the samples goes everywhere evenly, so that the density vanishes nowhere.
  const double spread = shines_ ? 1e-3 * total / (2.0 * kColumns) : 1.0;
  row_cdf_.resize(kRows + 1);
  column_cdf_.resize(kRows * (kColumns + 1));
  std::vector<double> rows(kRows, 0.0);
  for (int y = 0; y < kRows; ++y) {
    auto& row = weights[static_cast<std::size_t>(y)];
    for (double& w : row)
      rows[static_cast<std::size_t>(y)] += w += spread * (row_cosine(y, kRows) - row_cosine(y + 1, kRows));
    normalise(&column_cdf_[static_cast<std::size_t>(y * (kColumns + 1))], kColumns, row);
  }
  normalise(row_cdf_.data(), kRows, rows);
}

DirectionSample SkyLight::sample(std::array<float, 2> u) const {
  const Bin row = find_bin(row_cdf_.data(), kRows, u[0]);
  const Bin column =
      find_bin(&column_cdf_[static_cast<std::size_t>(row.index * (kColumns + 1))], kColumns, u[1]);
  const double top = row_cosine(row.index, kRows), bottom = row_cosine(row.index + 1, kRows);
  const double step = 2 * std::numbers::pi / kColumns;
  const Vec3 direction = direction_of(top + (bottom - top) * static_cast<double>(row.inside),
                                      (column.index + static_cast<double>(column.inside)) * step);
  return {direction.normalized(),
          static_cast<float>(static_cast<double>(row.probability) * static_cast<double>(column.probability) /
                             ((top - bottom) * step))};
}

float SkyLight::pdf(const Vec3& direction) const {
  const double theta = std::acos(std::clamp(static_cast<double>(direction.z()), -1.0, 1.0));
  const double phi = std::atan2(static_cast<double>(direction.y()), static_cast<double>(direction.x()));
  const double turn = phi < 0 ? phi / (2 * std::numbers::pi) + 1 : phi / (2 * std::numbers::pi);
  const int y = std::min(kRows - 1, static_cast<int>(theta / std::numbers::pi * kRows));
  const int x = std::min(kColumns - 1, static_cast<int>(turn * kColumns));
  const float* columns = &column_cdf_[static_cast<std::size_t>(y * (kColumns + 1))];
  const float probability =
      (row_cdf_[static_cast<std::size_t>(y) + 1] - row_cdf_[static_cast<std::size_t>(y)]) *
      (columns[x + 1] - columns[x]);
  const double solid_angle =
      (row_cosine(y, kRows) - row_cosine(y + 1, kRows)) * 2 * std::numbers::pi / kColumns;
  return static_cast<float>(static_cast<double>(probability) / solid_angle);
}

}  // namespace plenolab::tracer
