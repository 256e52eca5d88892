#include "experiments/reproduce/lut/lut_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"

namespace plenolab {

namespace {

constexpr int kGap_px = 4;

DisplayImage averaged(const DisplayImage& image, int divisor) {
  DisplayImage small(image.width() / divisor, image.height() / divisor);
  const float share = 1.0f / static_cast<float>(divisor * divisor);
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x)
      for (int j = 0; j < divisor; ++j)
        for (int i = 0; i < divisor; ++i)
          small.at(x, y) += image.at(divisor * x + i, divisor * y + j) * share;
  return small;
}

}  // namespace

std::string lut_paper(const std::string& where) {
  return "Zhao 2019, " + where;
}

DisplayImage contact_sheet(const std::vector<DisplayImage>& pictures, int columns, int divisor) {
  PLENOLAB_CHECK(!pictures.empty() && columns >= 1 && divisor >= 1, "pictures for a contact sheet");
  const int width = pictures.front().width() / divisor, height = pictures.front().height() / divisor;
  const int count = static_cast<int>(pictures.size()), across = std::min(columns, count),
            down = (count + across - 1) / across;
  DisplayImage sheet(across * (width + kGap_px) - kGap_px, down * (height + kGap_px) - kGap_px);
  std::ranges::fill(sheet.pixels(), Rgb{1, 1, 1});
  for (int n = 0; n < count; ++n) {
    const DisplayImage small = averaged(pictures[static_cast<std::size_t>(n)], divisor);
    const int left = n % across * (width + kGap_px), top = n / across * (height + kGap_px);
    for (int y = 0; y < height; ++y) std::copy_n(small.row(y), width, sheet.row(top + y) + left);
  }
  return sheet;
}

DisplayImage frame_sheet(WalkBench& bench, std::span<const std::size_t> frames, int columns,
                         const std::function<DisplayImage(std::size_t)>& picture) {
  constexpr int kSmallWidth_px = 200;
  std::vector<DisplayImage> pictures;
  for (const std::size_t i : frames) pictures.push_back(picture(i));
  return contact_sheet(pictures, columns, bench.frames().front().picture.width() > kSmallWidth_px ? 2 : 1);
}

std::string number_word(std::size_t number) {
  constexpr std::array kWords{"no",    "one",   "two",  "three", "four",   "five",  "six",
                              "seven", "eight", "nine", "ten",   "eleven", "twelve"};
  return number < kWords.size() ? kWords.at(number) : std::to_string(number);
}

std::vector<std::size_t> turning_frames(WalkBench& bench, bool turning) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < bench.frames().size(); ++i)
    if (bench.frames()[i].pose.turning == turning) frames.push_back(i);
  return frames;
}

ReportPlot walk_error_plot(WalkBench& bench, const std::vector<GradeReference>& references,
                           const std::string& caption) {
  Plot plot;
  plot.x = {.title = "Frame of the walk", .unit = ""};
  plot.y = {.title = "Mean colour difference ΔE*ab", .unit = "", .minimum = 0};
  plot.key = KeyPosition::kOutside;
  plot.width_px = 860;
  for (const GradeReference reference : references)
    for (const BlendMethod method : {BlendMethod::kLinear, BlendMethod::kPixel}) {
      PlotSeries series{
          fmt::format("{}, to {}", name_of(method), name_of(reference)), PlotSeries::Style::kLinesPoints, {}};
      const std::vector<double> errors = bench.errors(method, reference);
      for (std::size_t i = 0; i < errors.size(); ++i)
        series.points.push_back({static_cast<double>(i), errors[i]});
      plot.series.push_back(std::move(series));
    }
  return {plot, caption, "Colour difference to the reference over the frames, for both ways of blending."};
}

double mean_error(WalkBench& bench, BlendMethod method, GradeReference reference,
                  std::span<const std::size_t> frames) {
  double sum = 0;
  for (const std::size_t i : frames) sum += bench.scores()[i].of(method, reference);
  return sum / static_cast<double>(std::max<std::size_t>(1, frames.size()));
}

void add_error_rows(ReproductionResult& result, WalkBench& bench,
                    const std::vector<GradeReference>& references) {
  for (const GradeReference reference : references)
    for (const BlendMethod method : {BlendMethod::kLinear, BlendMethod::kPixel}) {
      const std::vector<double> errors = bench.errors(method, reference);
      for (std::size_t i = 0; i < errors.size(); ++i)
        result.rows.add({"mean_delta_e",
                         errors[i],
                         "1",
                         {{"frame", static_cast<long long>(i)},
                          {"leg", bench.frames()[i].pose.leg},
                          {"method", std::string(name_of(method))},
                          {"reference", std::string(name_of(reference))}}});
    }
}

}  // namespace plenolab
