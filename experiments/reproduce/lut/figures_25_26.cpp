// Figures 25 and 26: both blends beside the frame graded by the volume ahead, and beside mixed images.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "analysis/statistics.h"
#include "core/lut/mixed_image.h"
#include "experiments/reproduce/lut/lut_tools.h"

namespace plenolab {

ReproductionResult reproduce_turns(Laboratory& laboratory);
ReproductionResult reproduce_mixed_images(Laboratory& laboratory);

namespace {

/// Runs of frames in which the walker stands and turns.
std::vector<std::vector<std::size_t>> turns_of(WalkBench& bench) {
  std::vector<std::vector<std::size_t>> turns;
  for (const std::size_t i : turning_frames(bench)) {
    if (turns.empty() || turns.back().back() + 1 != i) turns.emplace_back();
    turns.back().push_back(i);
  }
  return turns;
}

std::string place_of(WalkBench& bench, int volume) {
  return volume < 0 ? "the background" : "the " + bench.place(volume);
}

void add_turn(ReproductionResult& result, WalkBench& bench, const std::vector<std::size_t>& frames,
              std::size_t number) {
  const std::string leg = bench.frames()[frames.front()].pose.leg;
  const auto sheet = [&](const std::function<DisplayImage(std::size_t)>& picture) {
    return frame_sheet(bench, frames, 4, picture);
  };
  const auto graded = [&](BlendMethod method) {
    return sheet([&bench, method](std::size_t i) { return bench.graded(i, method); });
  };
  result.add_comparison(
      fmt::format("turn-{}", number),
      {fmt::format("The walker {}: frames {} to {}", leg, frames.front(), frames.back()),
       fmt::format("The {} frames of a turn on the spot, graded in three ways.", number_word(frames.size())),
       {{"Linear", graded(BlendMethod::kLinear)},
        {"Pixel-based", graded(BlendMethod::kPixel)},
        {"Reference by volume ahead",
         sheet([&bench](std::size_t i) { return bench.reference(i, GradeReference::kAhead); })}}});
  const std::size_t last = frames.back();
  result.add_comparison(
      fmt::format("turn-{}-final", number),
      {fmt::format("Frame {}, the end of the turn, which looks into {}", last,
                   place_of(bench, bench.scores()[last].ahead)),
       "The last frame of the turn by both blends, and graded by the table of the volume ahead.",
       {{"Final linear", bench.graded(last, BlendMethod::kLinear)},
        {"Final pixel-based", bench.graded(last, BlendMethod::kPixel)},
        {"Final reference by volume ahead", bench.reference(last, GradeReference::kAhead)}}});
}

/// In how many of the frames linear blending is the closer of the two.
std::size_t linear_closer(WalkBench& bench, GradeReference reference,
                          const std::vector<std::size_t>& frames) {
  return static_cast<std::size_t>(std::ranges::count_if(frames, [&](std::size_t i) {
    const WalkBench::Score& score = bench.scores()[i];
    return score.of(BlendMethod::kLinear, reference) < score.of(BlendMethod::kPixel, reference);
  }));
}

std::string closer_text(WalkBench& bench, GradeReference reference, const std::vector<std::size_t>& frames) {
  return fmt::format("linear is the closer one in {} of {} frames", linear_closer(bench, reference, frames),
                     frames.size());
}

std::string error_text(WalkBench& bench, GradeReference reference, const std::vector<std::size_t>& frames) {
  return fmt::format("{:.2f} (linear) and {:.2f} (pixel-based)",
                     mean_error(bench, BlendMethod::kLinear, reference, frames),
                     mean_error(bench, BlendMethod::kPixel, reference, frames));
}

/// Colours of the places in a map of volumes, the background first.
constexpr std::array<Rgb, 4> kPlaceColours{
    {{0.75f, 0.75f, 0.75f}, {0.2f, 0.35f, 0.7f}, {0.8f, 0.45f, 0.1f}, {0.15f, 0.55f, 0.25f}}};

DisplayImage map_of(const Plane<int>& volume) {
  DisplayImage map(volume.width(), volume.height());
  for (std::size_t i = 0; i < volume.size(); ++i)
    map.pixels()[i] = kPlaceColours.at(static_cast<std::size_t>(volume.pixels()[i] + 1));
  return map;
}

/// 1 near, 0 at 40 m and beyond.
DisplayImage depth_picture(const Plane<float>& depth_m) {
  DisplayImage picture(depth_m.width(), depth_m.height());
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const float v = 1 / (1 + 0.25f * std::min(depth_m.pixels()[i], 1e6f));
    picture.pixels()[i] = {v, v, v};
  }
  return picture;
}

/// The volume of each pixel's place, and of its object.
struct Owners {
  Plane<int> by_pixel, by_object;
  /// Share of the pixels in which they differ.
  double reassigned() const {
    double changed = 0;
    for (std::size_t i = 0; i < by_pixel.size(); ++i)
      changed += by_pixel.pixels()[i] != by_object.pixels()[i] ? 1 : 0;
    return changed / static_cast<double>(by_pixel.size());
  }
};

Owners owners_in(WalkBench& bench, const WalkFrame& frame) {
  const std::vector<Volume>& volumes = bench.stage().volumes();
  Owners owners{volume_of_pixels(frame.depth_m, frame.pose.camera, volumes, bench.options().threads), {}};
  owners.by_object = volume_of_objects(owners.by_pixel, frame.object, static_cast<int>(volumes.size()));
  return owners;
}

/// Of the frames in which the walker turns the one that is divided most: whose largest share is least.
std::size_t most_divided(WalkBench& bench) {
  const std::vector<std::size_t> turning = turning_frames(bench);
  return *std::ranges::min_element(turning, {}, [&](std::size_t i) {
    const VolumeWeights& weights = bench.scores()[i].pixel;
    return std::max(weights.background, *std::ranges::max_element(weights.volumes));
  });
}

void add_mixed(ReproductionResult& result, WalkBench& bench, std::size_t frame, std::size_t number) {
  const WalkFrame& f = bench.frames()[frame];
  const Owners owners = owners_in(bench, f);
  ImageComparison comparison{
      fmt::format(
          "Frame {}, of the leg '{}'. Volumes: corridor blue, hall orange, garden house green, background "
          "grey",
          frame, f.pose.leg),
      "The frame mixed, blended, and graded by each table, with its depth and volumes.",
      {{"Linear", bench.graded(frame, BlendMethod::kLinear)},
       {"Pixel-based", bench.graded(frame, BlendMethod::kPixel)},
       {"Reference mixed by object", bench.reference(frame, GradeReference::kByObject)},
       {"Reference mixed by pixel", bench.reference(frame, GradeReference::kByPixel)},
       {"Depth", depth_picture(f.depth_m)},
       {"Volume by pixel", map_of(owners.by_pixel)},
       {"Volume by object", map_of(owners.by_object)}}};
  for (int v = -1; v < static_cast<int>(bench.tables().size()); ++v)
    comparison.images.push_back({fmt::format("Table of {}", bench.place(v)), bench.graded_by(frame, v)});
  result.add_comparison(fmt::format("mixed-{}", number), std::move(comparison));
}

}  // namespace

