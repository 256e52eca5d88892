#include "experiments/reproduce/study/published.h"

namespace plenolab {

namespace {

struct PrintedRow {
  int display, monitor;  ///< participants who chose IC
  const char *display_verdict, *monitor_verdict;
};

std::vector<StudyCount> counts_of(const std::array<PrintedRow, 5>& rows, std::int64_t participants) {
  std::vector<StudyCount> counts;
  for (const bool monitor : {false, true})
    for (std::size_t i = 0; i < rows.size(); ++i)
      counts.push_back({monitor ? "monitor" : "light-field",
                        "Image " + std::to_string(i + 1),
                        {monitor ? rows[i].monitor : rows[i].display, participants},
                        participants,
                        monitor ? rows[i].monitor_verdict : rows[i].display_verdict});
  return counts;
}

using Channels = std::array<double, 3>;  ///< r, g, b

std::array<double, 5> channel_means(const std::array<Channels, 5>& images) {
  std::array<double, 5> means{};
  for (std::size_t i = 0; i < images.size(); ++i) means[i] = (images[i][0] + images[i][1] + images[i][2]) / 3;
  return means;
}

}  // namespace

std::vector<StudyCount> published_main_study() {
  return counts_of({{{12, 19, "PASSED", "PASSED"},
                     {21, 18, "PASSED", "PASSED"},
                     {16, 11, "PASSED", "PASSED"},
                     {15, 16, "PASSED", "PASSED"},
                     {6, 6, "FAILED", "FAILED"}}},
                   34);
}

std::vector<StudyCount> published_initial_study() {
  return counts_of({{{25, 13, "PASSED", "PASSED"},
                     {20, 17, "PASSED", "PASSED"},
                     {15, 17, "PASSED", "PASSED"},
                     {18, 11, "PASSED", "FAILED"},
                     {8, 2, "FAILED", "FAILED"}}},
                   40);
}

PublishedDifferences published_differences() {
  return {channel_means({{{0.3569, 0.3725, 0.3569},
                          {0.3686, 0.3804, 0.3725},
                          {0.3922, 0.4471, 0.3882},
                          {0.2157, 0.3020, 0.2902},
                          {0.5451, 0.6431, 0.4549}}}),
          channel_means({{{0.0133, 0.0121, 0.0155},
                          {0.0098, 0.0091, 0.0116},
                          {0.0150, 0.0133, 0.0164},
                          {0.0099, 0.0084, 0.0089},
                          {0.0236, 0.0245, 0.0215}}}),
          channel_means({{{0.0078, 0.0078, 0.0118},
                          {0.0078, 0.0039, 0.0078},
                          {0.0078, 0.0078, 0.0118},
                          {0.0078, 0.0039, 0.0039},
                          {0.0078, 0.0078, 0.0078}}})};
}

std::vector<PublishedRunTime> published_run_times() {
  return {{"reprojection, supersampled", {0.1870, 0.1577, 1000}},
          {"reprojection", {0.1794, 0.1511, 1000}},
          {"direct rendering, 120 cameras", {0.0184, 0.0027, 1000}}};
}

}  // namespace plenolab
