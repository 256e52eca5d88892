#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/calibration/conflict.h"
#include "analysis/calibration/setups.h"
#include "experiments/calibration/calibration_page.h"
#include "experiments/calibration/calibration_results.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

ReproductionResult reproduce_field_of_view_conflict(Laboratory& laboratory);

namespace {

constexpr double kMeasured_deg = 19.86;
constexpr double kPixelsPerSubimageUsed = 80 + 1.0 / 3;  // section 3.2.3
constexpr double kClose = 0.05;                          // the thesis says "close": ours
/// By what our deviations are multiplied to see what hangs on them.
constexpr std::array kDeviationFactors{0.5, 1.0, 2.0};

CalibrationMeasurements with_deviations(CalibrationMeasurements m, double factor) {
  for (CalibrationRecord& record : m.records)
    std::visit(
        [&](auto& r) {
          if constexpr (requires { r.sd_mm; })
            r.sd_mm *= factor;
          else if constexpr (requires { r.sd_deg; })
            r.sd_deg *= factor;
          else if constexpr (requires { r.sd_dpt; })
            r.sd_dpt *= factor;
          else if constexpr (requires { r.sd_px; })
            r.sd_px *= factor;
          else
            r.sd *= factor;
        },
        record);
  for (ParameterSetting& p : m.parameters) p.sd *= factor;
  return m;
}

const DoubtedSource& without(const std::vector<DoubtedSource>& doubts, const std::string& source) {
  return *std::find_if(doubts.begin(), doubts.end(),
                       [&](const DoubtedSource& d) { return d.source == source; });
}

CalibrationEstimate field_of_view_in(const CalibrationFit& fit) {
  return fit.uncertainty.derived.front();
}

/// The field of view that everything but the measured angle and appendix D says: what was calculated.
CalibrationEstimate calculated(const CalibrationMeasurements& thesis) {
  CalibrationMeasurements rest = thesis;
  std::erase_if(rest.records,
                [](const CalibrationRecord& r) { return !std::holds_alternative<FocusRecord>(r); });
  return field_of_view_in(fit_calibration(rest, {.loss = CalibrationLoss::kNone}));
}

Verdict decide_close(const CalibrationEstimate& fov) {
  const auto apart = [](double calculated_deg) { return kMeasured_deg / calculated_deg - 1; };
  Verdict verdict =
      decide_claim({apart(fov.value), apart(fov.high()), apart(fov.low())}, Comparison::kBelow, kClose,
                   "relative_difference", "1", "95 % of the calculated angle, from the deviations we assume");
  verdict.explanation = fmt::format(
      "The lengths of section 3.1 give {:.2f}° ± {:.2f}°; measured was {:.2f}°. “Close” is taken as within "
      "{:.0f} %.",
      fov.value, *fov.sd, kMeasured_deg, 100 * kClose);
  return verdict;
}

/// p of everything that was printed if focal length and lens distance may be whatever they like.
double p_with_any_lens(const CalibrationMeasurements& thesis, double factor) {
  return without(doubt_each_source(with_deviations(thesis, factor)), "anchor of f").fit.p_value.value_or(1);
}

Verdict decide_lens(const CalibrationMeasurements& thesis, const CalibrationFit& any_lens) {
  std::array<double, kDeviationFactors.size()> p{};
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = p_with_any_lens(thesis, kDeviationFactors[i]);
  const auto [low, high] = std::minmax_element(p.begin(), p.end());
  return undecidable(fmt::format(
      "The printed figures cannot decide it: the thesis states no deviations, and a p-value is no "
      "measurement with an interval. With d_l and f free to be anything, so that no lens equation ties them "
      "to their nominal values, they become {} mm and {} mm; with the deviations we assume all figures then "
      "have p = {}, between {} and {} with these halved and doubled, as long as lens pitch and panel are "
      "what they are said to be.",
      format_number(any_lens.values[index_of(CalibrationParameter::kLensDistance)]),
      format_number(any_lens.values[index_of(CalibrationParameter::kFocalLength)]), format_number(p[1], 2),
      format_number(*low, 2), format_number(*high, 2)));
}

void add_doubts(ReproductionResult& result, const std::string& caption,
                const std::vector<DoubtedSource>& doubts) {
  const WideDesign design = doubt_design(doubts);
  result.add_table(wide_table(doubt_rows(doubts), design.keys, design.columns, caption));
}

/// The lens distance that the measured angle needs with subimages of this width.
double distance_for_angle_mm(double subimage_mm) {
  return subimage_mm / (2 * std::tan(radians(kMeasured_deg) / 2));
}

std::string value_text(const DoubtedSource& doubt, CalibrationParameter parameter) {
  return format_number(doubt.fit.values[index_of(parameter)]);
}

std::string with_scaling_text(const std::vector<DoubtedSource>& all) {
  const auto reconciling = [&](std::size_t sources) {
    return std::count_if(all.begin(), all.end(), [&](const DoubtedSource& d) {
      return d.left_out.size() == sources && !contradicts(d.fit);
    });
  };
  if (reconciling(1) > 0) return fmt::format("one source still suffices, {} of them", reconciling(1));
  if (reconciling(2) > 0)
    return fmt::format("no single source is enough, and {} pairs are, each with other lengths",
                       reconciling(2));
  return std::string("no single source is enough, and without any two of them nothing is left to test");
}

std::string ours_text(const std::vector<DoubtedSource>& two, const std::vector<DoubtedSource>& all) {
  using P = CalibrationParameter;
  const DoubtedSource& focus = without(two, "focus");
  const LeftOutReading vergence = focus.left_out.empty() ? LeftOutReading{} : focus.left_out.front();
  const double used_mm = kPixelsPerSubimageUsed * nominal_values()[index_of(P::kPixelPitch)];
  return fmt::format(
      "Angle and focus {} (p = {}). One of these alone would explain it, each with nothing left to test it: "
      "d_l = {} mm, and then the panel is sharp at {} dpt instead of {}; subimages of {} mm; a focal length "
      "of {} mm. Appendix D asks for smaller subimages where the angle "
      "asks for larger ones: with it, {}. If the angle was measured with the subimages that were used in the "
      "end, {} mm wide, it needs d_l = {} mm.",
      contradicts(two.front().fit) ? "contradict each other" : "agree",
      format_number(two.front().fit.p_value.value_or(1), 2), value_text(focus, P::kLensDistance),
      format_number(vergence.predicted, 3), format_number(vergence.measured, 3),
      format_number(without(two, "anchor of p").fit.values[index_of(P::kPixelPitch)] *
                    CalibrationInstrument{}.subimage_px),
      value_text(without(two, "anchor of f"), P::kFocalLength), with_scaling_text(all),
      format_number(used_mm), format_number(distance_for_angle_mm(used_mm)));
}

std::string differs_text(bool contradiction) {
  return fmt::format(
      "{} The angle is one printed number, without the height of the camera it was measured from: edges seen "
      "from two heights would tell an error of that height from one of the lens distance, and lens centres "
      "on "
      "the pixel grid the lens pitch. Standard deviations are ours: the thesis states none.",
      contradiction ? "The thesis settles on one number; its own figures do not allow one."
                    : "With the deviations that we assume, the thesis' figures do allow one number.");
}

}  // namespace

