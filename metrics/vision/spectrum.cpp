#include "metrics/vision/spectrum.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/parallel.h"

namespace plenolab::vision {
namespace {

constexpr int kRowsAtOnce = 16;

/// Index in [0, size) of a position beyond the borders, mirrored as often as needed.
int mirrored(int index, int size) {
  const int period = 2 * size;
  const int wrapped = ((index % period) + period) % period;
  return wrapped < size ? wrapped : period - 1 - wrapped;
}

/// Where a position of the padded axis takes its value from: (1 − weight)·first + weight·second.
struct Source {
  int first = 0, second = 0;
  float weight = 0;
};

std::vector<Source> sources(int size, int padded) {
  std::vector<Source> result;
  for (int i = 0; i < size; ++i) result.push_back({i, i, 0});
  const int margin = padded - size;
  for (int i = 0; i < margin; ++i)
    result.push_back({mirrored(size + i, size), mirrored(i - margin, size),
                      (static_cast<float>(i) + 0.5f) / static_cast<float>(margin)});
  return result;
}

int padded_size(int size) {
  return cv::getOptimalDFTSize(size + std::min(size, Canvas::kMargin));
}

/// A view of a plane's memory for OpenCV.
template <class T>
cv::Mat as_mat(Plane<T>& plane, int type) {
  return {plane.height(), plane.width(), type, plane.pixels().data()};
}

}  // namespace

Canvas canvas_for(int width, int height) {
  return {width, height, padded_size(width), padded_size(height)};
}

Plane<float> pad(const Plane<float>& image, const Canvas& canvas) {
  const std::vector<Source> columns = sources(canvas.width, canvas.padded_width);
  const std::vector<Source> rows = sources(canvas.height, canvas.padded_height);
  Plane<float> padded(canvas.padded_width, canvas.padded_height);
  for (int y = 0; y < padded.height(); ++y) {
    const Source& row = rows[static_cast<std::size_t>(y)];
    const float* above = image.row(row.first);
    const float* below = image.row(row.second);
    for (int x = 0; x < padded.width(); ++x) {
      const Source& c = columns[static_cast<std::size_t>(x)];
      const float first = (1 - c.weight) * above[c.first] + c.weight * above[c.second];
      const float second = (1 - c.weight) * below[c.first] + c.weight * below[c.second];
      padded.at(x, y) = (1 - row.weight) * first + row.weight * second;
    }
  }
  return padded;
}

Spectrum spectrum_of(const Plane<float>& padded) {
  Plane<float> input = padded;
  Spectrum spectrum(padded.width(), padded.height());
  cv::Mat output = as_mat(spectrum, CV_32FC2);
  cv::dft(as_mat(input, CV_32F), output, cv::DFT_COMPLEX_OUTPUT);
  return spectrum;
}

Spectrum filter(const Spectrum& spectrum, const PairResponse& response, int threads) {
  const int width = spectrum.width(), height = spectrum.height();
  Spectrum filtered(width, height);
  const auto put = [&](int x, int y, FilterPair r) {
    const std::complex<float> s = spectrum.at(x, y);
    filtered.at(x, y) = {r.first * s.real() - r.second * s.imag(), r.first * s.imag() + r.second * s.real()};
  };
  // Responses are even: each is evaluated once for (x, y) and (−x, −y).
  parallel_for(height / 2 + 1, kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const int opposite = (height - y) % height;
      const double fy = frequency_at(y, height);
      for (int x = 0; x < width; ++x) {
        const FilterPair r = response(frequency_at(x, width), fy);
        put(x, y, r);
        if (opposite != y) put((width - x) % width, opposite, r);
      }
    }
  });
  cv::Mat values = as_mat(filtered, CV_32FC2);
  cv::dft(values, values, cv::DFT_INVERSE | cv::DFT_SCALE);
  return filtered;
}

Plane<float> filter_precisely(const Plane<float>& image, const Canvas& canvas,
                              const std::function<double(double frequency)>& response, int threads) {
  Plane<float> padded = pad(image, canvas);
  cv::Mat values, spectrum;
  as_mat(padded, CV_32F).convertTo(values, CV_64F);
  cv::dft(values, spectrum, cv::DFT_COMPLEX_OUTPUT);
  parallel_for(spectrum.rows, kRowsAtOnce, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const double fy = frequency_at(y, spectrum.rows);
      auto* row = spectrum.ptr<std::complex<double>>(y);
      for (int x = 0; x < spectrum.cols; ++x) {
        const double fx = frequency_at(x, spectrum.cols);
        row[x] *= response(std::sqrt(fx * fx + fy * fy));
      }
    }
  });
  cv::dft(spectrum, values, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  Plane<float> result(canvas.width, canvas.height);
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x) result.at(x, y) = static_cast<float>(values.at<double>(y, x));
  return result;
}

}  // namespace plenolab::vision
