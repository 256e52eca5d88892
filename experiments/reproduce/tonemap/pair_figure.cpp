#include "experiments/reproduce/tonemap/pair_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/colour.h"

namespace plenolab {

namespace {

constexpr const char* kScenes[] = {"cellar", "desk", "dunes"};
constexpr float kChangeGain = 8, kFactorGain = 4;

/// Grey where nothing changes, lighter where the second view is brighter, blue where the pixel takes no part.
DisplayImage change_picture(const Plane<float>& changes) {
  DisplayImage picture(changes.width(), changes.height());
  for (std::size_t n = 0; n < changes.size(); ++n) {
    const float change = changes.pixels()[n];
    const float grey = std::clamp(0.5f + kChangeGain * change, 0.0f, 1.0f);
    picture.pixels()[n] = std::isfinite(change) ? Rgb{grey, grey, grey} : Rgb{0.1f, 0.15f, 0.35f};
  }
  return picture;
}

/// Grey where luma stays, lighter where it is raised.
DisplayImage factor_picture(const DisplayImage& before, const DisplayImage& after) {
  DisplayImage picture(before.width(), before.height());
  for (std::size_t n = 0; n < before.size(); ++n) {
    const float from = luminance(before.pixels()[n]), to = luminance(after.pixels()[n]);
    const float factor = from > 0 ? to / from : 1;
    const float grey = std::clamp(0.5f + kFactorGain * (factor - 1), 0.0f, 1.0f);
    picture.pixels()[n] = {grey, grey, grey};
  }
  return picture;
}

/// To four decimals, without a sign where nothing is left.
double rounded(double value) {
  return std::round(1e4 * value) / 1e4 + 0.0;
}

/// Both key views of a pair with one mapping.
struct MappedPair {
  std::string label;
  DisplayImage first, second;
  LineChange change;
  Plane<float> changes;
};

MappedPair map_pair(MappingBench& bench, const KeyViewPair& pair, Shown shown) {
  const PairChange& p = pair.naive;
  const int column = p.column + (p.down ? 0 : 1), row = p.row + (p.down ? 1 : 0);
  const Mapping mapping = mapping_for(bench, pair.scene, shown);
  const auto mapped = bench.key_views(pair.scene, mapping);
  const LightField field = bench.laboratory().light_field(pair.scene);
  const auto hdr_a = field.view(p.column, p.row), hdr_b = field.view(column, row);
  const auto a = mapped->field.view(p.column, p.row), b = mapped->field.view(column, row);
  const ConsistencyView from{a->colour, hdr_a->colour, hdr_a->disparity},
      to{b->colour, hdr_b->colour, hdr_b->disparity};
  const ViewMotion motion{p.down ? 0.0 : 1.0, p.down ? field.grid().vertical_ratio() : 0.0};
  const ConsistencyOptions options{.threads = bench.threads()};
  return {mapping.label, a->colour, b->colour, change_along_lines(from, to, motion, options),
          change_map_along_lines(from, to, motion, options)};
}

std::string place_of(const KeyViewPair& pair) {
  return fmt::format("key view {}, {} and the one {} it", pair.naive.column, pair.naive.row,
                     pair.naive.down ? "below" : "to the right of");
}

void add_pair(ReproductionResult& result, const KeyViewPair& pair, const std::vector<MappedPair>& mapped,
              bool factor) {
  ImageComparison shown{
      fmt::format(
          "{}: {}, the neighbours that naive Reinhard 2005 changes most. Change: from the first to the "
          "second along epipolar lines, grey none, white +{:.3f} luma; blue where the second view "
          "shows another surface or another luminance (by more than 0.02 log10 units, noise included){}. {}",
          pair.title, place_of(pair), 0.5 / kChangeGain,
          factor ? fmt::format(". Factor: of luma by the adjustment, grey 1, white {:.3f}",
                               1 + 0.5 / kFactorGain)
                 : "",
          kShortLabels),
      pair.title + ", two neighbouring key views",
      {}};
  for (const MappedPair& m : mapped) {
    shown.images.push_back({"First, " + short_label(m.label), m.first});
    shown.images.push_back({"Second, " + short_label(m.label), m.second});
    shown.images.push_back({"Change, " + short_label(m.label), change_picture(m.changes)});
  }
  if (factor) {
    shown.images.push_back({"Factor, first", factor_picture(mapped.front().first, mapped.back().first)});
    shown.images.push_back({"Factor, second", factor_picture(mapped.front().second, mapped.back().second)});
  }
  result.add_comparison(pair.scene, std::move(shown));
}

}  // namespace

std::optional<KeyViewPair> most_changed_pair(MappingBench& bench, const std::string& scene) {
  const auto mapped = bench.key_views(scene, mapping_for(bench, scene, Shown::kReinhardNaive));
  const std::vector<PairChange> pairs =
      pair_changes(bench.laboratory().light_field(scene), mapped->field, Neighbours::kBoth, bench.threads());
  const auto most =
      std::max_element(pairs.begin(), pairs.end(), [](const PairChange& a, const PairChange& b) {
        return std::abs(a.change.mean) < std::abs(b.change.mean);
      });
  if (most == pairs.end()) return std::nullopt;
  return KeyViewPair{scene, bench.laboratory().scene(scene).title, *most};
}

std::vector<KeyViewPair> most_changed_pairs(MappingBench& bench) {
  std::vector<KeyViewPair> pairs;
  for (const char* scene : kScenes)
    if (auto pair = most_changed_pair(bench, scene)) pairs.push_back(std::move(*pair));
  return pairs;
}

std::vector<ShownPair> show_pairs(ReproductionResult& result, MappingBench& bench,
                                  const std::vector<KeyViewPair>& pairs, const PairPictures& pictures) {
  ReportTable table{
      "Change of luma from the first key view to the second, over surfaces that both show under the same "
      "light",
      {"scene", "mapping", "mean [luma]", "RMS [luma]", "share of pixels", "peak luminance [log10]"},
      {},
      3};
  std::vector<ShownPair> shown;
  for (const KeyViewPair& pair : pairs) {
    std::vector<MappedPair> mapped;
    ShownPair numbers{pair, {}};
    for (const Shown one : pictures.mappings) {
      mapped.push_back(map_pair(bench, pair, one));
      const LineChange& change = mapped.back().change;
      numbers.changes.push_back(change);
      table.rows.push_back(
          {pair.title, mapped.back().label, change.mean, change.rms, change.share, pair.naive.log_peak_step});
      const Columns columns{{"scene", pair.scene}, {"mapping", mapped.back().label}};
      result.rows.add({"pair_change_mean", change.mean, "luma", columns});
      result.rows.add({"pair_change_rms", change.rms, "luma", columns});
    }
    add_pair(result, pair, mapped, pictures.factor);
    shown.push_back(std::move(numbers));
  }
  result.add_table(std::move(table));
  return shown;
}

std::string change_words(const std::vector<ShownPair>& pairs, std::size_t mapping) {
  std::string text;
  for (const ShownPair& shown : pairs)
    text += fmt::format("{}{} {:+.4f} (RMS {:.4f})", text.empty() ? "" : ", ", shown.pair.title,
                        rounded(shown.changes[mapping].mean), shown.changes[mapping].rms);
  return text;
}

}  // namespace plenolab
