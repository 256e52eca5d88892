#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"
#include "core/synthesis/synthesizer.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/claims/geometry_shapes.h"
#include "experiments/reproduce/claims/probes.h"

namespace plenolab {

ReproductionResult reproduce_claim_g8(Laboratory& laboratory);

namespace {

// Filling is worth claiming if it lowers the error at all: 1 is where it changes nothing.
constexpr double kNoChange = 1;

constexpr int kWidth = 104, kHeight = 88;

/// A plate with a random row of slits before a background, in a cell of four key views.
struct PlateProbe {
  double slit_px = 4, pitch_px = 16, angle = 0, offset = 0;
  double plate_px = 0, background_px = 0;  ///< disparities
  std::uint32_t pattern = 0;
  CameraPosition position;
};

/// Error inside the plate, where slits are, against the true view.
struct PlateErrors {
  ErrorSum unfilled, filled;
};

ViewGrid plate_grid() {
  return probe_grid(2, 2, 0.1, kWidth, kHeight);
}

PlateProbe random_plate(RandomStream& random) {
  return {.slit_px = uniform(random, 3, 6),
          .pitch_px = uniform(random, 12, 18),
          .angle = uniform(random, 0, 3.14159),
          .offset = uniform(random, 0, 12),
          .plate_px = uniform(random, 8, 16),
          .background_px = uniform(random, 0, 2),
          .pattern = static_cast<std::uint32_t>(random.next_u64() % 1000),
          .position = {uniform(random, 0.1, 0.9), uniform(random, 0.1, 0.9)}};
}

/// Whether the plate reaches a point: a disc of 34 px around the image centre.
bool in_plate(double x, double y) {
  return std::hypot(x - kWidth / 2.0, y - kHeight / 2.0) <= 34;
}

bool in_slit(const PlateProbe& probe, double x, double y) {
  const double c = std::cos(probe.angle), s = std::sin(probe.angle);
  const double u = x - kWidth / 2.0, v = y - kHeight / 2.0;
  const double across = c * v - s * u + probe.offset, along = c * u + s * v;
  const double phase = across - probe.pitch_px * std::floor(across / probe.pitch_px);
  return std::abs(along) <= 24 && std::abs(across - probe.offset) <= 24 && phase < probe.slit_px;
}

/// The background is uniform and bright, as the sky above the ceiling of the Cellar, or a pattern of the same
/// mean.
FlatWorld world_of(const PlateProbe& probe, bool uniform_background) {
  FlatSurface plate{probe.plate_px, {}, {}};
  plate.covers = [probe](double x, double y) { return in_plate(x, y) && !in_slit(probe, x, y); };
  plate.colour = [pattern = flat_pattern(6, probe.pattern)](double x, double y) {
    return pattern(x, y) * 0.3f;
  };
  FlatSurface background{probe.background_px, {}, {}};
  if (uniform_background)
    background.colour = Rgb{0.52f, 0.52f, 0.52f};
  else
    background.colour = flat_pattern(4, probe.pattern + 1);
  return {.surfaces = {plate, background}};
}

/// Largest or smallest value in a window along one axis, the image's edge repeated.
template <class Choose>
DisparityMap filtered(const DisparityMap& map, int radius, Choose choose) {
  DisparityMap rows = map, both = map;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      for (int i = std::max(0, x - radius); i <= std::min(map.width() - 1, x + radius); ++i)
        rows.at(x, y) = choose(rows.at(x, y), map.at(i, y));
  both = rows;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      for (int j = std::max(0, y - radius); j <= std::min(map.height() - 1, y + radius); ++j)
        both.at(x, y) = choose(both.at(x, y), rows.at(x, j));
  return both;
}

/// The light field with openings of up to `radius`·2 px closed in its disparity maps (grey closing); colours
/// stay.
LightField with_filled_slits(const LightField& field, int radius) {
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < field.grid().rows; ++row)
    for (int column = 0; column < field.grid().columns; ++column) {
      KeyView<SceneReferred> view = *field.view(column, row);
      const auto larger = [](float a, float b) { return std::max(a, b); };
      const auto smaller = [](float a, float b) { return std::min(a, b); };
      view.disparity = filtered(filtered(view.disparity, radius, larger), radius, smaller);
      views.push_back(std::move(view));
    }
  return LightField::from_views(field.grid(), field.unit(), field.name() + ", slits filled",
                                std::move(views));
}

struct PlateViews {
  SceneImage truth, unfilled, filled;
};

PlateViews views_of(const PlateProbe& probe, bool uniform_background, int threads) {
  const FlatWorld world = world_of(probe, uniform_background);
  const LightField field = flat_light_field(world, plate_grid(), "plate probe", threads);
  const int radius = static_cast<int>(std::ceil(probe.slit_px / 2)) + 1;
  SynthesisOptions options;
  options.threads = threads;
  return {flat_view(world, plate_grid(), probe.position, threads).colour,
          synthesize(field, probe.position, options).image,
          synthesize(with_filled_slits(field, radius), probe.position, options).image};
}

/// Errors inside the plate, at least 3 px from its outline, which slits have no part in.
PlateErrors errors_of(const PlateProbe& probe, const PlateViews& views) {
  const float exposure = 1;
  const Plane<float> unfilled = squared_error(views.unfilled, views.truth, exposure);
  const Plane<float> filled = squared_error(views.filled, views.truth, exposure);
  PlateErrors errors;
  const double ds = (probe.position.s - 0.5) * probe.plate_px, dt = (probe.position.t - 0.5) * probe.plate_px;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double u = x + 0.5 + ds - kWidth / 2.0, v = y + 0.5 + dt - kHeight / 2.0;
      if (std::hypot(u, v) > 31) continue;
      errors.unfilled.add(static_cast<double>(unfilled.at(x, y)));
      errors.filled.add(static_cast<double>(filled.at(x, y)));
    }
  return errors;
}

