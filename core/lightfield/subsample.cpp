#include "core/lightfield/subsample.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace plenolab {

namespace {

int kept(int count, int stride) {
  return (count - 1) / stride + 1;
}

/// Stride along an axis: one that has a single view keeps its spacing.
int axis_stride(int count, int stride) {
  return count == 1 ? 1 : stride;
}

}  // namespace

ViewGrid subsampled_grid(const ViewGrid& grid, int stride) {
  if (stride < 1) throw InputError(fmt::format("the key stride must be 1 or more, not {}", stride));
  ViewGrid sparse = grid;
  sparse.columns = kept(grid.columns, axis_stride(grid.columns, stride));
  sparse.rows = kept(grid.rows, axis_stride(grid.rows, stride));
  sparse.spacing_x_m *= axis_stride(grid.columns, stride);
  sparse.spacing_y_m *= axis_stride(grid.rows, stride);
  return sparse;
}

template <class Referral>
BasicLightField<Referral> subsample(const BasicLightField<Referral>& light_field, int stride) {
  const ViewGrid grid = light_field.grid();
  const ViewGrid sparse = subsampled_grid(grid, stride);
  const int step_x = axis_stride(grid.columns, stride);
  const int step_y = axis_stride(grid.rows, stride);
  return BasicLightField<Referral>(
      sparse, light_field.unit(), light_field.name(), [light_field, step_x, step_y](int column, int row) {
        KeyView<Referral> view = *light_field.view(column * step_x, row * step_y);
        for (float& disparity : view.disparity.pixels()) disparity *= static_cast<float>(step_x);
        return view;
      });
}

template LightField subsample(const LightField&, int);
template DisplayLightField subsample(const DisplayLightField&, int);

}  // namespace plenolab
