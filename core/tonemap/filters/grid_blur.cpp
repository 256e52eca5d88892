#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/tonemap/filters/grid_passes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tonemap/filters/grid_blur.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PLENOLAB_GRID_BLUR_ONCE
#define PLENOLAB_GRID_BLUR_ONCE
namespace plenolab {

/// Everything the blur of one row of cells reads. `sums` holds, layer by layer, the sums of a cell's layers
/// up to and with this one; used by the one-sided kernel only.
struct BlurSetup {
  const GridLayout& layout;
  const GridData& data;
  const GridLayout& sums_layout;
  const GridData& sums;
  const GridKernels& kernels;
};

/// A stretch of bins to be added with a weight.
struct WeightedBlock {
  const GridBlock* block;
  const float* data;
  float weight;
};

}  // namespace plenolab
#endif

HWY_BEFORE_NAMESPACE();
namespace plenolab {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One group of bins; narrower vectors take several steps.
using GroupTag = hn::CappedTag<float, kBinGroup * kBinFloats>;
inline constexpr int kGroupFloats = kBinGroup * kBinFloats;

/// Adds weight · source to the bins [begin, end) that start at `target`.
HWY_INLINE void AddBlock(const WeightedBlock& source, int begin, int end, float* target) {
  const GroupTag d;
  const int from = std::max(begin, source.block->begin), to = std::min(end, source.block->end);
  const float* in = source.data + source.block->offset + (from - source.block->begin) * kBinFloats;
  float* out = target + (from - begin) * kBinFloats;
  const auto weight = hn::Set(d, source.weight);
  for (int i = 0; i < (to - from) * kBinFloats; i += static_cast<int>(hn::Lanes(d)))
    hn::StoreU(hn::Add(hn::LoadU(d, out + i), hn::Mul(hn::LoadU(d, in + i), weight)), d, out + i);
}

/// Convolves along the bins; `in` starts `reach` bins before the first of the `bins` outputs.
HWY_INLINE void ConvolveBins(const float* in, const GridKernels& kernels, int bins, float* out) {
  const GroupTag d;
  for (int i = 0; i < bins * kBinFloats; i += static_cast<int>(hn::Lanes(d))) {
    const float* middle = in + i + kernels.bin_reach * kBinFloats;
    auto sum = hn::Mul(hn::LoadU(d, middle), hn::Set(d, kernels.bins[0]));
    for (int t = 1; t <= kernels.bin_reach; ++t) {
      const auto both = hn::Add(hn::LoadU(d, middle - t * kBinFloats), hn::LoadU(d, middle + t * kBinFloats));
      sum = hn::Add(sum, hn::Mul(both, hn::Set(d, kernels.bins[static_cast<std::size_t>(t)])));
    }
    hn::StoreU(sum, d, out + i);
  }
}

/// Blurs one row of cells: along disparity and down the columns into a row of sums, then along the row and
/// the bins.
class RowBlur {
 public:
  RowBlur(const BlurSetup& setup, int row) : s_(setup), row_(row) {}

  void run(float* out) {
    count_layers();
    blur_columns();
    blur_row(out);
  }

 private:
  int reach() const { return static_cast<int>(s_.kernels.space.size()) - 1; }

  /// Layers that any cell of the row has.
  void count_layers() {
    for (int x = 0; x < s_.layout.columns; ++x)
      for (const GridBlock& block : s_.layout.cell(x, row_)) layers_.push_back(block.layer);
    std::sort(layers_.begin(), layers_.end());
    layers_.erase(std::unique(layers_.begin(), layers_.end()), layers_.end());
    wanted_.assign(layers_.size(), 0);
  }

  void want(int column, int change) {
    if (column < 0 || column >= s_.layout.columns) return;
    auto layer = layers_.begin();
    for (const GridBlock& block : s_.layout.cell(column, row_)) {
      layer = std::lower_bound(layer, layers_.end(), block.layer);
      wanted_[static_cast<std::size_t>(layer - layers_.begin())] += change;
    }
  }

  /// Sums for each column of the layers that cells of this row within reach have.
  void blur_columns() {
    for (int x = 0; x < reach(); ++x) want(x, 1);
    for (int x = 0; x < s_.layout.columns; ++x) {
      want(x + reach(), 1);
      want(x - reach() - 1, -1);
      columns_.first.push_back(columns_.blocks.size());
      for (std::size_t i = 0; i < layers_.size(); ++i)
        if (wanted_[i] > 0) blur_column(x, layers_[i]);
    }
    columns_.first.push_back(columns_.blocks.size());
    columns_.columns = s_.layout.columns;
  }

  void blur_column(int x, int layer) {
    sources_.clear();
    for (int y = std::max(0, row_ - reach()); y <= std::min(s_.layout.rows - 1, row_ + reach()); ++y)
      add_sources(x, y, layer, s_.kernels.space[static_cast<std::size_t>(std::abs(y - row_))]);
    if (sources_.empty()) return;
    GridBlock block{layer, sources_[0].block->begin, sources_[0].block->end, column_data_.size()};
    for (const WeightedBlock& source : sources_) {
      block.begin = std::min(block.begin, source.block->begin);
      block.end = std::max(block.end, source.block->end);
    }
    columns_.blocks.push_back(block);
    column_data_.resize(block.offset + static_cast<std::size_t>(block.end - block.begin) * kBinFloats, 0.0f);
    for (const WeightedBlock& source : sources_)
      AddBlock(source, block.begin, block.end, column_data_.data() + block.offset);
  }

