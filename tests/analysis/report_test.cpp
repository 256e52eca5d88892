#include "analysis/report/report.h"

#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "analysis/report/blocks.h"
#include "core/base/error.h"
#include "core/base/file.h"

namespace plenolab {
namespace {

constexpr const char* kEvil = "<script>alert('x')</script> & \"quoted\"";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++found;
  return found;
}

ImageComparison two_images() {
  return {kEvil, kEvil, {{kEvil, DisplayImage(6, 4, {1, 0, 0})}, {"b", DisplayImage(6, 4, {0, 0.5f, 1})}}};
}

Plot small_plot() {
  Plot plot;
  plot.title = kEvil;
  plot.series = {{kEvil, PlotSeries::Style::kLines, {{1, 2, {}, {}, "", false}, {2, 3, {}, {}, "", false}}}};
  return plot;
}

/// Every kind of block with text that would break a page.
Report hostile_report() {
  Report report;
  report.title = report.subtitle = kEvil;
  report.key_figures = {{kEvil, kEvil, kEvil, kEvil}};
  ReportTable table{kEvil, {kEvil, "n"}, {{kEvil, 3LL}, {"", std::numeric_limits<double>::infinity()}}};
  Verdict verdict = decide_claim({0.4, 0.3, 0.5}, Comparison::kBelow, 1, kEvil, kEvil, kEvil);
  verdict.scenes = {kEvil};
  verdict.explanation = kEvil;
  ReportLedger ledger{kEvil, {{{"a-1", kEvil, kEvil}, verdict}, {{"a-2", "w", "s"}, undecidable(kEvil)}}};
  report.sections = {{kEvil, {Paragraph{kEvil}, table, ReportPlot{small_plot(), kEvil, kEvil}}},
                     {"Images", {two_images(), ledger}}};
  report.provenance = start_provenance({"plenolab", kEvil});
  report.provenance->parameters["text"] = kEvil;
  report.provenance->inputs = {{kEvil, "00"}};
  return report;
}

TEST(EscapeHtml, ReplacesEveryCharacterWithAMeaning) {
  EXPECT_EQ(escape_html("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

TEST(Report, LetsNoTextBecomeMarkup) {
  const std::string html = report_html(hostile_report());
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(count(html, "<script>"), 1u);
  EXPECT_NE(html.find("&lt;script&gt;alert(&#39;x&#39;)"), std::string::npos);
}

TEST(Report, ClosesWhatItOpens) {
  const std::string html = report_html(hostile_report());
  const std::string body = html.substr(html.find("<body>"), html.find("<script>\n") - html.find("<body>"));
  for (const std::string tag : {"section", "figure", "table", "div", "ul", "li", "p", "article", "nav", "dl",
                                "h2", "td", "th", "tr"}) {
    const std::regex opening("<" + tag + "[ >]");
    const auto opened =
        std::distance(std::sregex_iterator(body.begin(), body.end(), opening), std::sregex_iterator());
    EXPECT_EQ(static_cast<std::size_t>(opened), count(body, "</" + tag + ">")) << tag;
  }
}

TEST(Report, NeedsNothingFromOutside) {
  const std::string html = report_html(hostile_report());
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
  EXPECT_EQ(html.find("href=\"http"), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
}

TEST(Report, EmbedsEachImageOnceAndEachPlotForBothThemes) {
  const std::string html = report_html(hostile_report());
  EXPECT_EQ(count(html, "data:image/png;base64,"), 2u);
  EXPECT_EQ(count(html, "data:image/svg+xml;base64,"), 2u);
  EXPECT_EQ(count(html, "<img "), count(html, " alt=\""));
}

TEST(Report, LinksItsContentsToItsSections) {
  const std::string html = report_html(hostile_report());
  const std::regex link("<li><a href=\"#([^\"]+)\">");
  int links = 0;
  for (std::sregex_iterator it(html.begin(), html.end(), link), end; it != end; ++it, ++links) {
    EXPECT_EQ(count(html, "<section id=\"" + (*it)[1].str() + "\""), 1u);
  }
  EXPECT_EQ(links, 3);
}

TEST(Report, IsTheSameEveryTime) {
  Report report = hostile_report();
  EXPECT_EQ(report_html(report), report_html(report));
}

TEST(Report, OfNothingIsStillAPage) {
  Report report;
  report.title = "Empty";
  const std::string html = report_html(report);
  EXPECT_NE(html.find("<title>Empty</title>"), std::string::npos);
  EXPECT_NE(html.find("</html>"), std::string::npos);
}

TEST(Report, NamesSectionAndBlockOfWhatItCannotShow) {
  Report report;
  report.sections = {{"Quality", {Paragraph{"fine"}, ReportTable{"t", {"a", "b"}, {{1LL}}}}}};
  try {
    report_html(report);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"Quality\", block 2"), std::string::npos) << error.what();
  }
  ImageComparison comparison = two_images();
  comparison.images[1].image = DisplayImage(5, 4);
  report.sections = {{"Images", {comparison}}};
  EXPECT_THROW(report_html(report), InputError);
  comparison.images.clear();
  report.sections = {{"Images", {comparison}}};
  EXPECT_THROW(report_html(report), InputError);
  comparison = two_images();
  comparison.images[0].image.at(0, 0).r = std::numeric_limits<float>::quiet_NaN();
  report.sections = {{"Images", {comparison}}};
  EXPECT_THROW(report_html(report), InputError);
}

TEST(ReportTable, OfManyColumnsIsSetCloser) {
  const auto html_of = [](std::size_t columns) {
    return detail::block_html(ReportTable{"t", std::vector<std::string>(columns, "h"), {}});
  };
  EXPECT_EQ(html_of(7).find("table wide"), std::string::npos);
  EXPECT_NE(html_of(8).find("class=\"table wide\""), std::string::npos);
}

TEST(ReportTable, GivesNumbersOfSimilarSizeEqualDecimals) {
  Report report;
  report.sections = {{"S", {ReportTable{"t", {"a", "b"}, {{36.0, 1e-3}, {42.8512, 250.0}, {0.0, 1.0}}}}}};
  const std::string html = report_html(report);
  EXPECT_NE(html.find(">36.00</td>"), std::string::npos);
  EXPECT_NE(html.find(">42.85</td>"), std::string::npos);
  EXPECT_NE(html.find(">0.001</td>"), std::string::npos);
  EXPECT_NE(html.find(">250</td>"), std::string::npos);
  EXPECT_NE(detail::block_html(ReportTable{"t", {"n"}, {{2.0}, {1.0}}}).find(">2</td>"), std::string::npos)
      << "counts have no decimals";
}

TEST(DataUri, EncodesTheExamplesOfRfc4648) {
  EXPECT_EQ(detail::data_uri("t", ""), "data:t;base64,");
  EXPECT_EQ(detail::data_uri("t", "f"), "data:t;base64,Zg==");
  EXPECT_EQ(detail::data_uri("t", "fo"), "data:t;base64,Zm8=");
  EXPECT_EQ(detail::data_uri("t", "foo"), "data:t;base64,Zm9v");
  EXPECT_EQ(detail::data_uri("t", "foobar"), "data:t;base64,Zm9vYmFy");
  EXPECT_EQ(detail::data_uri("t", "\xff\xfe"), "data:t;base64,//4=");
}

TEST(Report, WritesItsFile) {
  const TemporaryFolder folder;
  write_report(hostile_report(), folder.path() / "new" / "report.html");
  EXPECT_EQ(read_text_file(folder.path() / "new" / "report.html").substr(0, 15), "<!DOCTYPE html>");
}

}  // namespace
}  // namespace plenolab
