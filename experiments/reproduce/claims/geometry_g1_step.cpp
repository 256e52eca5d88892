#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/image/colour.h"
#include "core/synthesis/synthesizer.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/figure_tools.h"
#include "metrics/error_map.h"

namespace plenolab {

ReproductionResult reproduce_claim_g1(Laboratory& laboratory);

namespace {

constexpr std::array kSteps_px{0.25, 0.5, 1.0, 2.0, 4.0};
constexpr std::size_t kOne = 2;  ///< index of the step of 1 px

// Each view is compared with the same view at the finest step, not with the truth: both contain the same
// noise of the key views, so that only what the step changes is left.

// If the difference grew in proportion to the step there would be no knee, and the way from the finest step
// to 1 px would bring its share of the whole way's loss. A knee at 1 px means less than that before it.
constexpr double kShareWithoutKnee =
    (kSteps_px[kOne] - kSteps_px.front()) / (kSteps_px.back() - kSteps_px.front());

/// RMS difference of encoded values between one view at each step and at the finest.
struct StepErrors {
  std::string scene;
  CameraPosition position;
  std::array<double, kSteps_px.size()> rms{};
};

StepErrors errors_of(Laboratory& laboratory, const std::string& id, CameraPosition position) {
  StepErrors errors{id, position, {}};
  SceneImage finest;
  float exposure = 1;
  for (std::size_t k = 0; k < kSteps_px.size(); ++k) {
    SynthesisOptions options;
    options.step_px = kSteps_px[k];
    options.threads = laboratory.options().threads;
    SceneImage view = laboratory.synthesizer(id).synthesize(position, options).image;
    if (k == 0) finest = view, exposure = exposure_from(finest);
    ErrorSum sum;
    const Plane<float> squares = squared_error(view, finest, exposure);
    for (const float square : squares.pixels()) sum.add(static_cast<double>(square));
    errors.rms[k] = sum.rms();
  }
  return errors;
}

/// The scenes of the thesis, as far as the run has them.
std::vector<std::string> judged_scenes(const Laboratory& laboratory) {
  std::vector<std::string> scenes;
  for (const std::string& id : laboratory.scene_ids())
    if (id == "cellar" || id == "tree" || id == "boats" || id == "tunnel") scenes.push_back(id);
  if (laboratory.options().effort == Effort::kTiny && scenes.size() > 2) scenes.resize(2);
  return scenes;
}

/// Mean over views of the difference from the finest step.
double mean_loss(const std::vector<StepErrors>& views, std::span<const double> drawn, std::size_t step) {
  double sum = 0;
  for (const double i : drawn) sum += views[static_cast<std::size_t>(i)].rms[step];
  return sum / static_cast<double>(drawn.size());
}

std::vector<double> all_of(const std::vector<StepErrors>& views) {
  std::vector<double> all(views.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<double>(i);
  return all;
}

Interval loss_interval(const std::vector<StepErrors>& views, std::size_t step, std::uint64_t seed) {
  return bootstrap_units(
      views.size(), [&](std::span<const double> drawn) { return mean_loss(views, drawn, step); }, seed);
}

/// Share of the loss at the coarsest step that has come about at 1 px; 1 if there is no loss to share.
Interval share_at_one(const std::vector<StepErrors>& views, std::uint64_t seed) {
  return bootstrap_units(
      views.size(),
      [&](std::span<const double> drawn) {
        const double whole = mean_loss(views, drawn, kSteps_px.size() - 1);
        return whole > 0 ? mean_loss(views, drawn, kOne) / whole : 1;
      },
      seed);
}

/// The step at which the curve over the logarithm of the step lies farthest below the line between its ends;
/// empty if it lies below it nowhere.
std::optional<double> knee_px(const std::vector<StepErrors>& views) {
  const auto all = all_of(views);
  const std::size_t last = kSteps_px.size() - 1;
  const double whole = mean_loss(views, all, last);
  double deepest = 0;
  std::optional<double> knee;
  for (std::size_t k = 1; k < last; ++k) {
    const double below =
        whole * static_cast<double>(k) / static_cast<double>(last) - mean_loss(views, all, k);
    if (below > deepest) deepest = below, knee = kSteps_px[k];
  }
  return knee;
}

std::string knee_text(const std::vector<StepErrors>& views) {
  const std::optional<double> knee = knee_px(views);
  if (!knee) return "Over the logarithm of the step the curve has no knee.";
  return fmt::format("Over the logarithm of the step the curve bends most at {:g} px.", *knee);
}

Plot plot_of(const std::vector<StepErrors>& views, std::uint64_t seed) {
  Plot plot;
  plot.x = {
      .title = "Distance of search samples", .unit = "px", .logarithmic = true, .minimum = 0.2, .maximum = 5};
  plot.y = {.title = fmt::format("RMS difference from {:g} px", kSteps_px.front()),
            .unit = "encoded",
            .minimum = 0,
            .maximum = {}};
  plot.key = KeyPosition::kTopLeft;
  std::map<std::string, std::vector<StepErrors>> by_scene;
  for (const StepErrors& view : views) by_scene[view.scene].push_back(view);
  const auto add = [&](const std::string& title, const std::vector<StepErrors>& some, bool bars) {
    PlotSeries series{.title = title, .points = {}};
    for (std::size_t k = 0; k < kSteps_px.size(); ++k) {
      const Interval loss = loss_interval(some, k, seed);
      PlotPoint point{.x = kSteps_px[k], .y = loss.estimate, .y_low = {}, .y_high = {}, .label = {}};
      if (bars) point.y_low = loss.low, point.y_high = loss.high;
      series.points.push_back(point);
    }
    plot.series.push_back(series);
  };
  for (const auto& [scene, some] : by_scene) add(scene, some, false);
  add("all views", views, true);
  return plot;
}

void add_rows(ResultTable& rows, const std::vector<StepErrors>& views) {
  for (const StepErrors& view : views)
    for (std::size_t k = 0; k < kSteps_px.size(); ++k)
      rows.add({"rms_difference_from_finest_step",
                view.rms[k],
                "1",
                {{"scene", view.scene},
                 {"view", fmt::format("{:.2f},{:.2f}", view.position.s, view.position.t)},
                 {"step_px", kSteps_px[k]}}});
}

void add_example(ReproductionResult& result, Laboratory& laboratory, const std::string& id,
                 CameraPosition position) {
  const SceneImage truth = laboratory.truth(id, position).colour;
  const float exposure = figure_exposure(truth);
  ImageComparison comparison{
      fmt::format("{} at three distances of search samples", laboratory.scene(id).title),
      "Truth and synthesised views with the finest, 1 px and the coarsest step",
      {{"Ground truth", expose(truth, exposure)}}};
  std::vector<SceneImage> radiance{truth};
  for (const double step : {kSteps_px.front(), kSteps_px[kOne], kSteps_px.back()}) {
    SynthesisOptions options;
    options.step_px = step;
    options.threads = laboratory.options().threads;
    radiance.push_back(laboratory.synthesizer(id).synthesize(position, options).image);
    comparison.images.push_back({fmt::format("Step {} px", step), expose(radiance.back(), exposure)});
  }
  result.add_comparison("steps", std::move(comparison), std::move(radiance));
}

Verdict decide_knee(const std::vector<StepErrors>& views, std::uint64_t seed) {
  const Interval whole = loss_interval(views, kSteps_px.size() - 1, seed);
  if (!(whole.low > 0))
    return undecidable(
        fmt::format("Views with steps of {:g} px do not differ from those with {:g} px, so that there is no "
                    "loss to share.",
                    kSteps_px.back(), kSteps_px.front()));
  const Interval share = share_at_one(views, seed);
  Verdict verdict = decide_claim(share, Comparison::kBelow, kShareWithoutKnee, "loss_share_at_1_px", "1",
                                 uncertainty_over(views.size(), "views"));
  for (const StepErrors& view : views)
    if (std::find(verdict.scenes.begin(), verdict.scenes.end(), view.scene) == verdict.scenes.end())
      verdict.scenes.push_back(view.scene);
  verdict.explanation = fmt::format(
      "The claim is read as: the curve of change over step is flat up to {:g} px and bends afterwards. Of "
      "the "
      "RMS difference (encoded values) between views with steps of {:g} and {:g} px, steps of {:g} px have "
      "this share already: {}; a difference in proportion to the step would give {:g}. Whether a viewer "
      "accepts the change is not decided.",
      kSteps_px[kOne], kSteps_px.back(), kSteps_px.front(), kSteps_px[kOne], interval_text(share),
      kShareWithoutKnee);
  return verdict;
}

std::string losses_text(const std::vector<StepErrors>& views, std::uint64_t seed) {
  std::string text;
  for (std::size_t k = 1; k < kSteps_px.size(); ++k)
    text += fmt::format("{}{} at {:g} px", k == 1 ? "" : ", ", interval_text(loss_interval(views, k, seed)),
                        kSteps_px[k]);
  return text;
}

}  // namespace

ReproductionResult reproduce_claim_g1(Laboratory& laboratory) {
  ReproductionResult result;
  const std::uint64_t seed = laboratory.options().seed;
  std::vector<StepErrors> views;
  for (const std::string& id : judged_scenes(laboratory))
    for (const CameraPosition position : judged_positions(laboratory.grid(id), laboratory.options().effort))
      views.push_back(errors_of(laboratory, id, position));
  Verdict verdict = decide_knee(views, seed);
  result.paper_shows =
      "Samples one pixel apart are called one of the coarsest samplings with an acceptable degree of "
      "artefacts; no error "
      "is given (section 4.1.3).";
  result.ours_shows = fmt::format(
      "Against views with steps of {:g} px the RMS difference of encoded values is {}. {} {}",
      kSteps_px.front(), losses_text(views, seed), outcome_text(verdict.outcome), knee_text(views));
  const Interval at_one = loss_interval(views, kOne, seed);
  result.differs = fmt::format(
      "The thesis judged artefacts by eye. Here steps of {:g} px change a view by {} of the display range, "
      "{} per cent of what steps of {:g} px change.",
      kSteps_px[kOne], format_number(at_one.estimate, 2),
      format_number(100 * share_at_one(views, seed).estimate, 2), kSteps_px.back());
  result.add_plot("error-over-step",
                  {plot_of(views, seed),
                   "Difference from the view with the finest step over the distance of search samples; "
                   "95 % intervals over all views",
                   result.ours_shows});
  add_rows(result.rows, views);
  if (!views.empty()) add_example(result, laboratory, views.front().scene, views.front().position);
  conclude(result,
           {"A-G1", "Altmeier 2018, section 4.1.3",
            "Search samples one pixel apart are the coarsest with acceptable artefacts."},
           std::move(verdict));
  return result;
}

}  // namespace plenolab
