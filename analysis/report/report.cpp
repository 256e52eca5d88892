#include "analysis/report/report.h"

#include <fmt/format.h>

#include <cctype>

#include "analysis/report/blocks.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/parallel.h"
#include "report_assets.h"

namespace plenolab {
namespace {

/// Text of an embedded file (its array ends with a 0).
template <std::size_t size>
std::string asset(const unsigned char (&bytes)[size]) {
  return {bytes, bytes + size - 1};
}

/// "s3-image-quality": unique by its number, readable in the address.
std::string section_id(std::size_t number, const std::string& title) {
  std::string id = fmt::format("s{}-", number);
  for (const char c : title) {
    const unsigned char u = static_cast<unsigned char>(c);
    if (u < 0x80 && std::isalnum(u)) {
      id += static_cast<char>(std::tolower(u));
    } else if (id.back() != '-') {
      id += '-';
    }
  }
  while (id.back() == '-') id.pop_back();
  return id;
}

std::string card_html(const KeyFigure& figure) {
  return fmt::format(
      "<div class=\"card\"><dt>{}</dt><dd><span class=\"value\">{}</span>{}{}</dd></div>\n",
      escape_html(figure.label), escape_html(figure.value),
      figure.unit.empty() ? "" : "<span class=\"unit\">" + escape_html(figure.unit) + "</span>",
      figure.note.empty() ? "" : "<span class=\"note\">" + escape_html(figure.note) + "</span>");
}

std::string cards_html(const std::vector<KeyFigure>& figures) {
  if (figures.empty()) return "";
  std::string html = "<dl class=\"cards\" aria-label=\"Summary\">\n";
  for (const KeyFigure& figure : figures) html += card_html(figure);
  return html + "</dl>\n";
}

std::string section_html(std::size_t number, const std::string& title, const std::string& body) {
  const std::string id = section_id(number, title);
  return fmt::format(
      "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\"><span "
      "class=\"number\">{1}</span>"
      "<a href=\"#{0}\">{2}</a></h2>\n{3}</section>\n",
      id, number, escape_html(title), body);
}

std::string body_of(const ReportSection& section) {
  std::string html;
  for (std::size_t i = 0; i < section.blocks.size(); ++i) {
    try {
      html += std::visit([](const auto& block) { return detail::block_html(block); }, section.blocks[i]);
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("section \"{}\", block {} of the report: {}", section.title, i + 1, error.what()));
    }
  }
  return html;
}

/// A section's place in the contents.
struct ContentsLine {
  std::string chapter, title;
};

std::string contents_html(const std::vector<ContentsLine>& lines) {
  if (lines.empty()) return "<div></div>\n";
  std::string html =
      "<nav class=\"toc\" aria-labelledby=\"contents\"><h2 id=\"contents\">Contents</h2><ol>\n";
  std::string chapter;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].chapter != chapter && !lines[i].chapter.empty())
      html += fmt::format("<li class=\"chapter\">{}</li>\n", escape_html(lines[i].chapter));
    chapter = lines[i].chapter;
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section_id(i + 1, lines[i].title),
                        escape_html(lines[i].title));
  }
  return html + "</ol></nav>\n";
}

std::string chapter_html(const std::string& chapter, const std::string& before) {
  if (chapter.empty() || chapter == before) return "";
  return fmt::format("<p class=\"chapter\">{}</p>\n", escape_html(chapter));
}

/// Bodies of all sections; those with plots wait for gnuplot, so they are made side by side.
std::vector<std::string> bodies_of(const std::vector<ReportSection>& sections) {
  std::vector<std::string> bodies(sections.size());
  parallel_for(static_cast<int>(sections.size()), 1, 0, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      bodies[i] = body_of(sections[i]);
  });
  return bodies;
}

std::string masthead_html(const Report& report) {
  std::string html = "<header class=\"masthead\"><h1>" + escape_html(report.title) + "</h1>\n";
  if (!report.subtitle.empty()) html += "<p class=\"subtitle\">" + escape_html(report.subtitle) + "</p>\n";
  if (report.provenance) {
    const Provenance& run = *report.provenance;
    html += fmt::format(
        "<p class=\"meta\"><span>{}</span><span>plenolab {}{}</span><span>{} s on {}</span></p>\n",
        escape_html(run.started_utc), escape_html(run.build.revision), run.build.dirty ? "+" : "",
        format_number(run.duration_s, 3), escape_html(run.machine.cpu));
  }
  return html + "<button class=\"theme\" type=\"button\" hidden>Theme</button></header>\n";
}

}  // namespace

std::string report_html(const Report& report) {
  std::vector<ContentsLine> contents;
  std::string sections, chapter;
  const std::vector<std::string> bodies = bodies_of(report.sections);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const ReportSection& section = report.sections[i];
    contents.push_back({section.chapter, section.title});
    sections += chapter_html(section.chapter, chapter) + section_html(i + 1, section.title, bodies[i]);
    chapter = section.chapter;
  }
  if (report.provenance) {
    contents.push_back({"", "Provenance"});
    sections += section_html(contents.size(), "Provenance", detail::provenance_html(*report.provenance));
  }
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"generator\" content=\"plenolab\">\n<title>" +
         escape_html(report.title) + "</title>\n<style>\n" + asset(detail::kReportCss) +
         "</style>\n</head>\n<body>\n<a class=\"skip\" href=\"#main\">Skip to the content</a>\n<div "
         "class=\"page\">\n" +
         masthead_html(report) + contents_html(contents) + "<main id=\"main\">\n" +
         cards_html(report.key_figures) + sections + "</main>\n</div>\n<script>\n" +
         asset(detail::kReportJs) + "</script>\n</body>\n</html>\n";
}

void write_report(const Report& report, const std::filesystem::path& path) {
  write_text_file(path, report_html(report));
}

std::string escape_html(const std::string& text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace plenolab
