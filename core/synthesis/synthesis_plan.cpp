#include "core/synthesis/synthesis_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace plenolab {
namespace {

class PlanMaker {
 public:
  PlanMaker(std::span<const UsedView> views, std::span<const std::shared_ptr<const PreparedView>> prepared,
            std::vector<EpipolarPath> paths, float d_max_px, const SynthesisOptions& options)
      : views_(views), prepared_(prepared), d_max_px_(d_max_px), options_(options) {
    plan_.paths = std::move(paths);
  }

  SynthesisPlan make() {
    set_up_blend();
    build_occupancies();
    return std::move(plan_);
  }

 private:
  int count() const { return static_cast<int>(views_.size()); }

  void prune(const char* stage, const std::string& reason) { plan_.pruned.push_back({stage, reason}); }

  void set_up_blend() {
    plan_.blend.count = count();
    plan_.blend.options = options_;
    plan_.blend.record = options_.record_provenance;
    float nearest = 0, farthest = d_max_px_, quad_range = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      plan_.blend.prepared[v] = prepared_[v].get();
      plan_.blend.used[v] = views_[v];
      nearest = std::max(nearest, prepared_[v]->max_disparity);
      farthest = std::min(farthest, prepared_[v]->min_disparity);
      quad_range = std::max(quad_range, prepared_[v]->max_quad_range);
    }
    if (!options_.prune) return;
    if (quad_range <= static_cast<float>(options_.disocclusion_px)) {
      plan_.blend.test_disocclusion = false;
      prune("disocclusion test and restoration",
            fmt::format("neighbouring pixels differ by at most {:.3g} px of disparity, rule 2 allows {:g} px",
                        quad_range, options_.disocclusion_px));
    }
    if (count() == 1) {
      plan_.blend.test_occlusion = false;
      prune("occlusion test", "a single key view takes part");
    } else if (nearest <= farthest + static_cast<float>(options_.occlusion_margin_px)) {
      plan_.blend.test_occlusion = false;
      prune("occlusion test",
            fmt::format("disparities lie in [{:.3g}, {:.3g}] px, which is within δ_occ = {:g} px", farthest,
                        nearest, options_.occlusion_margin_px));
    }
  }

  void build_occupancies() {
    for (std::size_t v = 0; v < plan_.paths.size(); ++v) {
      const EpipolarPath& path = plan_.paths[v];
      const bool below_step = path.d_max < path.step || path.is_key_view();
      if (options_.prune && below_step) {
        prune("first pass of the search",
              path.is_key_view()
                  ? std::string("the position is that of the key view")
                  : fmt::format("in key view ({}, {}) the largest disparity of {:.3g} px is below one step "
                                "of {:.3g} px",
                                views_[v].column, views_[v].row, path.d_max, path.step));
        plan_.occupancies[v] = last_sample_only(path);
      } else if (options_.search == SearchKind::kFast) {
        plan_.occupancies[v] = build_occupancy(*prepared_[v], path, options_.threads);
      }
      if (options_.keep_thin && plan_.blend.test_disocclusion)
        plan_.splats[v] =
            std::make_unique<ThinSplats>(splat_edge_pixels(*prepared_[v], path, options_.disocclusion_px));
    }
  }

  std::span<const UsedView> views_;
  std::span<const std::shared_ptr<const PreparedView>> prepared_;
  float d_max_px_;
  const SynthesisOptions& options_;
  SynthesisPlan plan_;
};

}  // namespace

SynthesisPlan make_plan(std::span<const UsedView> views,
                        std::span<const std::shared_ptr<const PreparedView>> prepared,
                        std::vector<EpipolarPath> paths, float d_max_px, const SynthesisOptions& options) {
  return PlanMaker(views, prepared, std::move(paths), d_max_px, options).make();
}

}  // namespace plenolab
