#pragma once

#include <string>

#include "core/io/image_file.h"
#include "core/lut/cube_file.h"
#include "core/lut/grade.h"
#include "experiments/cli/output.h"

namespace CLI {
class App;
}

namespace plenolab {

/// What `lut apply` and `lut frame` have in common: a picture to grade, and how.

struct GradingOptions {
  std::string interpolation = "tetrahedral", bits = "as the picture";
};

/// Declares --interpolation and --bits.
void add_grading_options(CLI::App& app, GradingOptions& options);

/// A picture with what its file says besides.
struct PictureFile {
  DisplayImage image;
  PngDepth depth = PngDepth::k8Bit;
  bool has_alpha = false;  ///< which is not read
};

/// Reads a .png and lists it among the inputs. Throws InputError for radiance, which tables do not grade.
PictureFile read_picture(const std::string& path, Provenance& provenance);

/// A graded picture, not yet written.
struct GradedPicture {
  GradedImage graded;
  PngDepth depth = PngDepth::k8Bit;
  double seconds = 0;
};
GradedPicture grade_picture(const PictureFile& picture, const PreparedLut& lut, const GradingOptions& options,
                            int threads);

/// By curves and what stands behind them, exactly.
GradedPicture grade_picture(const PictureFile& picture, const CubeContent& content,
                            const GradingOptions& options, int threads);

/// Rows values_cut and seconds_grade, and a note on transparency that is lost.
void add_grading_rows(ResultTable& table, const PictureFile& picture, const GradedPicture& graded,
                      const decltype(ResultRow::columns)& columns);

}  // namespace plenolab
