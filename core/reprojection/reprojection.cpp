#include "core/reprojection/reprojection.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/reprojection/holes.h"
#include "core/reprojection/search.h"

namespace plenolab {

using reprojection::kNoDepth;
using reprojection::Search;
using reprojection::SearchTask;
using reprojection::Source;

namespace {

using Position = std::array<int, 2>;  // column, row

bool is_finite(Rgb c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

void require_fitting(const CameraArray& array, std::span<const RenderedCamera> cameras) {
  array.validate();
  const int n = array.layout.size_px;
  if (cameras.size() > reprojection::kMaxSources)
    throw InputError(
        fmt::format("at most {} cameras can be rendered, not {}", reprojection::kMaxSources, cameras.size()));
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const RenderedCamera& c = cameras[i];
    if (c.column < 0 || c.row < 0 || c.column >= array.layout.columns || c.row >= array.layout.rows)
      throw InputError(fmt::format("the camera at column {}, row {} is outside the array", c.column, c.row));
    if (c.colour.width() != n || c.colour.height() != n || c.depth_m.width() != n || c.depth_m.height() != n)
      throw InputError(
          fmt::format("the camera at column {}, row {} has not {} × {} px", c.column, c.row, n, n));
    for (std::size_t j = 0; j < i; ++j)
      if (cameras[j].column == c.column && cameras[j].row == c.row)
        throw InputError(fmt::format("the camera at column {}, row {} is given twice", c.column, c.row));
  }
  for (const auto& [column, row] : corner_positions(array.layout))
    if (std::none_of(cameras.begin(), cameras.end(), [c = column, r = row](const RenderedCamera& camera) {
          return camera.column == c && camera.row == r;
        }))
      throw InputError(fmt::format("the corner camera at column {}, row {} is missing", column, row));
}

/// The light field while it is put together.
class Assembly {
 public:
  Assembly(const CameraArray& array, std::span<const RenderedCamera> cameras,
           const ReprojectionOptions& options, Search search, DisplayImage buffer)
      : array_(array), options_(options), search_(search), n_(array.layout.size_px) {
    const int width = array.layout.width(), height = array.layout.height();
    if (buffer.width() != width || buffer.height() != height) buffer = DisplayImage(width, height);
    result_.light_field = std::move(buffer);
    disparity_.resize(static_cast<std::size_t>(array.layout.columns) *
                      static_cast<std::size_t>(array.layout.rows));
    if (options.record_maps) {
      result_.disparity_px = Plane<float>(width, height, kNoDepth);
      result_.offset_px = Plane<float>(width, height);
    }
    for (const RenderedCamera& camera : cameras) place(camera);
    for (const Position& p : corner_positions(array.layout)) corners_.push_back(colours_at(p));
  }

  void run() {
    if (options_.method == ReprojectionMethod::kTwoStep) {
      const int last = array_.layout.rows - 1;
      fill_rows(0, last + 1, std::max(last, 1));
      fill_between(0, last);
    } else {
      fill_rows(0, array_.layout.rows, 1);
    }
  }

  ReprojectionResult take() {
    result_.holes = holes_;
    return std::move(result_);
  }

 private:
  struct Job {
    Position at;
    std::vector<Source> sources;
  };

  std::size_t index_of(Position p) const {
    return static_cast<std::size_t>(p[1]) * static_cast<std::size_t>(array_.layout.columns) +
           static_cast<std::size_t>(p[0]);
  }
  const Rgb* colours_at(Position p) const { return result_.light_field.row(p[1] * n_) + p[0] * n_; }
  Rgb* colours_at(Position p) { return result_.light_field.row(p[1] * n_) + p[0] * n_; }
  /// Makes room for disparities that later subimages are reprojected with.
  float* keep_disparity(Position p) {
    std::vector<float>& kept = disparity_[index_of(p)];
    kept.assign(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_), kNoDepth);
    return kept.data();
  }

  void place(const RenderedCamera& camera);
  bool is_rendered(Position p) const {
    return std::find(rendered_.begin(), rendered_.end(), p) != rendered_.end();
  }
  bool is_corner(Position p) const {
    const auto corners = corner_positions(array_.layout);
    return std::find(corners.begin(), corners.end(), p) != corners.end();
  }
  Source source_at(Position p) const {
    return {colours_at(p), disparity_[index_of(p)].data(), result_.light_field.width(), n_, p[0], p[1]};
  }
  void add_central(Job& job) const {
    for (const Position& p : rendered_)
      if (!is_corner(p)) job.sources.push_back(source_at(p));
  }

