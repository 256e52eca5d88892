#include "tests/experiments/plane_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/lightfield/light_field_folder.h"

namespace plenolab {

LightField plane_field(float disparity_px, double sign) {
  const ViewGrid grid{3, 3, 0.1, 0.1, 48, 32, 60};
  std::vector<KeyView<SceneReferred>> views;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      KeyView<SceneReferred> view{SceneImage(48, 32), DisparityMap(48, 32, disparity_px)};
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
          const double u = x + sign * column * disparity_px, v = y + sign * row * disparity_px;
          const double value = 2 + std::sin(0.9 * u) + 0.7 * std::cos(0.8 * v + 0.3 * u);
          view.colour.at(x, y) = Rgb{1, 0.9f, 0.8f} * static_cast<float>(value);
        }
      views.push_back(std::move(view));
    }
  return LightField::from_views(grid, RadianceUnit::kRelative, "plane", std::move(views));
}

std::filesystem::path written_plane(const std::filesystem::path& folder, double sign) {
  write_light_field(folder, plane_field(3, sign), {.colour_type = ExrPixelType::kFloat});
  return folder;
}

void expect_one_clear_sentence(const ProgramResult& result, const std::string& mentions, int status) {
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_TRUE(result.err.starts_with("plenolab: ")) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(mentions), std::string::npos) << "'" << mentions << "' in: " << result.err;
}

}  // namespace plenolab
