#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/file.h"
#include "core/lut/cube_file.h"
#include "core/lut/strip_file.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

ReproductionResult reproduce_lut_storage(Laboratory& laboratory);

namespace {

/// A look for the figure: contrast around middle grey, and shadows turned to blue.
Lut graded_look(int size) {
  return bake_lut(size, [](Rgb c) {
    const auto curve = [](float v) { return v * v * (3 - 2 * v); };
    const Rgb contrasty{curve(c.r), curve(c.g), curve(c.b)};
    return Rgb{contrasty.r * 0.95f, contrasty.g * 0.97f, 0.06f + 0.94f * contrasty.b};
  });
}

double largest_error(const Lut& a, const Lut& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    largest = std::max({largest, std::abs(a.nodes[i].r - b.nodes[i].r), std::abs(a.nodes[i].g - b.nodes[i].g),
                        std::abs(a.nodes[i].b - b.nodes[i].b)});
  return largest;
}

/// A way of storing a table: what it takes and what comes back.
struct Stored {
  const char* name;
  const char* file;
  double bytes = 0, error = 0;
};

std::vector<Stored> store_both_ways(const Lut& lut) {
  const TemporaryFolder folder;
  std::vector<Stored> ways{{"text, .cube", "look.cube"}, {"image strip, .png", "look.png"}};
  for (Stored& way : ways) {
    const auto path = folder.path() / way.file;
    write_lut(path, lut);
    way.bytes = static_cast<double>(std::filesystem::file_size(path));
    way.error = largest_error(lut, read_lut(path));
  }
  return ways;
}

/// The strip with its pixels enlarged, each a square of `scale` pixels.
DisplayImage enlarged(const DisplayImage& image, int scale) {
  DisplayImage large(image.width() * scale, image.height() * scale);
  for (int y = 0; y < large.height(); ++y)
    for (int x = 0; x < large.width(); ++x) large.at(x, y) = image.at(x / scale, y / scale);
  return large;
}

}  // namespace

ReproductionResult reproduce_lut_storage(Laboratory&) {
  const Lut shown = graded_look(8), stored = graded_look(kDefaultLutSize);
  const std::vector<Stored> ways = store_both_ways(stored);
  ReproductionResult result;
  result.paper_shows =
      "Figure 12: two ways of storing a table: the text of a .cube file, and its layers side by side as an "
      "image.";
  result.ours_shows = fmt::format(
      "A table of {}³ nodes takes {:.0f} KiB as .cube and comes back with an error of {:.1g}; as a strip of "
      "{}×{} pixels it takes {:.0f} KiB and "
      "comes back with one of {:.1g}.",
      stored.size, ways[0].bytes / 1024, ways[0].error, stored.size * stored.size, stored.size,
      ways[1].bytes / 1024, ways[1].error);
  result.differs =
      "The formats are the paper's. A .cube file keeps numbers as they are and outputs beyond 0 … 1; a strip "
      "is "
      "what an engine loads as a texture.";
  ReportTable table{fmt::format("A table of {}³ nodes, stored and read back", stored.size),
                    {"format", "bytes", "largest error"},
                    {}};
  table.digits = 3;
  for (const Stored& way : ways) {
    table.rows.push_back({way.name, way.bytes, way.error});
    result.rows.add({"file_size", way.bytes, "B", {{"format", std::string(way.name)}}});
    result.rows.add({"largest_error", way.error, "1", {{"format", std::string(way.name)}}});
  }
  result.add_table(std::move(table));
  ImageComparison comparison{fmt::format("Strips of {}³ nodes, enlarged: red rises to the right in a tile, "
                                         "green downwards, blue from tile to tile",
                                         shown.size),
                             "Eight coloured tiles side by side, twice",
                             {}};
  comparison.images = {{"Identity", enlarged(strip_of_lut(identity_lut(shown.size)), 8)},
                       {"A look", enlarged(strip_of_lut(shown), 8)}};
  result.add_comparison("strips", std::move(comparison));
  return result;
}

}  // namespace plenolab
