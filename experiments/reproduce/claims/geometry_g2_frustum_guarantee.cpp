#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/synthesis/synthesizer.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_shapes.h"
#include "experiments/reproduce/claims/probes.h"

namespace plenolab {

ReproductionResult reproduce_claim_g2(Laboratory& laboratory);

namespace {

// A guarantee has no uncertainty of sampling: one counter-example refutes it.
constexpr double kOneRay = 0.5;

constexpr int kPlaneWidth = 96, kPlaneHeight = 72;
// One pixel less than the image: the largest disparity of the corrected bound.
constexpr double kOnePixelLess = (kPlaneHeight - 1.0) / kPlaneHeight;

/// Rays of some views, and those for which no key view in use has an in-frustum correspondence.
struct RayCount {
  double rays = 0, lost = 0;
  int views = 0;
  RayCount& operator+=(const RayCount& other) {
    rays += other.rays, lost += other.lost, views += other.views;
    return *this;
  }
};

/// Whether every key view that takes part is out of frustum.
bool is_lost(const PixelProvenance& pixel) {
  bool any = false;
  for (const Correspondence& c : pixel) {
    if (c.state == CorrespondenceState::kNotUsed) continue;
    if (c.state != CorrespondenceState::kOutOfFrustum) return false;
    any = true;
  }
  return any;
}

RayCount count_rays(const Synthesizer& synthesizer, CameraPosition position, int threads) {
  SynthesisOptions options;
  options.threads = threads;
  options.record_provenance = true;
  const auto view = synthesizer.synthesize(position, options);
  const auto pixels = view.provenance.pixels();
  return {static_cast<double>(pixels.size()),
          static_cast<double>(std::count_if(pixels.begin(), pixels.end(), is_lost)), 1};
}

/// Largest disparity along either axis over the image size along it less `margin_px`.
double disparity_share(const ViewGrid& grid, double d_max_px, int margin_px) {
  return std::max(grid.columns > 1 ? d_max_px / (grid.width - margin_px) : 0,
                  grid.rows > 1 ? d_max_px * grid.vertical_ratio() / (grid.height - margin_px) : 0);
}

/// Random positions anywhere on the grid.
std::vector<CameraPosition> random_positions(const ViewGrid& grid, int count, std::uint64_t seed) {
  RandomStream random(seed, 0x4720, 0);
  std::vector<CameraPosition> positions;
  for (int i = 0; i < count; ++i) {
    const double s = uniform(random, 0, grid.columns - 1), t = uniform(random, 0, grid.rows - 1);
    positions.push_back({s, t});
  }
  return positions;
}

/// One light field with its d_max and what was counted.
struct FieldCount {
  std::string scene;
  double d_max_px = 0;
  double share = 0;       ///< of the image size
  double span_share = 0;  ///< of the way from the first to the last pixel centre, one pixel less
  RayCount count;
  bool meets_printed() const { return share < 1; }
  bool meets_corrected() const { return span_share <= 1; }
};

FieldCount count_field(const std::string& name, const Synthesizer& synthesizer,
                       const std::vector<CameraPosition>& positions, int threads) {
  FieldCount result{
      .scene = name, .d_max_px = static_cast<double>(synthesizer.field().max_disparity_px()), .count = {}};
  result.share = disparity_share(synthesizer.field().grid(), result.d_max_px, 0);
  result.span_share = disparity_share(synthesizer.field().grid(), result.d_max_px, 1);
  for (const CameraPosition position : positions) result.count += count_rays(synthesizer, position, threads);
  return result;
}

/// A plane of one disparity that fills all views; `share` = its disparity over the image height, the smaller
/// side.
FieldCount count_plane(double share, std::uint64_t seed, int threads) {
  const ViewGrid grid = probe_grid(2, 2, 0.1, kPlaneWidth, kPlaneHeight);
  const FlatSurface plane{share * grid.height, {}, Rgb{0.5f, 0.5f, 0.5f}};
  FlatWorld world;
  world.surfaces = {plane};
  return count_field("plane", Synthesizer(flat_light_field(world, grid, "plane probe", threads)),
                     random_positions(grid, 8, seed), threads);
}

void add_rows(ResultTable& rows, const FieldCount& field) {
  const std::vector<std::pair<std::string, Cell>> columns{{"scene", field.scene},
                                                          {"d_max_over_image", field.share}};
  rows.add({"d_max_px", field.d_max_px, "px", columns});
  rows.add({"rays", field.count.rays, "1", columns});
  rows.add({"rays_out_of_all_frustums", field.count.lost, "1", columns});
}

ReportTable table_of(const std::vector<FieldCount>& fields) {
  ReportTable table{
      "Rays for which all key views are out of frustum",
      {"scene", "largest disparity [px]", "over image size", "rays", "without in-frustum result"},
      {},
      4};
  for (const FieldCount& f : fields)
    table.rows.push_back({f.scene, f.d_max_px, f.share, static_cast<long long>(f.count.rays),
                          static_cast<long long>(f.count.lost)});
  return table;
}

std::vector<FieldCount> count_scenes(Laboratory& laboratory) {
  const LaboratoryOptions& options = laboratory.options();
  const int views = options.effort == Effort::kTiny ? 2 : 8;
  std::vector<FieldCount> fields;
  for (const std::string& id : laboratory.scene_ids())
    fields.push_back(count_field(id, laboratory.synthesizer(id),
                                 random_positions(laboratory.grid(id), views, options.seed),
                                 options.threads));
  return fields;
}

std::vector<FieldCount> count_planes(const LaboratoryOptions& options) {
  const std::vector<double> shares =
      options.effort == Effort::kTiny
          ? std::vector<double>{kOnePixelLess, 0.999, 1.5}
          : std::vector<double>{0.5,  0.75, 0.9,  0.95, 0.98, kOnePixelLess, 0.99, 0.999,
                                1.05, 1.1,  1.25, 1.5,  2};
  std::vector<FieldCount> fields;
  for (const double share : shares) fields.push_back(count_plane(share, options.seed, options.threads));
  return fields;
}

Plot plot_of(const std::vector<FieldCount>& planes) {
  Plot plot;
  plot.x = {
      .title = "Largest disparity over the smaller image side", .unit = "1", .minimum = 0, .maximum = 2.1};
  plot.y = {.title = "Rays without an in-frustum result", .unit = "%", .minimum = 0, .maximum = 100};
  plot.key = KeyPosition::kNone;
  plot.series = {{.title = "plane", .points = {}}};
  for (const FieldCount& f : planes)
    plot.series[0].points.push_back(
        {.x = f.share, .y = 100 * f.count.lost / f.count.rays, .y_low = {}, .y_high = {}, .label = {}});
  return plot;
}

/// Which light fields a condition admits.
using Premise = bool (FieldCount::*)() const;

RayCount total_of(const std::vector<FieldCount>& fields, Premise premise) {
  RayCount sum;
  for (const FieldCount& f : fields)
    if ((f.*premise)()) sum += f.count;
  return sum;
}

Verdict decide_guarantee(const std::vector<FieldCount>& fields, Premise premise,
                         const std::string& condition) {
  const RayCount within = total_of(fields, premise);
  Verdict verdict = decide_claim(
      {within.lost, within.lost, within.lost}, Comparison::kBelow, kOneRay, "rays_out_of_all_frustums", "1",
      fmt::format("an exact count over {:.0f} rays of {} views", within.rays, within.views));
  for (const FieldCount& f : fields)
    if ((f.*premise)() && f.scene != "plane") verdict.scenes.push_back(f.scene);
  verdict.scenes.emplace_back("flat planes");
  verdict.explanation = fmt::format(
      "Rays whose correspondences are out of frustum in all key views that take part, counted at random "
      "positions in every light field whose largest disparity is {} along both axes: {:.0f} of {:.0f}. A "
      "single one refutes the guarantee.",
      condition, within.lost, within.rays);
  return verdict;
}

}  // namespace

ReproductionResult reproduce_claim_g2(Laboratory& laboratory) {
  ReproductionResult result;
  const std::vector<FieldCount> planes = count_planes(laboratory.options());
  std::vector<FieldCount> fields = count_scenes(laboratory);
  fields.insert(fields.end(), planes.begin(), planes.end());
  for (const FieldCount& f : fields) add_rows(result.rows, f);
  const RayCount printed = total_of(fields, &FieldCount::meets_printed),
                 corrected = total_of(fields, &FieldCount::meets_corrected);
  result.paper_shows =
      "If the largest disparity is smaller than the smaller side of the image, the search starts inside the "
      "image in at "
      "least one key view, so every ray has an in-frustum result (section 4.1.3).";
  result.ours_shows = fmt::format(
      "Of {:.0f} rays in {} views that meet the printed condition, {:.0f} had no in-frustum result; of "
      "{:.0f} rays in {} views whose largest disparity is at most the image size less one pixel, {:.0f}.",
      printed.rays, printed.views, printed.lost, corrected.rays, corrected.views, corrected.lost);
  result.differs =
      "Colours and disparities are samples at pixel centres, so the image that a search can use ends half a "
      "pixel inside its border on either side. With unequal spacings the condition is held along each axis, "
      "with the disparity along that axis.";
  result.add_table(table_of(fields));
  result.add_plot(
      "rays-lost",
      {plot_of(planes),
       "Rays without an in-frustum result before a plane that fills all views, over its disparity",
       result.ours_shows});
  conclude(result,
           {"A-G2a", "Altmeier 2018, section 4.1.3",
            "If the largest disparity is below the image's width and height, at least one view's search "
            "starts inside the image."},
           decide_guarantee(fields, &FieldCount::meets_printed, "below the image size"));
  conclude(result,
           {"A-G2b", "Altmeier 2018, section 4.1.3, with a bound for samples at pixel centres",
            "If the largest disparity is at most the image's width and height less one pixel, at least one "
            "view's search starts inside the image."},
           decide_guarantee(fields, &FieldCount::meets_corrected, "at most the image size less one pixel"));
  return result;
}

}  // namespace plenolab
