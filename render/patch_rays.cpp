#include "render/patch_rays.hpp"

#include "foundation/error.hpp"
#include "render/bounding_box.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>

namespace radiosity {
namespace {

/// In units of the scaled scene (radius 1), where float32 positions are good to 6e-8.
constexpr double scaled_lift = 1e-6;

/// The context of a ray that looks through backs; Embree hands it to the filter below.
struct FrontsOnly {
  RTCIntersectContext context;  // first, so that a pointer to it is a pointer to the whole
  const std::vector<Index>* patch_of_triangle;
  const Eigen::Matrix3Xd* normal;
  Vector3 direction;
};

void reject_backs(const RTCFilterFunctionNArguments* arguments) {
  const auto* fronts = reinterpret_cast<const FrontsOnly*>(arguments->context);
  const unsigned triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
  const Index patch = (*fronts->patch_of_triangle)[triangle];
  if (fronts->normal->col(patch).dot(fronts->direction) >= 0) arguments->valid[0] = 0;
}

RTCRay make_ray(const Vector3& origin, const Vector3& direction, float near, float far) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = near;
  ray.tfar = far;
  ray.time = 0;
  ray.mask = ~0U;
  ray.id = 0;
  ray.flags = 0;
  return ray;
}

RTCRayHit make_query(const Vector3& origin, const Vector3& direction, float near, float far) {
  RTCRayHit query{};
  query.ray = make_ray(origin, direction, near, far);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.primID = RTC_INVALID_GEOMETRY_ID;
  for (unsigned& instance : query.hit.instID) instance = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

struct PatchRays::Implementation {
  explicit Implementation(const PatchMesh& patches);
  ~Implementation() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void fit_into_unit_ball();
  void add_geometry();

  Vector3 scaled(const Vector3& point) const { return (point - centre) * scale; }

  /// Where a ray from a patch starts: above it, and as far towards its middle, off the walls that meet it at
  /// its edges.
  Vector3 lifted(Index patch, const Vector3& point) const {
    const Vector3 inwards = (mesh.centroid.col(patch) - point).normalized();
    return scaled(point) + scaled_lift * (mesh.normal.col(patch) + inwards);
  }

  /// The first front between `near` and `far` (scaled units along the unit vector `direction`), -1 if there
  /// is none.
  Index front_between(const Vector3& scaled_origin, const Vector3& direction, float near, float far) const;
  PatchHit hit_on(Index patch, bool front, const Vector3& scaled_origin, const Vector3& direction) const;

  const PatchMesh& mesh;
  Vector3 centre = Vector3::Zero();
  double scale = 1;
  std::vector<Index> patch_of_triangle;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

PatchRays::Implementation::Implementation(const PatchMesh& patches) : mesh(patches) {
  fit_into_unit_ball();
  device = rtcNewDevice(nullptr);
  if (!device)
    fail("the ray tracing library could not be started (Embree error {})",
         static_cast<int>(rtcGetDeviceError(nullptr)));
  scene = rtcNewScene(device);
  rtcSetSceneFlags(
      scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  add_geometry();
  rtcCommitScene(scene);
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
    fail("the ray tracing library could not take the scene's {} patches (Embree error {})",
         mesh.patch_count(), static_cast<int>(error));
}

void PatchRays::Implementation::fit_into_unit_ball() {
  if (mesh.patches.empty()) return;
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  centre = box.center();
  scale = 2 / box.diagonal().norm();
}

void PatchRays::Implementation::add_geometry() {
  std::vector<std::array<unsigned, 3>> triangles;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Patch& patch = mesh.patches[static_cast<std::size_t>(i)];
    for (int k = 2; k < patch.corner_count; ++k) {
      triangles.push_back({static_cast<unsigned>(patch.corners[0]),
                           static_cast<unsigned>(patch.corners[static_cast<std::size_t>(k - 1)]),
                           static_cast<unsigned>(patch.corners[static_cast<std::size_t>(k)])});
      patch_of_triangle.push_back(i);
    }
  }
  if (triangles.empty()) return;

  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles.size()));
  if (vertices && indices) {
    for (const Vector3& vertex : mesh.vertices) {
      const Vector3 position = scaled(vertex);
      for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(position[axis]);
    }
    for (const auto& triangle : triangles)
      for (const unsigned corner : triangle) *indices++ = corner;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
  }
  rtcReleaseGeometry(geometry);
}

Index PatchRays::Implementation::front_between(const Vector3& scaled_origin, const Vector3& direction,
                                               float near, float far) const {
  FrontsOnly fronts{};
  rtcInitIntersectContext(&fronts.context);
  fronts.context.filter = reject_backs;
  fronts.patch_of_triangle = &patch_of_triangle;
  fronts.normal = &mesh.normal;
  fronts.direction = direction;
  RTCRayHit query = make_query(scaled_origin, direction, near, far);
  rtcIntersect1(scene, &fronts.context, &query);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1 : patch_of_triangle[query.hit.primID];
}

PatchHit PatchRays::Implementation::hit_on(Index patch, bool front, const Vector3& scaled_origin,
                                           const Vector3& direction) const {
  const Vector3 origin = scaled_origin / scale + centre;
  const Vector3 normal = mesh.normal.col(patch);
  const double distance = (mesh.corner(patch, 0) - origin).dot(normal) / direction.dot(normal);
  return {patch, front, origin + distance * direction};
}

PatchRays::PatchRays(const PatchMesh& mesh) : implementation_(std::make_unique<Implementation>(mesh)) {}
PatchRays::~PatchRays() = default;

double PatchRays::lift() const {
  return scaled_lift / implementation_->scale;
}

PatchHit PatchRays::from_patch(Index patch, const Vector3& point, const Vector3& direction) const {
  const Implementation& self = *implementation_;
  const Vector3 origin = self.lifted(patch, point);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = make_query(origin, direction, 0, std::numeric_limits<float>::infinity());
  rtcIntersect1(self.scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};

  const Index hit = self.patch_of_triangle[query.hit.primID];
  if (self.mesh.normal.col(hit).dot(direction) < 0) return self.hit_on(hit, true, origin, direction);
  constexpr auto around = static_cast<float>(2 * scaled_lift);
  const Index twin =
      self.front_between(origin, direction, std::max(0.0F, query.ray.tfar - around), query.ray.tfar + around);
  if (twin >= 0) return self.hit_on(twin, true, origin, direction);
  return self.hit_on(hit, false, origin, direction);
}

PatchHit PatchRays::first_front(const Vector3& origin, const Vector3& direction) const {
  const Implementation& self = *implementation_;
  const Vector3 scaled_origin = self.scaled(origin);
  const Index patch = self.front_between(scaled_origin, direction, 0, std::numeric_limits<float>::infinity());
  if (patch < 0) return {};
  return self.hit_on(patch, true, scaled_origin, direction);
}

bool PatchRays::blocked(Index patch_a, const Vector3& a, Index patch_b, const Vector3& b) const {
  const Implementation& self = *implementation_;
  const Vector3 from = self.lifted(patch_a, a);
  const Vector3 to = self.lifted(patch_b, b);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(from, to - from, 0, 1);
  rtcOccluded1(self.scene, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace radiosity
