#include "core/lightfield/hci.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/image/colour.h"
#include "core/io/image_file.h"
#include "core/io/pfm.h"
#include "core/lightfield/hci_truth.h"
#include "core/lightfield/self_check.h"
#include "tests/core/lightfield/synthetic.h"
#include "tests/support/message_of.h"

namespace plenolab {
namespace {
namespace fs = std::filesystem;

// The two planes as the benchmark stores them: images offset so that disparity `focus_px` becomes 0.
struct HciScene {
  TwoPlanes planes;
  double focus_px = 2.5;

  HciScene() {
    planes.radiance = 1;
    planes.grid.width = planes.grid.height = 96;
  }

  double centre_column() const { return (planes.grid.columns - 1) / 2.0; }

  /// Disparity (unsigned) and colour seen at the true image position (x, y) of view (column, row).
  std::pair<double, Rgb> at(double x, double y, int column, int row) const {
    const bool near = planes.is_near(x + column * planes.near_px, y + row * planes.near_px);
    const double d = near ? planes.near_px : planes.far_px;
    const float v = noise_texture(x + column * d, y + row * d, near ? 1 : 2);
    return {d, Rgb{v, 0.8f * v, v * v}};
  }

  HciParameters parameters() const {
    HciParameters p;
    p.width = p.height = planes.grid.width;
    p.columns = planes.grid.columns;
    p.rows = planes.grid.rows;
    p.baseline_mm = 40;
    p.focus_distance_m = p.baseline_mm * 1e-3 * p.focal_length_px() / focus_px;
    return p;
  }

  void write(const fs::path& folder, bool truth_for_all) const {
    const HciParameters p = parameters();
    write_text_file(folder / "parameters.cfg",
                    fmt::format("# benchmark\n[intrinsics]\nfocal_length_mm = {}\nimage_resolution_x_px = "
                                "{}\nimage_resolution_y_px = {}\n"
                                "sensor_size_mm = {}\n[extrinsics]\nnum_cams_x = {}\nnum_cams_y = "
                                "{}\nbaseline_mm = {}\nfocus_distance_m = {}\n"
                                "[meta]\nscene = planes\n",
                                p.focal_length_mm, p.width, p.height, p.sensor_size_mm, p.columns, p.rows,
                                p.baseline_mm, p.focus_distance_m));
    for (int row = 0; row < p.rows; ++row)
      for (int column = 0; column < p.columns; ++column) write_view(folder, p, column, row, truth_for_all);
  }

