#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/psychophysics/study_data.h"
#include "analysis/psychophysics/welch.h"

namespace plenolab {

/// Numbers as printed by Hansen & Klein 2016 ("Rendering the light field", thesis, Aalborg University).

/// The rate that a pass refutes and the level of the test, section 4.1.2.
inline constexpr double kPublishedNullRate = 0.19, kPublishedAlpha = 0.05;
/// Critical numbers stated for 34 and 40 participants, section 4.1.2 and appendix E.
inline constexpr int kPublishedCritical34 = 11, kPublishedCritical40 = 13;
/// What the rate of 0.19 is said to correspond to, section 4.1.2: 25 of at least 100 trials.
inline constexpr int kPublishedWrong = 25, kPublishedTrials = 100;

/// Table 5.1: 34 participants, five images, two displays.
std::vector<StudyCount> published_main_study();
/// Table of appendix E: 40 participants, reference not to be revisited, holes black, no supersampling.
std::vector<StudyCount> published_initial_study();

/// Tables 5.2 to 5.4: the largest, mean and median difference |VC − IC| of images 1 to 5, mean of the three
/// colour channels, display values on [0, 1].
struct PublishedDifferences {
  std::array<double, 5> largest, mean, median;
};
PublishedDifferences published_differences();

/// Section 5.1: run time of a frame in seconds, 1000 frames in sequence.
struct PublishedRunTime {
  std::string method;
  SampleSummary seconds;
};
std::vector<PublishedRunTime> published_run_times();
/// The p value printed for both comparisons.
inline constexpr double kPublishedRunTimeP = 2.2e-16;

}  // namespace plenolab
