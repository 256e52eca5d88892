#include "experiments/luminance_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/plot.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "core/luminance/display_folder.h"
#include "experiments/cli/output.h"
#include "experiments/cli/wide_table.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

/// Fields and plan of a run with what it has found so far.
struct Run {
  const ShownField& field;
  const LuminancePlan& plan;
  LuminanceUnit unit;
  std::vector<TimedEstimate> estimates;
  LuminanceResults results;
  std::vector<std::string> clipped;  ///< methods with the number of values that tone mapping cut

  Columns columns(const LuminanceOptions& method) const {
    return {{"source", plan.source}, {"method", setting_name(method)}};
  }
  void note(const std::string& sentence) {
    results.notes.push_back(sentence);
    results.rows.add({kNoteQuantity, 1, "1", {{"source", plan.source}, {"note", sentence}}});
  }
};

void add_samples(Run& run, const LuminanceOptions& method, const GlobalLuminance& luminance) {
  for (int i = 0; i < luminance.samples.size(); ++i) {
    const ObserverPosition at = luminance.samples.position(i);
    const auto index = static_cast<std::size_t>(i);
    run.results.samples.add({"luminance_" + run.unit.suffix,
                             std::exp(luminance.ln_luminance[index]),
                             run.unit.name,
                             {{"method", setting_name(method)},
                              {"x_m", at.x_m},
                              {"y_m", at.y_m},
                              {"defined", static_cast<long long>(luminance.defined[index])}}});
  }
}

void add_method_rows(Run& run, const LuminanceOptions& method, const TimedEstimate& estimate) {
  const Columns columns = run.columns(method);
  const GlobalLuminance& luminance = estimate.luminance;
  ResultTable& rows = run.results.rows;
  rows.add({"seconds", estimate.seconds, "s", columns});
  rows.add({"samples", static_cast<double>(luminance.samples.size()), "samples", columns});
  rows.add({"undefined_samples", static_cast<double>(luminance.undefined()), "samples", columns});
  if (!luminance.known()) return;
  const auto [low, high] = std::minmax_element(luminance.ln_luminance.begin(), luminance.ln_luminance.end());
  rows.add({"luminance_min_" + run.unit.suffix, std::exp(*low), run.unit.name, columns});
  rows.add({"luminance_max_" + run.unit.suffix, std::exp(*high), run.unit.name, columns});
  rows.add({"ln_total_variation", measure_curve(luminance).total_variation, "1", columns});
  add_samples(run, method, luminance);
}

void write_light(const fs::path& folder, const std::string& name, const DisplayLightImage& light) {
  if (!folder.empty() && !light.empty()) write_display_image(folder / (name + ".png"), encoded(light));
}

/// What an observer sees of the rays mapped with one method.
void look_at(Run& run, const NamedObserver& observer, std::size_t method, const DisplayRays& mapped,
             const ReferencePictures& references, const fs::path& folder) {
  const LuminanceOptions& options = run.plan.methods[method];
  ResultTable& rows = run.results.rows;
  Columns columns = run.columns(options);
  columns.emplace_back("observer_x_m", observer.position.x_m);
  if (run.field.display->space().on_a_plane()) columns.emplace_back("observer_y_m", observer.position.y_m);
  rows.add({"unlit_share", references.unlit_share, "1", columns});
  if (references.unlit_share >= 1) return;
  const auto ln = run.estimates[method].luminance.ln_at(observer.position);
  if (ln) rows.add({"luminance_" + run.unit.suffix, std::exp(*ln), run.unit.name, columns});
  const DisplayLightImage seen = perceive(*run.field.display, mapped, observer.position,
                                          run.field.display->resolution(), run.plan.threads)
                                     .image;
  // Black beside black compares nothing.
  if (ln && references.ln_truth)
    rows.add({"psnr_ground_truth_db", light_psnr_db(seen, references.ground_truth), "dB", columns});
  if (ln && references.ln_result)
    rows.add({"psnr_on_result_db", light_psnr_db(seen, references.on_result), "dB", columns});
  write_light(folder, fmt::format("{}-{}", name_of(options.method), observer.name), seen);
}

void note_unlit(Run& run, const NamedObserver& observer, double share) {
  if (share >= 1)
    run.note(fmt::format("No ray of the display reaches an observer at {:g} m: nothing is estimated there.",
                         observer.position.x_m));
  else if (share > 0)
    run.note(
        fmt::format("An observer at {:g} m sees {:.3g} % of the screen dark, as no ray gets from there to "
                    "them; PSNR compares that part, too.",
                    observer.position.x_m, 100 * share));
}

/// What one observer sees, tone mapped with each estimate, beside the references.
void look(Run& run, const NamedObserver& observer, const std::vector<DisplayRays>& mapped,
          const fs::path& folder) {
  const ReferencePictures references =
      reference_pictures(run.field, observer.position, run.field.display->resolution(), run.plan.reinhard,
                         run.plan.average, {.threads = run.plan.threads});
  for (std::size_t m = 0; m < mapped.size(); ++m) look_at(run, observer, m, mapped[m], references, folder);
  note_unlit(run, observer, references.unlit_share);
  if (folder.empty() || references.unlit_share >= 1) return;
  write_light(folder, "ground-truth-" + observer.name, references.ground_truth);
  write_light(folder, "on-result-" + observer.name, references.on_result);
  const SceneImage& hdr = references.result;
  const bool absolute = run.field.unit == RadianceUnit::kCdM2;
  write_scene_image(folder / fmt::format("perceived-{}.exr", observer.name), hdr,
                    absolute ? std::optional(1.0) : std::nullopt);
  write_display_image(folder / fmt::format("perceived-{}.png", observer.name),
                      expose(hdr, exposure_from(hdr)));
}

