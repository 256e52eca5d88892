#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/trimming_consistency.h"

namespace plenolab {

/// Scenes of claim A-T3 with the ceilings whose consistency is measured, and how they are shown.

inline constexpr std::array kCeilings{HistogramCeiling::kPerceptual, HistogramCeiling::kAsPrinted};
/// The thesis' number for Cellar.
inline constexpr int kFixedPasses = 4;

/// A scene with one ceiling: the automatic and the fixed number of passes.
struct CeilingStudy {
  bool dark = false;
  TrimmingConsistency automatic, fixed;
  double spacing_m = 0, paper_spacing_m = 0;  ///< of the key views here and in the thesis' grid
};

/// One for each ceiling.
std::vector<CeilingStudy> study_scene(Laboratory& laboratory, const std::string& id, bool dark);

/// Pairs whose numbers of passes differ and which show it.
std::size_t count_shown(const TrimmingConsistency& run);

/// "5 to 6", of all key views.
std::string passes_text(const TrimmingConsistency& run);

/// Rows with the columns scene, ceiling and passes ("automatic" or the fixed number): trimming_passes of each
/// view, linear_views and, where pairs were compared, mean_added_luma_change, largest_added_luma_change,
/// pairs, neighbours, neighbours_with_different_passes, neighbours_that_show_it.
void add_run_rows(ResultTable& rows, const TrimmingConsistency& run);

ReportTable passes_table(const std::vector<TrimmingConsistency>& runs);
ReportTable change_table(const std::vector<CeilingStudy>& studies);
ReportPlot change_plot(const std::vector<CeilingStudy>& studies);

}  // namespace plenolab
