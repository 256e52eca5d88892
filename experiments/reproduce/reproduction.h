#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/claims.h"
#include "analysis/report/report.h"
#include "experiments/reproduce/laboratory.h"

namespace plenolab {

/// A figure to draw and to file under its name.
struct NamedPlot {
  std::string name;  ///< of the files, e.g. "error-over-step"
  ReportPlot plot;
};

/// An image to file under its name.
struct NamedImage {
  std::string name;
  DisplayImage display;  ///< filed as .png
  SceneImage radiance;   ///< filed as .exr unless empty
};

/// Everything one reproduction yields. The three sentences say it in words; blocks hold what the report shows
/// of it, in order, plots included by add_plot and images by add_comparison.
struct ReproductionResult {
  std::string paper_shows, ours_shows, differs;
  std::vector<ReportBlock> blocks;
  ResultTable rows;
  std::vector<NamedPlot> plots;
  std::vector<NamedImage> images;
  std::vector<LedgerEntry> ledger;
  std::vector<KeyFigure> key_figures;  ///< for the summary on top of the report

  /// Shows a plot in the report and files it (.svg .pdf .gp .csv).
  void add_plot(const std::string& name, ReportPlot plot);
  /// Shows images for comparison in the report and files each (.png; .exr where radiance is given, in the
  /// same order).
  void add_comparison(const std::string& name, ImageComparison comparison,
                      std::vector<SceneImage> radiance = {});
  void add_table(ReportTable table) { blocks.emplace_back(std::move(table)); }
};

/// Which chapter of the report an item belongs to.
enum class Chapter {
  kScenes,
  kGeometry,
  kAppearance,
  kQuality,
  kOperators,
  kConsistency,
  kDisplay,       ///< near-eye light-field display: optics and reprojection
  kStudy,         ///< participants: sessions and their analysis
  kCalibration,   ///< fits of the display's lengths and angles
  kLuminance,     ///< luminance that observers of a projector display adapt to
  kOptimisation,  ///< tone mapping whose parameters a metric chooses
  kLuts,          ///< look-up tables blended by what a camera sees
  kSpeed,
  kClaims,
};

const char* title_of(Chapter chapter);

/// One figure, table or claim that can be run alone by its id.
struct Reproduction {
  const char* id;     ///< on the command line, e.g. "altmeier-fig-31"
  const char* title;  ///< of its section in the report
  Chapter chapter;
  ReproductionResult (*run)(Laboratory& laboratory);
};

/// All items in the order of the report. Adding one = one file in this folder + one line in table.cpp.
std::span<const Reproduction> reproductions();

/// The items named; each name is an id, or "all". Order of the table. Throws UsageError listing the ids for
/// an unknown one.
std::vector<const Reproduction*> select_reproductions(const std::vector<std::string>& ids);

}  // namespace plenolab
