#include "experiments/reproduce/claims/geometry_occluders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/synthesis/synthesizer.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/figure_tools.h"

namespace plenolab {

namespace {

constexpr int kPositions = 5;

/// The cell's centre and random points of the cell, not nearer than a tenth to its sides.
std::vector<CameraPosition> positions_in_cell(std::uint64_t seed) {
  std::vector<CameraPosition> positions{{0.5, 0.5}};
  RandomStream random(seed, 0x6f63636cu, 0);
  while (positions.size() < kPositions)
    positions.push_back({uniform(random, 0.1, 0.9), uniform(random, 0.1, 0.9)});
  return positions;
}

bool is_in_image(const ViewGrid& grid, double x, double y) {
  return x >= 0 && y >= 0 && x <= grid.width && y <= grid.height;
}

/// The nearest surface that covers a point of the view from `position`.
const FlatSurface* surface_at(const FlatWorld& world, CameraPosition position, double x, double y) {
  const FlatSurface* nearest = nullptr;
  for (const FlatSurface& surface : world.surfaces) {
    if (nearest != nullptr && nearest->disparity_px >= surface.disparity_px) continue;
    const double qx = x + (position.s - world.origin.s) * surface.disparity_px;
    const double qy = y + (position.t - world.origin.t) * surface.disparity_px;
    if (!surface.covers || surface.covers(qx, qy)) nearest = &surface;
  }
  return nearest;
}

/// Whether the corner view shows the surface that the view from `position` shows at (x, y).
bool is_shown(const FlatWorld& world, const ViewGrid& grid, CameraPosition position, double x, double y,
              CameraPosition corner) {
  const FlatSurface* surface = surface_at(world, position, x, y);
  const double qx = x + (position.s - corner.s) * surface->disparity_px;
  const double qy = y + (position.t - corner.t) * surface->disparity_px;
  return is_in_image(grid, qx, qy) && surface_at(world, corner, qx, qy) == surface;
}

}  // namespace

Mask hidden_from_all(const FlatWorld& world, const ViewGrid& grid, CameraPosition position) {
  Mask hidden(grid.width, grid.height);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      bool shown = false;
      for (const CameraPosition corner : {CameraPosition{0, 0}, {1, 0}, {0, 1}, {1, 1}})
        shown = shown || is_shown(world, grid, position, x + 0.5, y + 0.5, corner);
      hidden.at(x, y) = shown ? 0 : 1;
    }
  return hidden;
}

OccluderOutcome judge(const OccluderPlacement& placement, std::uint64_t seed, int threads) {
  const FlatWorld world = world_of(placement, false);
  const ViewGrid grid = occluder_grid();
  const Synthesizer synthesizer(flat_light_field(world, grid, "occluder probe", threads));
  SynthesisOptions options;
  options.threads = threads;
  OccluderOutcome outcome;
  double most = -1;
  for (const CameraPosition position : positions_in_cell(seed)) {
    const auto view = synthesizer.synthesize(position, options);
    const auto unseen = static_cast<double>(count_set(beyond_rim(where_zero(view.visible_views))));
    const auto hidden = static_cast<double>(count_set(beyond_rim(hidden_from_all(world, grid, position))));
    outcome.unseen_px += unseen / kPositions;
    outcome.geometry_px += hidden / kPositions;
    outcome.unseen = outcome.unseen || unseen > 0;
    outcome.hidden = outcome.hidden || hidden > 0;
    if (unseen > most) most = unseen, outcome.worst = position;
  }
  return outcome;
}

std::size_t OccluderStudy::unseen() const {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(), [](const OccluderOutcome& o) { return o.unseen; }));
}
std::size_t OccluderStudy::hidden() const {
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(), [](const OccluderOutcome& o) { return o.hidden; }));
}

std::vector<OccluderStudy> study_occluders(Laboratory& laboratory, std::span<const ShapeKind> kinds,
                                           Placing placing, int count, std::uint64_t purpose) {
  std::vector<OccluderStudy> studies;
  std::uint64_t index = 0;
  for (const ShapeKind kind : kinds) {
    OccluderStudy& study = studies.emplace_back();
    study.kind = kind;
    for (int i = 0; i < count; ++i, ++index) {
      RandomStream random(laboratory.options().seed, purpose, index);
      study.placements.push_back(placing(kind, random));
      study.outcomes.push_back(
          judge(study.placements.back(), random.next_u64(), laboratory.options().threads));
    }
  }
  return studies;
}

int placements_per_kind(const Laboratory& laboratory) {
  return laboratory.options().effort == Effort::kTiny ? 2 : 24;
}

Interval unseen_share(const std::vector<OccluderStudy>& studies) {
  std::size_t unseen = 0, all = 0;
  for (const OccluderStudy& study : studies) unseen += study.unseen(), all += study.outcomes.size();
  return share_interval(unseen, all);
}

}  // namespace plenolab
