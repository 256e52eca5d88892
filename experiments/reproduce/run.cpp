#include "experiments/reproduce/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/io/exr.h"
#include "core/io/image_file.h"
#include "experiments/cli/progress_bar.h"

namespace plenolab {
namespace fs = std::filesystem;

namespace {

std::string paragraph_of(const ReproductionResult& result) {
  std::string text;
  const auto add = [&text](const char* head, const std::string& body) {
    if (body.empty()) return;
    text += (text.empty() ? "" : "\n\n") + std::string(head) + body;
  };
  add("The paper: ", result.paper_shows);
  add("Ours: ", result.ours_shows);
  add("Where they differ and why: ", result.differs);
  return text;
}

/// Each claim with what decided it, as the ledger of the report has it.
std::string claims_text(const std::vector<LedgerEntry>& ledger) {
  std::string text;
  for (const auto& [claim, verdict] : ledger) {
    text += fmt::format("\n**{}** ({}): {} *{}*", claim.id, claim.where, claim.statement,
                        outcome_name(verdict.outcome));
    if (!verdict.quantity.empty() && verdict.interval)
      text += fmt::format(": {} {:.4g} [{:.4g}, {:.4g}] {} against {} {:.4g}, {}", verdict.quantity,
                          verdict.number, verdict.interval->low, verdict.interval->high, verdict.unit,
                          comparison_sign(verdict.comparison), verdict.threshold, verdict.uncertainty);
    text += fmt::format(". {}\n", verdict.explanation);
  }
  return text;
}

/// How to run an item alone, and how long it took here. Later items of a run find made what they share with
/// earlier ones.
std::string run_alone_text(const FinishedReproduction& finished, bool first) {
  return fmt::format("Run alone: plenolab reproduce {} ({} here{}).", finished.item->id,
                     format_duration(finished.seconds),
                     first ? "" : ", without what earlier items of this run had made that it shares");
}

ReportSection section_of(const FinishedReproduction& finished, bool first) {
  ReportSection section;
  section.title = finished.item->title;
  section.chapter = title_of(finished.item->chapter);
  if (!finished.failure.empty()) {
    section.blocks.emplace_back(Paragraph{"This item could not be run: " + finished.failure});
    return section;
  }
  if (const std::string text = paragraph_of(finished.result); !text.empty())
    section.blocks.emplace_back(Paragraph{text});
  for (const ReportBlock& block : finished.result.blocks) section.blocks.push_back(block);
  section.blocks.emplace_back(Paragraph{run_alone_text(finished, first)});
  return section;
}

/// One table of the ledger: claims whose ids begin with one of the prefixes.
struct LedgerPart {
  const char* caption;
  std::vector<std::string> prefixes;
};

const std::vector<LedgerPart>& ledger_parts() {
  static const std::vector<LedgerPart> parts{
      {"View synthesis: Altmeier, sections 3, 4 and 6.1", {"A-G", "A-A"}},
      {"Tone mapping: Altmeier, sections 2.1, 5, 6.2, 6.3 and 7", {"A-T", "A-S"}},
      {"Near-eye light-field display and its study: Hansen & Klein, with Kraus", {"H-"}},
      {"Luminance on a projector display: Doronin & Barsi", {"D-"}},
      {"Metrics, optimisation and look-up tables: Zhao", {"Z-"}},
  };
  return parts;
}

std::vector<LedgerEntry> entries_of(const LedgerPart& part, const std::vector<LedgerEntry>& ledger) {
  std::vector<LedgerEntry> entries;
  std::copy_if(ledger.begin(), ledger.end(), std::back_inserter(entries), [&](const LedgerEntry& entry) {
    return std::any_of(part.prefixes.begin(), part.prefixes.end(),
                       [&](const std::string& prefix) { return entry.claim.id.starts_with(prefix); });
  });
  return entries;
}

/// "A-T9b" as letters and number, so that A-T9 comes before A-T10.
std::tuple<std::string, int, std::string> natural_order(const std::string& id) {
  const std::size_t digits = id.find_first_of("0123456789");
  if (digits == std::string::npos) return {id, 0, ""};
  std::size_t end = 0;
  const int number = std::stoi(id.substr(digits), &end);
  return {id.substr(0, digits), number, id.substr(digits + end)};
}

void sort_by_id(std::vector<LedgerEntry>& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const LedgerEntry& a, const LedgerEntry& b) {
    return natural_order(a.claim.id) < natural_order(b.claim.id);
  });
}

