#include "core/luminance/luminance_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr std::array kNames{"all", "brute-force", "accumulative", "spread"};

/// A row or column of the samples.
struct Line {
  std::size_t first, step, count;
  std::size_t at(std::size_t i) const { return first + i * step; }
};

std::vector<Line> rows_of(const ObserverSamples& samples) {
  std::vector<Line> lines;
  const auto columns = static_cast<std::size_t>(samples.columns);
  for (std::size_t row = 0; row < static_cast<std::size_t>(samples.rows); ++row)
    lines.push_back({row * columns, 1, columns});
  return lines;
}

std::vector<Line> columns_of(const ObserverSamples& samples) {
  std::vector<Line> lines;
  const auto columns = static_cast<std::size_t>(samples.columns);
  for (std::size_t column = 0; column < columns; ++column)
    lines.push_back({column, columns, static_cast<std::size_t>(samples.rows)});
  return lines;
}

/// Fills a line linearly between known values, beyond the last ones with these. A line without any stays as
/// it is.
void fill(const Line& line, std::vector<double>& values, std::vector<unsigned char>& known) {
  std::vector<std::size_t> there;
  for (std::size_t i = 0; i < line.count; ++i)
    if (known[line.at(i)]) there.push_back(i);
  if (there.empty()) return;
  std::size_t next = 0;
  for (std::size_t i = 0; i < line.count; ++i) {
    while (next < there.size() && there[next] < i) ++next;
    const std::size_t before = there[next == 0 ? 0 : next - 1],
                      after = there[std::min(next, there.size() - 1)];
    if (known[line.at(i)]) continue;
    const double t =
        after > before ? static_cast<double>(i - before) / static_cast<double>(after - before) : 0;
    const double low = values[line.at(before)], high = values[line.at(after)];
    values[line.at(i)] = std::lerp(low, high, std::clamp(t, 0.0, 1.0));
  }
  for (std::size_t i = 0; i < line.count; ++i) known[line.at(i)] = 1;
}

void smooth(const Line& line, const std::vector<LogSum>& from, std::vector<LogSum>& to) {
  for (std::size_t i = 0; i < line.count; ++i) {
    LogSum sum = from[line.at(i)];
    if (i > 0) sum += from[line.at(i - 1)].scaled(0.5);
    if (i + 1 < line.count) sum += from[line.at(i + 1)].scaled(0.5);
    to[line.at(i)] = sum;
  }
}

/// Cell and share of the next one of a position among the centres of cells, kept within the outermost
/// centres.
struct Between {
  int low, high;
  double t;
};
Between between(double position, double low, double step, int cells) {
  if (cells == 1 || !(step > 0)) return {0, 0, 0};
  const double at = std::clamp((position - low) / step - 0.5, 0.0, cells - 1.0);
  const int cell = std::min(static_cast<int>(at), cells - 2);
  return {cell, cell + 1, at - cell};
}

}  // namespace

const char* name_of(LuminanceMethod method) {
  return kNames[static_cast<std::size_t>(method)];
}

const std::vector<std::string>& luminance_method_names() {
  static const std::vector<std::string> names(kNames.begin(), kNames.end());
  return names;
}

LuminanceMethod luminance_method_named(const std::string& name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i]) return static_cast<LuminanceMethod>(i);
  throw InputError(fmt::format("there is no method '{}' to estimate luminance; choose one of: {}", name,
                               fmt::join(kNames, ", ")));
}

void LuminanceOptions::validate() const {
  average.validate();
  pinhole.validate();
  if (smoothed && method != LuminanceMethod::kAccumulative)
    throw InputError(fmt::format("smoothing is for the method accumulative, not for {}", name_of(method)));
}

int GlobalLuminance::undefined() const {
  return static_cast<int>(std::count(defined.begin(), defined.end(), 0));
}

std::optional<double> GlobalLuminance::ln_at(ObserverPosition position) const {
  if (!known()) return std::nullopt;
  const Between x = between(position.x_m, samples.x_min_m, samples.step_x_m(), samples.columns);
  const Between y = between(position.y_m, samples.y_min_m, samples.step_y_m(), samples.rows);
  const auto value = [&](int column, int row) {
    return ln_luminance[static_cast<std::size_t>(row * samples.columns + column)];
  };
  return std::lerp(std::lerp(value(x.low, y.low), value(x.high, y.low), x.t),
                   std::lerp(value(x.low, y.high), value(x.high, y.high), x.t), y.t);
}

GlobalLuminance finish_samples(const ObserverSamples& samples, const std::vector<LogSum>& sums) {
  GlobalLuminance result{samples, std::vector<double>(sums.size()), std::vector<unsigned char>(sums.size())};
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (const auto ln = sums[i].ln_average()) result.ln_luminance[i] = *ln, result.defined[i] = 1;
  std::vector<unsigned char> known = result.defined;
  for (const Line& row : rows_of(samples)) fill(row, result.ln_luminance, known);
  for (const Line& column : columns_of(samples)) fill(column, result.ln_luminance, known);
  if (result.undefined() == samples.size()) result.ln_luminance.clear();
  return result;
}

std::vector<LogSum> smoothed_sums(const ObserverSamples& samples, const std::vector<LogSum>& sums) {
  std::vector<LogSum> along_x(sums.size());
  for (const Line& row : rows_of(samples)) smooth(row, sums, along_x);
  if (samples.rows == 1) return along_x;
  std::vector<LogSum> along_both(sums.size());
  for (const Line& column : columns_of(samples)) smooth(column, along_x, along_both);
  return along_both;
}

void require_estimable(const RayDisplay& display, const RayValues<float>& luminance,
                       const ObserverSamples& samples, const LuminanceOptions& options) {
  options.validate();
  samples.validate();
  const RayCount size = luminance.size(), expected = display.size();
  if (!(size == expected))
    throw InputError(fmt::format("the display has {} images of {} × {} pixels, but was given {} of {} × {}",
                                 expected.images, expected.width, expected.height, size.images, size.width,
                                 size.height));
}

}  // namespace plenolab
