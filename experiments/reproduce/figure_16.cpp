#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/image/colour.h"
#include "core/synthesis/visibility_map.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"

namespace plenolab {

ReproductionResult reproduce_visible_pixels(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "cellar";  // beams, posts and barrels before each other

/// Where a warped key view does not show: colours by cause.
struct Cause {
  CorrespondenceState state;
  const char* name;
  const char* colour_name;
  Rgb colour;
};
constexpr std::array kCauses{
    Cause{CorrespondenceState::kOutOfFrustum, "outside the frustum", "blue", {0.1f, 0.25f, 0.7f}},
    Cause{CorrespondenceState::kDisocclusion, "pseudo-surface", "red", {0.8f, 0.1f, 0.1f}},
    Cause{CorrespondenceState::kOccluded, "occluded", "yellow", {0.85f, 0.7f, 0.1f}},
    Cause{CorrespondenceState::kRestored, "restored background", "magenta", {0.8f, 0.2f, 0.8f}},
};

/// Pixels in which at least one key view is discarded because something hides the surface.
Plane<float> hidden_somewhere(const NovelView<SceneReferred>& view) {
  Plane<float> hidden(view.image.width(), view.image.height());
  for (std::size_t n = 0; n < hidden.size(); ++n)
    for (const Correspondence& c : view.provenance.pixels()[n])
      if (c.state == CorrespondenceState::kDisocclusion || c.state == CorrespondenceState::kOccluded)
        hidden.pixels()[n] = 1;
  return hidden;
}

Rgb shown_at(Rgb encoded, float exposure) {
  const float scale = gamma_encode(exposure);
  const auto shown = [scale](float v) { return std::min(1.0f, v * scale); };
  return {shown(encoded.r), shown(encoded.g), shown(encoded.b)};
}

/// The warped key view v where it is visible, the cause in colour where not.
DisplayImage masked(const NovelView<SceneReferred>& view, const WarpedView& warped, std::size_t v,
                    float exposure) {
  DisplayImage image(view.image.width(), view.image.height());
  for (std::size_t n = 0; n < image.size(); ++n) {
    image.pixels()[n] = shown_at(warped.encoded.pixels()[n], exposure);
    for (const Cause& cause : kCauses)
      if (view.provenance.pixels()[n][v].state == cause.state) image.pixels()[n] = cause.colour;
  }
  return image;
}

std::size_t count_state(const NovelView<SceneReferred>& view, std::size_t v, CorrespondenceState state) {
  std::size_t count = 0;
  for (const PixelProvenance& pixel : view.provenance.pixels()) count += pixel[v].state == state ? 1 : 0;
  return count;
}

/// Rows for each key view; returns the smallest and largest visible share.
std::pair<double, double> add_state_rows(ReproductionResult& result, const NovelView<SceneReferred>& view) {
  std::pair<double, double> range{1, 0};
  const auto pixels = static_cast<double>(view.image.size());
  for (std::size_t v = 0; v < view.views.size(); ++v) {
    const Columns columns{{"scene", std::string(kScene)},
                          {"key_view", fmt::format("{},{}", view.views[v].column, view.views[v].row)}};
    const auto share = [&](CorrespondenceState state) {
      return static_cast<double>(count_state(view, v, state)) / pixels;
    };
    const double visible = share(CorrespondenceState::kUsed);
    range = {std::min(range.first, visible), std::max(range.second, visible)};
    result.rows.add({"visible_share", visible, "1", columns});
    result.rows.add({"out_of_frustum_share", share(CorrespondenceState::kOutOfFrustum), "1", columns});
    result.rows.add({"pseudo_surface_share", share(CorrespondenceState::kDisocclusion), "1", columns});
    result.rows.add({"occluded_share", share(CorrespondenceState::kOccluded), "1", columns});
  }
  return range;
}

std::string legend() {
  std::string text;
  for (const Cause& cause : kCauses)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", cause.colour_name, cause.name);
  return text;
}

void show(ReproductionResult& result, Laboratory& laboratory, const NovelView<SceneReferred>& view) {
  const float exposure = figure_exposure(view.image);
  const auto warped = warp_key_views(view, laboratory.light_field(kScene));
  ImageComparison shown{fmt::format("{} from {}: the key views as they are seen from there ({}), and their "
                                    "blend",
                                    laboratory.scene(kScene).title, name_of(view.position), legend()),
                        "Warped key views with what is not visible masked",
                        {}};
  for (std::size_t v = 0; v < warped.size(); ++v)
    shown.images.push_back({fmt::format("Key view {}, {} warped", view.views[v].column, view.views[v].row),
                            masked(view, warped[v], v, exposure)});
  shown.images.push_back({"Synthesised", expose(view.image, exposure)});
  shown.images.push_back({"Visibility", visibility_map(view)});
  result.add_comparison("warped", std::move(shown));
}

/// Share of pixels that all key views see.
double share_seen_by_all(const NovelView<SceneReferred>& view) {
  const auto seen = view.visible_views.pixels();
  const auto all = std::count(seen.begin(), seen.end(), static_cast<std::uint8_t>(view.views.size()));
  return static_cast<double>(all) / static_cast<double>(seen.size());
}

}  // namespace

ReproductionResult reproduce_visible_pixels(Laboratory& laboratory) {
  ReproductionResult result;
  const auto candidates = cell_positions(laboratory.grid(kScene), offsets_inside_cells().first(1));
  const Place place =
      find_place(laboratory.synthesizer(kScene), candidates, laboratory.options().threads, hidden_somewhere);
  const NovelView<SceneReferred>& view = place.view;
  show(result, laboratory, view);
  const auto [least, most] = add_state_rows(result, view);
  const double seen_by_all = share_seen_by_all(view);
  result.rows.add({"seen_by_all_share", seen_by_all, "1", Columns{{"scene", std::string(kScene)}}});
  result.paper_shows =
      "Figure 16 shows the pixels of the top-left key view of the Dominoes scene that remain visible after "
      "it is warped to a novel view: the pixels on pseudo-surfaces and behind occluders are discarded.";
  result.ours_shows = fmt::format(
      "All {} key views around a position in the scene {}, the one of {} cell centres whose best crop has "
      "most discarded pixels. Each key view alone shows {} to {} of the view; {} of its pixels are visible "
      "in all of them and {} in none before restoration: each key view fills the holes that the others "
      "leave.",
      view.views.size(), laboratory.scene(kScene).title, place.searched, percent(least), percent(most),
      percent(seen_by_all),
      percent(static_cast<double>(view.restored_pixels + view.unseen_pixels) /
              static_cast<double>(view.image.size())));
  result.differs =
      "The thesis shows one key view of another scene and leaves discarded pixels dark; here all four are "
      "shown and colours tell the cause.";
  return result;
}

}  // namespace plenolab
