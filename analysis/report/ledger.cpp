#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/report/blocks.h"

namespace plenolab::detail {
namespace {

constexpr std::array<Outcome, 3> kOutcomes{Outcome::kConfirmed, Outcome::kRefuted, Outcome::kUndecided};

/// Signs beside the colours, for readers who do not see these.
const char* outcome_sign(Outcome outcome) {
  switch (outcome) {
    case Outcome::kConfirmed:
      return "✓";
    case Outcome::kRefuted:
      return "✕";
    case Outcome::kUndecided:
      break;
  }
  return "?";
}

std::string badge(Outcome outcome, const std::string& text) {
  return fmt::format("<span class=\"badge {}\">{} {}</span>", outcome_name(outcome), outcome_sign(outcome),
                     text);
}

std::string with_unit(double value, const std::string& unit) {
  if (unit.empty() || unit == "1") return format_number(value);
  return fmt::format("{} {}", format_number(value), escape_html(unit));
}

/// A small drawing of interval, estimate and threshold on a common line.
std::string interval_drawing(const Interval& interval, double threshold, const std::string& unit) {
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high) || !std::isfinite(threshold)) return "";
  constexpr double kWidth = 220, kMargin = 14;
  const double low = std::min(interval.low, threshold), high = std::max(interval.high, threshold);
  const double scale = high > low ? (kWidth - 2 * kMargin) / (high - low) : 0;
  const auto x = [&](double v) { return scale > 0 ? kMargin + (v - low) * scale : kWidth / 2; };
  return fmt::format(
      "<svg width=\"220\" height=\"22\" viewBox=\"0 0 220 22\" role=\"img\" aria-label=\"Interval {} to {}, "
      "threshold {}\">"
      "<line x1=\"0\" x2=\"220\" y1=\"11\" y2=\"11\" stroke=\"currentColor\" stroke-opacity=\".18\"/>"
      "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"11\" y2=\"11\" stroke=\"currentColor\" stroke-width=\"3\" "
      "stroke-linecap=\"round\" stroke-opacity=\".55\"/><circle cx=\"{:.1f}\" cy=\"11\" r=\"4.5\" "
      "fill=\"currentColor\"/>"
      "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"2\" y2=\"20\" stroke=\"currentColor\" stroke-width=\"1.5\" "
      "stroke-dasharray=\"3 2\"/></svg>",
      with_unit(interval.low, unit), with_unit(interval.high, unit), with_unit(threshold, unit),
      x(interval.low), x(interval.high), x(interval.estimate), x(threshold), x(threshold));
}

std::string measure_html(const Verdict& verdict) {
  if (verdict.quantity.empty()) return "<div class=\"measure\"><small>no measurement</small></div>";
  std::string html = fmt::format(
      "<div class=\"measure\"><strong>{}</strong> (claimed {} {})", with_unit(verdict.number, verdict.unit),
      escape_html(comparison_sign(verdict.comparison)), with_unit(verdict.threshold, verdict.unit));
  if (verdict.interval) {
    html += interval_drawing(*verdict.interval, verdict.threshold, verdict.unit);
    html += fmt::format("<small>{} … {}{}</small>", format_number(verdict.interval->low),
                        with_unit(verdict.interval->high, verdict.unit),
                        verdict.uncertainty.empty() ? "" : ", " + escape_html(verdict.uncertainty));
  } else if (!verdict.uncertainty.empty()) {
    html += "<small>" + escape_html(verdict.uncertainty) + "</small>";
  }
  return html + "<small>" + escape_html(verdict.quantity) + "</small></div>";
}

std::string entry_html(const LedgerEntry& entry) {
  std::string scenes;
  for (const std::string& scene : entry.verdict.scenes)
    scenes += (scenes.empty() ? " Measured on " : ", ") + scene;
  if (!scenes.empty()) scenes += ".";
  return fmt::format(
      "<article class=\"claim\" id=\"claim-{}\"><div>{}</div><div><h3>{}</h3><p class=\"where\">{} · {}</p>"
      "<p class=\"why\">{}</p></div>{}</article>\n",
      escape_html(entry.claim.id), badge(entry.verdict.outcome, outcome_name(entry.verdict.outcome)),
      escape_html(entry.claim.statement), escape_html(entry.claim.id), escape_html(entry.claim.where),
      escape_html(entry.verdict.explanation + scenes), measure_html(entry.verdict));
}

}  // namespace

std::string block_html(const ReportLedger& ledger) {
  std::string html = "<div class=\"ledger\">\n";
  if (!ledger.caption.empty()) html += "<p class=\"caption\">" + escape_html(ledger.caption) + "</p>\n";
  html += "<ul class=\"tally\">";
  for (const Outcome outcome : kOutcomes) {
    const auto count = std::count_if(ledger.entries.begin(), ledger.entries.end(),
                                     [&](const LedgerEntry& e) { return e.verdict.outcome == outcome; });
    html += "<li>" + badge(outcome, fmt::format("{} {}", count, outcome_name(outcome))) + "</li>";
  }
  html += "</ul>\n";
  for (const LedgerEntry& entry : ledger.entries) html += entry_html(entry);
  return html + "</div>\n";
}

}  // namespace plenolab::detail
