#pragma once

#include "core/lightfield/light_field.h"

namespace plenolab {

/// The grid that keeps every `stride`-th column and row from (0, 0) on; an axis with a single view keeps it.
/// Columns and rows behind the last kept one are dropped. Throws InputError for a stride below 1.
ViewGrid subsampled_grid(const ViewGrid& grid, int stride);

/// The light field of those views, loaded lazily from the original. Spacings grow by `stride`, and
/// disparities with the column spacing, because they are given per column spacing; an axis with a single view
/// keeps its spacing. Throws InputError for a stride below 1.
template <class Referral>
BasicLightField<Referral> subsample(const BasicLightField<Referral>& light_field, int stride);

}  // namespace plenolab
