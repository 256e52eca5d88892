#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/provenance.h"
#include "experiments/reproduce/reproduction.h"

namespace plenolab {

/// An item that was run, or why it failed.
struct FinishedReproduction {
  const Reproduction* item = nullptr;
  ReproductionResult result;
  double seconds = 0;
  std::string failure;  ///< empty = it ran
};

/// Runs the items in order. One that fails with bad input does not stop the others; its failure is kept.
/// `begin` is called with each item before it runs.
std::vector<FinishedReproduction> run_reproductions(
    const std::vector<const Reproduction*>& items, Laboratory& laboratory,
    const std::function<void(const Reproduction&, std::size_t)>& begin);

/// Files one item below `folder`/ID: plots (.svg .pdf .gp .csv), images (.png .exr), rows.csv and text.md.
void file_reproduction(const FinishedReproduction& finished, const std::filesystem::path& folder);

/// Everything in one page.
Report assemble_report(const std::vector<FinishedReproduction>& finished, const Laboratory& laboratory,
                       const Provenance& provenance);

}  // namespace plenolab
