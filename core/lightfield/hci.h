#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/lightfield/light_field.h"

namespace plenolab {

/// The parameters.cfg of a scene of the HCI 4D light field benchmark (Honauer et al., ACCV 2016), as far as
/// used: sections [intrinsics], [extrinsics] and [meta].
struct HciParameters {
  int width = 512, height = 512;  ///< image_resolution_x_px, image_resolution_y_px
  double focal_length_mm = 100;
  double sensor_size_mm = 35;   ///< of the longer side
  int columns = 9, rows = 9;    ///< num_cams_x, num_cams_y
  double baseline_mm = 50;      ///< in both directions
  double focus_distance_m = 8;  ///< of the plane of disparity 0; may be "inf"
  std::string scene = "scene";
  /// Focal length in pixels: f·max(W, H)/sensor.
  double focal_length_px() const;
  /// Disparity of the focus plane in a parallel rig, px per spacing: B·f_px/Z_focus; what must be added to
  /// the benchmark's signed disparity to get ours.
  double focus_disparity_px() const;
  void validate() const;
};

/// Parses parameters.cfg (INI); `name` stands for the file in messages. Unknown sections and keys are
/// ignored. Throws InputError naming the key that is missing, not a number, or out of range.
HciParameters parse_hci_parameters(std::string_view text, const std::string& name);

/// Whether `folder` holds parameters.cfg and input_Cam000.png.
bool is_hci_folder(const std::filesystem::path& folder);

struct HciImportOptions {
  std::size_t memory_bound_bytes = LightField::kDefaultMemoryBound;
};

/// Imports a scene of the HCI benchmark as a display-referred light field.
///
/// The benchmark's cameras are parallel, but every image is offset so that the plane at the focus distance
/// has disparity 0; its disparity is signed. Ours has centred principal points and d ≥ 0 with 0 at infinity,
/// so view (c, r) is moved by the constant (c − c_mid, r − r_mid)·d_focus pixels (bilinear interpolation of
/// the encoded values where that is not whole) and all views are cropped to the area common to all, which
/// narrows the opening angle; d = d_signed + d_focus. Ground truth, in this order: per view
/// gt_disp_lowres_Cam%03d.pfm, per view gt_depth_lowres_Cam%03d.pfm, centre gt_disp_lowres.pfm,
/// gt_depth_lowres.pfm, gt_disp_highres.pfm (the sample at each pixel's centre). Centre-only truth is spread
/// to the other views by forward warping: the nearest surface wins, holes take the farther of their two
/// neighbours in the row, cracks of one pixel in a surface are closed. Disparity is not interpolated across
/// depth edges
/// (> 1 px); d between −0.01 and 0 counts as rounding at infinity and becomes 0. Throws InputError naming the
/// missing or wrong file, or if the views have no area in common.
DisplayLightField import_hci(const std::filesystem::path& folder, const HciImportOptions& options = {});

/// The same as relative scene radiance, decoded by gamma 2.2 (the benchmark's tone curve is unknown:
/// sRGB-like).
LightField import_hci_linear(const std::filesystem::path& folder, const HciImportOptions& options = {});

struct HciExportOptions {
  /// Disparity that becomes 0, in whole pixels so that no image is resampled; default: the middle of the
  /// range.
  std::optional<int> focus_disparity_px;
  /// Ground truth for every view beside the centre's.
  bool all_ground_truth = true;
};

/// Writes the benchmark's layout (parameters.cfg, 8-bit input_Cam%03d.png, gt_disp_lowres.pfm of the centre
/// view, gt_disp_lowres_Cam%03d.pfm), views moved by whole pixels and cropped to the common area. The folder
/// appears whole or not at all. Throws InputError for a grid with unequal spacings, an even number of columns
/// or rows (no centre view), an existing non-empty folder, or views with nothing in common.
void export_hci(const std::filesystem::path& folder, const DisplayLightField& light_field,
                const HciExportOptions& options = {}, const Progress& progress = {});

}  // namespace plenolab
