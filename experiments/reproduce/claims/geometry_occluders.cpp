#include "experiments/reproduce/claims/geometry_occluders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/synthesis/synthesizer.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/figure_tools.h"

namespace plenolab {

namespace {

constexpr int kPositions = 5;

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
    if (surface.is_at(qx, qy)) nearest = &surface;
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

/// Whether a nearer surface lies across the path of the search in the corner view, between the largest
/// disparity and that of the surface at (x, y): there the search ends too early.
bool is_path_blocked(const FlatWorld& world, CameraPosition position, double x, double y,
                     CameraPosition corner) {
  double largest = 0;
  for (const FlatSurface& surface : world.surfaces) largest = std::max(largest, surface.disparity_px);
  for (double d = largest; d > surface_at(world, position, x, y)->disparity_px; d -= 0.25) {
    const double qx = x + (position.s - corner.s) * d, qy = y + (position.t - corner.t) * d;
    if (surface_at(world, corner, qx, qy)->disparity_px > d) return true;
  }
  return false;
}

constexpr std::array kCorners{CameraPosition{0, 0}, CameraPosition{1, 0}, CameraPosition{0, 1},
                              CameraPosition{1, 1}};

UnseenCauses causes_of(const Mask& unseen, const FlatWorld& world, const ViewGrid& grid,
                       CameraPosition position) {
  UnseenCauses causes;
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      if (unseen.at(x, y) == 0) continue;
      bool shown = false, free = false;
      for (const CameraPosition corner : kCorners) {
        if (!is_shown(world, grid, position, x + 0.5, y + 0.5, corner)) continue;
        shown = true;
        free = free || !is_path_blocked(world, position, x + 0.5, y + 0.5, corner);
      }
      (!shown ? causes.hidden : !free ? causes.behind : causes.beside) += 1;
    }
  return causes;
}

/// The surface that covers everything and so is seen wherever no other one is.
const FlatSurface& background_of(const FlatWorld& world) {
  const auto farthest = std::min_element(
      world.surfaces.begin(), world.surfaces.end(),
      [](const FlatSurface& a, const FlatSurface& b) { return a.disparity_px < b.disparity_px; });
  PLENOLAB_CHECK(farthest != world.surfaces.end() && farthest->is_endless(),
                 "a world of occluders needs an endless background");
  return *farthest;
}

/// Marks the pixels of a row of the view in which something else than background seen by the first corner
/// view, too, is possible: within the bounds of an occluder, in this view or as the corner sees it, or
/// outside of the corner's image. All others are shown, without a look at silhouettes.
void mark_doubtful(std::vector<unsigned char>& doubtful, const FlatWorld& world, const ViewGrid& grid,
                   CameraPosition position, double y) {
  std::fill(doubtful.begin(), doubtful.end(), 0);
  const auto mark = [&](double left, double right) {
    const double width = grid.width;
    const auto begin = static_cast<int>(std::clamp(std::floor(left - 0.5), 0.0, width));
    const auto end = static_cast<int>(std::clamp(std::ceil(right + 0.5), 0.0, width));
    std::fill(doubtful.begin() + begin, doubtful.begin() + std::max(begin, end), 1);
  };
  const FlatSurface& background = background_of(world);
  const CameraPosition corner = kCorners.front();
  const double corner_dx = (position.s - corner.s) * background.disparity_px;
  const double corner_y = y + (position.t - corner.t) * background.disparity_px;
  if (corner_y < 0 || corner_y > grid.height) return mark(0, grid.width);
  mark(-1, -corner_dx);
  mark(grid.width - corner_dx, grid.width + 1);
  for (const FlatSurface& surface : world.surfaces) {
    if (&surface == &background) continue;
    const auto mark_bounds = [&](CameraPosition view, double row, double dx) {
      const double shift_x = (view.s - world.origin.s) * surface.disparity_px;
      const double shift_y = (view.t - world.origin.t) * surface.disparity_px;
      if (row + shift_y < surface.bounds.top || row + shift_y > surface.bounds.bottom) return;
      mark(surface.bounds.left - shift_x - dx, surface.bounds.right - shift_x - dx);
    };
    mark_bounds(position, y, 0);
    mark_bounds(corner, corner_y, corner_dx);
  }
}

/// Adds what geometry hides from one position.
void add_geometry(OccluderOutcome& outcome, const Mask& all_hidden) {
  const auto hidden = static_cast<double>(count_set(beyond_rim(all_hidden)));
  outcome.geometry_px += hidden / kPositions;
  outcome.hidden = outcome.hidden || hidden > 0;
  outcome.hidden_2x2 = outcome.hidden_2x2 || count_set(beyond_rim(all_hidden, 2)) > 0;
}

}  // namespace

std::vector<CameraPosition> positions_in_cell(std::uint64_t seed) {
  std::vector<CameraPosition> positions{{0.5, 0.5}};
  RandomStream random(seed, 0x6f63636cu, 0);
  while (positions.size() < kPositions)
    positions.push_back({uniform(random, 0.1, 0.9), uniform(random, 0.1, 0.9)});
  return positions;
}

