// A-A5, thesis section 6.1.2: water with small distortions and a denser grid hides the copies of reflections,
// mirror-like tunnel walls do not. Both causes apart: ripples on and off × spacing, everything else equal.
#include <fmt/format.h>

#include <array>

#include "experiments/reproduce/claims/appearance_floor.h"

namespace plenolab {

ReproductionResult reproduce_claim_a5(Laboratory& laboratory);

namespace {

// Thresholds, set before any run. Copy strength is 0.5 for copies that stand side by side and 0 for none.
// Half of the ideal strength or more counts as plain copies on a mirror; copies count as hidden where less
// than half of the mirror's strength is left.
constexpr double kPlainCopies = 0.25;
constexpr double kHidden = 0.5;

// Root mean square slope of the ripples in each direction: that of the Boats scene's water, four octaves of
// gradient noise (root mean square 0.28) with amplitudes from 0.034 down, 0.72 from one to the next.
constexpr double kRippleSlope = 0.013;

// How much denser Boats is recorded than the Tunnel: 2.5 times in the paper presets of our scenes, 0.04
// against 0.1 m.
// against 0.1 m; a first run judged at 2 times and came to the same verdict.
constexpr std::array kDivisors{1.0, 2.0, 2.5, 4.0};
constexpr std::size_t kSparse = 0, kDense = 2;

struct Setting {
  double ripple_slope = 0, spacing_m = 0;
  Interval strength, spots, error;
  std::size_t lamps = 0;
  double displacement_px = 0;  ///< mean distance of copies
  TwinView middle;
};

Setting measure_setting(Laboratory& laboratory, double ripple_slope, double divisor) {
  Setting setting{.ripple_slope = ripple_slope, .spacing_m = kSparseSpacing_m / divisor};
  const std::uint64_t seed = laboratory.options().seed;
  const FloorLook look{.kind = FloorLook::Kind::kMirror, .ripple_slope = ripple_slope};
  std::vector<TwinView> views = floor_views(laboratory, look, setting.spacing_m);
  const std::vector<LampCopies> lamps =
      copies_of_lamps(views, floor_probe(look), appearance_grid(laboratory, setting.spacing_m));
  setting.lamps = lamps.size();
  for (const LampCopies& lamp : lamps)
    setting.displacement_px += lamp.displacement_px / static_cast<double>(lamps.size());
  setting.strength = mean_strength(lamps, seed);
  setting.spots = mean_spots(lamps, seed);
  setting.error = root_mean_interval(tile_errors(views).error, seed);
  setting.middle = std::move(views.front());
  return setting;
}

std::string surface_of(const Setting& setting) {
  return setting.ripple_slope > 0 ? "rippled" : "flat";
}

/// Settings of one surface, sparsest first.
struct Surface {
  std::vector<Setting> settings;
};

ReportPlot strength_plot(const Surface& flat, const Surface& rippled) {
  Plot plot;
  plot.x = {.title = "Spacing of the key views", .unit = "m", .logarithmic = true};
  plot.y = {.title = "Copy strength", .unit = "1"};
  plot.key = KeyPosition::kTopLeft;
  for (const Surface* surface : {&flat, &rippled}) {
    PlotSeries series{.title = surface_of(surface->settings.front()) + " mirror"};
    for (const Setting& setting : surface->settings)
      series.points.push_back(plot_point(setting.spacing_m, setting.strength));
    plot.series.push_back(std::move(series));
  }
  return {plot,
          "How plainly the synthesised view shows copies of reflected lamps: its autocorrelation at the "
          "displacement between copies, less that of the truth (0.5: copies side by side). Bars: 95 % "
          "bootstrap over reflections",
          "Copy strength against spacing for a flat and a rippled mirror"};
}

ReportTable cause_table(const Surface& flat, const Surface& rippled) {
  ReportTable table{"Each cause alone and both together",
                    {"surface", "spacing [m]", "copy strength", "low", "high", "spots per lamp", "RMS error",
                     "reflections"},
                    {},
                    3};
  for (const Surface* surface : {&flat, &rippled})
    for (const Setting& s : surface->settings)
      table.rows.push_back({surface_of(s), s.spacing_m, s.strength.estimate, s.strength.low, s.strength.high,
                            s.spots.estimate, s.error.estimate, static_cast<long long>(s.lamps)});
  return table;
}

void add_rows(ResultTable& rows, const Surface& surface) {
  for (const Setting& s : surface.settings) {
    const std::vector<std::pair<std::string, Cell>> columns{{"surface", surface_of(s)},
                                                            {"spacing_m", s.spacing_m}};
    rows.add({"copy_strength", s.strength.estimate, "1", columns});
    rows.add({"spots_per_reflection", s.spots.estimate, "1", columns});
    rows.add({"rms_error_without_noise", s.error.estimate, "1", columns});
    rows.add({"reflections_counted", static_cast<double>(s.lamps), "1", columns});
  }
}

/// Bounds of a ratio of independent positive numbers; wider than necessary.
Interval ratio_of(const Interval& above, const Interval& below) {
  return {above.estimate / below.estimate, above.low / (above.low < 0 ? below.low : below.high),
          above.high / (above.high < 0 ? below.high : below.low)};
}

LedgerEntry walls_entry(const Setting& flat) {
  LedgerEntry entry{{"A-A5a", "Altmeier 2018, section 6.1.2, figure 35",
                     "Mirror-like surfaces on a sparse grid show copies of reflections plainly."},
                    {}};
  entry.verdict = decide_claim(flat.strength, Comparison::kAbove, kPlainCopies, "copy_strength", "1",
                               fmt::format("95 % bootstrap over {} reflections in 2 views", flat.lamps));
  entry.verdict.scenes = {"floor probe, mirror"};
  entry.verdict.explanation =
      "Autocorrelation of the synthesised view at the displacement between copies of a reflected lamp, less "
      "that of the truth: 0.5 for separate copies, 0 for none; half of the ideal counts as plain.";
  return entry;
}

LedgerEntry water_entry(const Setting& flat, const Setting& water) {
  LedgerEntry entry{{"A-A5b", "Altmeier 2018, section 6.1.2, figure 36",
                     "Small distortions of the water and a denser grid together hide the copies."},
                    {}};
  if (!(flat.strength.low > 0)) {
    entry.verdict = undecidable("The flat mirror shows no copies that could be hidden.");
    return entry;
  }
  entry.verdict = decide_claim(ratio_of(water.strength, flat.strength), Comparison::kBelow, kHidden,
                               "copy_strength_ratio", "1",
                               fmt::format("quotient of 95 % bootstrap intervals over {} and {} reflections",
                                           water.lamps, flat.lamps));
  entry.verdict.scenes = {"floor probe, mirror", "floor probe, rippled mirror"};
  entry.verdict.explanation = fmt::format(
      "Copy strength on rippled water at {:g} m spacing over that on a flat mirror at {:g} m; hidden means "
      "that "
      "less than half is left. The measure also counts the blur that merged copies leave: {:.1f} separate "
      "spots "
      "per lamp are left of {:.1f}.",
      water.spacing_m, flat.spacing_m, water.spots.estimate, flat.spots.estimate);
  return entry;
}

std::string causes_sentence(const Surface& flat, const Surface& rippled) {
  const double all = flat.settings[kSparse].strength.estimate;
  const auto percent = [all](const Setting& s) { return all > 0 ? 100 * s.strength.estimate / all : 0.0; };
  const Setting &dense = flat.settings[kDense], &densest = flat.settings.back();
  return fmt::format(
      "Of the copy strength on the flat mirror at {:g} m, ripples alone leave {:.0f} %, the denser grid "
      "({:g} m) "
      "alone {:.0f} %, both {:.0f} %; at {:g} m {:.0f} % are left flat and {:.0f} % rippled. Separate spots "
      "per "
      "lamp: {:.1f} flat and {:.1f} rippled at {:g} m, {:.1f} and {:.1f} at {:g} m.",
      flat.settings[kSparse].spacing_m, percent(rippled.settings[kSparse]), dense.spacing_m, percent(dense),
      percent(rippled.settings[kDense]), densest.spacing_m, percent(densest),
      percent(rippled.settings.back()), dense.spots.estimate, rippled.settings[kDense].spots.estimate,
      dense.spacing_m, densest.spots.estimate, rippled.settings.back().spots.estimate, densest.spacing_m);
}

/// What the numbers say about the causes.
std::string difference_sentence(const Surface& flat, const Surface& rippled) {
  const auto strength = [](const Setting& s) { return s.strength.estimate; };
  const double by_ripples = strength(flat.settings[kSparse]) - strength(rippled.settings[kSparse]);
  const double by_density = strength(flat.settings[kSparse]) - strength(flat.settings[kDense]);
  std::string text = fmt::format(
      "The thesis compares two scenes that differ in everything; here one cause changes at a time, and "
      "ripples "
      "take away {:.2f} of the copy strength, the denser grid {:.2f}. ",
      by_ripples, by_density);
  text += fmt::format(
      "Copy strength does not tell copies from the blur that they merge into: the lamps here are about 4 px "
      "wide "
      "and copies stand {:.1f} px apart at {:g} m, so that the spots counted there are the better guide to "
      "whether a viewer sees single copies. ",
      flat.settings[kDense].displacement_px, flat.settings[kDense].spacing_m);
  const double flat_error = flat.settings[kDense].error.estimate,
               rippled_error = rippled.settings[kDense].error.estimate;
  return text + fmt::format(
                    "Against the truth the error of rippled water is {} than that of the flat mirror "
                    "({:.3f} against {:.3f} at {:g} m).",
                    rippled_error > flat_error ? "larger" : "smaller", rippled_error, flat_error,
                    flat.settings[kDense].spacing_m);
}

}  // namespace

ReproductionResult reproduce_claim_a5(Laboratory& laboratory) {
  ReproductionResult result;
  Surface flat, rippled;
  for (const double divisor : kDivisors) {
    flat.settings.push_back(measure_setting(laboratory, 0, divisor));
    rippled.settings.push_back(measure_setting(laboratory, kRippleSlope, divisor));
  }
  add_rows(result.rows, flat);
  add_rows(result.rows, rippled);
  result.ledger = {walls_entry(flat.settings[kSparse]),
                   water_entry(flat.settings[kSparse], rippled.settings[kDense])};
  add_ledger_rows(result.rows, result.ledger);
  result.paper_shows =
      "Section 6.1.2: reflections on the tunnel's mirror-like walls appear as overlapping copies (figure "
      "35). On "
      "the water of Boats and Lanterns small distortions and a denser grid leave only slightly blurry "
      "outlines, "
      "not noticeable without the truth beside them (figure 36).";
  const Setting &walls = flat.settings[kSparse], &water = rippled.settings[kDense];
  result.ours_shows = fmt::format(
      "A mirror floor under lamps, flat and rippled, at equal spacing and disparity. Copy strength on the "
      "flat "
      "mirror at {:g} m: {}; on the rippled one at {:g} m: {}. ",
      walls.spacing_m, text_of(walls.strength), water.spacing_m, text_of(water.strength));
  result.ours_shows += causes_sentence(flat, rippled);
  result.differs = difference_sentence(flat, rippled);
  result.add_plot("copy-strength", strength_plot(flat, rippled));
  result.add_table(cause_table(flat, rippled));
  for (const Surface* surface : {&flat, &rippled})
    for (const std::size_t i : {kSparse, kDense}) {
      const Setting& setting = surface->settings[i];
      add_twin_comparison(
          result, fmt::format("{}-{}", surface_of(setting), i == kSparse ? "sparse" : "dense"),
          setting.middle, fmt::format("{} mirror, {:g} m spacing", surface_of(setting), setting.spacing_m));
    }
  return result;
}

}  // namespace plenolab