  /// Every `step`-th row: in one step from all cameras; in two steps from the corners of that row.
  void fill_rows(int first, int end, int step);
  /// Columns between two rows that are complete.
  void fill_between(int top, int bottom);
  void fill(const std::vector<Job>& jobs);
  void fill_one(const Job& job, std::span<std::uint64_t> keys, float* disparity);
  std::int64_t take_colours(const Job& job, std::span<const std::uint64_t> keys, float* disparity);
  void record(const Job& job, std::span<const std::uint64_t> keys);

  const CameraArray& array_;
  const ReprojectionOptions& options_;
  Search search_;
  int n_;
  float max_disparity_px_ = 0;
  ReprojectionResult result_;
  std::vector<std::vector<float>> disparity_;  // by subimage, row by row; empty for those that are no source
  std::vector<Position> rendered_;
  std::vector<const Rgb*> corners_;
  std::atomic<std::int64_t> holes_ = 0;
};

void Assembly::place(const RenderedCamera& camera) {
  rendered_.push_back({camera.column, camera.row});
  // Nearer pixels land outside all other subimages, wherever exactly.
  const float most = static_cast<float>(n_) + 1;
  const double at_one_metre_px = array_.disparity_px(1);
  float* disparity = keep_disparity({camera.column, camera.row});
  for (int y = 0; y < n_; ++y, disparity += n_) {
    Rgb* colour = colours_at({camera.column, camera.row}) +
                  static_cast<std::ptrdiff_t>(y) * result_.light_field.width();
    for (int x = 0; x < n_; ++x) {
      const bool coloured = is_finite(camera.colour.at(x, y));
      colour[x] = coloured ? camera.colour.at(x, y) : Rgb{};
      const float depth = camera.depth_m.at(x, y);
      if (!coloured || !(depth > 0)) {
        ++result_.ignored_pixels;
        continue;
      }
      disparity[x] = std::min(static_cast<float>(at_one_metre_px / static_cast<double>(depth)), most);
      max_disparity_px_ = std::max(max_disparity_px_, disparity[x]);
    }
    if (options_.record_maps)
      std::copy(disparity, disparity + n_,
                result_.disparity_px.row(camera.row * n_ + y) + camera.column * n_);
  }
}

void Assembly::fill_rows(int first, int end, int step) {
  std::vector<Job> jobs;
  for (int row = first; row < end; row += step)
    for (int column = 0; column < array_.layout.columns; ++column) {
      if (is_rendered({column, row})) continue;
      if (options_.method == ReprojectionMethod::kTwoStep) keep_disparity({column, row});
      Job job{{column, row}, {}};
      for (const Position& corner : corner_positions(array_.layout))
        if (options_.method == ReprojectionMethod::kOneStep || corner[1] == row)
          job.sources.push_back(source_at(corner));
      add_central(job);
      jobs.push_back(std::move(job));
    }
  fill(jobs);
}

void Assembly::fill_between(int top, int bottom) {
  std::vector<Job> jobs;
  for (int column = 0; column < array_.layout.columns; ++column)
    for (int row = top + 1; row < bottom; ++row) {
      if (is_rendered({column, row})) continue;
      Job job{{column, row}, {source_at({column, top}), source_at({column, bottom})}};
      add_central(job);
      jobs.push_back(std::move(job));
    }
  fill(jobs);
}

void Assembly::fill(const std::vector<Job>& jobs) {
  const std::size_t pixels = static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_);
  parallel_for(static_cast<int>(jobs.size()), 1, options_.threads, [&](int begin, int end) {
    std::vector<std::uint64_t> keys(pixels);
    std::vector<float> scratch(pixels);
    for (int i = begin; i < end; ++i) {
      const Job& job = jobs[static_cast<std::size_t>(i)];
      std::vector<float>& kept = disparity_[index_of(job.at)];
      fill_one(job, keys, kept.empty() ? scratch.data() : kept.data());
    }
  });
  result_.pixels += static_cast<std::int64_t>(jobs.size() * pixels);
}

void Assembly::fill_one(const Job& job, std::span<std::uint64_t> keys, float* disparity) {
  search_({job.at[0], job.at[1], n_, max_disparity_px_, job.sources}, keys);
  const std::int64_t holes = take_colours(job, keys, disparity);
  if (options_.record_maps) record(job, keys);
  if (holes == 0) return;
  holes_ += holes;
  reprojection::fill_holes({colours_at(job.at), result_.light_field.width(), disparity, n_}, options_.holes,
                           corners_);
}

