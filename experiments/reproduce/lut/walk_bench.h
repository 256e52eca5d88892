#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/lut/grade.h"
#include "experiments/reproduce/laboratory.h"
#include "experiments/walk.h"

namespace plenolab {

/// How the table of a frame is found.
enum class BlendMethod { kLinear, kPixel };
/// What blends are judged against: the whole frame graded by the table of the volume ahead (that most pixels
/// of the middle ninth of the picture show) or of the volume that most pixels of the whole picture show; and
/// mixed images, by object and by pixel.
enum class GradeReference { kAhead, kMost, kByObject, kByPixel };
inline constexpr std::size_t kBlendMethods = 2, kGradeReferences = 4;
const char* name_of(BlendMethod method);        ///< "linear", "pixel-based"
const char* name_of(GradeReference reference);  ///< "volume ahead", "volume of most pixels", …

/// What the items on look-up tables in a scene share during one run: the walk, rendered, its looks, and the
/// errors of both blends, each computed when first asked for and kept.
///
/// A quick run has 41 frames of 384 × 216 pixels, a tiny one 14 of 96 × 54, a paper run 81 of 960 × 540.
class WalkBench {
 public:
  explicit WalkBench(LaboratoryOptions options);

  const WalkStage& stage() const { return stage_; }
  const std::vector<WalkFrame>& frames();
  /// By volume, the background's last. Each is made from the frame that shows most of its place.
  const std::vector<WalkLook>& looks();
  const std::vector<Lut>& tables();  ///< of the volumes
  const Lut& background();
  /// All tables ready for grading, the background's last.
  const std::vector<PreparedLut>& prepared();
  /// Name of a volume, −1: the background.
  std::string place(int volume) const;

  /// One frame.
  struct Score {
    int ahead = -1, most = -1;
    VolumeWeights linear, pixel;
    /// Mean ΔE*ab by method and reference.
    std::array<std::array<double, kGradeReferences>, kBlendMethods> error{};
    double of(BlendMethod method, GradeReference reference) const {
      return error[static_cast<std::size_t>(method)][static_cast<std::size_t>(reference)];
    }
  };
  const std::vector<Score>& scores();
  /// Error of a method against a reference, frame by frame.
  std::vector<double> errors(BlendMethod method, GradeReference reference);

  /// A frame as each method and reference shows it.
  DisplayImage graded(std::size_t frame, BlendMethod method);
  DisplayImage reference(std::size_t frame, GradeReference reference);
  /// A picture of which each pixel takes the table of its volume, −1: the background's.
  DisplayImage grade_mixed_image(const WalkFrame& frame, const Plane<int>& volume);
  /// A frame graded by one table all over, −1: the background's.
  DisplayImage graded_by(std::size_t frame, int volume);

  const LaboratoryOptions& options() const { return options_; }

 private:
  Score score(std::size_t frame);

  LaboratoryOptions options_;
  WalkStage stage_;
  std::vector<WalkFrame> frames_;
  std::vector<VolumeCounts> counts_;
  std::vector<WalkLook> looks_;
  std::vector<Lut> tables_;
  std::vector<PreparedLut> prepared_;
  std::vector<Score> scores_;
};

}  // namespace plenolab
