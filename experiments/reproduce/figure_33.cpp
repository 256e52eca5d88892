#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/image/colour.h"
#include "core/synthesis/provenance_maps.h"
#include "experiments/reproduce/figure_pictures.h"
#include "experiments/reproduce/figure_places.h"

namespace plenolab {

ReproductionResult reproduce_thin_branches(Laboratory& laboratory);

namespace {

constexpr const char* kScene = "tree";

/// Disparities of a thin structure in the true view and of what is farthest beside it.
struct ThinPixel {
  int x = 0, y = 0;
  float near = 0, far = 0;
};

/// Smallest disparity of the 2×2 pixels from (x, y) on.
float farthest_of_quad(const DisparityMap& d, int x, int y) {
  return std::min({d.at(x, y), d.at(x + 1, y), d.at(x, y + 1), d.at(x + 1, y + 1)});
}

/// Pixels whose four 2×2 neighbourhoods all hold something farther by more than `limit_px`: the surface is
/// narrower than 2 × 2 px there.
std::vector<ThinPixel> thin_pixels(const DisparityMap& disparity, float limit_px) {
  std::vector<ThinPixel> thin;
  for (int y = 1; y + 1 < disparity.height(); ++y)
    for (int x = 1; x + 1 < disparity.width(); ++x) {
      const std::array quads{farthest_of_quad(disparity, x - 1, y - 1), farthest_of_quad(disparity, x, y - 1),
                             farthest_of_quad(disparity, x - 1, y), farthest_of_quad(disparity, x, y)};
      const auto [far, least_far] = std::minmax_element(quads.begin(), quads.end());
      const float near = disparity.at(x, y);
      if (near - *least_far > limit_px) thin.push_back({x, y, near, *far});
    }
  return thin;
}

/// Whether the view shows the structure (rather than what lies behind it) at its pixel.
bool is_kept(const NovelView<SceneReferred>& view, const ThinPixel& thin) {
  return shown_disparity(view.provenance.at(thin.x, thin.y)) > (thin.near + thin.far) / 2;
}

struct Recall {
  double share = 0;
  Plane<float> lost;  ///< 1 where a thin pixel of the truth is not shown
};

Recall recall_of(const NovelView<SceneReferred>& view, const std::vector<ThinPixel>& thin) {
  Recall recall{0, Plane<float>(view.image.width(), view.image.height())};
  for (const ThinPixel& pixel : thin) {
    const bool kept = is_kept(view, pixel);
    recall.share += kept ? 1 : 0;
    if (!kept) recall.lost.at(pixel.x, pixel.y) = 1;
  }
  if (!thin.empty()) recall.share /= static_cast<double>(thin.size());
  return recall;
}

/// Share of the view's pixels that show something nearer than the truth by more than `limit_px`: structures
/// where there are none.
double invented_share(const NovelView<SceneReferred>& view, const DisparityMap& truth, float limit_px) {
  int invented = 0;
  for (std::size_t n = 0; n < truth.size(); ++n)
    invented += shown_disparity(view.provenance.pixels()[n]) > truth.pixels()[n] + limit_px ? 1 : 0;
  return static_cast<double>(invented) / static_cast<double>(truth.size());
}

/// The thin pixels of the truth: white where a view shows them, red where it does not, over the dimmed truth.
DisplayImage recall_map(const SceneImage& truth, const std::vector<ThinPixel>& thin, const Recall& recall) {
  DisplayImage map = expose(truth, figure_exposure(truth));
  for (Rgb& c : map.pixels()) c = c * 0.5f;
  for (const ThinPixel& p : thin)
    map.at(p.x, p.y) = recall.lost.at(p.x, p.y) > 0 ? Rgb{1, 0.2f, 0.1f} : Rgb{1, 1, 1};
  return map;
}

/// Both ways to synthesise the view, and what they make of thin structures.
struct ThinStudy {
  Place place;  ///< with the view as in the thesis
  NovelView<SceneReferred> keeping;
  KeyView<SceneReferred> truth;
  std::vector<ThinPixel> thin;
  Recall plain, kept;
  double invented = 0, invented_keeping = 0;
  PictureNumbers pictures;
};

ThinStudy study_thin(Laboratory& laboratory) {
  const int threads = laboratory.options().threads;
  const Synthesizer& synthesizer = laboratory.synthesizer(kScene);
  SynthesisOptions options;
  options.threads = threads;
  options.record_provenance = true;
  options.keep_thin = true;
  const auto limit_px = static_cast<float>(options.disocclusion_px);
  ThinStudy study;
  study.place = find_place(synthesizer, cell_positions(laboratory.grid(kScene), offsets_inside_cells()),
                           threads, restored_pixels);
  study.keeping = synthesizer.synthesize(study.place.view.position, options);
  study.truth = laboratory.truth(kScene, study.place.view.position, kTruthPathFactor);
  study.thin = thin_pixels(study.truth.disparity, limit_px);
  study.plain = recall_of(study.place.view, study.thin);
  study.kept = recall_of(study.keeping, study.thin);
  study.invented = invented_share(study.place.view, study.truth.disparity, limit_px);
  study.invented_keeping = invented_share(study.keeping, study.truth.disparity, limit_px);
  return study;
}

void show(ReproductionResult& result, Laboratory& laboratory, ThinStudy& study) {
  const std::string position = name_of(study.place.view.position);
  const SceneImage& truth = study.truth.colour;
  const Columns columns{{"scene", std::string(kScene)}, {"position", position}};
  study.pictures = add_pictures(
      result,
      {.what = laboratory.scene(kScene).title + " from " + position,
       .truth = &truth,
       .synthesised = {{"Synthesised", &study.place.view.image},
                       {"Keeping thin structures", &study.keeping.image}},
       .maps = {{"Thin pixels", recall_map(truth, study.thin, study.plain)},
                {"Thin pixels, keeping", recall_map(truth, study.thin, study.kept)}},
       .box = densest_box(study.plain.lost, crop_size(truth.width(), truth.height())),
       .cut_row = {},
       .note = "Thin pixels: white where the synthesis shows them, red where it does not. Enlarged is the "
               "square that loses most of them"},
      columns, laboratory.options().threads);
  const auto add = [&](const char* method, double recall, double extra) {
    Columns all = columns;
    all.emplace_back("method", std::string(method));
    result.rows.add({"thin_pixels", static_cast<double>(study.thin.size()), "px", all});
    result.rows.add({"thin_recall", recall, "1", all});
    result.rows.add({"invented_share", extra, "1", all});
  };
  add("thesis", study.plain.share, study.invented);
  add("keep_thin", study.kept.share, study.invented_keeping);
}

void describe(ReproductionResult& result, const ThinStudy& study) {
  const double plain = study.plain.share, kept = study.kept.share;
  result.ours_shows = fmt::format(
      "{} pixels of the true view belong to surfaces narrower than 2 × 2 px. The synthesis as in the thesis "
      "shows the structure at {} of them. Our variant that keeps thin structures shows it at {}; pixels "
      "where a view shows something nearer than the truth are {} with it and {} without. PSNR in the "
      "enlarged part, the one that lost most: {:.1f} dB as in the thesis, {:.1f} dB with the variant (whole "
      "view {:.1f} and {:.1f} dB).",
      study.thin.size(), percent(plain), percent(kept), percent(study.invented_keeping),
      percent(study.invented), study.pictures.box[0].psnr_db, study.pictures.box[1].psnr_db,
      study.pictures.whole[0].psnr_db, study.pictures.whole[1].psnr_db);
  result.differs = plain < 0.5 ? "They agree: most thin structures are lost by the method of the thesis."
                               : "They differ: most pixels of thin structures survive here, because "
                                 "neighbouring pixels of larger surfaces cover them.";
  if (kept > plain)
    result.differs +=
        fmt::format(" The variant brings back {} of what is lost.", percent((kept - plain) / (1 - plain)));
  result.key_figures.push_back({"Thin structures shown", format_number(100 * kept, 2), "%",
                                fmt::format("keeping thin structures; {} as in the thesis", percent(plain))});
}

}  // namespace

ReproductionResult reproduce_thin_branches(Laboratory& laboratory) {
  ReproductionResult result;
  result.paper_shows =
      "Figure 33 shows that thin branches of the Tree and fine parts of its leaves are lost: surfaces "
      "narrower than 2 × 2 px lie between foreground and background in every key view, so the background is "
      "shown.";
  ThinStudy study = study_thin(laboratory);
  show(result, laboratory, study);
  if (study.thin.empty()) {
    result.ours_shows = "The true view holds no surface narrower than 2 × 2 px in this run.";
    result.differs = "Nothing can be compared.";
  } else {
    describe(result, study);
  }
  return result;
}

}  // namespace plenolab
