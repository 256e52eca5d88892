#include "experiments/reproduce/figure_places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/image/colour.h"
#include "core/synthesis/prepared_view.h"
#include "core/synthesis/provenance_maps.h"

namespace plenolab {

namespace {

/// Colour at A: bilinear between pixel centres, as in the synthesis.
Rgb sample(const PreparedView& prepared, const Correspondence& c) {
  const float u = c.x - 0.5f, v = c.y - 0.5f;
  const int i = std::clamp(static_cast<int>(u), 0, prepared.width - 1);
  const int j = std::clamp(static_cast<int>(v), 0, prepared.height - 1);
  const int right = std::min(i + 1, prepared.width - 1), below = std::min(j + 1, prepared.height - 1);
  const float fx = u - static_cast<float>(i), fy = v - static_cast<float>(j);
  const auto colour = [&](int x, int y) {
    const ColourDisparity& p = prepared.pixels.at(x, y);
    return Rgb{p.r, p.g, p.b};
  };
  const Rgb upper = colour(i, j) * (1 - fx) + colour(right, j) * fx;
  const Rgb lower = colour(i, below) * (1 - fx) + colour(right, below) * fx;
  return upper * (1 - fy) + lower * fy;
}

/// Deviation of each view's luma, clipped as it is shown, from the weighted mean of the contributing views.
std::vector<Plane<float>> deviations(const std::vector<WarpedView>& warped, float encoded_exposure, int width,
                                     int height) {
  std::vector<Plane<float>> all(warped.size(), Plane<float>(width, height));
  for (std::size_t n = 0; n < static_cast<std::size_t>(width) * static_cast<std::size_t>(height); ++n) {
    float weight = 0, mean = 0;
    for (std::size_t v = 0; v < warped.size(); ++v) {
      const float luma = std::min(1.0f, luminance(warped[v].encoded.pixels()[n] * encoded_exposure));
      all[v].pixels()[n] = luma;
      weight += warped[v].weight.pixels()[n];
      mean += warped[v].weight.pixels()[n] * luma;
    }
    for (std::size_t v = 0; v < warped.size(); ++v)
      all[v].pixels()[n] = warped[v].weight.pixels()[n] > 0 ? all[v].pixels()[n] - mean / weight : 0.0f;
  }
  return all;
}

/// Mean over those of the 5×5 pixels around whose contributing views are the same: across a visibility border
/// the deviations have another mean.
Plane<float> mean_within_set(const Plane<float>& values, const Plane<std::uint8_t>& sets) {
  constexpr int kRadius = 2;
  Plane<float> means(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x) {
      float sum = 0;
      int count = 0;
      for (int v = std::max(y - kRadius, 0); v <= std::min(y + kRadius, values.height() - 1); ++v)
        for (int u = std::max(x - kRadius, 0); u <= std::min(x + kRadius, values.width() - 1); ++u) {
          if (sets.at(u, v) != sets.at(x, y)) continue;
          sum += values.at(u, v);
          ++count;
        }
      means.at(x, y) = sum / static_cast<float>(count);
    }
  return means;
}

/// Key views warped to the novel view, who contributes where, and by how much they deviate from the blend.
struct Contributions {
  std::vector<WarpedView> warped;
  Plane<std::uint8_t> sets;
  std::vector<Plane<float>> deviations;
};

Contributions contributions_to(const NovelView<SceneReferred>& view, const LightField& field) {
  const int width = view.image.width(), height = view.image.height();
  Contributions all;
  all.warped = warp_key_views(view, field);
  all.sets = contributing_views(view.provenance);
  all.deviations = deviations(all.warped, gamma_encode(figure_exposure(view.image)), width, height);
  for (Plane<float>& one : all.deviations) one = mean_within_set(one, all.sets);
  return all;
}

/// Disparity of the nearest surface that a contributing view shows at a pixel, −1 for none.
float nearest_shown_disparity(const PixelProvenance& provenance) {
  float disparity = -1;
  for (const Correspondence& c : provenance)
    if (c.state == CorrespondenceState::kUsed) disparity = std::max(disparity, c.disparity_px);
  return disparity;
}

/// What the blend at pixel n would change by if only the views of `left` were left; 0 unless these are some,
/// but not all, of those that contribute there.
float loss_towards(const Contributions& all, std::size_t n, std::uint8_t left) {
  const std::uint8_t set = all.sets.pixels()[n];
  if ((set & left) == 0 || (set & left) == set) return 0;
  float weight = 0, change = 0;
  for (std::size_t v = 0; v < all.warped.size(); ++v) {
    if ((left >> v & 1) == 0) continue;
    weight += all.warped[v].weight.pixels()[n];
    change += all.warped[v].weight.pixels()[n] * all.deviations[v].pixels()[n];
  }
  return weight > 0 ? change / weight : 0;
}

double sum_inside(const Plane<float>& values, const PixelBox& box) {
  double sum = 0;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) sum += static_cast<double>(values.at(x, y));
  return sum;
}

}  // namespace

