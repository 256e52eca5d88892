#pragma once

#include <string>
#include <vector>

#include "core/lut/lut.h"
#include "experiments/cli/output.h"
#include "experiments/commands.h"

namespace CLI {
class App;
}

namespace plenolab {

/// The subcommands of `plenolab lut`, one file each, and what they share.

void add_lut_info(CLI::App& app, const Invocation& invocation);
void add_lut_convert(CLI::App& app, const Invocation& invocation);
void add_lut_apply(CLI::App& app, const Invocation& invocation);
void add_lut_blend(CLI::App& app, const Invocation& invocation);
void add_lut_transfer(CLI::App& app, const Invocation& invocation);
void add_lut_frame(CLI::App& app, const Invocation& invocation);
void add_lut_walk(CLI::App& app, const Invocation& invocation);

/// Declares --interpolation.
void add_interpolation_option(CLI::App& app, std::string& interpolation);
LutInterpolation interpolation_of(const std::string& word);

/// Reads a table and lists it among the inputs. "identity" is the identity with 32 nodes along an axis.
Lut read_lut_input(const std::string& path, Provenance& provenance);

/// Declares -o for a table.
void add_lut_output(CLI::App& app, std::string& out);
/// Throws UsageError if writing would replace an input, and InputError if a file of this kind cannot hold the
/// table: before anything is written.
void require_lut_output(const std::string& out, const Lut& lut, const Provenance& provenance);
/// Writes a table with its run.json and says so. Throws UsageError if it would replace an input.
void write_lut_output(const std::string& out, const Lut& lut, Provenance& provenance,
                      const CommonOptions& common);

/// Rows lut_size, lut_minimum and lut_maximum of the outputs, and how far they are from the inputs:
/// lut_mean_change, lut_largest_change (encoded values).
void add_lut_rows(ResultTable& table, const Lut& lut, const std::string& name);

/// Of a .cube file with curves (LUT_1D_SIZE), which become a lattice: how many nodes the curves have
/// (lut_curve_nodes) and how far `lut` is from them at most, at their nodes and between
/// (lut_largest_curve_error); nothing for other tables. Reads the file again.
void add_curve_rows(ResultTable& table, const Lut& lut, const std::string& path);

}  // namespace plenolab