 private:
  void write_view(const fs::path& folder, const HciParameters& p, int column, int row,
                  bool truth_for_all) const {
    DisplayImage image(p.width, p.height);
    Plane<float> truth(p.width, p.height);
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x) {
        const auto [d, colour] = at(x + 0.5 - focus_px * (column - centre_column()),
                                    y + 0.5 - focus_px * (row - (p.rows - 1) / 2.0), column, row);
        image.at(x, y) = colour;
        truth.at(x, y) = static_cast<float>(d - focus_px);
      }
    const int index = row * p.columns + column;
    write_display_image(folder / fmt::format("input_Cam{:03}.png", index), image, PngDepth::k16Bit);
    if (truth_for_all) write_pfm(folder / fmt::format("gt_disp_lowres_Cam{:03}.pfm", index), truth);
    if (!truth_for_all && index == p.columns * p.rows / 2) write_pfm(folder / "gt_disp_lowres.pfm", truth);
  }
};

// Share of pixels whose disparity is not the true one.
double wrong_share(const HciScene& scene, const DisplayLightField& lf, int column, int row) {
  const auto view = lf.view(column, row);
  const int crop = (scene.planes.grid.width - lf.grid().width) / 2;
  int wrong = 0;
  for (int y = 0; y < lf.grid().height; ++y)
    for (int x = 0; x < lf.grid().width; ++x)
      wrong += std::abs(view->disparity.at(x, y) -
                        scene.at(x + crop + 0.5, y + crop + 0.5, column, row).first) > 1e-4;
  return static_cast<double>(wrong) / static_cast<double>(view->disparity.size());
}

TEST(Hci, SignedDisparityAboutAFocusPlaneBecomesTrueDisparityInEveryView) {
  for (const double focus_px : {2.0, 2.5}) {
    HciScene scene;
    scene.focus_px = focus_px;
    const TemporaryFolder folder;
    scene.write(folder.path(), true);
    ASSERT_TRUE(is_hci_folder(folder.path()));
    const DisplayLightField lf = import_hci(folder.path());
    EXPECT_EQ(lf.grid().width, 96 - 2 * static_cast<int>(std::ceil(focus_px)));
    EXPECT_NEAR(lf.grid().disparity_px(scene.parameters().focus_distance_m), focus_px, 1e-9);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        EXPECT_LT(wrong_share(scene, lf, column, row), focus_px == 2.0 ? 1e-9 : 0.03);
  }
}

TEST(Hci, CentreTruthIsSpreadToAllViewsWithoutLosingTheForeground) {
  const HciScene scene;
  const TemporaryFolder folder;
  scene.write(folder.path(), false);
  const DisplayLightField lf = import_hci(folder.path());
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      EXPECT_LT(wrong_share(scene, lf, column, row), 0.04) << column << " " << row;
  const SelfCheckResult check = self_check(lf);
  EXPECT_EQ(check.verdict, SelfCheckVerdict::kConsistent) << check.explanation;
  EXPECT_NEAR(check.best_scale, 1, 0.05);
}

TEST(Hci, ColoursMoveWithTheirGeometry) {
  HciScene scene;
  scene.focus_px = 2;  // whole pixels: copied exactly
  const TemporaryFolder folder;
  scene.write(folder.path(), true);
  const DisplayLightField lf = import_hci(folder.path());
  const LightField linear = import_hci_linear(folder.path());
  for (int x = 0; x < lf.grid().width; ++x) {
    const Rgb expected = scene.at(x + 2.5, 30.5, 2, 0).second;
    const Rgb got = lf.view(2, 0)->colour.at(x, 28);
    EXPECT_NEAR(got.g, expected.g, 1e-5);
    EXPECT_EQ(linear.view(2, 0)->colour.at(x, 28), gamma_decode(got));
  }
}

TEST(Hci, DepthAndFineDisparityServeAsTruthToo) {
  const HciScene scene;
  const HciParameters p = scene.parameters();
  const TemporaryFolder folder;
  Plane<float> depth(96, 96), fine(288, 288);
  const double at_one_metre = p.baseline_mm * 1e-3 * p.focal_length_px();
  for (int y = 0; y < 288; ++y)
    for (int x = 0; x < 288; ++x) fine.at(x, y) = static_cast<float>(x / 3);
  for (float& z : depth.pixels()) z = static_cast<float>(at_one_metre / 4);
  write_pfm(folder.path() / "gt_disp_highres.pfm", fine);
  EXPECT_EQ(find_hci_truth(folder.path(), p)(1, 1).at(50, 7), 50);
  write_pfm(folder.path() / "gt_depth_lowres.pfm", depth);
  EXPECT_NEAR(find_hci_truth(folder.path(), p)(1, 1).at(50, 7), 4 - scene.focus_px, 1e-5);
}

TEST(Hci, SpreadingMovesSurfacesKeepsTheNearestAndFillsHolesFromBehind) {
  Plane<float> centre(20, 3, 0.0f);
  for (int y = 0; y < 3; ++y)
    for (int x = 8; x < 12; ++x) centre.at(x, y) = 3;
  const Plane<float> right = spread_disparity(centre, 1, 0), left = spread_disparity(centre, -1, 0);
  for (int x = 0; x < 20; ++x) {
    EXPECT_EQ(right.at(x, 1), x >= 5 && x < 9 ? 3 : 0) << x;
    EXPECT_EQ(left.at(x, 1), x >= 11 && x < 15 ? 3 : 0) << x;
  }
  EXPECT_EQ(spread_disparity(centre, 0, 0), centre);
}

TEST(Hci, WhatIsExportedIsImportedAgain) {
  TwoPlanes planes;
  planes.radiance = 1;
  const DisplayLightField original = planes.light_field<DisplayReferred>();
  const TemporaryFolder folder;
  export_hci(folder.path() / "hci", original, {.focus_disparity_px = 2});
  const DisplayLightField back = import_hci(folder.path() / "hci");
  const int crop = 4;  // two pixels at each step
  ASSERT_EQ(back.grid().width, planes.grid.width - 2 * crop);
  EXPECT_NEAR(back.grid().disparity_px(1), original.grid().disparity_px(1), 1e-9);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      for (int x = 0; x < back.grid().width; ++x) {
        EXPECT_NEAR(back.view(column, row)->disparity.at(x, 30),
                    original.view(column, row)->disparity.at(x + crop, 30 + crop), 1e-4);
        EXPECT_NEAR(back.view(column, row)->colour.at(x, 30).r,
                    original.view(column, row)->colour.at(x + crop, 30 + crop).r, 0.501 / 255);
      }
}

TEST(Hci, AFocusPlaneAtInfinityNeedsNoCrop) {
  TwoPlanes planes;
  planes.radiance = 1;
  const TemporaryFolder folder;
  export_hci(folder.path() / "hci", planes.light_field<DisplayReferred>(), {.focus_disparity_px = 0});
  const DisplayLightField back = import_hci(folder.path() / "hci");
  EXPECT_EQ(back.grid().width, planes.grid.width);
  EXPECT_EQ(back.view(0, 2)->disparity, planes.view<DisplayReferred>(0, 2).disparity);
}

TEST(Hci, GridsWithoutACentreViewAreNotExported) {
  TwoPlanes planes;
  planes.radiance = 1;
  planes.grid.columns = 2;
  const TemporaryFolder folder;
  EXPECT_THROW(export_hci(folder.path() / "hci", planes.light_field<DisplayReferred>()), InputError);
  planes.grid.columns = 3;
  EXPECT_THROW(
      export_hci(folder.path() / "hci", planes.light_field<DisplayReferred>(), {.focus_disparity_px = 60}),
      InputError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Hci, WrongParametersAndMissingFilesAreNamed) {
  const HciScene scene;
  const TemporaryFolder folder;
  scene.write(folder.path(), false);
  const std::string good = read_text_file(folder.path() / "parameters.cfg");
  for (const auto& [from, to, word] : {std::tuple{"baseline_mm = 40", "", "baseline_mm"},
                                       {"baseline_mm = 40", "baseline_mm = x", "baseline_mm"},
                                       {"baseline_mm = 40", "baseline_mm = -40", "baseline_mm"},
                                       {"num_cams_x = 3", "num_cams_x = 3.5", "num_cams_x"},
                                       {"num_cams_x = 3", "num_cams_x = 1000", "num_cams_x"},
                                       {"baseline_mm = 40", "baseline_mm = 1e5", "no area in common"},
                                       {"num_cams_y = 3", "num_cams_y = 4", "input_Cam009.png"}}) {
    std::string text = good;
    text.replace(text.find(from), std::string(from).size(), to);
    write_text_file(folder.path() / "parameters.cfg", text);
    const std::string message = message_of([&] { import_hci(folder.path()); });
    EXPECT_NE(message.find(word), std::string::npos) << message;
  }
  write_text_file(folder.path() / "parameters.cfg", good);
  fs::remove(folder.path() / "gt_disp_lowres.pfm");
  EXPECT_NE(message_of([&] { import_hci(folder.path()); }).find("no ground truth"), std::string::npos);
}

}  // namespace
}  // namespace plenolab
