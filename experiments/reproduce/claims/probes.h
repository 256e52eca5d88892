#pragma once

#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "core/lightfield/light_field.h"
#include "stimuli/scene.h"

namespace plenolab {

/// Probes of the claims: stimuli so simple that one cause of error stands alone. There are two kinds.
///
/// Flat worlds are computed, not rendered: surfaces parallel to the image, seen exactly and without noise
/// from any camera position, after the key-view preprocessing of all views (stimuli/block_preprocess.h). They
/// carry every claim that only depends on which surface hides which.
///
/// Probe scenes are rendered (Laboratory::render): materials, lights and media, modelled from planes and
/// boxes before a uniform sky, which converges with few paths.

/// left ≤ x ≤ right and top ≤ y ≤ bottom, in image coordinates.
struct FlatBounds {
  double left = -std::numeric_limits<double>::infinity(), right = -left;
  double top = left, bottom = right;
};

/// Linear radiance at a point of a surface.
using FlatColour = std::function<Rgb(double x, double y)>;

/// A surface parallel to the image.
struct FlatSurface {
  double disparity_px = 0;  ///< ≥ 0; 0 = infinitely far
  /// Whether the surface covers a point; empty = everywhere. Points are image coordinates of the view from
  /// FlatWorld::origin.
  std::function<bool(double x, double y)> covers;
  /// Linear radiance ≥ 0: the same everywhere, or at each point. Features of 4 px or more are reproduced
  /// almost exactly by bilinear interpolation.
  std::variant<Rgb, FlatColour> colour;
  /// Outside of it the surface covers nothing, and `covers` is not asked: saves time. Unbounded by default.
  FlatBounds bounds = {};

  /// Whether it covers every point.
  bool is_endless() const {
    const FlatBounds none;
    return !covers && bounds.left == none.left && bounds.right == none.right && bounds.top == none.top &&
           bounds.bottom == none.bottom;
  }
  bool is_at(double x, double y) const {
    return x >= bounds.left && x <= bounds.right && y >= bounds.top && y <= bounds.bottom &&
           (!covers || covers(x, y));
  }
  Rgb colour_at(double x, double y) const {
    const Rgb* plain = std::get_if<Rgb>(&colour);
    return plain ? *plain : std::get<FlatColour>(colour)(x, y);
  }
};

/// Surfaces in any order, the nearest in front. Where no surface is, radiance and disparity are 0.
struct FlatWorld {
  CameraPosition origin{0.5, 0.5};  ///< the view whose image coordinates the surfaces are given in
  std::vector<FlatSurface> surfaces;
};

/// The view from anywhere on the camera plane: 4 × 4 samples a pixel, then preprocess_block as for rendered
/// views. `threads`: 0 = all cores, no influence on the result.
KeyView<SceneReferred> flat_view(const FlatWorld& world, const ViewGrid& grid, CameraPosition position,
                                 int threads = 0);

/// All key views. `name` stands in messages.
LightField flat_light_field(const FlatWorld& world, const ViewGrid& grid, const std::string& name,
                            int threads = 0);

/// A grid of equal spacings for flat worlds and probe scenes; spacing in metres, horizontal opening angle
/// 60°.
ViewGrid probe_grid(int columns, int rows, double spacing_m, int width, int height);

/// A tinted pattern, linear radiance in [0.04, 1] with mean 0.52: random tones `feature_px` apart, smooth in
/// between, repeated after 64 of them. For FlatSurface::colour.
FlatColour flat_pattern(double feature_px, std::uint32_t seed);

/// A scene without surfaces: camera at the origin looking along +y, z up, uniform light of `sky_cd_m2` from
/// all directions, also from below. `id` must not be that of a scene of the table.
Scene empty_probe(const std::string& id, float sky_cd_m2 = 1000, float fov_h_deg = 60);

/// Appends a material and its mesh to the scene.
void add_surface(Scene& scene, Material material, const Mesh& mesh);

/// Parallelogram corner + a·edge_u + b·edge_v, facing edge_u × edge_v; u, v in metres along the edges.
Mesh parallelogram(const Vec3& corner_m, const Vec3& edge_u_m, const Vec3& edge_v_m);
/// Rectangle parallel to the image, centred at a point, facing the camera of empty_probe.
Mesh card(const Vec3& centre_m, float width_m, float height_m);
/// Axis-aligned box with sharp edges: bars, posts, blocks. u, v in metres on each face.
Mesh block(const Vec3& centre_m, const Vec3& size_m);

/// Names the scene's contents in Scene::variant by a hash of everything in it: camera, lights, medium,
/// meshes, and materials, whose textures are looked up at up to 512 points of each mesh. Call it last, after
/// all changes: the render cache tells probe scenes apart by id and variant only.
void seal(Scene& scene);

}  // namespace plenolab
