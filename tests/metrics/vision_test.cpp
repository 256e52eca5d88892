// The front end of DRIM: published values of HDR-VDP 1's parts, and values of an independent computation in
// Python's floats, straight from the formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "metrics/viewing_conditions.h"
#include "metrics/vision/cortex.h"
#include "metrics/vision/eye.h"
#include "metrics/vision/perceived_contrast.h"
#include "metrics/vision/spectrum.h"
#include "tests/support/message_of.h"

namespace plenolab::vision {
namespace {

TEST(Pupil, ShrinksWithLightBetweenItsLimits) {
  EXPECT_NEAR(pupil_diameter_mm(0), 7.78, 0.1);
  EXPECT_NEAR(pupil_diameter_mm(100), 4.9 - 3 * std::tanh(1.2), 1e-12);
  EXPECT_NEAR(pupil_diameter_mm(1e9), 1.9, 1e-2);
}

TEST(OpticalTransfer, IsDeeleysFormula) {
  EXPECT_EQ(optical_transfer(0, 3), 1);
  EXPECT_NEAR(optical_transfer(8, 3), 0.5950755, 1e-6);  // Python
  EXPECT_LT(optical_transfer(8, 6), optical_transfer(8, 3));
}

TEST(ContrastSensitivity, PeaksWhereDalysModelDoes) {
  const ContrastSensitivity::Peak bright = ContrastSensitivity(100, 0.5).peak();
  EXPECT_NEAR(bright.sensitivity, 171.8, 0.05);
  EXPECT_NEAR(bright.frequency_cpd, 4.70, 0.01);
}

TEST(ContrastSensitivity, AgreesWithTheFormulaComputedElsewhere) {
  const double eighth = std::numbers::pi / 8;
  EXPECT_NEAR(ContrastSensitivity(100, 0.5)(1, 1), 42.909822, 1e-5);
  EXPECT_NEAR(ContrastSensitivity(100, 0.5)(8, std::cos(1.2)), 112.394284, 1e-5);
  EXPECT_NEAR(ContrastSensitivity(1, 0.5)(2, -1), 55.832735, 1e-5);
  EXPECT_NEAR(ContrastSensitivity(0.001, 0.5)(0.5, 1), 2.467636, 1e-5);
  EXPECT_NEAR(ContrastSensitivity(10, 0.5)(16, std::cos(4 * eighth)), 11.410717, 1e-5);
}

TEST(ContrastSensitivity, IsLowerForObliqueGratingsAndInTheDark) {
  const ContrastSensitivity bright(100, 0.5), dark(0.01, 0.5);
  EXPECT_LT(bright(12, -1), bright(12, 1));
  EXPECT_LT(dark.peak().sensitivity, bright.peak().sensitivity / 5);
  EXPECT_LT(dark.peak().frequency_cpd, bright.peak().frequency_cpd);
  EXPECT_EQ(bright(0), 0);
}

TEST(JndScale, CountsThePublishedSteps) {
  const JndScale& scale = jnd_scale();
  EXPECT_NEAR(scale(100), 355, 1);
  // Python, stepping literally; its peaks were interpolated coarsely.
  EXPECT_NEAR(scale(0.01), 10.553, 0.1);
  EXPECT_NEAR(scale(1), 82.674, 0.1);
  EXPECT_NEAR(scale(1e4), 800.029, 0.1);
  EXPECT_NEAR(scale(1e6), 1260.815, 0.1);
}

TEST(JndScale, IsMonotoneAndFiniteForEveryLuminance) {
  const JndScale& scale = jnd_scale();
  EXPECT_EQ(scale(0), 0);
  EXPECT_EQ(scale(-1), 0);
  EXPECT_EQ(scale(std::nan("")), 0);
  EXPECT_EQ(scale(1e30), scale(1e10));
  double before = 0;
  for (double log10 = -4; log10 <= 10; log10 += 0.013) {
    const double now = scale(std::pow(10, log10));
    EXPECT_GE(now, before);
    before = now;
  }
}

TEST(CortexTransform, ResponsesAddUpToOneAtEveryFrequency) {
  for (const CortexLayout layout : {CortexLayout{5, 6}, {1, 1}, {3, 2}, {6, 7}}) {
    for (int y = -8; y <= 8; ++y) {
      for (int x = -8; x <= 8; ++x) {
        const double fx = x / 16.0, fy = y / 16.0, frequency = std::hypot(fx, fy);
        double sum = base_response(layout, frequency);
        for (int band = 0; band < layout.bands; ++band)
          for (int o = 0; o < layout.orientations; ++o)
            sum += band_response(layout, band, frequency) * orientation_response(layout, o, fx, fy);
        EXPECT_NEAR(sum, 1, 1e-12) << fx << " " << fy;
      }
    }
  }
}

TEST(CortexTransform, BandsAreOctavesAndOrientationsTurn) {
  const CortexLayout layout;
  EXPECT_NEAR(band_response(layout, 1, 0.25), 0.5, 1e-12);
  EXPECT_NEAR(band_response(layout, 1, 0.125), 0.5, 1e-12);
  EXPECT_NEAR(band_response(layout, 1, 0.167), 1, 1e-3);
  EXPECT_EQ(band_response(layout, 0, 0.5), 1);
  EXPECT_EQ(orientation_response(layout, 0, 0.2, 0), 1);
  EXPECT_EQ(orientation_response(layout, 3, 0.2, 0), 0);
  EXPECT_NEAR(orientation_response(layout, 3, 0, 0.2), 1, 1e-12);
}

TEST(Spectrum, FiltersOfResponseOneGiveTheImageBack) {
  Plane<float> image(23, 14);
  for (std::size_t i = 0; i < image.size(); ++i) image.pixels()[i] = static_cast<float>((i * 37) % 101);
  const Canvas canvas = canvas_for(image.width(), image.height());
  const Spectrum same = filter(
      spectrum_of(pad(image, canvas)),
      [](double, double) {
        return FilterPair{1, 0.5f};
      },
      1);
  const Plane<float> precise = filter_precisely(
      image, canvas, [](double) { return 1.0; }, 1);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      EXPECT_NEAR(same.at(x, y).real(), image.at(x, y), 1e-4f);
      EXPECT_NEAR(same.at(x, y).imag(), image.at(x, y) / 2, 1e-4f);
      EXPECT_NEAR(precise.at(x, y), image.at(x, y), 1e-5f);
    }
  }
}

