#pragma once

#include <vector>

/// Parts of the visual system as HDR-VDP 1 models them (Mantiuk, Daly, Myszkowski & Seidel 2005, Predicting
/// visible differences in high dynamic range images, section 4, after Daly 1993): optics of the eye, contrast
/// sensitivity, and a scale of luminance in just noticeable differences (JND). Frequencies in cycles per
/// degree, luminance in cd/m².
namespace plenolab::vision {

/// Pupil diameter in mm of an eye that looks at an average luminance: 4.9 − 3·tanh(0.4·(log10 Y + 1)), from
/// 7.9 in the dark to 1.9. Y = 0 counts as 1e-6.
double pupil_diameter_mm(double average_cd_m2);

/// Modulation transfer of the eye's optics (Deeley, Drasdo & Charman 1991):
/// exp(−(ρ/(20.9 − 2.1·d))^(1.3 − 0.07·d)), 1 at ρ = 0.
double optical_transfer(double frequency_cpd, double pupil_mm);

/// Daly's contrast sensitivity of a viewer at some distance who is adapted to some luminance.
class ContrastSensitivity {
 public:
  /// `adaptation_cd_m2` > 0, `distance_m` > 0.
  ContrastSensitivity(double adaptation_cd_m2, double distance_m);

  /// S(ρ, θ) = 250·min(S1(ρ), S1(ρ/(r_a·r_θ))) with r_a = 0.856·distance^0.14, r_θ = 0.11·cos4θ + 0.89, for
  /// an image of 1 square degree. ρ ≥ 0; 0 at ρ = 0.
  double operator()(double frequency_cpd, double cos_4_theta = 1) const;

  /// Its parts, for tables: S = 250·min(basic(ρ), basic(ρ/falloff(cos4θ))).
  double basic(double frequency_cpd) const;
  double falloff(double cos_4_theta) const { return falloff_ * (0.11 * cos_4_theta + 0.89); }

  /// Largest sensitivity to horizontal and vertical gratings, and its frequency.
  struct Peak {
    double frequency_cpd = 0, sensitivity = 0;
  };
  Peak peak() const;

 private:
  double a_, b_;    // A, B
  double falloff_;  // r_a
};

/// Luminance in JND: y₀ = 1e-4 cd/m², y ← y·(1 + c(y)/5), value = number of steps/5, with the threshold
/// contrast c(y) = 0.01·P(1e7)/P(y), P(y) the peak of the sensitivity of a viewer at 0.5 m adapted to y. 355
/// JND at 100 cd/m².
class JndScale {
 public:
  JndScale();

  /// Monotone; 0 for luminance up to 1e-4 (and NaN), that of 1e10 cd/m² above.
  double operator()(double luminance_cd_m2) const;

 private:
  std::vector<float> jnd_;  // at equal steps of log10 luminance
};

/// The scale, made once.
const JndScale& jnd_scale();

}  // namespace plenolab::vision