ReproductionResult reproduce_field_of_view_conflict(Laboratory&) {
  ReproductionResult result;
  const CalibrationMeasurements thesis = thesis_measurements();
  CalibrationMeasurements angle_and_focus = thesis;
  std::erase_if(angle_and_focus.records,
                [](const CalibrationRecord& r) { return std::holds_alternative<SharpestScaleRecord>(r); });
  const auto two = doubt_each_source(angle_and_focus), all = doubt_each_source(thesis);
  result.rows.append(doubt_rows(all));
  result.paper_shows =
      "Calculated is a field of view of 17.28° (d_l = 3.29 mm), measured 19.86°, which the thesis works with "
      "and puts down to the thin lens equation. Appendix D scales subimages down from 83⅓ to 80⅓ px to make "
      "the image sharp.";
  result.ours_shows = ours_text(two, all);
  result.differs = differs_text(contradicts(all.front().fit));
  add_doubts(result, "Angle and focus: plain least-squares fits without one source each", two);
  add_doubts(
      result,
      "With the scaling of appendix D: without one source, and without two where that reconciles the rest",
      all);
  result.add_plot("residuals", residual_plot(all.front().fit));
  result.ledger.push_back({{"H-10-fov-a", "Hansen & Klein 2016, appendix C",
                            "The measured field of view is close to the calculated one."},
                           decide_close(calculated(thesis))});
  result.ledger.push_back({{"H-10-fov-b", "Hansen & Klein 2016, section 3.1",
                            "The thin lens equation is the source of the difference in the field of view."},
                           decide_lens(thesis, without(two, "anchor of f").fit)});
  add_ledger_rows(result.rows, result.ledger);
  return result;
}

}  // namespace plenolab
