#pragma once

namespace plenolab::detail {

/// The continued fraction F of the incomplete beta function,
///   I_x(a, b) = x^a (1 − x)^b / (a B(a, b)) · F,
/// in the form of DiDonato & Morris 1992 (eq. 9), which stays exact for a large beside b, by Lentz's method.
/// Converges in O(√max(a, b)) steps where x < (a + 1)/(a + b + 2); elsewhere use I_x(a, b) = 1 − I_{1−x}(b,
/// a). Takes x and its complement y = 1 − x, which may be known more exactly than the difference. a, b > 0.
double beta_fraction(double a, double b, double x, double y);

}  // namespace plenolab::detail
