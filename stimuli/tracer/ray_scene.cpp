#include "stimuli/tracer/ray_scene.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>

#include "core/base/error.h"

namespace plenolab::tracer {

struct RayScene::State {
  const Scene* scene = nullptr;
  RTCDevice device = nullptr;
  RTCScene embree = nullptr;

  ~State() {
    if (embree) rtcReleaseScene(embree);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

// One geometry per mesh with the mesh's index as its id. Buffers are copies because Embree reads 16 bytes per
// vertex.
void attach(RTCDevice device, RTCScene embree, const Mesh& mesh, unsigned id) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3), mesh.positions_m.size());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          sizeof(mesh.triangles[0]), mesh.triangles.size());
  PLENOLAB_CHECK(vertices && indices, fmt::format("no memory for mesh {}", id));
  std::memcpy(vertices, mesh.positions_m.data(), mesh.positions_m.size() * sizeof(Vec3));
  std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree, geometry, id);
  rtcReleaseGeometry(geometry);
}

RTCRay embree_ray(const Ray& ray, float far_m) {
  RTCRay r;
  r.org_x = ray.origin.x(), r.org_y = ray.origin.y(), r.org_z = ray.origin.z();
  r.dir_x = ray.direction.x(), r.dir_y = ray.direction.y(), r.dir_z = ray.direction.z();
  r.tnear = 0, r.tfar = far_m;
  r.time = 0, r.mask = ~0u, r.id = 0, r.flags = 0;
  return r;
}

RTCRayHit cast(RTCScene embree, const Ray& ray) {
  RTCRayHit query;
  query.ray = embree_ray(ray, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree, &context, &query);
  return query;
}

Vec3 unit_normal(const Vec3& e1, const Vec3& e2) {
  const Vec3 cross = e1.cross(e2);
  const float length2 = cross.squaredNorm();
  // In a tiny triangle the square underflows: normalise the edges first.
  if (length2 < 1e-30f) return e1.normalized().cross(e2.normalized()).normalized();
  return cross / std::sqrt(length2);
}

}  // namespace

RayScene::RayScene(const Scene& scene) : state_(std::make_unique<State>()) {
  state_->scene = &scene;
  state_->device = rtcNewDevice(nullptr);
  PLENOLAB_CHECK(state_->device,
                 fmt::format("Embree error {}", static_cast<int>(rtcGetDeviceError(nullptr))));
  state_->embree = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->embree, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(state_->embree, RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    if (!scene.meshes[i].triangles.empty())
      attach(state_->device, state_->embree, scene.meshes[i], static_cast<unsigned>(i));
  // One thread makes the tree repeatable. Not by the device option "threads=1": that limits the whole
  // process.
  tbb::task_arena(1).execute([&] { rtcCommitScene(state_->embree); });
  const RTCError error = rtcGetDeviceError(state_->device);
  PLENOLAB_CHECK(error == RTC_ERROR_NONE, fmt::format("Embree error {}", static_cast<int>(error)));
}

RayScene::~RayScene() = default;

bool RayScene::intersect(const Ray& ray, Hit& hit) const {
  const RTCRayHit query = cast(state_->embree, ray);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const Mesh& mesh = state_->scene->meshes[query.hit.geomID];
  const auto& corner = mesh.triangles[query.hit.primID];
  const float b = query.hit.u, c = query.hit.v, a = 1.0f - b - c;
  const Vec3& p0 = mesh.positions_m[corner[0]];
  const Vec3 e1 = mesh.positions_m[corner[1]] - p0, e2 = mesh.positions_m[corner[2]] - p0;

  hit.distance_m = query.ray.tfar;
  hit.point.position_m = p0 + b * e1 + c * e2;
  hit.geometric_normal = unit_normal(e1, e2);
  hit.front = hit.geometric_normal.dot(ray.direction) < 0;
  if (!hit.front) hit.geometric_normal = -hit.geometric_normal;
  hit.point.normal = hit.geometric_normal;
  if (!mesh.normals.empty()) {
    const Vec3 sum = a * mesh.normals[corner[0]] + b * mesh.normals[corner[1]] + c * mesh.normals[corner[2]];
    const float length = sum.norm();
    if (length > 1e-6f) hit.point.normal = sum / length;
    if (hit.point.normal.dot(hit.geometric_normal) < 0) hit.point.normal = -hit.point.normal;
  }
  hit.point.u = hit.point.v = 0;
  if (!mesh.uvs.empty()) {
    const auto &t0 = mesh.uvs[corner[0]], &t1 = mesh.uvs[corner[1]], &t2 = mesh.uvs[corner[2]];
    hit.point.u = a * t0[0] + b * t1[0] + c * t2[0];
    hit.point.v = a * t0[1] + b * t1[1] + c * t2[1];
  }
  hit.material = &state_->scene->materials[static_cast<std::size_t>(mesh.material)];
  return true;
}

float RayScene::distance(const Ray& ray) const {
  const RTCRayHit query = cast(state_->embree, ray);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                     : query.ray.tfar;
}

bool RayScene::occluded(const Ray& ray, float distance_m) const {
  RTCRay query = embree_ray(ray, distance_m);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->embree, &context, &query);
  return query.tfar < 0;
}

Vec3 offset_origin(const Vec3& position_m, const Vec3& geometric_normal, const Vec3& direction) {
  // A few units in the last place of the largest coordinate, well above the rounding of interpolated
  // positions.
  const float step = 1e-5f * std::max(1.0f, position_m.cwiseAbs().maxCoeff());
  return position_m + (direction.dot(geometric_normal) >= 0 ? step : -step) * geometric_normal;
}

}  // namespace plenolab::tracer
