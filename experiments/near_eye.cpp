#include "experiments/near_eye.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/timing.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/image/colour.h"

namespace plenolab {

namespace {

struct FillName {
  HoleFill fill;
  const char* name;
};
constexpr std::array kFills{FillName{HoleFill::kMean, "mean"}, FillName{HoleFill::kEdge, "edge"},
                            FillName{HoleFill::kBackground, "background"},
                            FillName{HoleFill::kNearest, "nearest"}, FillName{HoleFill::kBlack, "black"}};

/// Statistics of a histogram of differences of 8-bit codes.
ChannelDifference summarise(const std::array<std::int64_t, 256>& counts) {
  std::int64_t total = 0, sum = 0;
  for (int d = 0; d < 256; ++d)
    total += counts[static_cast<std::size_t>(d)], sum += d * counts[static_cast<std::size_t>(d)];
  const auto value_at = [&](std::int64_t rank) {
    int d = 0;
    for (std::int64_t below = counts[0]; below <= rank && d < 255;
         below += counts[static_cast<std::size_t>(d)])
      ++d;
    return d / 255.0;
  };
  return {value_at(0), value_at(total - 1), static_cast<double>(sum) / static_cast<double>(total) / 255,
          (value_at((total - 1) / 2) + value_at(total / 2)) / 2};
}

void copy_into(const DisplayImage& view, DisplayImage& light_field, int column, int row) {
  for (int y = 0; y < view.height(); ++y)
    std::copy(view.row(y), view.row(y) + view.width(),
              light_field.row(row * view.height() + y) + column * view.width());
}

Plane<float> depths_of(const DisparityMap& disparity, const ViewGrid& grid) {
  Plane<float> depth(disparity.width(), disparity.height());
  std::transform(disparity.pixels().begin(), disparity.pixels().end(), depth.pixels().begin(),
                 [&](float d) { return static_cast<float>(grid.depth_m(static_cast<double>(d))); });
  return depth;
}

}  // namespace

NearEyeScene prepare_near_eye(const DirectScene& scene, int supersampling, double fov_deg) {
  if (supersampling != 1 && supersampling != 2 && supersampling != 4)
    throw InputError(fmt::format("the supersampling must be 1, 2 or 4, not {}", supersampling));
  NearEyeScene result{scene, grid_of(scene.scene(), Preset::kQuick), 1, supersampling};
  result.grid.width = result.grid.height = kSubimagePixels * supersampling;
  if (fov_deg > 0) result.grid.fov_h_deg = fov_deg;
  result.exposure = exposure_from(render_direct(result.scene, result.grid, {0, 0}, 1).radiance);
  return result;
}

CameraArray camera_array(const ViewGrid& grid) {
  grid.validate();
  if (grid.width != grid.height)
    throw InputError(
        fmt::format("subimages are square, but the views have {} × {} px", grid.width, grid.height));
  if (std::abs(grid.vertical_ratio() - 1) > 1e-6)
    throw InputError(
        fmt::format("lenses are as far apart across as down, but the cameras are {:g} m and {:g} m apart",
                    grid.spacing_x_m, grid.spacing_y_m));
  return {{grid.columns, grid.rows, grid.width}, grid.spacing_x_m, grid.fov_h_deg};
}

std::vector<std::array<int, 2>> rendered_positions(const SubimageLayout& layout, int cameras) {
  auto positions = corner_positions(layout);
  const auto centre = central_position(layout);
  if (cameras == 5 && std::find(positions.begin(), positions.end(), centre) == positions.end())
    positions.push_back(centre);
  return positions;
}

std::vector<RenderedCamera> render_cameras(const NearEyeScene& scene, int cameras, int threads) {
  std::vector<RenderedCamera> rendered;
  for (const auto& [column, row] : rendered_positions(camera_array(scene.grid).layout, cameras)) {
    DirectView view = render_direct(scene.scene, scene.grid,
                                    {static_cast<double>(column), static_cast<double>(row)}, threads);
    rendered.push_back({column, row, expose(view.radiance, scene.exposure), std::move(view.depth_m)});
  }
  return rendered;
}

std::vector<RenderedCamera> cameras_of(const LightField& field, int cameras, float exposure) {
  std::vector<RenderedCamera> rendered;
  for (const auto& [column, row] : rendered_positions(camera_array(field.grid()).layout, cameras)) {
    const auto view = field.view(column, row);
    rendered.push_back(
        {column, row, expose(view->colour, exposure), depths_of(view->disparity, field.grid())});
  }
  return rendered;
}

DirectLightField render_directly(const NearEyeScene& scene, int threads) {
  const Stopwatch watch;
  DirectView views = render_direct_views(scene.scene, scene.grid, threads);
  DirectLightField result{DisplayImage(views.radiance.width(), views.radiance.height()),
                          std::move(views.depth_m), 0};
  // Row by row on all cores: the same as expose() of every view.
  parallel_for(views.radiance.height(), 16, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < views.radiance.width(); ++x) {
        const Rgb c = views.radiance.at(x, y) * scene.exposure;
        const auto clipped = [](float v) { return gamma_encode(std::clamp(v, 0.0f, 1.0f)); };
        result.light_field.at(x, y) = {clipped(c.r), clipped(c.g), clipped(c.b)};
      }
  });
  result.seconds = watch.seconds();
  return result;
}

