#include "experiments/reproduce/lut/walk_bench.h"

#include <algorithm>
#include <utility>

#include "core/lut/grade.h"
#include "core/lut/mixed_image.h"
#include "experiments/colour_error.h"

namespace plenolab {

namespace {

struct WalkSize {
  int width, height;
  double density;
};

WalkSize size_for(Effort effort) {
  switch (effort) {
    case Effort::kTiny:
      return {96, 54, 0.34};
    case Effort::kPaper:
      return {960, 540, 2};
    default:
      return {384, 216, 1};
  }
}

/// The place that most of the pixels show, −1: the background.
int most_of(const VolumeCounts& counts) {
  const auto most = std::ranges::max_element(counts.volumes);
  return *most > counts.background ? static_cast<int>(most - counts.volumes.begin()) : -1;
}

/// Counts of the middle ninth of the picture.
VolumeCounts count_middle(const Plane<int>& volume, std::size_t volumes) {
  VolumeCounts counts{std::vector<std::int64_t>(volumes), 0};
  for (int y = volume.height() / 3; y < volume.height() - volume.height() / 3; ++y)
    for (int x = volume.width() / 3; x < volume.width() - volume.width() / 3; ++x) {
      const int v = volume.at(x, y);
      ++(v < 0 ? counts.background : counts.volumes[static_cast<std::size_t>(v)]);
    }
  return counts;
}

}  // namespace

const char* name_of(BlendMethod method) {
  return method == BlendMethod::kLinear ? "linear" : "pixel-based";
}

const char* name_of(GradeReference reference) {
  switch (reference) {
    case GradeReference::kAhead:
      return "volume ahead";
    case GradeReference::kMost:
      return "volume of most pixels";
    case GradeReference::kByObject:
      return "mixed by object";
    case GradeReference::kByPixel:
      return "mixed by pixel";
  }
  return "";
}

WalkBench::WalkBench(LaboratoryOptions options) : options_(std::move(options)) {}

const std::vector<WalkFrame>& WalkBench::frames() {
  if (!frames_.empty()) return frames_;
  const WalkSize size = size_for(options_.effort);
  for (const WalkPose& pose : walk_path(size.density)) {
    frames_.push_back(stage_.frame(pose, size.width, size.height, options_.threads));
    counts_.push_back(
        count_pixels(frames_.back().depth_m, pose.camera, stage_.volumes(), {1, options_.threads}));
  }
  return frames_;
}

const std::vector<WalkLook>& WalkBench::looks() {
  frames();
  if (looks_.empty())
    looks_ = make_walk_looks(
        counts_, [&](std::size_t i) { return frames_[i].picture; }, options_.seed);
  return looks_;
}

const std::vector<Lut>& WalkBench::tables() {
  if (tables_.empty())
    for (std::size_t v = 0; v < stage_.volumes().size(); ++v) tables_.push_back(looks()[v].transfer.lut);
  return tables_;
}

const std::vector<PreparedLut>& WalkBench::prepared() {
  if (prepared_.empty())
    for (const WalkLook& look : looks()) prepared_.emplace_back(look.transfer.lut);
  return prepared_;
}

const Lut& WalkBench::background() {
  return looks().back().transfer.lut;
}

std::string WalkBench::place(int volume) const {
  return volume < 0 ? "background" : stage_.volumes()[static_cast<std::size_t>(volume)].name;
}

DisplayImage WalkBench::grade_mixed_image(const WalkFrame& frame, const Plane<int>& volume) {
  return grade_mixed(frame.picture, volume, std::span(prepared()).first(tables().size()), prepared().back(),
                     options_.threads);
}

DisplayImage WalkBench::graded_by(std::size_t frame, int volume) {
  const PreparedLut& lut = volume < 0 ? prepared().back() : prepared()[static_cast<std::size_t>(volume)];
  return lut.grade(frames()[frame].picture, {.threads = options_.threads}).image;
}

DisplayImage WalkBench::graded(std::size_t frame, BlendMethod method) {
  const Score& score = scores()[frame];
  const PreparedLut blend(
      blend_volumes(method == BlendMethod::kLinear ? score.linear : score.pixel, tables(), background()));
  return blend.grade(frames_[frame].picture, {.threads = options_.threads}).image;
}

DisplayImage WalkBench::reference(std::size_t frame, GradeReference reference) {
  const WalkFrame& f = frames()[frame];
  if (reference == GradeReference::kAhead) return graded_by(frame, scores()[frame].ahead);
  if (reference == GradeReference::kMost) return graded_by(frame, scores()[frame].most);
  Plane<int> volume = volume_of_pixels(f.depth_m, f.pose.camera, stage_.volumes(), options_.threads);
  if (reference == GradeReference::kByObject)
    volume = volume_of_objects(volume, f.object, static_cast<int>(stage_.volumes().size()));
  return grade_mixed_image(f, volume);
}

WalkBench::Score WalkBench::score(std::size_t frame) {
  const WalkFrame& f = frames()[frame];
  const std::vector<Volume>& volumes = stage_.volumes();
  const Plane<int> volume = volume_of_pixels(f.depth_m, f.pose.camera, volumes, options_.threads);
  Score score;
  score.ahead = most_of(count_middle(volume, volumes.size()));
  score.most = most_of(counts_[frame]);
  score.linear = linear_weights(volumes, f.pose.camera.position_m);
  score.pixel = pixel_weights(counts_[frame], volumes);
  return score;
}

const std::vector<WalkBench::Score>& WalkBench::scores() {
  if (!scores_.empty()) return scores_;
  for (std::size_t i = 0; i < frames().size(); ++i) scores_.push_back(score(i));
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    std::array<Plane<CieLab>, kBlendMethods> blends;
    for (std::size_t m = 0; m < kBlendMethods; ++m)
      blends[m] = lab_of(graded(i, static_cast<BlendMethod>(m)), options_.threads);
    for (std::size_t r = 0; r < kGradeReferences; ++r) {
      const Plane<CieLab> wanted = lab_of(reference(i, static_cast<GradeReference>(r)), options_.threads);
      for (std::size_t m = 0; m < kBlendMethods; ++m)
        scores_[i].error[m][r] = colour_error(blends[m], wanted).mean;
    }
  }
  return scores_;
}

std::vector<double> WalkBench::errors(BlendMethod method, GradeReference reference) {
  std::vector<double> errors;
  for (const Score& score : scores()) errors.push_back(score.of(method, reference));
  return errors;
}

}  // namespace plenolab
