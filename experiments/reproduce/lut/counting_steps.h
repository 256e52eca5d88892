#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "analysis/timing.h"
#include "experiments/reproduce/lut/walk_bench.h"

namespace plenolab {

/// What table 3 and claim Z-5 time, and what the thesis prints of it.

/// Table 3 of Zhao 2019 and the text before it: seconds a frame of 1920 × 1080 pixels on a Core i7-4770K and
/// a GeForce GTX 1070. A time printed once is its own range.
struct PrintedTime {
  const char* method;  ///< "CPU", "GPU" or "mixed image"
  int divisor;
  double low_s, high_s;
  double middle_s() const { return 0.5 * (low_s + high_s); }
};
inline constexpr int kPrintedWidth = 1920, kPrintedHeight = 1080;
/// Null where the thesis prints no time.
const PrintedTime* printed_time(const std::string& method, int divisor);

/// Down-scaling along each axis.
inline constexpr std::array kDivisors{1, 2, 4, 8};

/// The frame that is timed, in the printed size (a quarter of it along each axis in tiny runs): half-way
/// through the hall, from where hall, garden house and park are in sight. `lit`: with its picture.
WalkFrame timed_frame(WalkBench& bench, bool lit);
/// Depth of a pose in the size of the timed frame.
WalkFrame surfaces_of_timed_size(WalkBench& bench, const WalkPose& pose);

/// A way of doing one step of a frame.
struct FrameStep {
  std::string method, what;
  int divisor = 1;
  std::string printed_as;  ///< method of the printed time; empty: none
  std::function<void()> run;
};

/// Names of methods.
inline constexpr const char* kOneByOne = "counting one by one, 1 thread";
inline constexpr const char* kVectorised = "counting, vectorised, 1 thread";
std::string on_threads(const std::string& what, const WalkBench& bench);  ///< "grading, 2 threads"

/// Counting, by each method and divisor. `frame` and `bench` outlive the steps.
std::vector<FrameStep> counting_steps(WalkBench& bench, const WalkFrame& frame);
/// The mixed image, and what comes after counting: blending the tables and grading by the blend.
std::vector<FrameStep> other_steps(WalkBench& bench, const WalkFrame& frame);

/// A step that measures itself.
StagedWork timed_work(const FrameStep& step);

}  // namespace plenolab