/// Where the pixel taken for (x, y) lands from its centre.
struct Offset {
  float x, y;
};
Offset offset_of(const reprojection::Candidate& from, const Source& source, Position at, int x, int y) {
  return {reprojection::landing(from.x, from.disparity_px, at[0] - source.column) - static_cast<float>(x),
          reprojection::landing(from.y, from.disparity_px, at[1] - source.row) - static_cast<float>(y)};
}

std::int64_t Assembly::take_colours(const Job& job, std::span<const std::uint64_t> keys, float* disparity) {
  std::int64_t holes = 0;
  std::size_t i = 0;
  for (int y = 0; y < n_; ++y) {
    Rgb* colour = colours_at(job.at) + static_cast<std::ptrdiff_t>(y) * result_.light_field.width();
    for (int x = 0; x < n_; ++x, ++i) {
      if (keys[i] == 0) {
        disparity[i] = kNoDepth;
        ++holes;
        continue;
      }
      const reprojection::Candidate from = reprojection::candidate_of(keys[i]);
      const Source& source = job.sources[from.source];
      const Offset offset = offset_of(from, source, job.at, x, y);
      colour[x] = reprojection::corrected_colour(source, n_, from.x, from.y, offset.x, offset.y);
      disparity[i] = from.disparity_px;
    }
  }
  return holes;
}

void Assembly::record(const Job& job, std::span<const std::uint64_t> keys) {
  std::size_t i = 0;
  for (int y = 0; y < n_; ++y)
    for (int x = 0; x < n_; ++x, ++i) {
      if (keys[i] == 0) continue;
      const reprojection::Candidate from = reprojection::candidate_of(keys[i]);
      const Offset offset = offset_of(from, job.sources[from.source], job.at, x, y);
      result_.disparity_px.at(job.at[0] * n_ + x, job.at[1] * n_ + y) = from.disparity_px;
      result_.offset_px.at(job.at[0] * n_ + x, job.at[1] * n_ + y) =
          std::max(std::abs(offset.x), std::abs(offset.y));
    }
}

ReprojectionResult assemble(const CameraArray& array, std::span<const RenderedCamera> cameras,
                            const ReprojectionOptions& options, Search search, DisplayImage buffer) {
  require_fitting(array, cameras);
  const auto start = std::chrono::steady_clock::now();
  Assembly assembly(array, cameras, options, search, std::move(buffer));
  assembly.run();
  ReprojectionResult result = assembly.take();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace

double CameraArray::disparity_px(double depth_m) const {
  return layout.size_px * spacing_m / (2 * depth_m * std::tan(fov_deg * std::numbers::pi / 360));
}

void CameraArray::validate() const {
  layout.validate();
  if (layout.size_px > reprojection::kMaxSize)
    throw InputError(
        fmt::format("subimages are at most {} px wide, not {}", reprojection::kMaxSize, layout.size_px));
  if (!(spacing_m > 0) || !std::isfinite(spacing_m))
    throw InputError(fmt::format("the cameras must be a positive distance apart, not {:g} m", spacing_m));
  if (!(fov_deg > 0 && fov_deg < 180))
    throw InputError(fmt::format("the field of view must lie between 0 and 180 degrees, not {:g}", fov_deg));
}

std::vector<std::array<int, 2>> corner_positions(const SubimageLayout& layout) {
  std::vector<Position> positions;
  for (const int row : {0, layout.rows - 1})
    for (const int column : {0, layout.columns - 1})
      if (const Position p{column, row}; std::find(positions.begin(), positions.end(), p) == positions.end())
        positions.push_back(p);
  return positions;
}

std::array<int, 2> central_position(const SubimageLayout& layout) {
  return {layout.columns / 2, (layout.rows - 1) / 2};
}

ReprojectionResult reproject(const CameraArray& array, std::span<const RenderedCamera> cameras,
                             const ReprojectionOptions& options, DisplayImage buffer) {
  return assemble(array, cameras, options, reprojection::search_by_splatting, std::move(buffer));
}

ReprojectionResult reproject_literally(const CameraArray& array, std::span<const RenderedCamera> cameras,
                                       const ReprojectionOptions& options) {
  return assemble(array, cameras, options, reprojection::search_literally, {});
}

}  // namespace plenolab
