#pragma once

#include <complex>
#include <functional>

#include "core/image/image.h"

/// Linear filters given by their frequency response, applied through the Fourier transform (OpenCV's).
namespace plenolab::vision {

/// An image on a larger periodic canvas, without seams: beyond its right and lower border the image is
/// mirrored and blended into what is mirrored at the opposite border, over `kMargin` pixels or more (over the
/// image's own size if that is smaller).
struct Canvas {
  static constexpr int kMargin = 128;
  int width = 0, height = 0;                ///< of the image, which lies at the top left
  int padded_width = 0, padded_height = 0;  ///< of the canvas, sizes that transform fast
};
Canvas canvas_for(int width, int height);

/// The image (of the canvas' width × height) spread over the canvas.
Plane<float> pad(const Plane<float>& image, const Canvas& canvas);

/// Frequencies in cycles per pixel at a place of a spectrum of `size` samples: in (−0.5, 0.5].
inline double frequency_at(int index, int size) {
  return static_cast<double>(2 * index > size ? index - size : index) / size;
}

using Spectrum = Plane<std::complex<float>>;

/// Response of two filters at one frequency (x, y in cycles per pixel), each real and even: the same for
/// (x, y) and (−x, −y), and on x = ±0.5 or y = ±0.5 for every choice of sign.
struct FilterPair {
  float first = 0, second = 0;
};
using PairResponse = std::function<FilterPair(double x, double y)>;

/// Transform of a real image of the canvas' padded size.
Spectrum spectrum_of(const Plane<float>& padded);

/// The image filtered by two filters at once, as real and imaginary part, on the whole canvas. `threads` are
/// for evaluating the response.
Spectrum filter(const Spectrum& spectrum, const PairResponse& response, int threads);

/// The image filtered by one filter whose response depends on the frequency's magnitude in cycles per pixel
/// alone, of the image's own size. In double throughout: next to a sun the rounding of float exceeds what is
/// dark.
Plane<float> filter_precisely(const Plane<float>& image, const Canvas& canvas,
                              const std::function<double(double frequency)>& response, int threads);

}  // namespace plenolab::vision
