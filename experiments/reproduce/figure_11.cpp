#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "core/lightfield/profile.h"
#include "experiments/reproduce/figure_tools.h"
#include "experiments/reproduce/reproduction.h"
#include "metrics/error_map.h"

namespace plenolab {

ReproductionResult reproduce_scene_overview(Laboratory& laboratory);

namespace {

DisplayImage false_colour(const DisparityMap& disparity, float full_scale) {
  DisplayImage image(disparity.width(), disparity.height());
  for (std::size_t n = 0; n < image.size(); ++n)
    image.pixels()[n] = inferno(full_scale > 0 ? disparity.pixels()[n] / full_scale : 0);
  return image;
}

void add_profile_rows(ResultTable& rows, const std::string& id, const LightFieldProfile& profile) {
  const std::vector<std::pair<std::string, Cell>> columns{{"scene", id}};
  rows.add({"max_disparity_px", static_cast<double>(profile.max_disparity_px), "px", columns});
  rows.add({"depth_edge_share", profile.depth_edge_share, "1", columns});
  rows.add({"dynamic_range_log10", profile.dynamic_range_log10, "1", columns});
  rows.add({"lighting_change", profile.lighting_change, "1", columns});
}

std::vector<Cell> table_row(const std::string& title, const ViewGrid& grid, int paths,
                            const LightFieldProfile& profile) {
  return {title,
          fmt::format("{} × {}", grid.columns, grid.rows),
          fmt::format("{:g} × {:g}", 100 * grid.spacing_x_m, 100 * grid.spacing_y_m),
          fmt::format("{} × {}", grid.width, grid.height),
          static_cast<long long>(paths),
          static_cast<double>(profile.max_disparity_px),
          100 * profile.depth_edge_share,
          std::pow(10.0, profile.log10_p1),
          std::pow(10.0, profile.log10_p99),
          profile.dynamic_range_log10,
          profile.lighting_change};
}

void show_middle(ReproductionResult& result, const Scene& scene, const LightField& field,
                 float max_disparity_px) {
  const auto middle = field.view(field.grid().columns / 2, field.grid().rows / 2);
  result.add_comparison(scene.id,
                        {scene.title + ": " + scene.description,
                         "Middle key view of " + scene.title + " and its disparity",
                         {{"Middle key view", expose(middle->colour, figure_exposure(middle->colour))},
                          {"Disparity", false_colour(middle->disparity, max_disparity_px)}}},
                        {middle->colour});
}

}  // namespace

ReproductionResult reproduce_scene_overview(Laboratory& laboratory) {
  ReproductionResult result;
  ReportTable table{
      "The scenes as recorded in this run",
      {"scene", "key views", "spacing [cm]", "pixels", "paths per pixel", "d_max [px]", "depth edges [%]",
       "1st percentile [cd/m²]", "99th percentile [cd/m²]", "dynamic range [log10]", "change of light"},
      {},
      3};
  double least = 1e9, most = 0;
  for (const std::string& id : laboratory.scene_ids()) {
    const Scene& scene = laboratory.scene(id);
    const LightField field = laboratory.light_field(id);
    const LightFieldProfile measured = profile(field);
    show_middle(result, scene, field, measured.max_disparity_px);
    table.rows.push_back(table_row(scene.title, field.grid(), laboratory.paths_per_pixel(id), measured));
    add_profile_rows(result.rows, id, measured);
    least = std::min(least, measured.dynamic_range_log10);
    most = std::max(most, measured.dynamic_range_log10);
  }
  result.paper_shows =
      "Figure 11 shows one view of each of the nine light fields, from Blender scenes that are not "
      "available: Tunnel, Dunes, Cellar without and with light shafts, Boats and Lanterns, Dominoes, Tree "
      "and Desk. The grids have 17 × 9 key views, the Cellar 17 × 5.";
  result.ours_shows = fmt::format(
      "{} procedural scenes, each modelled to provoke what its namesake shows. Their dynamic range is "
      "10^{:.1f} to 10^{:.1f} between the 1st and 99th percentile of luminance. Disparity is drawn from "
      "black (infinitely far) to light yellow (d_max of the light field).",
      laboratory.scene_ids().size(), least, most);
  result.differs =
      "The scenes are other ones; what can be compared is which effects they provoke, not their errors in "
      "numbers. Grids and images are those of this run's effort: the paper preset has the thesis' grids.";
  result.add_table(std::move(table));
  return result;
}

}  // namespace plenolab