  /// The blocks of a cell from which `layer` takes.
  void add_sources(int x, int y, int layer, float weight) {
    const auto cell = s_.layout.cell(x, y);
    const int depth_reach = static_cast<int>(s_.kernels.layers.size()) - 1;
    const int first_layer = s_.kernels.one_sided ? layer + 1 : layer - depth_reach;
    const auto first = std::lower_bound(cell.begin(), cell.end(), first_layer,
                                        [](const GridBlock& block, int l) { return block.layer < l; });
    if (s_.kernels.one_sided && first != cell.begin())
      sources_.push_back({&s_.sums_layout.cell(x, y)[static_cast<std::size_t>(first - cell.begin()) - 1],
                          s_.sums.data(), weight});
    for (auto block = first; block != cell.end() && block->layer <= layer + depth_reach; ++block)
      sources_.push_back(
          {&*block, s_.data.data(),
           weight * s_.kernels.layers[static_cast<std::size_t>(std::abs(block->layer - layer))]});
  }

  void blur_row(float* out) {
    for (int x = 0; x < s_.layout.columns; ++x)
      for (const GridBlock& block : s_.layout.cell(x, row_)) {
        const int begin = block.begin - s_.kernels.bin_reach, end = block.end + s_.kernels.bin_reach;
        row_data_.assign(static_cast<std::size_t>(end - begin) * kBinFloats, 0.0f);
        for (int from = std::max(0, x - reach()); from <= std::min(s_.layout.columns - 1, x + reach());
             ++from) {
          const GridBlock* source = find_block(columns_.cell(from, 0), block.layer);
          const float weight = s_.kernels.space[static_cast<std::size_t>(std::abs(from - x))];
          if (source != nullptr)
            AddBlock({source, column_data_.data(), weight}, begin, end, row_data_.data());
        }
        ConvolveBins(row_data_.data(), s_.kernels, block.end - block.begin, out + block.offset);
      }
  }

  const BlurSetup& s_;
  int row_;
  std::vector<int> layers_, wanted_;
  std::vector<WeightedBlock> sources_;
  GridLayout columns_;
  std::vector<float> column_data_, row_data_;
};

void BlurRow(const BlurSetup& setup, int row, float* out) {
  RowBlur(setup, row).run(out);
}

}  // namespace HWY_NAMESPACE
}  // namespace plenolab
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plenolab {
namespace {
HWY_EXPORT(BlurRow);

/// Blocks that hold, for each block of a cell, room for the sum of it and those of smaller disparity.
GridLayout layout_of_sums(const GridLayout& layout) {
  GridLayout sums = layout;
  sums.floats = 0;
  for (std::size_t c = 0; c + 1 < sums.first.size(); ++c)
    for (std::size_t i = sums.first[c]; i < sums.first[c + 1]; ++i) {
      GridBlock& block = sums.blocks[i];
      if (i > sums.first[c]) {
        block.begin = std::min(block.begin, sums.blocks[i - 1].begin);
        block.end = std::max(block.end, sums.blocks[i - 1].end);
      }
      block.offset = sums.floats;
      sums.floats += static_cast<std::size_t>(block.end - block.begin) * kBinFloats;
    }
  return sums;
}

void add(const GridBlock& source, const float* in, const GridBlock& target, float* out) {
  const float* from = in + source.offset;
  float* to = out + target.offset + static_cast<std::size_t>(source.begin - target.begin) * kBinFloats;
  for (int i = 0; i < (source.end - source.begin) * kBinFloats; ++i) to[i] += from[i];
}

GridData sum_layers(const GridLayout& layout, const GridData& data, const GridLayout& sums_layout) {
  GridData sums(sums_layout.floats, 0.0f);
  for (std::size_t c = 0; c + 1 < layout.first.size(); ++c)
    for (std::size_t i = layout.first[c]; i < layout.first[c + 1]; ++i) {
      if (i > layout.first[c])
        add(sums_layout.blocks[i - 1], sums.data(), sums_layout.blocks[i], sums.data());
      add(layout.blocks[i], data.data(), sums_layout.blocks[i], sums.data());
    }
  return sums;
}

}  // namespace

GridData blur(const GridLayout& layout, const GridData& data, const GridKernels& kernels, int threads) {
  const GridLayout sums_layout = kernels.one_sided ? layout_of_sums(layout) : GridLayout{};
  const GridData sums = kernels.one_sided ? sum_layers(layout, data, sums_layout) : GridData{};
  const BlurSetup setup{layout, data, sums_layout, sums, kernels};
  GridData out(layout.floats);
  parallel_for(layout.rows, 1, threads, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) HWY_DYNAMIC_DISPATCH(BlurRow)(setup, row, out.data());
  });
  return out;
}

}  // namespace plenolab
#endif  // HWY_ONCE
