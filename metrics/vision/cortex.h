#pragma once

/// Cortex transform (Watson 1987) in the form of Daly 1993 that HDR-VDP 1 uses: bands an octave wide times
/// orientations, whose responses add up to 1 with the base at every frequency, so that the bands of an image
/// add up to the image.
///
/// Daly leaves open where the highest band ends. Here band 0 reaches from a quarter of a cycle per pixel
/// upwards, corners of the spectrum included, and band k from 2^−(k+2) to 2^−(k+1) cycles per pixel (at half
/// response): no band lies where images have no frequencies.
namespace plenolab::vision {

struct CortexLayout {
  int bands = 5;         ///< [1, 12]
  int orientations = 6;  ///< [1, 24]
};

/// Response of a band alone, over all orientations. `frequency` ≥ 0 in cycles per pixel.
double band_response(const CortexLayout& layout, int band, double frequency);

/// Response of the base: a Gaussian, cut off where its band ends.
double base_response(const CortexLayout& layout, double frequency);

/// Response of an orientation: Hann windows 180/orientations degrees apart, of twice that width; orientation
/// 0 is for gratings along y (frequency on the x axis). Even; at the largest frequency of an axis the mean
/// over both signs. 1 for a single orientation. x, y in cycles per pixel, not both 0.
double orientation_response(const CortexLayout& layout, int orientation, double x, double y);

/// Lowest frequency of a band at half response, cycles per pixel.
double lower_edge(int band);

}  // namespace plenolab::vision