TEST(Canvas, MirrorsTheImageWithoutSeams) {
  Plane<float> ramp(300, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 300; ++x) ramp.at(x, y) = static_cast<float>(x);
  const Plane<float> padded = pad(ramp, canvas_for(300, 2));
  ASSERT_GE(padded.width(), 300 + Canvas::kMargin);
  EXPECT_EQ(padded.at(299, 0), 299);
  for (int x = 0; x < padded.width(); ++x)
    EXPECT_LT(std::abs(padded.at((x + 1) % padded.width(), 0) - padded.at(x, 0)), 8) << x;
}

/// A grating in JND about a luminance of `mean`, of contrast `contrast`.
Plane<float> grating(int size, double mean, double contrast, double cycles_per_pixel) {
  Plane<float> image(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      image.at(x, y) = static_cast<float>(
          mean * (1 + contrast * std::cos(2 * std::numbers::pi * cycles_per_pixel * (x + 0.5))));
  return image;
}

float amplitude(const Plane<float>& image) {
  float largest = 0;
  for (int x = 32; x < image.width() - 32; ++x)
    largest = std::max(largest, std::abs(image.at(x, image.height() / 2)));
  return largest;
}

TEST(PerceivedContrast, OfThresholdGratingsIsAboutOneJnd) {
  // At 100 cd/m² the scale's steps are a contrast of 0.01·P(1e7)/P(100); a grating of that amplitude where
  // sensitivity is best becomes 1 JND, less what the optics take away.
  const ViewingConditions viewing;
  const double threshold = 0.01 * ContrastSensitivity(1e7, 0.5).peak().sensitivity / 171.83;
  const double frequency = 4.7 / viewing.pixels_per_degree;
  const double optics = optical_transfer(4.7, pupil_diameter_mm(100));
  EXPECT_NEAR(amplitude(perceived_contrast(grating(192, 100, threshold, frequency), viewing, 1)),
              optics * 1.0, 0.03);
}

TEST(PerceivedContrast, OfAnEvenFieldIsNothing) {
  for (const float level : {0.0f, 1e-9f, 1.0f, 1e9f}) {
    const Plane<float> contrast = perceived_contrast(Plane<float>(40, 30, level), {}, 1);
    EXPECT_LT(amplitude(contrast), 1e-2f) << level;
  }
}

TEST(PerceivedContrast, FallsWithDistanceForFineGratings) {
  ViewingConditions far;
  far.pixels_per_degree = 60;
  const Plane<float> fine = grating(128, 100, 0.2, 0.4);
  EXPECT_LT(amplitude(perceived_contrast(fine, far, 1)), 0.5f * amplitude(perceived_contrast(fine, {}, 1)));
}

TEST(SensitivityFilter, IsTheSensitivityOverItsPeakAndTheOptics) {
  const ViewingConditions viewing;
  const SensitivityFilter filter_at(1, 4, viewing);
  const ContrastSensitivity sensitivity(1, viewing.distance_m);
  const double peak = sensitivity.peak().sensitivity;
  EXPECT_EQ(filter_at(0, 0), 0);
  for (const double x : {0.01, 0.05, 0.2, 0.45}) {
    for (const double y : {0.0, 0.02, 0.3}) {
      const double rho = std::hypot(x, y) * viewing.pixels_per_degree, theta = std::atan2(y, x);
      const double expected =
          std::min(1.0, sensitivity(rho, std::cos(4 * theta)) / peak / optical_transfer(rho, 4));
      EXPECT_NEAR(filter_at(x, y), expected, 2e-3) << x << " " << y;
    }
  }
}

TEST(ViewingConditions, SayWhatIsOutOfRange) {
  const auto message = [](auto change) {
    ViewingConditions viewing;
    change(viewing);
    return message_of([&] { viewing.validate(); });
  };
  EXPECT_NE(message([](auto& v) { v.pixels_per_degree = 0; }).find("pixels_per_degree is 0"),
            std::string::npos);
  EXPECT_NE(message([](auto& v) { v.distance_m = NAN; }).find("distance_m"), std::string::npos);
  EXPECT_NE(message([](auto& v) { v.display_black_cd_m2 = 300; }).find("below the peak"), std::string::npos);
  EXPECT_EQ(message([](auto&) {}), "");
}

TEST(DisplayedLuminance, SpansBlackToPeak) {
  DisplayImage image(3, 1);
  image.at(1, 0) = {0.5f, 0.5f, 0.5f};
  image.at(2, 0) = {2, 1, 1};
  const Plane<float> shown = displayed_luminance(image, {});
  EXPECT_FLOAT_EQ(shown.at(0, 0), 0.3f);
  EXPECT_NEAR(shown.at(1, 0), 0.3 + 299.7 * std::pow(0.5, 2.2), 1e-3);
  EXPECT_NEAR(shown.at(2, 0), 300, 1e-3);
}

}  // namespace
}  // namespace plenolab::vision