ReproductionResult reproduce_turns(Laboratory& laboratory) {
  ReproductionResult result;
  WalkBench& bench = laboratory.walk_bench();
  const std::vector<std::size_t> turning = turning_frames(bench), walking = turning_frames(bench, false);
  const double linear = mean_error(bench, BlendMethod::kLinear, GradeReference::kAhead, turning),
               pixel = mean_error(bench, BlendMethod::kPixel, GradeReference::kAhead, turning);
  result.paper_shows =
      "Figure 25: while the player looks round between two volumes, pixel-based frames come closer to the "
      "frame graded by the table of the volume in front; linear ones hardly change.";
  result.ours_shows = fmt::format(
      "Mean ΔE*ab to the frame graded by the volume ahead: {} while the walker stands and turns ({}), {} in "
      "the "
      "other frames ({}).",
      error_text(bench, GradeReference::kAhead, turning), closer_text(bench, GradeReference::kAhead, turning),
      error_text(bench, GradeReference::kAhead, walking),
      closer_text(bench, GradeReference::kAhead, walking));
  result.differs = fmt::format(
      "{} The thesis shows pictures and measures nothing. What counts as the volume in front is not said: "
      "here it is the one that most pixels of the middle ninth of the picture show, be it the background; "
      "the volume of most pixels of the whole picture would favour the counting of pixels by definition.",
      pixel < linear ? "As in the thesis, pixel-based frames are closer while the walker turns."
                     : "Other than in the thesis, pixel-based frames are not closer while the walker turns.");
  const auto turns = turns_of(bench);
  for (std::size_t n = 0; n < turns.size(); ++n) add_turn(result, bench, turns[n], n + 1);
  result.add_plot("error-to-volume-ahead",
                  walk_error_plot(bench, {GradeReference::kAhead},
                                  "Difference to the frame graded by the volume ahead, over the walk"));
  add_error_rows(result, bench, {GradeReference::kAhead, GradeReference::kMost});
  return result;
}

ReproductionResult reproduce_mixed_images(Laboratory& laboratory) {
  ReproductionResult result;
  WalkBench& bench = laboratory.walk_bench();
  std::vector<std::size_t> all(bench.frames().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<double> reassigned;
  for (const WalkFrame& frame : bench.frames()) reassigned.push_back(owners_in(bench, frame).reassigned());
  result.rows.add({"reassigned_share", mean(reassigned), "1", {}});
  result.paper_shows =
      "Figure 26: the mixed image, stitched from frames graded by each table, has diverse colours with "
      "strong contrast between its parts; the pixel-based blend keeps one mood.";
  result.ours_shows = fmt::format(
      "Mean ΔE*ab over the walk to the image mixed by object is {} ({}), to the one mixed by pixel {} ({}). "
      "Objects that cross volumes give {:.1f} % of all pixels another table than their place would.",
      error_text(bench, GradeReference::kByObject, all), closer_text(bench, GradeReference::kByObject, all),
      error_text(bench, GradeReference::kByPixel, all), closer_text(bench, GradeReference::kByPixel, all),
      100 * mean(reassigned));
  result.differs =
      "The thesis compares by eye. Which volume holds most of an object is decided here by its pixels in "
      "the picture, so that it may change along the walk.";
  const auto crossing = static_cast<std::size_t>(std::ranges::max_element(reassigned) - reassigned.begin());
  add_mixed(result, bench, crossing, 1);
  if (most_divided(bench) != crossing) add_mixed(result, bench, most_divided(bench), 2);
  result.add_plot("error-to-mixed-image",
                  walk_error_plot(bench, {GradeReference::kByObject, GradeReference::kByPixel},
                                  "Difference to mixed images over the walk"));
  add_error_rows(result, bench, {GradeReference::kByObject, GradeReference::kByPixel});
  return result;
}

}  // namespace plenolab
