#include <CLI/CLI.hpp>

#include "experiments/lut/lut.h"

namespace plenolab {

void add_lut_command(CLI::App& app, const Invocation& invocation);

void add_lut_command(CLI::App& app, const Invocation& invocation) {
  app.require_subcommand(1);
  const auto add = [&](const char* name, const char* summary, void (*declare)(CLI::App&, const Invocation&)) {
    declare(*app.add_subcommand(name, summary), invocation);
  };
  add("info", "Size, range and strength of tables", add_lut_info);
  add("convert", "Between .cube files, image strips and numbers of nodes; the identity", add_lut_convert);
  add("apply", "Grade a picture", add_lut_apply);
  add("blend", "Weighted sum of tables", add_lut_blend);
  add("transfer", "Table that gives a picture the colours of another", add_lut_transfer);
  add("frame", "Table of a frame from post-processing volumes and what the camera sees", add_lut_frame);
  add("walk", "A scene with three volumes to try this on: frames, depth, tables and volumes", add_lut_walk);
  app.footer(
      "Example: plenolab lut apply warm.cube frame.png -o graded.png\n"
      "'plenolab lut WHAT --help' explains each of them and gives an example.");
}

}  // namespace plenolab