DirectLightField directly_from(const LightField& field, float exposure) {
  const SubimageLayout layout = camera_array(field.grid()).layout;
  DirectLightField result{DisplayImage(layout.width(), layout.height()), {}, 0};
  for (int row = 0; row < layout.rows; ++row)
    for (int column = 0; column < layout.columns; ++column)
      copy_into(expose(field.view(column, row)->colour, exposure), result.light_field, column, row);
  return result;
}

DisplayImage to_subimages(const DisplayImage& light_field, SubimageLayout layout, int supersampling,
                          int threads) {
  if (supersampling <= 1) return light_field;
  DisplayImage image = halve_subimages(light_field, layout, threads);
  for (int factor = supersampling / 2; factor > 1; factor /= 2) {
    layout.size_px /= 2;
    image = halve_subimages(image, layout, threads);
  }
  return image;
}

int display_code(float value) {
  return static_cast<int>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
}

std::array<ChannelDifference, 3> difference_statistics(const DisplayImage& a, const DisplayImage& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.empty())
    throw InputError("light-field images of different sizes cannot be compared");
  std::array<std::array<std::int64_t, 256>, 3> counts{};
  const auto add = [&](std::size_t channel, float u, float v) {
    ++counts[channel][static_cast<std::size_t>(std::abs(display_code(u) - display_code(v)))];
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb u = a.pixels()[i], v = b.pixels()[i];
    add(0, u.r, v.r);
    add(1, u.g, v.g);
    add(2, u.b, v.b);
  }
  return {summarise(counts[0]), summarise(counts[1]), summarise(counts[2])};
}

double mean_difference(const std::array<ChannelDifference, 3>& channels) {
  return (channels[0].mean + channels[1].mean + channels[2].mean) / 3;
}

DisplayImage difference_picture(const DisplayImage& a, const DisplayImage& b, float gain) {
  DisplayImage picture(a.width(), a.height());
  const auto shown = [gain](float u, float v) { return std::min(1.0f, gain * std::abs(u - v)); };
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Rgb u = a.pixels()[i], v = b.pixels()[i];
    picture.pixels()[i] = {shown(u.r, v.r), shown(u.g, v.g), shown(u.b, v.b)};
  }
  return picture;
}

const std::vector<std::string>& hole_fill_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const FillName& f : kFills) list.emplace_back(f.name);
    return list;
  }();
  return names;
}

HoleFill hole_fill_named(const std::string& name) {
  for (const FillName& f : kFills)
    if (name == f.name) return f.fill;
  throw InputError(fmt::format("there is no hole fill '{}'", name));
}

std::string name_of(HoleFill fill) {
  return kFills[static_cast<std::size_t>(fill)].name;
}

std::string name_of(ReprojectionMethod method) {
  return method == ReprojectionMethod::kTwoStep ? "two-step" : "one-step";
}

}  // namespace plenolab
