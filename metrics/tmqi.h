#pragma once

#include "metrics/comparison.h"

namespace plenolab {

/// Tone mapped image quality index, Yeganeh & Wang 2013 (Objective quality assessment of tone-mapped images),
/// in the form of the authors' code: Q = 0.8012·S^0.3046 + (1 − 0.8012)·N^0.7088.
///
/// Structural fidelity S: on five scales, each the 2×2 mean of the one before (an odd last row or column is
/// left out), in Gaussian windows of 11×11 pixels, between the luminance of the HDR image scaled to [0, 2³² −
/// 1] and the luma of the tone mapped image in [0, 255]. Deviations pass through a normal distribution about
/// the threshold of the viewer's contrast sensitivity at 16, 8, 4, 2 and 1 cycles per degree: the metric
/// brings its own viewing conditions. Naturalness N: a normal distribution of the mean luma times a beta
/// distribution of the mean deviation in blocks of 11×11 pixels, each over its largest value.
///
/// What the code leaves open or gets wrong at its borders, and what is done here:
///  - scales at which a side is shorter than the window are left out, the first one is not: its window is
///    cropped. Weights of the scales that are left are scaled to the sum of all;
///  - blocks cut off by the border keep their own pixels (the code fills them up with black);
///  - a scale whose mean is negative counts as 0 (the code raises it to a broken power);
///  - an HDR image of one luminance has deviations 0;
///  - deviations below the rounding of their computation count as 0;
///  - with a mask, windows and blocks with an invalid pixel are left out, and a scale or naturalness without
///    any of them (the first scale: InputError).

/// tmqi, tmqi_fidelity (S) and tmqi_naturalness (N), all in [0, 1] and unit "1"; higher is better. `test` is
/// the tone mapped image; the scale of the reference does not matter.
std::vector<Measurement> tmqi(const DisplayImage& test, const SceneImage& reference,
                              const ComparisonConditions& conditions);

/// Naturalness of a luma with this mean and this mean block deviation, both on [0, 255].
double tmqi_naturalness(double mean, double deviation);

/// What a deviation σ ≥ 0 counts at a scale 0 … 4: Φ((σ − μ)/(μ/3)), μ = 128/(1.4·CSF(f)).
double tmqi_detected_deviation(double deviation, int scale);

}  // namespace plenolab