/// RMS error filled / unfilled, pooled over plates.
Interval ratio_of(const std::vector<PlateErrors>& plates, std::uint64_t seed) {
  return bootstrap_units(
      plates.size(),
      [&](std::span<const double> drawn) {
        ErrorSum unfilled, filled;
        for (const double i : drawn) {
          unfilled += plates[static_cast<std::size_t>(i)].unfilled;
          filled += plates[static_cast<std::size_t>(i)].filled;
        }
        return filled.rms() / std::max(unfilled.rms(), 1e-9);
      },
      seed);
}

PlateErrors pooled(const std::vector<PlateErrors>& plates) {
  PlateErrors sum;
  for (const PlateErrors& p : plates) sum.unfilled += p.unfilled, sum.filled += p.filled;
  return sum;
}

void add_rows(ResultTable& rows, const std::vector<PlateErrors>& plates, const Interval& ratio,
              const std::string& background) {
  const PlateErrors sum = pooled(plates);
  const auto columns = [&](const char* slits) {
    return std::vector<std::pair<std::string, Cell>>{{"background", background},
                                                     {"slits", std::string(slits)}};
  };
  rows.add({"rms_error", sum.unfilled.rms(), "1", columns("as they are")});
  rows.add({"rms_error", sum.filled.rms(), "1", columns("filled")});
  rows.add({"rms_error_ratio", ratio.estimate, "1", columns("filled / as they are")});
}

std::string words_of(const std::vector<PlateErrors>& plates, const Interval& ratio) {
  const PlateErrors sum = pooled(plates);
  return fmt::format("{} filled against {} as they are, ratio {}", format_number(sum.filled.rms(), 3),
                     format_number(sum.unfilled.rms(), 3), interval_text(ratio));
}

void add_example(ReproductionResult& result, const PlateProbe& probe, const PlateViews& views) {
  result.add_comparison(
      "slits-before-uniform-background",
      {fmt::format("A plate with slits of {:.1f} px before a uniform background: truth, synthesis "
                   "from the disparity maps as they are and with slits filled",
                   probe.slit_px),
       "A plate with slits in three versions",
       {{"Ground truth", expose(views.truth, 1)},
        {"Slits as they are", expose(views.unfilled, 1)},
        {"Slits filled", expose(views.filled, 1)}}},
      {views.truth, views.unfilled, views.filled});
}

