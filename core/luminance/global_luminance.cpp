#include "core/luminance/global_luminance.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/luminance/luminance_samples.h"
#include "core/luminance/point_rays.h"

namespace plenolab {

namespace {

constexpr int kColumnsAtATime = 256;

/// What the estimate of one display is made from.
struct Input {
  const RayDisplay& display;
  const RayValues<float>& luminance;
  const ObserverSamples& samples;
  const LuminanceOptions& options;
};

/// Σ ln L of every column: all rays of a column of a display in columns count for the same samples with the
/// same weight, so that the rays themselves are read once, whatever becomes of them.
std::vector<LogSum> column_sums(const Input& in) {
  const RayCount size = in.luminance.size();
  std::vector<LogSum> sums(static_cast<std::size_t>(size.images) * static_cast<std::size_t>(size.width));
  parallel_for(static_cast<int>(sums.size()), kColumnsAtATime, in.options.threads, [&](int begin, int end) {
    for (int c = begin; c < end; ++c)
      sums[static_cast<std::size_t>(c)] =
          log_sum({in.luminance.column(0, c), static_cast<std::size_t>(size.height)}, in.options.average);
  });
  return sums;
}

/// Calls sum_of(observer position) for every sample.
template <class SumOf>
std::vector<LogSum> for_samples(const Input& in, const SumOf& sum_of) {
  std::vector<LogSum> sums(static_cast<std::size_t>(in.samples.size()));
  parallel_for(in.samples.size(), 8, in.options.threads, [&](int begin, int end) {
    for (int j = begin; j < end; ++j) sums[static_cast<std::size_t>(j)] = sum_of(in.samples.position(j));
  });
  return sums;
}

std::vector<LogSum> everything(const Input& in) {
  LogSum all;
  for (const LogSum& sum : column_sums(in)) all += sum;
  return std::vector<LogSum>(static_cast<std::size_t>(in.samples.size()), all);
}

std::vector<LogSum> accumulation(const Input& in) {
  if (!in.display.in_columns())
    return literal_accumulation(in.display, in.luminance, in.samples, in.options.average);
  std::vector<LogSum> sums(static_cast<std::size_t>(in.samples.size()));
  const std::vector<LogSum> columns = column_sums(in);
  const RayCount size = in.luminance.size();
  for (int image = 0; image < size.images; ++image)
    for (int u = 0; u < size.width; ++u) {
      const int nearest = in.samples.nearest(in.display.position({image, u, 0}));
      if (nearest >= 0)
        sums[static_cast<std::size_t>(nearest)] += columns[static_cast<std::size_t>(image * size.width + u)];
    }
  return sums;
}

std::vector<LogSum> spread(const Input& in) {
  const bool normalised = in.options.normalised_spread;
  if (!in.display.in_columns())
    return for_samples(in, [&](ObserverPosition observer) {
      return literal_spread(in.display, in.luminance, observer, normalised, in.options.average);
    });
  const std::vector<LogSum> sums = column_sums(in);
  const PointColumns points(in.display, in.display.resolution().width);
  const int width = in.luminance.size().width;
  return for_samples(in, [&](ObserverPosition observer) {
    std::vector<PointColumns::Column> columns;
    std::vector<float> weights;
    LogSum sum;
    for (int a = 0; a < points.width(); ++a) {
      points.reaching(a, observer, columns, weights);
      if (normalised && !normalise(std::span(weights))) continue;
      for (std::size_t i = 0; i < columns.size(); ++i)
        sum += sums[static_cast<std::size_t>(columns[i].image * width + columns[i].u)].scaled(
            static_cast<double>(weights[i]));
    }
    return sum;
  });
}

/// The luminance at the rows that a pinhole image shows, so that its columns are contiguous.
RayValues<float> at_rows(const RayValues<float>& luminance, const std::vector<int>& rows, int threads) {
  const RayCount size = luminance.size();
  RayValues<float> shown({size.images, size.width, static_cast<int>(rows.size())});
  parallel_for(size.images * size.width, kColumnsAtATime, threads, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      const float* from = luminance.column(0, c);
      float* to = shown.column(0, c);
      for (std::size_t b = 0; b < rows.size(); ++b) to[b] = from[rows[b]];
    }
  });
  return shown;
}

LogSum perceived_sum(const PointColumns& points, const RayValues<float>& shown, ObserverPosition observer,
                     const LogAverageOptions& average) {
  std::vector<PointColumns::Column> columns;
  std::vector<float> weights;
  std::vector<const float*> values;
  const auto length = static_cast<std::size_t>(shown.size().height);
  LogSum sum;
  for (int a = 0; a < points.width(); ++a) {
    points.reaching(a, observer, columns, weights);
    if (!normalise(std::span(weights))) continue;
    values.clear();
    for (const PointColumns::Column& column : columns) values.push_back(shown.column(column.image, column.u));
    sum += log_sum_of_mixture(values, weights, length, average);
  }
  return sum;
}

std::vector<LogSum> brute_force(const Input& in) {
  const PinholeSize size = in.options.pinhole;
  if (!in.display.in_columns())
    return for_samples(in, [&](ObserverPosition observer) {
      return literal_brute_force(in.display, in.luminance, observer, size, in.options.average);
    });
  const PointColumns points(in.display, size.width);
  const int height = in.luminance.size().height;
  RayValues<float> copy;
  if (size.height != height)
    copy = at_rows(in.luminance, rows_shown(size.height, height), in.options.threads);
  const RayValues<float>& shown = copy.empty() ? in.luminance : copy;
  return for_samples(in, [&](ObserverPosition observer) {
    return perceived_sum(points, shown, observer, in.options.average);
  });
}

std::vector<LogSum> sums_of(const Input& in) {
  switch (in.options.method) {
    case LuminanceMethod::kAll:
      return everything(in);
    case LuminanceMethod::kBruteForce:
      return brute_force(in);
    case LuminanceMethod::kAccumulative:
      return in.options.smoothed ? smoothed_sums(in.samples, accumulation(in)) : accumulation(in);
    case LuminanceMethod::kSpread:
      return spread(in);
  }
  return {};
}

}  // namespace

GlobalLuminance estimate_luminance(const RayDisplay& display, const RayValues<float>& luminance,
                                   const ObserverSamples& samples, const LuminanceOptions& options) {
  require_estimable(display, luminance, samples, options);
  return finish_samples(samples, sums_of({display, luminance, samples, options}));
}

}  // namespace plenolab
