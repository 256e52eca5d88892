#include "analysis/plot.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <regex>
#include <set>

#include "analysis/plot_script.h"
#include "analysis/plot_style.h"
#include "analysis/subprocess.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace {

Plot sweep() {
  Plot plot;
  plot.x = {"Run time", "s", true, {}, {}};
  plot.y = {"RMS error", "1", true, {}, {}};
  plot.marked_title = "Pareto front";
  plot.series = {{"linear search",
                  PlotSeries::Style::kLinesPoints,
                  {{0.01, 1e-2, {}, {}, "4 px", true}, {1, 1e-5, 8e-6, 2e-5, "", false}}},
                 {"fast", PlotSeries::Style::kPoints, {{0.02, 3e-3, {}, {}, "", true}}}};
  return plot;
}

TEST(Plot, DrawsTheSameSvgEveryTime) {
  const std::string svg = plot_svg(sweep());
  EXPECT_EQ(svg, plot_svg(sweep()));
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("linear search"), std::string::npos);
  EXPECT_NE(svg.find("Run time [s]"), std::string::npos);
  EXPECT_NE(svg.find("Pareto front"), std::string::npos);
}

TEST(Plot, HasItsOwnInkForDarkPages) {
  EXPECT_NE(plot_svg(sweep(), PlotTheme::kLight), plot_svg(sweep(), PlotTheme::kDark));
}

/// Relative luminance of "#rrggbb" (WCAG 2.1).
double luminance_of(const std::string& colour) {
  const auto linear = [&](std::size_t at) {
    const double v = std::stoi(colour.substr(at, 2), nullptr, 16) / 255.0;
    return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5);
}

double contrast(const std::string& a, const std::string& b) {
  const double x = luminance_of(a), y = luminance_of(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(PlotStyle, ColoursStandOutFromThePagesOfReports) {
  const std::string css =
      read_text_file(std::filesystem::path(PLENOLAB_SOURCE_DIR) / "analysis/report/report.css");
  const std::regex page("--(page|raised): (#[0-9a-f]{6})");
  int pages = 0;
  for (std::sregex_iterator it(css.begin(), css.end(), page), end; it != end; ++it, ++pages) {
    const std::string colour = (*it)[2];
    const auto output =
        luminance_of(colour) > 0.5 ? detail::PlotOutput::kSvgLight : detail::PlotOutput::kSvgDark;
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_GE(contrast(detail::series_style(i, output).colour, colour), 3) << i << " on " << colour;
  }
  EXPECT_GE(pages, 4);
}

TEST(PlotStyle, SeriesDifferByMoreThanColour) {
  std::set<std::pair<int, int>> marks;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto style = detail::series_style(i, detail::PlotOutput::kSvgLight);
    marks.insert({style.point_type, style.dash_type});
  }
  EXPECT_EQ(marks.size(), 8u);
}

TEST(Plot, WritesScriptDataSvgAndPdf) {
  const TemporaryFolder folder;
  const PlotFiles files = write_plot(sweep(), folder.path() / "new" / "it's `a` plot");
  EXPECT_EQ(read_text_file(files.svg), plot_svg(sweep()));
  EXPECT_NE(read_text_file(files.svg_dark), read_text_file(files.svg));
  EXPECT_EQ(read_text_file(files.pdf).substr(0, 5), "%PDF-");
  EXPECT_EQ(read_text_file(files.data),
            "series,x,y,y_low,y_high,label,marked\r\nlinear search,0.01,0.01,,,4 px,1\r\n"
            "linear search,1,1e-05,8e-06,2e-05,,0\r\nfast,0.02,0.003,,,,1\r\n");
  const TemporaryFolder elsewhere;
  std::filesystem::copy(files.script, elsewhere.path() / "again.gp");
  EXPECT_EQ(run_process({"gnuplot", "-d", "again.gp"}, elsewhere.path()).exit_code, 0);
  EXPECT_EQ(read_text_file(elsewhere.path() / files.svg.filename()), read_text_file(files.svg));
}

TEST(Plot, TakesAnyTextLiterally) {
  const TemporaryFolder folder;
  const std::string evil =
      "`touch " + (folder.path() / "owned").string() + "` it's \"x_{y}\" @ ^\n; system('false')";
  Plot plot = sweep();
  plot.title = plot.x.title = plot.marked_title = plot.series[0].title = plot.series[0].points[0].label =
      evil;
  const std::string svg = plot_svg(plot);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "owned"));
  EXPECT_NE(svg.find("x_{y}"), std::string::npos);
  EXPECT_EQ(detail::gnuplot_quoted("a'b\nc"), "'a''b c'");
}

