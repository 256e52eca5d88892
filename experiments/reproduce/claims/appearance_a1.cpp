// A-A1, thesis section 4.2.1 (key-view interpolation): on a key view the output is that key view.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/image/colour.h"
#include "core/image/repair.h"
#include "experiments/reproduce/claims/appearance_measures.h"

namespace plenolab {

ReproductionResult reproduce_claim_a1(Laboratory& laboratory);

namespace {

// Threshold: exact means that not a single pixel differs in any bit.
constexpr double kOnePixel = 1;

/// Pixels whose colour is not, bit by bit, that of the key view (after the stated repair of defects).
std::size_t differing_pixels(const SceneImage& output, SceneImage key_view) {
  repair(key_view);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < output.size(); ++i)
    if (!(output.pixels()[i] == key_view.pixels()[i])) ++differing;
  return differing;
}

/// Opposite corners and the middle of a grid, each once.
std::vector<std::pair<int, int>> checked_views(const ViewGrid& grid) {
  const std::set<std::pair<int, int>> views{
      {0, 0}, {grid.columns / 2, grid.rows / 2}, {grid.columns - 1, grid.rows - 1}};
  return {views.begin(), views.end()};
}

struct Exactness {
  std::vector<double> differing;  ///< one number for each key view and setting
  double share_equal = 1;         ///< of all pixels
};

Exactness check_scene(Laboratory& laboratory, const std::string& id, ResultTable& rows) {
  Exactness exactness;
  const ViewGrid grid = laboratory.grid(id);
  double pixels = 0, differing_total = 0;
  for (const auto& [column, row] : checked_views(grid))
    for (const bool prune : {true, false}) {
      const auto key_view = laboratory.light_field(id).view(column, row);
      SynthesisOptions options;
      options.prune = prune;
      options.threads = laboratory.options().threads;
      const auto novel = laboratory.synthesizer(id).synthesize(
          {static_cast<double>(column), static_cast<double>(row)}, options);
      const auto differing = static_cast<double>(differing_pixels(novel.image, key_view->colour));
      exactness.differing.push_back(differing);
      pixels += static_cast<double>(novel.image.size());
      differing_total += differing;
      rows.add({"pixels_that_differ_from_key_view",
                differing,
                "px",
                {{"scene", id},
                 {"view", fmt::format("{},{}", column, row)},
                 {"pruning", std::string(prune ? "on" : "off")}}});
    }
  exactness.share_equal = 1 - differing_total / pixels;
  return exactness;
}

/// Root mean square difference of encoded values between the key view and the view a little beside it: over
/// the middle of the image, and over the border region that W_bo fades.
struct Approach {
  double distance = 0, middle = 0, border = 0;
};

Approach approach_at(Laboratory& laboratory, const std::string& id, double distance) {
  const ViewGrid grid = laboratory.grid(id);
  const int column = (grid.columns - 1) / 2, row = (grid.rows - 1) / 2;
  const auto key_view = laboratory.light_field(id).view(column, row);
  SynthesisOptions options;
  options.threads = laboratory.options().threads;
  const double s = std::min(column + distance, grid.columns - 1.0),
               t = std::min(row + distance, grid.rows - 1.0);
  const DisplayImage near =
      expose(laboratory.synthesizer(id).synthesize({s, t}, options).image, exposure_from(key_view->colour));
  const DisplayImage key = expose(key_view->colour, exposure_from(key_view->colour));
  const int margin_x = grid.width / 10, margin_y = grid.height / 10;
  std::array<double, 2> sum{};
  std::array<int, 2> count{};
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const bool border =
          x < margin_x || x >= grid.width - margin_x || y < margin_y || y >= grid.height - margin_y;
      const Rgb d = near.at(x, y) - key.at(x, y);
      sum[border] += static_cast<double>(d.r * d.r + d.g * d.g + d.b * d.b) / 3;
      ++count[border];
    }
  return {distance, std::sqrt(sum[0] / std::max(1, count[0])), std::sqrt(sum[1] / std::max(1, count[1]))};
}

ReportPlot approach_plot(Laboratory& laboratory, const std::string& id, ResultTable& rows) {
  Plot plot;
  plot.x = {.title = "Distance from the key view along both axes", .unit = "spacings", .logarithmic = true};
  plot.y = {.title = "Difference from the key view, RMS", .unit = "encoded", .minimum = 0};
  plot.key = KeyPosition::kTopLeft;
  PlotSeries middle{.title = "middle of the image"}, border{.title = "border region"};
  for (const double distance : {0.0001, 0.001, 0.01, 0.03, 0.1, 0.3}) {
    const Approach approach = approach_at(laboratory, id, distance);
    middle.points.push_back({.x = distance, .y = approach.middle, .label = {}});
    border.points.push_back({.x = distance, .y = approach.border, .label = {}});
    const std::vector<std::pair<std::string, Cell>> columns{{"scene", id}, {"distance_spacings", distance}};
    rows.add({"rms_difference_from_key_view_middle", approach.middle, "1", columns});
    rows.add({"rms_difference_from_key_view_border", approach.border, "1", columns});
  }
  plot.series = {middle, border};
  return {plot,
          fmt::format("{}: how the view approaches the key view (the scene's own parallax is part of the "
                      "difference)",
                      laboratory.scene(id).title),
          "Difference from the key view against the distance from it"};
}

}  // namespace

ReproductionResult reproduce_claim_a1(Laboratory& laboratory) {
  ReproductionResult result;
  ReportTable table{
      "Views synthesised exactly on key views", {"scene", "comparisons", "share of equal pixels"}, {}, 9};
  std::vector<double> differing;
  for (const std::string& id : laboratory.scene_ids()) {
    const Exactness exactness = check_scene(laboratory, id, result.rows);
    differing.insert(differing.end(), exactness.differing.begin(), exactness.differing.end());
    table.rows.push_back({id, static_cast<long long>(exactness.differing.size()), exactness.share_equal});
  }
  const auto [least, most] = std::minmax_element(differing.begin(), differing.end());
  LedgerEntry entry{
      {"A-A1", "Altmeier 2018, section 4.2.1", "On a key view the synthesised view is that key view."}, {}};
  entry.verdict =
      decide_claim({*most, *least, *most}, Comparison::kBelow, kOnePixel, "pixels_that_differ_from_key_view",
                   "px", fmt::format("range over {} comparisons, which are exact", differing.size()));
  entry.verdict.scenes = laboratory.scene_ids();
  entry.verdict.explanation =
      "Most pixels of one view that are not bit for bit those of the key view, over two opposite corners and "
      "the "
      "middle of "
      "every "
      "scene's grid, with pruning on and off.";
  result.ledger = {entry};
  add_ledger_rows(result.rows, result.ledger);
  result.paper_shows = "Section 4.2.1 calls this key-view interpolation and derives it from the weights.";
  result.ours_shows = fmt::format(
      "{} views were synthesised on key views of {} scenes and compared bit by bit: at most {:.0f} pixels of "
      "a "
      "view differ.",
      differing.size(), laboratory.scene_ids().size(), *most);
  result.differs = *most == 0
                       ? "No difference."
                       : "The claim does not hold for every pixel here; rows.csv names the scenes and views.";
  result.add_table(table);
  result.add_plot("approach", approach_plot(laboratory, "cellar", result.rows));
  return result;
}

}  // namespace plenolab
