#pragma once

#include <array>
#include <span>

#include "metrics/comparison.h"

/// Quality of a display image without a reference, from how far its statistics are from those of natural
/// images. Features: BRISQUE, Mittal, Moorthy & Bovik 2012 (No-reference image quality assessment in the
/// spatial domain). The regressor is our own (brisque_weights.h says how it was trained): its score is not
/// the published BRISQUE, and the two must not be compared.
namespace plenolab {

inline constexpr int kBrisqueFeatures = 36;
using BrisqueFeatures = std::array<double, kBrisqueFeatures>;

/// Features of luma on [0, 255], at full size and at half of it (2×2 means; an odd last row or column is
/// left out; a side of one pixel is kept), 18 each: shape and variance of a generalised Gaussian fitted to
/// locally normalised luma (I − μ)/(σ + 1) in 7×7 Gaussian windows of σ = 7/6; then, for its products with
/// the neighbour to the right, below, below right and below left: shape, mean, left and right variance of an
/// asymmetric generalised Gaussian.
///
/// Unlike the authors' code, borders repeat the outermost pixels (not black), and products stay inside the
/// image. Where there is nothing to fit (an image without contrast, or of one pixel) the shape is 10 and the
/// rest 0. With a mask, only windows of valid pixels count. Throws InputError if the mask leaves none.
BrisqueFeatures brisque_features(const DisplayImage& image, const Mask* valid = nullptr);

/// Shape γ in [0.2, 10] of the generalised Gaussian whose E[x²]/E[|x|]² is `ratio`: 2 for π/2, 1 for 2.
double generalised_gaussian_shape(double ratio);

/// What the regressor reads: the features, with variances and shapes as logarithms, in the same order.
BrisqueFeatures brisque_inputs(const BrisqueFeatures& features);

/// A regressor of inputs: standardise each, then a weighted sum of them and of their squares. Standardised
/// inputs are cut to [−4, 4], so that images unlike all of the training cannot get any score.
struct BrisqueModel {
  std::span<const double> mean, deviation;  ///< of each input; kBrisqueFeatures each
  std::span<const double> weights;          ///< of inputs, then of squares: 2·kBrisqueFeatures
  double intercept = 0;
};

/// The 2·kBrisqueFeatures terms that a model weighs.
std::array<double, 2 * kBrisqueFeatures> brisque_terms(const BrisqueModel& model,
                                                       const BrisqueFeatures& features);

/// Score in [0, 100]; lower is better.
double brisque_score(const BrisqueModel& model, const BrisqueFeatures& features);

/// The model that comes with plenolab.
const BrisqueModel& brisque_plenolab_model();

/// brisque_plenolab, unit "1": score of that model. Throws InputError for images with NaN or infinity.
std::vector<Measurement> brisque_plenolab(const DisplayImage& image, const ComparisonConditions& conditions);

}  // namespace plenolab
