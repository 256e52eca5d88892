// Z-4: which blend is closer to what the thesis takes for right.
#include <fmt/format.h>

#include <array>

#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/lut/lut_tools.h"

namespace plenolab {

ReproductionResult reproduce_claim_z4(Laboratory& laboratory);

namespace {

struct SubClaim {
  const char* id;
  GradeReference reference;
  const char* statement;
};
constexpr std::array kSubClaims{
    SubClaim{"Z-4a", GradeReference::kAhead,
             "Pixel-based blending is closer than linear blending to the frame graded by the volume ahead."},
    SubClaim{"Z-4b", GradeReference::kByObject,
             "Pixel-based blending is closer than linear blending to the image mixed by object."},
    SubClaim{"Z-4c", GradeReference::kByPixel,
             "Pixel-based blending is closer than linear blending to the image mixed by pixel."}};

/// Linear less pixel-based, of some frames.
std::vector<double> gains(WalkBench& bench, GradeReference reference,
                          const std::vector<std::size_t>& frames) {
  std::vector<double> gains;
  for (const std::size_t i : frames)
    gains.push_back(bench.scores()[i].of(BlendMethod::kLinear, reference) -
                    bench.scores()[i].of(BlendMethod::kPixel, reference));
  return gains;
}

std::vector<std::size_t> all_frames(WalkBench& bench) {
  std::vector<std::size_t> all(bench.frames().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

/// Frames whose camera stands in a volume, where the linear method uses its table alone.
std::vector<std::size_t> inside_frames(WalkBench& bench) {
  std::vector<std::size_t> frames;
  for (const std::size_t i : all_frames(bench))
    if (innermost(bench.stage().volumes(), bench.frames()[i].pose.camera.position_m) >= 0)
      frames.push_back(i);
  return frames;
}

ReportPlot gain_plot(WalkBench& bench) {
  Plot plot;
  plot.x = {.title = "Frame of the walk"};
  plot.y = {.title = "ΔE*ab of linear less pixel-based"};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 860;
  for (const GradeReference reference :
       {GradeReference::kAhead, GradeReference::kMost, GradeReference::kByObject}) {
    PlotSeries series{fmt::format("to {}", name_of(reference)), PlotSeries::Style::kLinesPoints, {}};
    const std::vector<double> gain = gains(bench, reference, all_frames(bench));
    for (std::size_t i = 0; i < gain.size(); ++i) series.points.push_back({static_cast<double>(i), gain[i]});
    plot.series.push_back(std::move(series));
  }
  return {plot, "Gain of pixel-based over linear blending over the walk; above 0 pixel-based is closer",
          "Difference of both errors over the frames, for three references."};
}

void add_table(ReproductionResult& result, WalkBench& bench) {
  ReportTable table{"Mean ΔE*ab by reference and part of the walk",
                    {"reference", "frames", "number", "linear", "pixel-based"},
                    {},
                    3};
  const std::vector<std::pair<std::string, std::vector<std::size_t>>> parts{
      {"all", all_frames(bench)},
      {"turning between volumes", turning_frames(bench)},
      {"camera in a volume", inside_frames(bench)}};
  for (std::size_t r = 0; r < kGradeReferences; ++r)
    for (const auto& part : parts) {
      const auto reference = static_cast<GradeReference>(r);
      std::vector<Cell> row{std::string(name_of(reference)), part.first,
                            static_cast<long long>(part.second.size())};
      for (const BlendMethod method : {BlendMethod::kLinear, BlendMethod::kPixel}) {
        const double error = mean_error(bench, method, reference, part.second);
        row.emplace_back(error);
        result.rows.add({"mean_delta_e",
                         error,
                         "1",
                         {{"reference", std::string(name_of(reference))},
                          {"frames", part.first},
                          {"method", std::string(name_of(method))}}});
      }
      table.rows.push_back(std::move(row));
    }
  result.add_table(std::move(table));
}

}  // namespace

ReproductionResult reproduce_claim_z4(Laboratory& laboratory) {
  ReproductionResult result;
  WalkBench& bench = laboratory.walk_bench();
  std::string outcomes, shown;
  for (const SubClaim& claim : kSubClaims) {
    const std::vector<double> all = gains(bench, claim.reference, all_frames(bench));
    const Interval gain = mean_interval(all, laboratory.options().seed, kFramesTogether)
                              .value_or(Interval{mean(all), -1e9, 1e9});
    Verdict verdict = decide_claim(gain, Comparison::kAbove, 0, "delta_e_linear_less_pixel_based", "1",
                                   uncertainty_over(all.size(), "frames", kFramesTogether));
    const double turning = mean(gains(bench, claim.reference, turning_frames(bench)));
    verdict.scenes = {"walk"};
    verdict.explanation = fmt::format(
        "Over the whole walk pixel-based blending is closer to the reference '{}' by {} ΔE*ab (less than 0: "
        "farther), by {:.2f} while the walker turns between volumes.",
        name_of(claim.reference), interval_text(gain), turning);
    shown += fmt::format("{}{} {}", shown.empty() ? "" : ", ", interval_text(gain), name_of(claim.reference));
    outcomes +=
        fmt::format("{}{} is {}", outcomes.empty() ? "" : ", ", claim.id, outcome_name(verdict.outcome));
    conclude(result, {claim.id, lut_paper("section 4.5"), claim.statement}, std::move(verdict));
  }
  result.paper_shows =
      "Sections 4.1 and 4.5: the result of pixel-based blending is closer to the colours of the table that "
      "ought to be seen than that of linear blending, judged by eye.";
  result.ours_shows =
      fmt::format("Gain of pixel-based over linear blending in mean ΔE*ab over {} frames, by reference: {}.",
                  bench.frames().size(), shown);
  const std::vector<std::size_t> inside = inside_frames(bench);
  const auto inside_error = [&](BlendMethod method) {
    return mean_error(bench, method, GradeReference::kByObject, inside);
  };
  result.differs = fmt::format(
      "{}. Two things favour the pixel-based blend: the volume ahead is judged from the same pixels, and "
      "the blend is the mean of the tables of the image mixed by pixel. How much is gained depends on the "
      "walk: with the camera in a volume, where the linear method shows that volume's table unmixed, the "
      "difference to the image mixed by object is {:.2f} (linear) and {:.2f} (pixel-based). Between volumes "
      "only the pixel-based blend knows where the walker looks.",
      outcomes, inside_error(BlendMethod::kLinear), inside_error(BlendMethod::kPixel));
  add_table(result, bench);
  result.add_plot("gain-over-the-walk", gain_plot(bench));
  return result;
}

}  // namespace plenolab
