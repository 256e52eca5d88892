#pragma once

#include <filesystem>
#include <string>

#include "core/lightfield/description.h"
#include "core/lightfield/light_field_folder.h"

namespace plenolab {

/// Writes a light field view by view into a folder that exists, for results that come one view at a time.
/// The folder is complete after `finish`: use it inside write_folder_atomically
/// (core/lightfield/new_folder.h), or by write_light_field, which does.
template <class Referral>
class ViewWriter {
 public:
  /// `unit` is that of scene-referred radiance, `name` says in messages where the views come from.
  ViewWriter(std::filesystem::path folder, const ViewGrid& grid, RadianceUnit unit, std::string name,
             const WriteLightFieldOptions& options = {});

  /// Writes view (column, row), each once. Throws InputError as write_exr does, and for disparity that is
  /// negative, infinite or NaN.
  void write(int column, int row, const RgbImage<Referral>& colour, const DisparityMap& disparity);

  /// Writes lightfield.json, once all views are written.
  void finish();

 private:
  std::filesystem::path folder_;
  std::string name_;
  LightFieldDescription description_;
  ExrWriteOptions exr_;
  int written_ = 0;
};

using SceneViewWriter = ViewWriter<SceneReferred>;
using DisplayViewWriter = ViewWriter<DisplayReferred>;

}  // namespace plenolab
