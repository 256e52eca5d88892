#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "experiments/reproduce/lut/walk_bench.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/score.h"

namespace plenolab {

/// What the items on look-up tables have in common.

/// "Zhao 2019, section …".
std::string lut_paper(const std::string& where);

/// Neighbouring frames of the walk see almost the same: so many of them are drawn together.
inline constexpr int kFramesTogether = 5;

/// Pictures of equal size side by side in rows of `columns`, with a gap of white; each made smaller by taking
/// the mean of `divisor` × `divisor` pixels.
DisplayImage contact_sheet(const std::vector<DisplayImage>& pictures, int columns, int divisor = 1);

/// The contact sheet of some frames of the walk, each as `picture` makes it; large ones at half their size.
DisplayImage frame_sheet(WalkBench& bench, std::span<const std::size_t> frames, int columns,
                         const std::function<DisplayImage(std::size_t)>& picture);

/// "two", "three" …; digits from thirteen on.
std::string number_word(std::size_t number);

/// Indices of the frames in which the walker stands between two volumes and turns, and of all others.
std::vector<std::size_t> turning_frames(WalkBench& bench, bool turning = true);

/// Errors of both blends against references over the frames of the walk.
ReportPlot walk_error_plot(WalkBench& bench, const std::vector<GradeReference>& references,
                           const std::string& caption);

/// Mean error of a method against a reference over some frames.
double mean_error(WalkBench& bench, BlendMethod method, GradeReference reference,
                  std::span<const std::size_t> frames);

/// Rows mean_delta_e of every frame, method and reference.
void add_error_rows(ReproductionResult& result, WalkBench& bench,
                    const std::vector<GradeReference>& references);

}  // namespace plenolab
