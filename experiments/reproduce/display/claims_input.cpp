// Claims H-7 to H-9: what reprojection asks of resolution, depth and sampling of the rendered cameras.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/display/degraded_input.h"
#include "experiments/reproduce/display/near_eye_tools.h"
#include "experiments/reproduce/figure_pictures.h"

namespace plenolab {

ReproductionResult reproduce_claim_h7(Laboratory& laboratory);
ReproductionResult reproduce_claim_h8(Laboratory& laboratory);
ReproductionResult reproduce_claim_h9(Laboratory& laboratory);

namespace {

// ---- H-7: resolution ----

/// Codes of 255 by which a channel may differ before its pixel counts as wrong.
constexpr int kRightCodes = 5;

/// 5 × 3 cameras over the same area as the display's, without supersampling.
NearEyeScene at_resolution(const NearEyeScene& scene, int size_px) {
  NearEyeScene result = scene;
  const double width_m = (scene.grid.columns - 1) * scene.grid.spacing_x_m;
  result.grid.columns = 5;
  result.grid.rows = 3;
  result.grid.spacing_x_m = result.grid.spacing_y_m = width_m / 4;
  result.grid.width = result.grid.height = size_px;
  result.supersampling = 1;
  return result;
}

/// Of all pixels of a light field.
struct ResolutionShares {
  double wrong = 0, holes = 0;
};

ResolutionShares shares_at(NearEyeBench& bench, const std::string& id, int size_px) {
  const NearEyeScene scene = at_resolution(bench.scene(id), size_px);
  const ReprojectionOptions options{.threads = bench.threads()};
  const ReprojectionResult image =
      reproject(camera_array(scene.grid), render_cameras(scene, 4, bench.threads()), options);
  const DisplayImage truth = render_directly(scene, bench.threads()).light_field;
  return {share_beyond_codes(truth, image.light_field, kRightCodes),
          static_cast<double>(image.holes) / static_cast<double>(truth.size())};
}

/// Shares of each scene at each of the sizes, smallest first.
using SharesByScene = std::vector<std::vector<ResolutionShares>>;

SharesByScene measure_resolutions(NearEyeBench& bench, const std::vector<int>& sizes, ResultTable& rows) {
  SharesByScene shares;
  for (const std::string& id : bench.scene_ids()) {
    shares.emplace_back();
    for (const int size : sizes) {
      const ResolutionShares here = shares_at(bench, id, size);
      const Columns columns{{"scene", id}, {"size_px", static_cast<long long>(size)}};
      rows.add({"share_wrong", here.wrong, "1", columns});
      rows.add({"share_holes", here.holes, "1", columns});
      shares.back().push_back(here);
    }
  }
  return shares;
}

ReportPlot resolution_plot(NearEyeBench& bench, const std::vector<int>& sizes, const SharesByScene& shares) {
  Plot plot;
  plot.x = {.title = "Size of a subimage", .unit = "px", .logarithmic = true};
  plot.y = {.title = "Wrong pixels", .unit = "share", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  int falling = 0;
  for (std::size_t s = 0; s < shares.size(); ++s) {
    plot.series.push_back({.title = bench.scene(bench.scene_ids()[s]).scene.scene().title});
    for (std::size_t i = 0; i < sizes.size(); ++i)
      plot.series.back().points.push_back({.x = static_cast<double>(sizes[i]), .y = shares[s][i].wrong});
    falling += std::adjacent_find(shares[s].begin(), shares[s].end(), [](const auto& a, const auto& b) {
                 return b.wrong >= a.wrong;
               }) == shares[s].end();
  }
  return {plot, "Share of wrong pixels over the size of a subimage",
          fmt::format("A line for each scene; {} of {} fall at every step.", falling, shares.size())};
}

/// Which scene gains least from resolution, and what holes do meanwhile: what no camera sees cannot be right.
std::string resolution_text(NearEyeBench& bench, const SharesByScene& shares) {
  const auto gain = [](const std::vector<ResolutionShares>& of_scene) {
    return of_scene.back().wrong / std::max(of_scene.front().wrong, 1e-12);
  };
  const auto least = std::max_element(shares.begin(), shares.end(),
                                      [&](const auto& a, const auto& b) { return gain(a) < gain(b); });
  double low = 0, high = 0;
  for (const auto& of_scene : shares) low += of_scene.front().holes, high += of_scene.back().holes;
  const auto scenes = static_cast<double>(shares.size());
  return fmt::format(
      " Measured with 5 × 3 cameras over the same area, without supersampling. Least is gained in the scene "
      "{} ({:.3g} times as large a share). Holes, which no camera sees, take {} of the pixels at the lowest "
      "resolution and {} at the highest, mean of the scenes.",
      bench.scene(bench.scene_ids()[static_cast<std::size_t>(least - shares.begin())]).scene.scene().title,
      gain(*least), percent(low / scenes), percent(high / scenes));
}

// ---- H-8: coding of depth ----

double error_with_coding(NearEyeBench& bench, const std::string& id, const DepthCoding& coding) {
  std::vector<RenderedCamera> cameras = bench.cameras(id, 4);
  for (RenderedCamera& camera : cameras)
    for (float& z : camera.depth_m.pixels()) z = coded_depth(z, coding);
  const CameraArray array = bench.array(id);
  const ReprojectionResult r = reproject(array, cameras, {.threads = bench.threads()});
  return mean_absolute(bench.truth(id), to_subimages(r.light_field, array.layout, 2, bench.threads()));
}

/// Mean |VC − IC| of each scene by coding, and with exact depth.
struct CodingErrors {
  std::array<std::vector<double>, kDepthCodings.size()> coded;
  std::vector<double> exact;
};

CodingErrors coding_errors(NearEyeBench& bench) {
  CodingErrors errors;
  for (const std::string& id : bench.scene_ids()) {
    errors.exact.push_back(mean_absolute(bench.truth(id), bench.image(id, {})));
    for (std::size_t c = 0; c < kDepthCodings.size(); ++c)
      errors.coded[c].push_back(error_with_coding(bench, id, kDepthCodings[c]));
  }
  return errors;
}

ResultTable coding_rows(NearEyeBench& bench, const CodingErrors& errors) {
  ResultTable rows;
  for (std::size_t s = 0; s < bench.scene_ids().size(); ++s)
    for (std::size_t c = 0; c < kDepthCodings.size(); ++c)
      rows.add({"mean_difference",
                errors.coded[c][s],
                "1",
                {{"scene", bench.scene_ids()[s]}, {"coding", std::string(kDepthCodings[c].name)}}});
  return rows;
}

ReportPlot coding_plot(NearEyeBench& bench, const CodingErrors& errors) {
  Plot plot;
  plot.x.title = "Coding of depth";
  plot.y = {.title = "Mean |VC − IC|", .unit = "1", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  for (const DepthCoding& c : kDepthCodings) plot.categories.emplace_back(c.name);
  for (std::size_t s = 0; s < bench.scene_ids().size(); ++s) {
    plot.series.push_back({.title = bench.scene(bench.scene_ids()[s]).scene.scene().title});
    for (const std::vector<double>& of_coding : errors.coded)
      plot.series.back().points.push_back({.y = of_coding[s]});
  }
  return {plot, "Mean difference by coding of depth", "Bars for each coding and scene"};
}

// ---- H-9: anti-aliased input ----

/// What corner cameras of two resolutions give: mean |VC − IC| and the share of stray depths.
struct InputQuality {
  double error = 0, stray = 0;
};

InputQuality quality_of(NearEyeBench& bench, const std::string& id, const ReprojectionResult& r) {
  const CameraArray array = bench.array(id);
  return {mean_absolute(bench.truth(id), to_subimages(r.light_field, array.layout, 2, bench.threads())),
          stray_share(r.disparity_px, bench.true_disparity_px(id), array.layout.size_px)};
}

/// Corner cameras as they are, with averaged colour, and with averaged colour and depth.
constexpr std::array<const char*, 3> kInputs{"point-sampled", "colour averaged", "colour and depth averaged"};

std::array<InputQuality, kInputs.size()> input_qualities(NearEyeBench& bench, const std::string& id) {
  const std::vector<RenderedCamera>& sharp = bench.cameras(id, 4);
  NearEyeScene twice = bench.scene(id);
  twice.grid.width = twice.grid.height = 2 * twice.grid.width;
  const std::vector<RenderedCamera> fine = render_cameras(twice, 4, bench.threads());
  const auto with = [&](bool depth_too) {
    std::vector<RenderedCamera> cameras;
    for (std::size_t i = 0; i < sharp.size(); ++i)
      cameras.push_back(anti_aliased(sharp[i], fine[i], depth_too));
    const ReprojectionOptions options{.record_maps = true, .threads = bench.threads()};
    return quality_of(bench, id, reproject(bench.array(id), cameras, options));
  };
  return {quality_of(bench, id, *bench.reprojected(id, {})), with(false), with(true)};
}

/// By input, one number for each scene.
struct InputsOverScenes {
  std::array<std::vector<double>, kInputs.size()> errors, strays;
};

/// Files the rows and the table as well.
InputsOverScenes measure_inputs(NearEyeBench& bench, ReproductionResult& result) {
  InputsOverScenes measured;
  ReportTable table{
      "Corner cameras point-sampled and averaged: mean |VC − IC|, and the share of matches with a depth that "
      "nothing around has",
      {"scene", "point-sampled", "colour averaged", "colour and depth averaged",
       "stray depths, point-sampled", "colour averaged", "colour and depth averaged"},
      {},
      3};
  for (const std::string& id : bench.scene_ids()) {
    const auto qualities = input_qualities(bench, id);
    std::vector<Cell> row{bench.scene(id).scene.scene().title};
    for (std::size_t i = 0; i < kInputs.size(); ++i) {
      const Columns columns{{"scene", id}, {"input", std::string(kInputs[i])}};
      result.rows.add({"mean_difference", qualities[i].error, "1", columns});
      result.rows.add({"stray_depth_share", qualities[i].stray, "1", columns});
      measured.errors[i].push_back(qualities[i].error);
      measured.strays[i].push_back(qualities[i].stray);
      row.emplace_back(qualities[i].error);
    }
    for (const InputQuality& q : qualities) row.emplace_back(percent(q.stray));
    table.rows.push_back(std::move(row));
  }
  result.add_table(std::move(table));
  return measured;
}

}  // namespace

ReproductionResult reproduce_claim_h7(Laboratory& laboratory) {
  ReproductionResult result;
  NearEyeBench& bench = laboratory.near_eye_bench();
  const std::vector<int> sizes =
      laboratory.options().effort == Effort::kTiny ? std::vector{20, 40} : std::vector{40, 81, 162};
  const SharesByScene shares = measure_resolutions(bench, sizes, result.rows);
  std::vector<double> lowest, highest;
  for (const auto& of_scene : shares) {
    lowest.push_back(of_scene.front().wrong);
    highest.push_back(of_scene.back().wrong);
  }
  const Interval ratio = ratio_over_scenes(highest, lowest, laboratory.options().seed);
  Verdict verdict = decide_claim(ratio, Comparison::kBelow, 1, "share_wrong_high_over_low_resolution", "1",
                                 kRatioOverScenes);
  result.paper_shows = "Higher resolution lowers the share of wrong pixels.";
  result.ours_shows = fmt::format(
      "With subimages of {} px {} times as large a share of the pixels is wrong (a channel off by more than "
      "five codes) as with {} px.",
      sizes.back(), interval_text(ratio), sizes.front());
  result.differs = outcome_text(verdict.outcome) + resolution_text(bench, shares);
  result.add_plot("wrong-pixels", resolution_plot(bench, sizes, shares));
  conclude_on_scenes(
      result, bench,
      {"H-7", "Hansen, Klein & Kraus, section 7", "Higher resolution lowers the share of wrong pixels."},
      std::move(verdict), result.ours_shows);
  return result;
}

ReproductionResult reproduce_claim_h8(Laboratory& laboratory) {
  ReproductionResult result;
  NearEyeBench& bench = laboratory.near_eye_bench();
  const CodingErrors errors = coding_errors(bench);
  result.rows.append(coding_rows(bench, errors));
  const std::uint64_t seed = laboratory.options().seed;
  const Interval linear = ratio_over_scenes(errors.coded[0], errors.exact, seed),
                 z_buffer = ratio_over_scenes(errors.coded[1], errors.exact, seed),
                 float_z = ratio_over_scenes(errors.coded.back(), errors.exact, seed);
  // "Enough": within a hundredth of exact depth.
  constexpr double kEnough = 1.01;
  Verdict linear_short = decide_claim(linear, Comparison::kAbove, kEnough,
                                      "difference_8_bit_linear_over_exact", "1", kRatioOverScenes);
  Verdict z_buffer_short = decide_claim(z_buffer, Comparison::kAbove, kEnough,
                                        "difference_8_bit_z_buffer_over_exact", "1", kRatioOverScenes);
  Verdict enough = decide_claim(float_z, Comparison::kBelow, kEnough, "difference_float_over_exact", "1",
                                kRatioOverScenes);
  result.paper_shows =
      "Depth in a texture of 8 bits a channel is not precise enough; a texture of 32-bit floats is.";
  result.ours_shows = fmt::format(
      "Mean difference as a multiple of that with exact depth: {} with 8 bits of linear depth between {:g} "
      "and {:g} m, {} with 8 bits of z-buffer, {} with a z-buffer of floats.",
      interval_text(linear), kCodedNear_m, kCodedFar_m, interval_text(z_buffer), interval_text(float_z));
  result.differs = fmt::format(
      "Eight bits not enough: linear {}, z-buffer {}. Floats enough: {}. The paper does not say how its 8 "
      "bits were coded, and the clipping planes are our choice; z-buffers spend their steps near, where "
      "disparity needs them: {}.",
      outcome_name(linear_short.outcome), outcome_name(z_buffer_short.outcome), outcome_name(enough.outcome),
      z_buffer.estimate < linear.estimate ? "at 8 bits they lose less than linear depth"
                                          : "at 8 bits that does not help here");
  result.add_plot("depth-coding", coding_plot(bench, errors));
  conclude_on_scenes(result, bench,
                     {"H-8a-linear", thesis("section 3.2.1"), "Linear depth of 8 bits is not enough."},
                     std::move(linear_short), result.ours_shows);
  conclude_on_scenes(result, bench,
                     {"H-8a-z-buffer", thesis("section 3.2.1"), "A z-buffer of 8 bits is not enough."},
                     std::move(z_buffer_short), result.ours_shows);
  conclude_on_scenes(result, bench, {"H-8b", thesis("section 3.2.1"), "Depth of 32-bit floats is enough."},
                     std::move(enough), result.ours_shows);
  return result;
}

ReproductionResult reproduce_claim_h9(Laboratory& laboratory) {
  ReproductionResult result;
  NearEyeBench& bench = laboratory.near_eye_bench();
  const InputsOverScenes measured = measure_inputs(bench, result);
  const auto& [errors, strays] = measured;
  const std::uint64_t seed = laboratory.options().seed;
  const Interval depth = ratio_over_scenes(errors[2], errors[1], seed),
                 colour = ratio_over_scenes(errors[1], errors[0], seed);
  Verdict verdict =
      decide_claim(depth, Comparison::kAbove, 1, "difference_depth_averaged_over_not", "1", kRatioOverScenes);
  result.rows.add({"difference_colour_averaged_over_point_sampled", colour.estimate, "1", {}});
  result.paper_shows =
      "Section 3.2: anti-aliased corner views break the matching of depths, so smoothing comes after "
      "reprojection.";
  result.ours_shows = fmt::format(
      "With depth averaged over 2 × 2 samples besides colour the mean difference is {} times that with "
      "colour averaged alone; averaging colour alone makes it {} times that of point samples. On average "
      "over the scenes {} of the matches have a depth that nothing around has, {} without averaged depth.",
      interval_text(depth), interval_text(colour), percent(mean(strays[2])), percent(mean(strays[1])));
  result.differs =
      outcome_text(verdict.outcome) +
      " Decided by averaged depth against point-sampled depth with the same averaged colour, so that blur, "
      "which both have, does not count (the measure was changed after a first look, at which colour and "
      "depth were averaged at once). Averaged depths lie between two surfaces, where nothing is.";
  conclude_on_scenes(result, bench,
                     {"H-9", thesis("section 3.2"),
                      "Averaged depth of anti-aliased corner cameras makes reprojection worse."},
                     std::move(verdict), result.ours_shows);
  return result;
}

}  // namespace plenolab