Mask hidden_from_all(const FlatWorld& world, const ViewGrid& grid, CameraPosition position) {
  Mask hidden(grid.width, grid.height);
  std::vector<unsigned char> doubtful(static_cast<std::size_t>(grid.width));
  for (int y = 0; y < grid.height; ++y) {
    mark_doubtful(doubtful, world, grid, position, y + 0.5);
    for (int x = 0; x < grid.width; ++x)
      if (doubtful[static_cast<std::size_t>(x)] != 0)
        hidden.at(x, y) = std::none_of(kCorners.begin(), kCorners.end(), [&](CameraPosition corner) {
          return is_shown(world, grid, position, x + 0.5, y + 0.5, corner);
        });
  }
  return hidden;
}

OccluderOutcome judge(const OccluderPlacement& placement, std::uint64_t seed, int threads) {
  const FlatWorld world = world_of(placement, Patterned::kNothing);
  const ViewGrid grid = occluder_grid();
  const Synthesizer synthesizer(flat_light_field(world, grid, "occluder probe", threads));
  SynthesisOptions options;
  options.threads = threads;
  OccluderOutcome outcome;
  double most = -1;
  for (const CameraPosition position : positions_in_cell(seed)) {
    const auto view = synthesizer.synthesize(position, options);
    const Mask all_unseen = where_zero(view.visible_views);
    const Mask unseen = beyond_rim(all_unseen);
    const UnseenCauses causes = causes_of(unseen, world, grid, position);
    add_geometry(outcome, hidden_from_all(world, grid, position));
    outcome.unseen_px.hidden += causes.hidden / kPositions;
    outcome.unseen_px.behind += causes.behind / kPositions;
    outcome.unseen_px.beside += causes.beside / kPositions;
    outcome.unseen = outcome.unseen || causes.all() > 0;
    outcome.unseen_2x2 = outcome.unseen_2x2 || count_set(beyond_rim(all_unseen, 2)) > 0;
    if (causes.all() > most) most = causes.all(), outcome.worst = position;
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

namespace {

using Judging = std::function<OccluderOutcome(const OccluderPlacement& placement, std::uint64_t seed)>;

std::vector<OccluderStudy> study(Laboratory& laboratory, std::span<const ShapeKind> kinds, Placing placing,
                                 int count, std::uint64_t purpose, const Judging& judging) {
  std::vector<OccluderStudy> studies;
  const auto per_kind = static_cast<std::size_t>(count);
  for (const ShapeKind kind : kinds)
    studies.push_back({.kind = kind,
                       .name = name_of(kind),
                       .placements = std::vector<OccluderPlacement>(per_kind),
                       .outcomes = std::vector<OccluderOutcome>(per_kind)});
  parallel_for(
      count * static_cast<int>(kinds.size()), 1, laboratory.options().threads, [&](int begin, int end) {
        for (auto index = static_cast<std::size_t>(begin); index < static_cast<std::size_t>(end); ++index) {
          OccluderStudy& one = studies[index / per_kind];
          RandomStream random(laboratory.options().seed, purpose, index);
          one.placements[index % per_kind] = placing(one.kind, random);
          one.outcomes[index % per_kind] = judging(one.placements[index % per_kind], random.next_u64());
        }
      });
  return studies;
}

/// What geometry says about the placement; the rest of the outcome stays empty.
OccluderOutcome judge_geometry(const OccluderPlacement& placement, std::uint64_t seed) {
  const FlatWorld world = world_of(placement, Patterned::kNothing);
  OccluderOutcome outcome;
  for (const CameraPosition position : positions_in_cell(seed))
    add_geometry(outcome, hidden_from_all(world, occluder_grid(), position));
  return outcome;
}

}  // namespace

std::vector<OccluderStudy> study_occluders(Laboratory& laboratory, std::span<const ShapeKind> kinds,
                                           Placing placing, int count, std::uint64_t purpose) {
  return study(
      laboratory, kinds, placing, count, purpose,
      [](const OccluderPlacement& placement, std::uint64_t seed) { return judge(placement, seed, 1); });
}

std::vector<OccluderStudy> study_geometry(Laboratory& laboratory, std::span<const ShapeKind> kinds,
                                          Placing placing, int count, std::uint64_t purpose) {
  return study(laboratory, kinds, placing, count, purpose, judge_geometry);
}

int placements_per_kind(const Laboratory& laboratory, int wanted) {
  return laboratory.options().effort == Effort::kTiny ? 2 : wanted;
}

std::size_t unseen_of(const OccluderStudy& study, UnseenBy by) {
  return by == UnseenBy::kGeometry ? study.hidden() : study.unseen();
}

std::size_t placements_of(const std::vector<OccluderStudy>& studies) {
  std::size_t all = 0;
  for (const OccluderStudy& study : studies) all += study.outcomes.size();
  return all;
}

const OccluderStudy& rarest_of(const std::vector<OccluderStudy>& studies, UnseenBy by) {
  return *std::min_element(
      studies.begin(), studies.end(),
      [by](const OccluderStudy& a, const OccluderStudy& b) { return unseen_of(a, by) < unseen_of(b, by); });
}

const char* quantity_of(UnseenBy by) {
  return by == UnseenBy::kGeometry ? "hidden_placement_share" : "unseen_placement_share";
}

Interval unseen_share(const std::vector<OccluderStudy>& studies, UnseenBy by) {
  std::size_t unseen = 0;
  for (const OccluderStudy& study : studies) unseen += unseen_of(study, by);
  return share_interval(unseen, placements_of(studies));
}

}  // namespace plenolab
