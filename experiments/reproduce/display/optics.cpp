// Figure 3.2 and claim H-10: every number printed about the display's optics, recomputed.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/display/retina.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/display/near_eye_tools.h"

namespace plenolab {

ReproductionResult reproduce_circle_of_confusion(Laboratory& laboratory);
ReproductionResult reproduce_claim_h10(Laboratory& laboratory);

namespace {

constexpr double kPrintedNearLimit_mm = 248;

ReportPlot confusion_plot(const NearEyeDisplay& display) {
  Plot plot;
  plot.x = {.title = "Distance from the eye", .unit = "mm", .logarithmic = true};
  plot.y = {.title = "Diameter", .unit = "mm", .logarithmic = true};
  plot.key = KeyPosition::kTopLeft;
  plot.series = {{.title = "optical circle of confusion", .style = PlotSeries::Style::kLines},
                 {.title = "panel pixel", .style = PlotSeries::Style::kLines}};
  for (int i = 0; i <= 120; ++i) {
    const double d = 100 * std::pow(100, i / 120.0);
    const CircleOfConfusion c = circle_of_confusion(display, d);
    if (c.optical_mm > 1e-3) plot.series[0].points.push_back({.x = d, .y = c.optical_mm});
    plot.series[1].points.push_back({.x = d, .y = c.pixel_mm});
  }
  return {plot, "Circle of confusion of a lens and of a pixel, on a plane at that distance (equation 3.6)",
          "Two curves over distance; the optical one dips to nothing at 1 m and lies below the pixel's "
          "beyond the near "
          "limit"};
}

/// A number of section 3.1.
struct Printed {
  std::string name, unit;
  double printed = 0, recomputed = 0;
  double half_digit = 0;  ///< what rounding the printed digits allows
  std::string remark;
};

std::vector<Printed> printed_numbers(const NearEyeDisplay& d) {
  const double across = total_field_of_view_deg(d, d.columns), down = total_field_of_view_deg(d, d.rows);
  return {{"d_l", "mm", 3.2888, lens_separation_mm(d), 5e-5, ""},
          {"M", "1", 293.42, magnification(d), 5e-3, ""},
          {"α of a lens", "degrees", 17.28, lens_field_of_view_deg(d.lens_pitch_mm, 3.29), 5e-3,
           "with the rounded d_l = 3.29 mm"},
          {"α_t of 15 lenses", "degrees", 24.2, across, 0.05,
           "printed as the vertical one: it is the horizontal one"},
          {"α_t of 8 lenses", "degrees", 13.0, down, 0.05,
           "printed as the horizontal one: it is the vertical one"},
          {"N_p across", "px", 121, spatial_resolution_px(d, across), 0.5, "truncated, not rounded"},
          {"N_p down", "px", 64, spatial_resolution_px(d, down), 0.5, "truncated, not rounded"},
          {"depth of field from", "mm", kPrintedNearLimit_mm, depth_of_field(d).near_mm, 0.5, ""},
          {"pixel pitch", "mm", 0.012, 15.36 / d.panel_width, 5e-4, ""},
          {"α used for rendering", "degrees", d.rendered_fov_deg,
           lens_field_of_view_deg(d.lens_pitch_mm, lens_separation_mm(d)), 5e-3,
           fmt::format("measured instead; a thin lens needs d_l = {:.3f} mm for it",
                       separation_for_field_of_view_mm(d.lens_pitch_mm, d.rendered_fov_deg))}};
}

bool agrees(const Printed& p) {
  return std::abs(p.printed - p.recomputed) <= p.half_digit * (1 + 1e-9);
}

void add_printed(ReproductionResult& result, const std::vector<Printed>& numbers) {
  ReportTable table{"Numbers of section 3.1 as printed and as the equations give them",
                    {"number", "unit", "printed", "recomputed", "within the printed digits", "remark"},
                    {},
                    6};
  for (const Printed& p : numbers) {
    result.rows.add({"optics_recomputed", p.recomputed, p.unit, {{"number", p.name}}});
    result.rows.add({"optics_printed", p.printed, p.unit, {{"number", p.name}}});
    table.rows.push_back(
        {p.name, p.unit, p.printed, p.recomputed, std::string(agrees(p) ? "yes" : "no"), p.remark});
  }
  result.add_table(std::move(table));
}

/// A scene through the lenses of either display, by an eye focused at two distances.
void add_retina(ReproductionResult& result, NearEyeBench& bench, const NearEyeDisplay& printed) {
  const std::string id = "near-eye-3";
  const NearEyeBench::Recipe recipe;
  const SubimageLayout layout = bench.subimages(id);
  NearEyeDisplay consistent = consistent_with_thin_lenses(printed);
  ImageComparison comparison{
      "Objects behind each other, as an eye with a 4 mm pupil sees them through thin lenses: subimages 83 "
      "1/3 px apart as "
      "the lenses are, focused near and far; and with the printed pitch of 80 1/3 px",
      "What the eye sees through the lenses",
      {}};
  struct Look {
    const char* label;
    const NearEyeDisplay* display;
    double focus_mm;
  };
  NearEyeDisplay thesis_display = printed;
  consistent.columns = thesis_display.columns = layout.columns;
  consistent.rows = thesis_display.rows = layout.rows;
  for (const Look& look : {Look{"Focus 0.3 m", &consistent, 300}, Look{"Focus 3 m", &consistent, 3000},
                           Look{"Printed pitch, focus 1 m", &thesis_display, 1000}}) {
    const DisplayImage panel = panel_image(bench.image(id, recipe), layout, *look.display, bench.threads());
    comparison.images.push_back({look.label, retinal_image(panel, *look.display, {.focus_mm = look.focus_mm},
                                                           {.threads = bench.threads()})});
  }
  result.add_comparison("retina", std::move(comparison));
}

}  // namespace

ReproductionResult reproduce_circle_of_confusion(Laboratory&) {
  ReproductionResult result;
  const NearEyeDisplay display;
  const DepthOfField depth = depth_of_field(display);
  result.paper_shows =
      "Figure 3.2: the optical circle of confusion falls to nothing at the virtual image, 1 m away, and "
      "stays below the width of a pixel from 24.8 cm to infinity.";
  result.ours_shows = fmt::format(
      "The two are equal {:.1f} mm from the eye; beyond, the pixel is the wider one{}.", depth.near_mm,
      std::isfinite(depth.far_mm) ? fmt::format(" up to {:.0f} mm", depth.far_mm)
                                  : std::string(" at every distance"));
  result.differs = std::abs(depth.near_mm - kPrintedNearLimit_mm) < 0.5 && !std::isfinite(depth.far_mm)
                       ? "They agree to the printed digits."
                       : "They differ by more than the printed digits allow.";
  result.rows.add({"depth_of_field_near", depth.near_mm, "mm", {}});
  result.rows.add({"depth_of_field_far", depth.far_mm, "mm", {}});
  result.add_plot("circle-of-confusion", confusion_plot(display));
  return result;
}

ReproductionResult reproduce_claim_h10(Laboratory& laboratory) {
  ReproductionResult result;
  const NearEyeDisplay display;
  const std::vector<Printed> numbers = printed_numbers(display);
  add_printed(result, numbers);
  std::string off;
  double count = 0;
  for (const Printed& p : numbers)
    if (!agrees(p)) {
      ++count;
      off += fmt::format("{}{} ({} printed, {})", off.empty() ? "" : ", ", p.name,
                         format_number(p.printed, 6), format_number(p.recomputed, 6));
    }
  const double subimage_mm = display.subimage_pitch_px * display.pixel_pitch_mm;
  const double apparent = apparent_depth_mm(display, display.image_distance_mm - display.eye_relief_mm);
  result.rows.add(
      {"apparent_depth", apparent, "mm", {{"depth_mm", display.image_distance_mm - display.eye_relief_mm}}});
  result.paper_shows =
      "Section 3.1 derives the display's numbers from f, d_0, d_e and w_l by thin-lens equations, then "
      "renders with a field of view of 19.86° instead of 17.28° because that looked sharper.";
  result.ours_shows = fmt::format(
      "{} of {} printed numbers are off by more than their digits: {}. The field of view needs another lens "
      "distance, and "
      "subimages {:.3f} mm wide under lenses of {:g} mm point inwards: through thin lenses rays of what is "
      "rendered at the "
      "virtual image would meet {:.0f} mm from the lenses.",
      count, numbers.size(), off.empty() ? "none" : off, subimage_mm, display.lens_pitch_mm, apparent);
  result.differs =
      "The two total fields of view are swapped in the text, both resolutions are truncated, and the "
      "measured field of "
      "view contradicts the thin lens: a wider angle asks for lenses nearer to the panel or larger "
      "subimages, the "
      "calibrated pitch makes them smaller. One effective length cannot stand for both; the real lenses are "
      "as thick as "
      "their focal length.";
  conclude(
      result,
      {"H-10a", thesis("section 3.1"), "The printed numbers of the optics follow from its equations."}, [&] {
        Verdict v =
            decide_claim({count, count, count}, Comparison::kBelow, 0.5, "numbers_off", "numbers", "exact");
        v.explanation =
            "Printed numbers that differ from the recomputed ones by more than half of their last digit: " +
            (off.empty() ? std::string("none") : off) + ".";
        return v;
      }());
  const double used = display.rendered_fov_deg,
               gap = std::abs(used -
                              lens_field_of_view_deg(display.lens_pitch_mm, lens_separation_mm(display)));
  Verdict verdict =
      decide_claim({gap, gap, gap}, Comparison::kBelow, 0.005, "field_of_view_gap_deg", "degrees", "exact");
  verdict.explanation = fmt::format(
      "A thin lens at d_l shows {:.2f} degrees less than was used; the thesis itself suspects the thin-lens "
      "approximation.",
      gap);
  conclude(result,
           {"H-10b", thesis("section 3.1 and appendix C"),
            "The field of view used agrees with a thin lens at d_l."},
           std::move(verdict));
  add_retina(result, laboratory.near_eye_bench(), display);
  return result;
}

}  // namespace plenolab