TEST(Plot, DrawsBarsWithCategoriesAndErrorBars) {
  Plot plot;
  plot.categories = {"cellar", "desk"};
  plot.y = {"Unseen pixels", "%", false, {}, {}};
  plot.series = {
      {"shifted", PlotSeries::Style::kPoints, {{0, 1.5, 1.0, 2.0, "", false}, {0, 0, 0, 0.1, "", false}}},
      {"fixed", PlotSeries::Style::kPoints, {{0, 3, {}, {}, "", false}, {0, 2, {}, {}, "", false}}}};
  EXPECT_NE(plot_svg(plot).find("cellar"), std::string::npos);
  plot.series[1].points.pop_back();
  EXPECT_THROW(plot_svg(plot), InputError);
}

TEST(Plot, DrawsASinglePointOnAnyAxis) {
  for (const bool logarithmic : {false, true}) {
    Plot plot;
    plot.x.logarithmic = plot.y.logarithmic = logarithmic;
    plot.series = {{"one", PlotSeries::Style::kLinesPoints, {{2, 2, {}, {}, "", false}}}};
    EXPECT_NE(plot_svg(plot).find("</svg>"), std::string::npos);
  }
}

/// Values at which an axis has labelled ticks.
std::vector<double> ticks_of(const PlotAxis& axis, double low, double high) {
  const std::string text = detail::axis_commands("y", axis, low, high);
  const std::regex tick("'([^']*)' ([^,)]*)");
  std::vector<double> values;
  for (std::sregex_iterator
           it(text.begin() + static_cast<std::ptrdiff_t>(text.find("ytics")), text.end(), tick),
       end;
       it != end; ++it) {
    EXPECT_EQ((*it)[1], (*it)[2]);
    values.push_back(std::stod((*it)[2]));
  }
  return values;
}

TEST(PlotStyle, ShortLogarithmicAxesHaveThreeToTenLabels) {
  const PlotAxis axis{"Luminance", "cd/m²", true, {}, {}};
  for (const auto& [low, high] : {std::pair{150.0, 420.0},
                                  {0.15, 0.4},
                                  {7.0, 30.0},
                                  {82.5, 468.0},
                                  {1.0, 900.0},
                                  {2.0, 2.0},
                                  {0.0991, 0.0992},
                                  {1e-12, 3e-12},
                                  {4e6, 6e8}}) {
    const std::vector<double> ticks = ticks_of(axis, low, high);
    EXPECT_GE(ticks.size(), 3u) << low << " to " << high;
    EXPECT_LE(ticks.size(), 10u) << low << " to " << high;
    for (const double tick : ticks) {
      EXPECT_GE(tick, low / 2) << low;
      EXPECT_LE(tick, 2 * high) << high;
    }
  }
  const PlotAxis bounded{"Luminance", "cd/m²", true, 100.0, 300.0};
  EXPECT_EQ(ticks_of(bounded, 150, 200), (std::vector<double>{100, 150, 200, 300}));
}

TEST(Plot, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(plot_svg(Plot{}), InputError);
  Plot plot = sweep();
  plot.series[0].points[0].x = 0;
  EXPECT_THROW(plot_svg(plot), InputError);
  plot = sweep();
  plot.series[0].points[0].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(plot_svg(plot), InputError);
  plot = sweep();
  plot.series[0].points[0].y_low = 1e-3;
  EXPECT_THROW(plot_svg(plot), InputError);
  plot = sweep();
  plot.series[1].points.clear();
  EXPECT_THROW(plot_svg(plot), InputError);
}

TEST(Plot, SaysSoWhenGnuplotIsMissing) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  std::string message;
  try {
    plot_svg(sweep());
  } catch (const InputError& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("gnuplot"), std::string::npos);
  EXPECT_NE(message.find("install"), std::string::npos);
}

TEST(Subprocess, ReturnsExitCodeAndOutput) {
  const ProcessResult result = run_process({"sh", "-c", "pwd; echo \"$1\" >&2; exit 3", "sh", "a; b"}, "/");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.output, "/\na; b\n");
  EXPECT_EQ(run_process({"sh", "-c", "kill -9 $$"}, "/").exit_code, 137);
}

TEST(Subprocess, AChildCanBeStoppedThoughItsParentBlocksTheSignal) {
  sigset_t stop, before;
  sigemptyset(&stop);
  sigaddset(&stop, SIGTERM);
  ASSERT_EQ(pthread_sigmask(SIG_BLOCK, &stop, &before), 0);
  const int exit_code = run_process({"sh", "-c", "kill -TERM $$; exit 0"}, "/").exit_code;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_EQ(exit_code, 128 + SIGTERM);
}

}  // namespace
}  // namespace plenolab