ReportSection ledger_section(const std::vector<LedgerEntry>& ledger) {
  ReportSection section{"Claims ledger", {}, {}};
  section.blocks.emplace_back(Paragraph{
      "Each claim of the papers with the measurement that decides it here. A claim is confirmed or refuted "
      "only if the whole interval of the number lies on one side of the threshold."});
  for (const LedgerPart& part : ledger_parts()) {
    std::vector<LedgerEntry> entries = entries_of(part, ledger);
    sort_by_id(entries);
    if (!entries.empty()) section.blocks.emplace_back(ReportLedger{part.caption, std::move(entries)});
  }
  return section;
}

ReportSection effort_section(const Laboratory& laboratory,
                             const std::vector<FinishedReproduction>& finished) {
  ReportSection section{"What it took", {}, {}};
  const RenderingTally& tally = laboratory.tally();
  const std::string rendered = tally.rendered > 0 && tally.seconds > 0
                                   ? fmt::format("{} views rendered in {} ({:.3g} million rays a second)",
                                                 tally.rendered, format_duration(tally.seconds),
                                                 static_cast<double>(tally.rays) / tally.seconds * 1e-6)
                                   : std::string("no view path traced");
  section.blocks.emplace_back(
      Paragraph{fmt::format("Effort {}: {}, {} views from the cache.", name_of(laboratory.options().effort),
                            rendered, tally.from_cache)});
  ReportTable table{"Time of each item, with what it was the first to need: rendering, and what items share",
                    {"item", "seconds", "outcome"},
                    {},
                    3};
  for (const FinishedReproduction& f : finished)
    table.rows.push_back(
        {std::string(f.item->id), f.seconds, f.failure.empty() ? std::string("done") : f.failure});
  section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace

std::vector<FinishedReproduction> run_reproductions(
    const std::vector<const Reproduction*>& items, Laboratory& laboratory,
    const std::function<void(const Reproduction&, std::size_t)>& begin) {
  std::vector<FinishedReproduction> all;
  for (const Reproduction* item : items) {
    begin(*item, all.size());
    FinishedReproduction& finished =
        all.emplace_back(FinishedReproduction{.item = item, .result = {}, .failure = {}});
    const Stopwatch watch;
    try {
      finished.result = item->run(laboratory);
    } catch (const InputError& error) {
      finished.failure = error.what();
    }
    finished.seconds = watch.seconds();
  }
  return all;
}

void file_reproduction(const FinishedReproduction& finished, const fs::path& folder) {
  const fs::path own = folder / finished.item->id;
  const ReproductionResult& result = finished.result;
  write_text_file(own / "text.md", fmt::format("# {}\n\n{}\n{}", finished.item->title, paragraph_of(result),
                                               claims_text(result.ledger)));
  if (!result.rows.empty()) write_text_file(own / "rows.csv", to_csv(result.rows));
  for (const NamedPlot& plot : result.plots) write_plot(plot.plot.plot, own / plot.name);
  for (const NamedImage& image : result.images) {
    write_display_image(own / (image.name + ".png"), image.display);
    if (!image.radiance.empty())
      write_exr(own / (image.name + ".exr"), image.radiance, {}, {.colour_type = ExrPixelType::kFloat});
  }
}

Report assemble_report(const std::vector<FinishedReproduction>& finished, const Laboratory& laboratory,
                       const Provenance& provenance) {
  Report report;
  report.title = "HDR light fields: synthesis, tone mapping and a near-eye display";
  report.subtitle =
      "Views synthesised from sparse key views against ground truth, and the consistency of tone mapping "
      "within them and over time, after Altmeier 2018; a near-eye light-field display, its study and its "
      "calibration, after Hansen & Klein 2016; luminance on a projector display, after Doronin & Barsi; "
      "tone mapping tuned by metrics and look-up tables, after Zhao 2019. "
      "Measured on "
      "procedural scenes.";
  std::vector<LedgerEntry> ledger;
  for (const FinishedReproduction& f : finished) {
    for (const KeyFigure& figure : f.result.key_figures) report.key_figures.push_back(figure);
    for (const LedgerEntry& entry : f.result.ledger) ledger.push_back(entry);
  }
  if (!ledger.empty()) report.sections.push_back(ledger_section(ledger));
  for (const FinishedReproduction& f : finished)
    report.sections.push_back(section_of(f, &f == &finished.front()));
  report.sections.push_back(effort_section(laboratory, finished));
  report.provenance = provenance;
  return report;
}

}  // namespace plenolab
