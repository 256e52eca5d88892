// How statistics follow the light from frame to frame (section 5.2.2): frame rates, ramps and long steps.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/tonemap/adaptation.h"
#include "experiments/reproduce/reproduction.h"
#include "experiments/reproduce/tonemap/adaptation_tracks.h"
#include "experiments/reproduce/tonemap/curves.h"
#include "experiments/score.h"

namespace plenolab {

ReproductionResult reproduce_adaptation_in_time(Laboratory& laboratory);

namespace {

constexpr std::array kRates_Hz{24, 60, 120};
constexpr std::array kSchemes{AdaptationScheme::kHeldTarget, AdaptationScheme::kLinearTarget,
                              AdaptationScheme::kExplicitEuler};
/// Steps of the tracks, in time constants: before, between and behind the limits of explicit Euler.
constexpr std::array kTrackSteps{0.5, 1.5, 2.5};
constexpr double kTrackLength = 12;  ///< in time constants
constexpr double kHour_s = 3600;

AdaptationOptions options_of(AdaptationScheme scheme) {
  return {.scheme = scheme};
}

/// Largest difference from 24 Hz at the times that all rates have, in the first second of a held target.
double largest_rate_difference(AdaptationScheme scheme) {
  constexpr int kCommonPerSecond = 12;
  const auto values = [&](int rate_hz) {
    const std::vector<double> track = track_of_step(options_of(scheme), 1.0 / rate_hz, rate_hz);
    std::vector<double> common;
    for (std::size_t i = 0; i < track.size(); i += static_cast<std::size_t>(rate_hz / kCommonPerSecond))
      common.push_back(track[i]);
    return common;
  };
  const std::vector<double> first = values(kRates_Hz[0]);
  double largest = 0;
  for (const int rate : kRates_Hz) {
    const std::vector<double> other = values(rate);
    for (std::size_t i = 0; i < first.size(); ++i) largest = std::max(largest, std::abs(other[i] - first[i]));
  }
  return largest;
}

double lag_ms(AdaptationScheme scheme, int rate_hz) {
  return 1000 * lag_on_ramp_s(options_of(scheme), 1.0 / rate_hz);
}

ReportPlot ramp_plot() {
  Plot plot;
  plot.x = {.title = "Frame rate", .unit = "Hz", .logarithmic = true};
  plot.y = {.title = "Lag behind a ramp", .unit = "ms"};
  plot.key = KeyPosition::kBottomRight;
  for (const AdaptationScheme scheme : kSchemes)
    plot.series.push_back(curve_series(name_of(scheme), log_spaced(10, 240, 60), [&](double rate_hz) {
      return 1000 * lag_on_ramp_s(options_of(scheme), 1 / rate_hz);
    }));
  return {plot, "How far the adapted value is behind a target that rises steadily, over the frame rate",
          "Three lines: one rises with the rate, one is level, one falls"};
}

ReportPlot one_step_plot() {
  Plot plot;
  plot.x = {.title = "Step over time constant, Δt/t₀", .logarithmic = true};
  plot.y = {.title = "Value after one step from 0 to target 1", .minimum = 0, .maximum = 4};
  plot.key = KeyPosition::kTopLeft;
  const double longest = 3 * kHour_s / kRodAdaptation_s;
  for (const AdaptationScheme scheme : kSchemes)
    plot.series.push_back(curve_series(name_of(scheme), log_spaced(1e-3, longest, 300), [&](double steps) {
      const double value = value_after_step(options_of(scheme), steps * kRodAdaptation_s);
      return std::min(value, 4.0);  // drawn at the upper edge
    }));
  return {plot,
          "One step to a held target, up to three hours; what exceeds 4 is drawn at the upper edge. Held and "
          "linear target give the same value",
          "Two curves that rise to 1 and stay there, one that goes on rising"};
}

/// The values of a track as long as they lie in the plot.
PlotSeries track_series(AdaptationScheme scheme, double steps, PlotSeries::Style style, const PlotAxis& y) {
  PlotSeries series{
      .title = fmt::format("{}, Δt = {:g} t₀", name_of(scheme), steps), .style = style, .points = {}};
  const std::vector<double> track =
      track_of_step(options_of(scheme), steps * kRodAdaptation_s, static_cast<int>(kTrackLength / steps));
  for (std::size_t i = 0; i < track.size() && track[i] >= *y.minimum && track[i] <= *y.maximum; ++i)
    series.points.push_back({.x = static_cast<double>(i) * steps, .y = track[i]});
  return series;
}

ReportPlot track_plot() {
  Plot plot;
  plot.x = {.title = "Time over time constant, t/t₀"};
  plot.y = {.title = "Value; target 1 from time 0 on", .minimum = -2, .maximum = 4.5};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 860;
  for (const double steps : kTrackSteps)
    plot.series.push_back(
        track_series(AdaptationScheme::kExplicitEuler, steps, PlotSeries::Style::kLinesPoints, plot.y));
  for (const double steps : kTrackSteps)
    plot.series.push_back(track_series(
        AdaptationScheme::kHeldTarget, steps,
        steps == kTrackSteps.front() ? PlotSeries::Style::kLinesPoints : PlotSeries::Style::kPoints, plot.y));
  return {plot,
          "Response to a step of the target, with three step lengths; tracks end where they leave the plot",
          "The held scheme lies on one rising curve for all steps; explicit Euler swings and diverges"};
}

ReportTable step_table(ReproductionResult& result) {
  ReportTable table{"One step from 0 to a held target of 1, by its length",
                    {"Δt [s]", "Δt/t₀", "held target", "linear target", "explicit Euler"},
                    {},
                    5};
  const double t0 = kRodAdaptation_s;
  for (const double step_s :
       {0.0, 1.0 / 120, 1.0 / 24, t0, 2 * t0, 2.5 * t0, 1.0, 60.0, kHour_s, 3 * kHour_s}) {
    std::vector<Cell> row{step_s, step_s / t0};
    for (const AdaptationScheme scheme : kSchemes) {
      const double value = value_after_step(options_of(scheme), step_s);
      row.emplace_back(value);
      result.rows.add({"value_after_step", value, "1", {{"scheme", name_of(scheme)}, {"step_s", step_s}}});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

void add_rate_rows(ReproductionResult& result) {
  for (const AdaptationScheme scheme : kSchemes) {
    result.rows.add({"largest_difference_between_rates",
                     largest_rate_difference(scheme),
                     "1",
                     {{"scheme", name_of(scheme)}}});
    for (const int rate : {24, 30, 60, 120})
      result.rows.add({"ramp_lag",
                       lag_ms(scheme, rate),
                       "ms",
                       {{"scheme", name_of(scheme)}, {"rate_hz", static_cast<long long>(rate)}}});
  }
}

void describe(ReproductionResult& result) {
  constexpr auto kHeld = AdaptationScheme::kHeldTarget, kLinear = AdaptationScheme::kLinearTarget,
                 kEuler = AdaptationScheme::kExplicitEuler;
  const double held = largest_rate_difference(kHeld);
  result.ours_shows = fmt::format(
      "After a step of the light, values at equal times differ between 24, 60 and 120 Hz by at most {:.1g} "
      "(explicit Euler: {:.3f}). On a ramp the scheme of the thesis lags {:.0f}, {:.0f} and {:.0f} ms behind "
      "at "
      "these rates, {:.0f} ms more at 120 than at 30 Hz; with a linear target it lags {:.0f}, {:.0f} and "
      "{:.0f} "
      "ms. After a step of an hour it is at {:.3f}, explicit Euler at {:.0f}.",
      held, largest_rate_difference(kEuler), lag_ms(kHeld, 24), lag_ms(kHeld, 60), lag_ms(kHeld, 120),
      lag_ms(kHeld, 120) - lag_ms(kHeld, 30), lag_ms(kLinear, 24), lag_ms(kLinear, 60), lag_ms(kLinear, 120),
      value_after_step(options_of(kHeld), kHour_s), value_after_step(options_of(kEuler), kHour_s));
  const double lag_spread = lag_ms(kHeld, 120) - lag_ms(kHeld, 24);
  result.differs =
      held < 1e-9
          ? "The exponential weight is exact for a light that holds, whatever the frame rate and however "
            "long a frame takes."
          : "The exponential weight depends on the frame rate even for a light that holds.";
  if (std::abs(lag_spread) > 1)
    result.differs += fmt::format(
        " It is not for one that changes: each frame takes its target as if it had held since the last one, "
        "which "
        "makes {:.0f} ms between 24 and 120 Hz. Taking the target as linear between frames, an option of the "
        "program, removes that.",
        lag_spread);
}

}  // namespace

ReproductionResult reproduce_adaptation_in_time(Laboratory&) {
  ReproductionResult result;
  result.paper_shows =
      "Section 5.2.2: statistics follow those of the key views with the weight w = e^(−t/t₀) for the "
      "previous "
      "frame, t₀ = 150 ms, t being the time between frames. No figures; dependence on the frame rate is not "
      "discussed.";
  describe(result);
  add_rate_rows(result);
  result.add_plot("lag-on-a-ramp", ramp_plot());
  result.add_plot("value-after-one-step", one_step_plot());
  result.add_plot("step-response", track_plot());
  result.add_table(step_table(result));
  return result;
}

}  // namespace plenolab
