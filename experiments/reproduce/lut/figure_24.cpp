// Figure 24: the walk through three volumes, and what both methods blend their tables by.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/reproduce/lut/lut_tools.h"

namespace plenolab {

ReproductionResult reproduce_walk(Laboratory& laboratory);

namespace {

/// Share of place `index` (the background's behind the volumes').
double share(const VolumeWeights& weights, std::size_t index) {
  return index < weights.volumes.size() ? weights.volumes[index] : weights.background;
}

Plot map_of(WalkBench& bench) {
  Plot plot;
  // Equal scales along both axes beside the key.
  plot.x = {.title = "x", .unit = "m", .minimum = -8, .maximum = 20};
  plot.y = {.title = "y", .unit = "m", .minimum = -2, .maximum = 24};
  plot.key = KeyPosition::kOutside;
  plot.height_px = 480;
  for (const Volume& v : bench.stage().volumes())
    plot.series.push_back({v.name,
                           PlotSeries::Style::kLines,
                           {{v.min[0], v.min[1]},
                            {v.max[0], v.min[1]},
                            {v.max[0], v.max[1]},
                            {v.min[0], v.max[1]},
                            {v.min[0], v.min[1]}}});
  PlotSeries path{"walk, with frame numbers", PlotSeries::Style::kLinesPoints, {}};
  const auto apart_m = [](const Point3& a, const Point3* b) {
    return b ? std::hypot(a[0] - (*b)[0], a[1] - (*b)[1]) : 1e9;
  };
  const Point3 *last = nullptr, *labelled = nullptr;
  for (std::size_t i = 0; i < bench.frames().size(); ++i) {
    const Point3& p = bench.frames()[i].pose.camera.position_m;
    if (apart_m(p, last) < 0.01) continue;
    const bool label = apart_m(p, labelled) > 2;
    path.points.push_back({p[0], p[1], {}, {}, label ? std::to_string(i) : ""});
    last = &p;
    if (label) labelled = &p;
  }
  plot.series.push_back(std::move(path));
  return plot;
}

Plot weight_plot(WalkBench& bench, BlendMethod method) {
  Plot plot;
  plot.x = {.title = "Frame of the walk"};
  plot.y = {.title = fmt::format("Weight, {}", name_of(method)), .minimum = 0, .maximum = 1};
  plot.key = KeyPosition::kOutside;
  for (std::size_t k = 0; k <= bench.stage().volumes().size(); ++k) {
    const int volume = k < bench.stage().volumes().size() ? static_cast<int>(k) : -1;
    PlotSeries series{bench.place(volume), PlotSeries::Style::kLinesPoints, {}};
    for (std::size_t i = 0; i < bench.scores().size(); ++i) {
      const WalkBench::Score& score = bench.scores()[i];
      series.points.push_back(
          {static_cast<double>(i), share(method == BlendMethod::kLinear ? score.linear : score.pixel, k)});
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// How far the weights of a method move while the walker stands and turns: half the sum of the changes of all
/// shares, 1 if one table gives way to another.
double moved_while_turning(WalkBench& bench, BlendMethod method) {
  double moved = 0;
  const std::vector<std::size_t> turning = turning_frames(bench);
  for (std::size_t n = 1; n < turning.size(); ++n) {
    if (turning[n] != turning[n - 1] + 1) continue;
    for (std::size_t k = 0; k <= bench.stage().volumes().size(); ++k) {
      const auto weights = [&](std::size_t i) {
        const WalkBench::Score& score = bench.scores()[i];
        return share(method == BlendMethod::kLinear ? score.linear : score.pixel, k);
      };
      moved += 0.5 * std::abs(weights(turning[n]) - weights(turning[n - 1]));
    }
  }
  return moved;
}

void add_weight_rows(ReproductionResult& result, WalkBench& bench) {
  for (std::size_t i = 0; i < bench.scores().size(); ++i)
    for (std::size_t k = 0; k <= bench.stage().volumes().size(); ++k) {
      const int volume = k < bench.stage().volumes().size() ? static_cast<int>(k) : -1;
      for (const BlendMethod method : {BlendMethod::kLinear, BlendMethod::kPixel}) {
        const WalkBench::Score& score = bench.scores()[i];
        result.rows.add({"blend_weight",
                         share(method == BlendMethod::kLinear ? score.linear : score.pixel, k),
                         "1",
                         {{"frame", static_cast<long long>(i)},
                          {"leg", bench.frames()[i].pose.leg},
                          {"method", std::string(name_of(method))},
                          {"volume", bench.place(volume)}}});
      }
    }
}

/// Every `step`-th frame in one picture, made by `picture`.
template <class Picture>
DisplayImage sheet_of(WalkBench& bench, const Picture& picture) {
  std::vector<DisplayImage> pictures;
  const std::size_t count = bench.frames().size(), step = std::max<std::size_t>(1, (count - 1) / 19);
  for (std::size_t i = 0; i < count && pictures.size() < 20; i += step) pictures.push_back(picture(i));
  return contact_sheet(pictures, 4, bench.frames().front().picture.width() > 200 ? 2 : 1);
}

}  // namespace

ReproductionResult reproduce_walk(Laboratory& laboratory) {
  ReproductionResult result;
  WalkBench& bench = laboratory.walk_bench();
  const double linear = moved_while_turning(bench, BlendMethod::kLinear),
               pixel = moved_while_turning(bench, BlendMethod::kPixel);
  result.rows.add({"weights_moved_while_turning", linear, "1", {{"method", std::string("linear")}}});
  result.rows.add({"weights_moved_while_turning", pixel, "1", {{"method", std::string("pixel-based")}}});
  add_weight_rows(result, bench);
  result.paper_shows =
      "Figure 24: a demo scene with three post-processing volumes and a background; the player stands "
      "between two of them and looks round.";
  result.ours_shows = fmt::format(
      "Our walk has {} frames through a corridor, a hall and a garden house, with two full turns between "
      "them. While the walker stands and turns, the linear weights move by {:.2f} in all and the "
      "pixel-based ones by {:.1f} (1 is a whole table's worth).",
      bench.frames().size(), linear, pixel);
  result.differs =
      "The scene of the thesis is a bought one; ours is modelled for the purpose, with a carpet, a pipe, a "
      "pergola and a bench that reach from one volume into the next, and the park and the sky belong to the "
      "background.";
  result.add_plot("map", {map_of(bench), "The volumes and the walk from above",
                          "Three boxes and the path through them."});
  for (const BlendMethod method : {BlendMethod::kLinear, BlendMethod::kPixel})
    result.add_plot(fmt::format("weights-{}", name_of(method)),
                    {weight_plot(bench, method), fmt::format("Weights of the tables, {}", name_of(method)),
                     "Shares of the four tables over the frames of the walk."});
  result.add_comparison(
      "walk",
      {"The walk, every second frame, in reading order",
       "Small pictures of the walk, as rendered and graded in four ways.",
       {{"Not graded", sheet_of(bench, [&](std::size_t i) { return bench.frames()[i].picture; })},
        {"Linear", sheet_of(bench, [&](std::size_t i) { return bench.graded(i, BlendMethod::kLinear); })},
        {"Pixel-based", sheet_of(bench, [&](std::size_t i) { return bench.graded(i, BlendMethod::kPixel); })},
        {"Volume ahead",
         sheet_of(bench, [&](std::size_t i) { return bench.reference(i, GradeReference::kAhead); })},
        {"Mixed by object",
         sheet_of(bench, [&](std::size_t i) { return bench.reference(i, GradeReference::kByObject); })}}});
  return result;
}

}  // namespace plenolab
