// Z-7: code values that PQ and gamma 2.4 spend on the dark.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/image/colour.h"
#include "experiments/reproduce/claims/geometry_measure.h"
#include "experiments/reproduce/reproduction.h"
#include "metrics/vision/eye.h"

namespace plenolab {

ReproductionResult reproduce_claim_z7(Laboratory& laboratory);

namespace {

constexpr double kCodes = 1023, kGamma = 2.4;  // 10 bits

/// A way of coding luminance: code value, not rounded, of cd/m².
struct Coding {
  const char* name;
  double peak_cd_m2;
  bool pq;
  double code(double cd_m2) const {
    return kCodes * (pq ? pq_encode(cd_m2) : std::pow(std::min(1.0, cd_m2 / peak_cd_m2), 1 / kGamma));
  }
};
constexpr std::array kCodings{
    Coding{"PQ, peak 10000 cd/m²", 10000, true}, Coding{"gamma 2.4, peak 100 cd/m²", 100, false},
    Coding{"gamma 2.4, peak 1000 cd/m²", 1000, false}, Coding{"gamma 2.4, peak 10000 cd/m²", 10000, false}};

struct Band {
  double from_cd_m2, to_cd_m2;
};
constexpr std::array<Band, 7> kBands{
    {{0, 0.01}, {0.01, 0.1}, {0.1, 1}, {1, 10}, {10, 100}, {100, 1000}, {1000, 10000}}};

double codes_in(const Coding& coding, const Band& band) {
  return coding.code(std::min(band.to_cd_m2, coding.peak_cd_m2)) -
         coding.code(std::min(band.from_cd_m2, coding.peak_cd_m2));
}

/// Code values per just noticeable difference at a luminance; below 1, steps are visible.
double codes_per_jnd(const Coding& coding, double cd_m2) {
  constexpr double kStep = 1.1;  // wide enough for the table of the scale
  const double low = cd_m2 / kStep, high = cd_m2 * kStep;
  const vision::JndScale& jnd = vision::jnd_scale();
  return (coding.code(high) - coding.code(low)) / (jnd(high) - jnd(low));
}

ReportPlot jnd_plot(ReproductionResult& result) {
  Plot plot;
  plot.x = {.title = "Luminance", .unit = "cd/m²", .logarithmic = true};
  plot.y = {.title = "10-bit codes per JND", .unit = "", .logarithmic = true};
  plot.key = KeyPosition::kOutside;
  for (const Coding& coding : kCodings) {
    PlotSeries series{coding.name, PlotSeries::Style::kLines, {}};
    for (int i = -30; i <= 38; ++i) {
      const double cd_m2 = std::pow(10, 0.1 * i);
      if (cd_m2 * 1.1 > coding.peak_cd_m2) continue;
      const double codes = codes_per_jnd(coding, cd_m2);
      series.points.push_back({cd_m2, codes});
      if (i % 10 == 0)
        result.rows.add({"codes_per_jnd",
                         codes,
                         "1",
                         {{"coding", std::string(coding.name)}, {"luminance_cd_m2", cd_m2}}});
    }
    plot.series.push_back(std::move(series));
  }
  return {plot, "Code values per just noticeable difference (below 1 a step of one code can be seen)",
          "PQ stays level over luminance; gamma curves fall towards the dark."};
}

void add_bands(ReproductionResult& result) {
  ReportTable table{"10-bit code values by range of luminance", {"from [cd/m²]", "to [cd/m²]"}, {}, 3};
  for (const Coding& coding : kCodings) table.headings.push_back(coding.name);
  for (const Band& band : kBands) {
    std::vector<Cell> row{band.from_cd_m2, band.to_cd_m2};
    for (const Coding& coding : kCodings) {
      const double codes = codes_in(coding, band);
      row.emplace_back(codes);
      result.rows.add({"codes",
                       codes,
                       "1",
                       {{"coding", std::string(coding.name)},
                        {"from_cd_m2", band.from_cd_m2},
                        {"to_cd_m2", band.to_cd_m2}}});
    }
    table.rows.push_back(std::move(row));
  }
  result.add_table(std::move(table));
}

/// Files one of the two readings of the claim; gives the ratio of codes in 0.1 to 1 cd/m².
double decide_dark(ReproductionResult& result, const char* id, const char* statement, const Coding& gamma) {
  const Band dark{0.1, 1};
  const double pq = codes_in(kCodings[0], dark), other = codes_in(gamma, dark), ratio = pq / other;
  Verdict verdict = decide_claim({ratio, ratio, ratio}, Comparison::kAbove, 1, "pq_codes_over_gamma_codes",
                                 "1", "none: computed from the definitions");
  verdict.explanation = fmt::format(
      "Between 0.1 and 1 cd/m² PQ has {:.1f} 10-bit codes and {} {:.1f}; below 0.01 cd/m² they have {:.1f} "
      "and {:.1f}.",
      pq, gamma.name, other, codes_in(kCodings[0], kBands[0]), codes_in(gamma, kBands[0]));
  conclude(result, {id, "Zhao 2019, section 2.3", statement}, std::move(verdict));
  return ratio;
}

}  // namespace

ReproductionResult reproduce_claim_z7(Laboratory&) {
  ReproductionResult result;
  const double equal = decide_dark(
      result, "Z-7a", "On a display of the same peak PQ keeps more codes in the dark than gamma 2.4.",
      kCodings[3]);
  const double unequal =
      decide_dark(result, "Z-7b",
                  "PQ keeps more codes in the dark than gamma 2.4 on its display of 100 cd/m².", kCodings[1]);
  result.paper_shows =
      "Section 2.3 and figure 7: PQ is more sensitive in the dark than gamma 2.4, below 0.01 cd/m² above "
      "all, and shows what is brighter than 100 cd/m² as well.";
  result.ours_shows = fmt::format(
      "Between 0.1 and 1 cd/m² PQ has {:.2f} times the codes of gamma 2.4 at the same peak of 10000 cd/m², "
      "and {:.2f} times those at a peak of 100 cd/m². At 0.1 cd/m² PQ spends {:.2f} codes on a just "
      "noticeable difference, gamma {:.2f} and {:.2f}.",
      equal, unequal, codes_per_jnd(kCodings[0], 0.1), codes_per_jnd(kCodings[3], 0.1),
      codes_per_jnd(kCodings[1], 0.1));
  result.differs = fmt::format(
      "The thesis leaves the peaks open, and they decide: {}. PQ codes a range a hundred times as wide as a "
      "display of 100 cd/m² has and {} in the dark.",
      equal > 1 && unequal < 1
          ? "at equal peaks PQ wins by far, but against the gamma of an ordinary display it loses a little"
          : fmt::format("the ratios are {:.2f} at equal and {:.2f} at unequal peaks", equal, unequal),
      unequal < 1 ? "still gives up little" : "gives up nothing");
  add_bands(result);
  ReportPlot plot = jnd_plot(result);
  result.add_plot("codes-per-jnd", std::move(plot));
  return result;
}

}  // namespace plenolab
