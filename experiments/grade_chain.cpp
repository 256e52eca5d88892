#include "experiments/grade_chain.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/image/colour.h"

namespace plenolab {

namespace {

constexpr Rgb kBalance{1.55f, 1.42f, 1.22f};  // warm, and half a stop up
constexpr float kContrast = 1.15f, kMiddleGrey = 0.18f, kSaturation = 1.2f;
constexpr Rgb kLift{0.004f, 0.006f, 0.012f}, kGamma{0.98f, 1, 1.05f}, kGain{1.02f, 1, 0.95f};

float smooth(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

float contrasted(float x) {
  return kMiddleGrey * std::pow(std::max(0.0f, x) / kMiddleGrey, kContrast);
}

float finished(float x, float lift, float gamma, float gain) {
  return gran_turismo_curve(gain * std::pow(std::max(0.0f, x + lift), gamma));
}

}  // namespace

float gran_turismo_curve(float x) {
  // Maximum, slope, start and length of the linear part, tightness of the toe.
  constexpr float kPeak = 1, kSlope = 1, kStart = 0.22f, kLength = 0.4f, kToe = 1.33f;
  constexpr float l0 = (kPeak - kStart) * kLength / kSlope, s0 = kStart + l0, s1 = kStart + kSlope * l0;
  constexpr float c2 = kSlope * kPeak / (kPeak - s1);
  const float toe = 1 - smooth(0, kStart, x), shoulder = x >= kStart + l0 ? 1.0f : 0.0f;
  const float in_toe = kStart * std::pow(x / kStart, kToe),
              in_shoulder = kPeak - (kPeak - s1) * std::exp(-c2 * (x - s0) / kPeak),
              in_line = kStart + kSlope * (x - kStart);
  return in_toe * toe + in_line * (1 - toe - shoulder) + in_shoulder * shoulder;
}

Rgb grade_chain(Rgb encoded) {
  const Rgb light = gamma_decode(encoded) * kBalance;
  const Rgb c{contrasted(light.r), contrasted(light.g), contrasted(light.b)};
  const float grey = luminance(c);
  const Rgb s = Rgb{grey, grey, grey} * (1 - kSaturation) + c * kSaturation;
  const Rgb shown =
      gamma_encode(Rgb{finished(s.r, kLift.r, kGamma.r, kGain.r), finished(s.g, kLift.g, kGamma.g, kGain.g),
                       finished(s.b, kLift.b, kGamma.b, kGain.b)});
  return {std::min(shown.r, 1.0f), std::min(shown.g, 1.0f), std::min(shown.b, 1.0f)};
}

DisplayImage evaluate_chain(const DisplayImage& picture, const std::function<Rgb(Rgb)>& chain, int threads) {
  constexpr int kRowGrain = 4;
  DisplayImage out(picture.width(), picture.height());
  parallel_for(picture.height(), kRowGrain, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < picture.width(); ++x) out.at(x, y) = chain(picture.at(x, y));
  });
  return out;
}

}  // namespace plenolab
