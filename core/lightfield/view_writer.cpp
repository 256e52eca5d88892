#include "core/lightfield/view_writer.h"

#include <fmt/format.h>

#include <type_traits>
#include <utility>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/lightfield/folder_views.h"

namespace plenolab {

template <class Referral>
ViewWriter<Referral>::ViewWriter(std::filesystem::path folder, const ViewGrid& grid, RadianceUnit unit,
                                 std::string name, const WriteLightFieldOptions& options)
    : folder_(std::move(folder)), name_(std::move(name)) {
  description_.grid = grid;
  description_.display_referred = std::is_same_v<Referral, DisplayReferred>;
  description_.unit = unit;
  description_.view_pattern = "view_{row:02}_{column:02}.exr";
  exr_.colour_type = options.colour_type;
  exr_.compression = options.compression;
  // So that a view says what it means when it is looked at by itself.
  if (!description_.display_referred && unit == RadianceUnit::kCdM2)
    exr_.float_attributes[kWhiteLuminance] = 1;
}

template <class Referral>
void ViewWriter<Referral>::write(int column, int row, const RgbImage<Referral>& colour,
                                 const DisparityMap& disparity) {
  check_disparity(disparity, fmt::format("view (column {}, row {}) of {}", column, row, name_));
  write_exr(view_path(folder_, description_, column, row), colour, {{description_.geometry, &disparity}},
            exr_);
  ++written_;
}

template <class Referral>
void ViewWriter<Referral>::finish() {
  const int views = description_.grid.columns * description_.grid.rows;
  PLENOLAB_CHECK(written_ == views, fmt::format("{} of {} views", written_, views));
  write_text_file(folder_ / kDescriptionFile, format_description(description_));
}

template class ViewWriter<SceneReferred>;
template class ViewWriter<DisplayReferred>;

}  // namespace plenolab
