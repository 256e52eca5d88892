#include "experiments/reproduce/tonemap/mapping_bench.h"

#include <algorithm>

#include <array>
#include "core/base/error.h"

#include "experiments/reproduce/figure_places.h"

namespace plenolab {

namespace {

/// Mapped light fields held at a time: what neighbouring items share, and more of them as long as they are
/// small (adjusted key views are costly and many items show them).
constexpr std::size_t kKeptKeyViews = 6, kKeptBytes = std::size_t{1} << 29;

std::size_t bytes_of(const ViewGrid& grid) {
  const auto count = [](int n) { return static_cast<std::size_t>(n); };
  return count(grid.columns) * count(grid.rows) * count(grid.width) * count(grid.height) *
         (sizeof(Rgb) + sizeof(float));
}

constexpr int kFramesPerColumn = 10, kFramesPerRow = 20;

}  // namespace

Motion motion_over(const std::string& scene, const ViewGrid& grid, int line) {
  PLENOLAB_CHECK(line >= 0 && line < kMotionLines, std::to_string(line));
  const double last_column = grid.columns - 1, last_row = grid.rows - 1;
  const double share = (line + 1.0) / (kMotionLines + 1);
  if (scene == "dunes")
    return {.from = {share * last_column, 0},
            .to = {share * last_column, last_row},
            .frames = kFramesPerRow * (grid.rows - 1) + 1};
  return {.from = {0, share * last_row},
          .to = {last_column, share * last_row},
          .frames = kFramesPerColumn * (grid.columns - 1) + 1};
}

MappingBench::MappingBench(Laboratory& laboratory) : laboratory_(laboratory) {}

int MappingBench::threads() const {
  return laboratory_.options().threads;
}

const LightFieldStatistics& MappingBench::statistics(const std::string& scene) {
  std::optional<LightFieldStatistics>& statistics = scenes_[scene].statistics;
  if (!statistics) statistics = measure_light_field(laboratory_.light_field(scene), threads());
  return *statistics;
}

std::shared_ptr<const MappedKeyViews> MappingBench::key_views(const std::string& scene,
                                                              const Mapping& mapping) {
  // The weights at image borders do not belong to the key views.
  Mapping of_views = mapping;
  of_views.border_weight = BorderWeight::kPrinted;
  const std::string key = scene + ": " + of_views.key();
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&](const KeptKeyViews& k) { return k.key == key; });
  if (found != kept_.end()) {
    std::rotate(found, found + 1, kept_.end());
    return kept_.back().views;
  }
  std::size_t bytes = bytes_of(laboratory_.grid(scene));
  for (const KeptKeyViews& k : kept_) bytes += bytes_of(k.views->field.grid());
  while (kept_.size() >= kKeptKeyViews && bytes > kKeptBytes) {
    bytes -= bytes_of(kept_.front().views->field.grid());
    kept_.erase(kept_.begin());
  }
  kept_.push_back({key, std::make_shared<const MappedKeyViews>(map_key_views(
                            laboratory_.light_field(scene), statistics(scene), mapping, threads()))});
  return kept_.back().views;
}

const std::vector<ReferenceFrame>& MappingBench::views_in_cells(const std::string& scene) {
  static constexpr std::array<CameraPosition, kViewsInCell> kOffsets{{{0.5, 0.5}, {0.25, 0.6}}};
  return fill_views(scene, kOffsets, scenes_[scene].views_in_cells);
}

const std::vector<ReferenceFrame>& MappingBench::views_near_key_views(const std::string& scene) {
  static constexpr std::array<CameraPosition, kViewsOfBorders> kOffsets{
      {{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}}};
  return fill_views(scene, kOffsets, scenes_[scene].views_near_key_views);
}

const std::vector<ReferenceFrame>& MappingBench::fill_views(const std::string& scene,
                                                            std::span<const CameraPosition> offsets,
                                                            std::vector<ReferenceFrame>& views) {
  SynthesisOptions options;
  options.threads = threads();
  if (views.empty())
    for (const CameraPosition& position : cell_positions(laboratory_.grid(scene), offsets))
      views.push_back(reference_frame(laboratory_.synthesizer(scene), position, options));
  return views;
}

const RecordedMotion& MappingBench::recording(const std::string& scene, int line) {
  std::optional<RecordedMotion>& recording = scenes_[scene].recordings.at(static_cast<std::size_t>(line));
  if (!recording)
    recording = record_motion(laboratory_.synthesizer(scene),
                              motion_over(scene, laboratory_.grid(scene), line), threads());
  return *recording;
}

const MappedMotion& MappingBench::motion(const std::string& scene, const Mapping& mapping, int line) {
  auto& motions = scenes_[scene].motions;
  const std::pair key{line, mapping.key()};
  const auto found = motions.find(key);
  if (found != motions.end()) return found->second;
  return motions.emplace(key, show(scene, recording(scene, line), mapping)).first->second;
}

void MappingBench::for_each_frame(
    const std::string& scene, const Mapping& mapping, std::span<const ReferenceFrame> frames,
    const std::function<void(std::size_t index, FrameMapping&& frame)>& receive) {
  std::shared_ptr<const MappedKeyViews> mapped;
  if (mapping.place() == MappingPlace::kKeyViews) mapped = key_views(scene, mapping);
  for_each_mapped_frame(laboratory_.light_field(scene), statistics(scene), frames, Motion{}.frames_per_second,
                        mapping, mapped.get(), threads(), receive);
}

std::vector<DisplayImage> MappingBench::frames(const std::string& scene, const Mapping& mapping,
                                               std::span<const ReferenceFrame> frames) {
  std::vector<DisplayImage> images;
  for_each_frame(scene, mapping, frames,
                 [&](std::size_t, FrameMapping&& frame) { images.push_back(std::move(frame.image)); });
  return images;
}

MappedMotion MappingBench::show(const std::string& scene, const RecordedMotion& recording,
                                const Mapping& mapping) {
  std::shared_ptr<const MappedKeyViews> mapped;
  if (mapping.place() == MappingPlace::kKeyViews) mapped = key_views(scene, mapping);
  return map_motion(laboratory_.light_field(scene), statistics(scene), recording, mapping, mapped.get(),
                    {{"scene", scene}, {"mapping", mapping.label}}, threads());
}

}  // namespace plenolab