std::span<const CameraPosition> offsets_inside_cells() {
  static constexpr std::array<CameraPosition, 5> kOffsets{
      {{0.5, 0.5}, {0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}};
  return kOffsets;
}

std::span<const CameraPosition> offsets_on_rows() {
  static constexpr std::array<CameraPosition, 1> kOffsets{{{0.5, 0}}};
  return kOffsets;
}

std::vector<CameraPosition> cell_positions(const ViewGrid& grid, std::span<const CameraPosition> offsets) {
  std::vector<CameraPosition> positions;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      for (const CameraPosition& offset : offsets) {
        const CameraPosition position{column + offset.s, row + offset.t};
        if (grid.contains(position)) positions.push_back(position);
      }
  if (positions.empty()) positions.push_back({(grid.columns - 1) / 2.0, (grid.rows - 1) / 2.0});
  return positions;
}

Place find_place(const Synthesizer& synthesizer, std::span<const CameraPosition> candidates, int threads,
                 const EffectMeasure& measure) {
  PLENOLAB_CHECK(!candidates.empty(), "no positions");
  SynthesisOptions options;
  options.threads = threads;
  options.record_provenance = true;
  Place best;
  best.sum = -1;
  synthesizer.synthesize_sequence(candidates, options, [&](std::size_t, NovelView<SceneReferred>&& view) {
    Plane<float> effect = measure(view);
    const PixelBox box = densest_box(effect, crop_size(effect.width(), effect.height()));
    const double sum = sum_inside(effect, box);
    if (sum > best.sum) best = {std::move(view), std::move(effect), box, sum, 0};
  });
  best.searched = static_cast<int>(candidates.size());
  return best;
}

std::vector<WarpedView> warp_key_views(const NovelView<SceneReferred>& view, const LightField& field) {
  const int width = view.image.width(), height = view.image.height();
  std::vector<WarpedView> warped;
  for (std::size_t v = 0; v < view.views.size(); ++v) {
    const PreparedView prepared = prepare_view(*field.view(view.views[v].column, view.views[v].row));
    WarpedView& out = warped.emplace_back(WarpedView{Plane<Rgb>(width, height), Plane<float>(width, height)});
    for (std::size_t n = 0; n < view.provenance.size(); ++n) {
      const Correspondence& c = view.provenance.pixels()[n][v];
      if (c.state == CorrespondenceState::kNotUsed || c.state == CorrespondenceState::kOutOfFrustum) continue;
      out.encoded.pixels()[n] = sample(prepared, c);
      if (c.state == CorrespondenceState::kUsed) out.weight.pixels()[n] = c.weight;
    }
  }
  return warped;
}

Plane<float> unseen_beyond_frustum(const NovelView<SceneReferred>& view) {
  Plane<float> effect(view.image.width(), view.image.height());
  for (std::size_t n = 0; n < effect.size(); ++n) {
    const PixelProvenance& pixel = view.provenance.pixels()[n];
    const bool beyond = std::any_of(pixel.begin(), pixel.end(), [](const Correspondence& c) {
      return c.state == CorrespondenceState::kOutOfFrustum;
    });
    effect.pixels()[n] = beyond && view.visible_views.pixels()[n] == 0 ? 1.0f : 0.0f;
  }
  const Plane<float> share = box_mean(effect, 2);
  for (std::size_t n = 0; n < effect.size(); ++n) effect.pixels()[n] *= share.pixels()[n];
  return effect;
}

Plane<float> restored_pixels(const NovelView<SceneReferred>& view) {
  return as_weights(view.restored);
}

EffectMeasure disagreement_of_views(const LightField& field) {
  return [field](const NovelView<SceneReferred>& view) {
    const Contributions all = contributions_to(view, field);
    Plane<float> effect(view.image.width(), view.image.height());
    for (std::size_t v = 0; v < all.warped.size(); ++v)
      for (std::size_t n = 0; n < effect.size(); ++n) {
        const float deviation = all.deviations[v].pixels()[n];
        effect.pixels()[n] += all.warped[v].weight.pixels()[n] * deviation * deviation;
      }
    return effect;
  };
}

EffectMeasure jump_at_visibility_borders(const LightField& field) {
  return [field](const NovelView<SceneReferred>& view) {
    const Contributions all = contributions_to(view, field);
    const int width = view.image.width(), height = view.image.height();
    Plane<float> effect(width, height);
    const auto compare = [&](int x, int y, int dx, int dy) {
      const float here = nearest_shown_disparity(view.provenance.at(x, y));
      const float beside = nearest_shown_disparity(view.provenance.at(x + dx, y + dy));
      if (here < 0 || beside < 0 || std::abs(here - beside) >= 1) return;
      const auto n =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const auto next = dx == 1 ? n + 1 : n + static_cast<std::size_t>(width);
      const float jump = std::max(std::abs(loss_towards(all, n, all.sets.pixels()[next])),
                                  std::abs(loss_towards(all, next, all.sets.pixels()[n])));
      effect.at(x, y) = std::max(effect.at(x, y), jump * jump);
    };
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (x + 1 < width) compare(x, y, 1, 0);
        if (y + 1 < height) compare(x, y, 0, 1);
      }
    return effect;
  };
}

}  // namespace plenolab