/// Displays with full parallax have many rows of samples, of which curves are the middle one.
std::string row_shown(const Run& run) {
  const ObserverSamples& samples = run.plan.samples;
  if (samples.rows == 1) return "";
  const int row = samples.rows / 2;
  return fmt::format("row {} of {} of the observers' plane, y = {:g} m", row + 1, samples.rows,
                     samples.position(row * samples.columns).y_m);
}

Plot line_plot(const Run& run) {
  Plot plot;
  if (const std::string row = row_shown(run); !row.empty()) plot.title = "Only " + row;
  plot.x = {.title = "Position on the observer line", .unit = "m"};
  plot.y = {.title = "Luminance adapted to", .unit = run.unit.name, .logarithmic = true};
  plot.key = KeyPosition::kOutside;
  for (std::size_t m = 0; m < run.plan.methods.size(); ++m) {
    PlotSeries series{setting_name(run.plan.methods[m]), PlotSeries::Style::kLines, {}};
    for (const CurvePoint& point : curve_of(run.estimates[m].luminance))
      series.points.push_back({point.x_m, std::exp(point.ln_luminance)});
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Estimates with a method and maps all rays with it.
DisplayRays estimate_and_map(Run& run, const LuminanceOptions& method) {
  run.estimates.push_back(timed_estimate(run.field, run.plan.samples, method));
  add_method_rows(run, method, run.estimates.back());
  LightMapped<DisplayRays> mapped =
      map_rays(*run.field.display, run.field.rays, run.estimates.back().luminance, run.plan.reinhard,
               run.plan.threads);
  run.results.rows.add({"clipped_high", static_cast<double>(mapped.clipped), "values", run.columns(method)});
  if (mapped.clipped > 0) run.clipped.push_back(fmt::format("{} {}", setting_name(method), mapped.clipped));
  return std::move(mapped.light);
}

void note_field(Run& run) {
  const PixelRepairs& repairs = run.field.repairs;
  run.results.rows.add(
      {"repaired_values", static_cast<double>(repairs.total()), "values", {{"source", run.plan.source}}});
  if (repairs.total() > 0)
    run.note(fmt::format("{} channel values of {} were repaired: {} not a number, {} infinite, {} negative.",
                         repairs.total(), run.plan.source, repairs.nan, repairs.positive_infinity,
                         repairs.negative));
  if (run.field.unit == RadianceUnit::kRelative)
    run.note(
        fmt::format("{} holds relative radiance: luminance and --epsilon are in its unit. "
                    "--cd-m2-per-unit gives a scale.",
                    run.plan.source));
}

void write_files(Run& run, const fs::path& folder) {
  if (folder.empty()) return;
  write_text_file(folder / "samples.csv", to_csv(run.results.samples));
  const Plot plot = line_plot(run);
  if (!plot.series.empty()) write_plot(plot, folder / "luminance");
  const auto* projectors = dynamic_cast<const ProjectorDisplay*>(run.field.display.get());
  if (run.plan.display_images && projectors)
    write_display_folder(folder / "display", *projectors, run.field.rays);
}

}  // namespace

LuminanceResults run_luminance_plan(const ShownField& field, const LuminancePlan& plan,
                                    const fs::path& folder) {
  Run run{field, plan, luminance_unit(field), {}, {}, {}};
  note_field(run);
  std::vector<DisplayRays> mapped;
  for (const LuminanceOptions& method : plan.methods) mapped.push_back(estimate_and_map(run, method));
  if (!run.clipped.empty())
    run.note(
        fmt::format("Of {} channel values tone mapping cut to white, as their colours are too saturated "
                    "for their luminance: {}.",
                    3 * field.rays.size().total(), fmt::join(run.clipped, ", ")));
  for (const NamedObserver& observer : plan.observers) look(run, observer, mapped, folder);
  if (!run.estimates.front().luminance.known())
    run.note(
        fmt::format("No ray of {} that counts is above {:g}{}: its luminance is undefined, its pictures "
                    "are black.",
                    plan.source, plan.average.epsilon, field.unit == RadianceUnit::kCdM2 ? " cd/m²" : ""));
  if (const std::string row = row_shown(run); !row.empty())
    run.note(
        fmt::format("The curve of the plot and the variation of ln are those of {}; least and most are over "
                    "all rows.",
                    row));
  write_files(run, folder);
  return std::move(run.results);
}

std::string luminance_tables(const ShownField& field, const LuminanceResults& results) {
  const LuminanceUnit unit = luminance_unit(field);
  std::vector<WideColumn> of_observers{{"luminance_" + unit.suffix, fmt::format("luminance [{}]", unit.name)},
                                       {"psnr_ground_truth_db", "PSNR, ground truth [dB]"},
                                       {"psnr_on_result_db", "PSNR, on result [dB]"}};
  const auto& rows = results.rows.rows();
  if (std::any_of(rows.begin(), rows.end(),
                  [](const ResultRow& row) { return row.quantity == "unlit_share" && row.value > 0; }))
    of_observers.push_back({"unlit_share", "unlit share"});
  std::vector<std::string> observer_keys{"method", "observer_x_m"};
  if (field.display->space().on_a_plane()) observer_keys.emplace_back("observer_y_m");
  return fmt::format("{}\n{}",
                     to_wide_text(results.rows, {"source", "method"},
                                  {{"luminance_min_" + unit.suffix, fmt::format("least [{}]", unit.name)},
                                   {"luminance_max_" + unit.suffix, fmt::format("most [{}]", unit.name)},
                                   {"ln_total_variation", "variation of ln"},
                                   {"undefined_samples", "undefined"},
                                   {"samples", "samples"},
                                   {"seconds", "seconds"}}),
                     to_wide_text(results.rows, observer_keys, of_observers));
}

}  // namespace plenolab