/// Errors of every plate before either background.
struct Plates {
  std::vector<PlateErrors> uniform, structured;
};

Plates measure_plates(const LaboratoryOptions& options, ReproductionResult& result) {
  const int count = options.effort == Effort::kTiny ? 2 : 16;
  Plates plates;
  for (int i = 0; i < count; ++i) {
    RandomStream random(options.seed, 0x4780, static_cast<std::uint64_t>(i));
    const PlateProbe probe = random_plate(random);
    const PlateViews views = views_of(probe, true, options.threads);
    plates.uniform.push_back(errors_of(probe, views));
    plates.structured.push_back(errors_of(probe, views_of(probe, false, options.threads)));
    if (i == 0) add_example(result, probe, views);
  }
  return plates;
}

Verdict decide_filling(const Interval& ratio, std::size_t plates) {
  Verdict verdict = decide_claim(ratio, Comparison::kBelow, kNoChange, "rms_error_ratio", "1",
                                 uncertainty_over(plates, "plates"));
  verdict.scenes = {"flat plates with slits"};
  verdict.explanation = fmt::format(
      "RMS error (encoded values) inside a plate with slits before a uniform background, with slits closed "
      "in the "
      "disparity maps (grey closing, a little wider than the slits) divided by that with the maps as they "
      "are: {}. "
      "Restoration is on in both. Below 1, filling helps; it is faithful as far as a painted stripe of the "
      "same outline "
      "would be.",
      interval_text(ratio));
  return verdict;
}

ReportPlot plot_of(const Interval& uniform_background, const Interval& structured_background,
                   std::string alt) {
  Plot plot;
  plot.x.title = "Background";
  plot.y = {.title = "RMS error, filled / as they are", .unit = "1", .minimum = 0, .maximum = {}};
  plot.categories = {"uniform", "structured"};
  plot.key = KeyPosition::kNone;
  plot.series = {{.title = "ratio", .points = {}}};
  for (const Interval& r : {uniform_background, structured_background})
    plot.series[0].points.push_back({.y = r.estimate, .y_low = r.low, .y_high = r.high, .label = {}});
  return {plot, "Error with filled slits as a multiple of that with slits as they are; 95 % intervals",
          std::move(alt)};
}

}  // namespace

ReproductionResult reproduce_claim_g8(Laboratory& laboratory) {
  const std::uint64_t seed = laboratory.options().seed;
  ReproductionResult result;
  const Plates plates = measure_plates(laboratory.options(), result);
  const Interval ratio = ratio_of(plates.uniform, seed);
  const Interval structured = ratio_of(plates.structured, seed);
  Verdict verdict = decide_filling(ratio, plates.uniform.size());
  result.paper_shows =
      "Filling the slits of the ceiling when the disparity maps are made can give a faithful view, since the "
      "sky behind "
      "is uniform (section 4.1.5).";
  result.ours_shows = fmt::format(
      "Before a uniform background the RMS error of encoded values is {}. {} Before a structured background "
      "it is {}.",
      words_of(plates.uniform, ratio), outcome_text(verdict.outcome),
      words_of(plates.structured, structured));
  result.differs = fmt::format(
      "The thesis fills slits in the model of one scene; here openings are closed in the maps of {} random "
      "plates. What "
      "is left with filled slits is the error of their outlines, which every key view has rounded to its own "
      "pixels.",
      plates.uniform.size());
  result.add_plot("filled-over-unfilled", plot_of(ratio, structured, result.ours_shows));
  add_rows(result.rows, plates.uniform, ratio, "uniform");
  add_rows(result.rows, plates.structured, structured, "structured");
  conclude(result,
           {"A-G8", "Altmeier 2018, section 4.1.5",
            "Filling slits in the disparity map before a uniform background gives a faithful view."},
           std::move(verdict));
  return result;
}

}  // namespace plenolab
