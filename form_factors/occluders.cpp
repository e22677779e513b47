#include "form_factors/occluders.hpp"

#include "foundation/error.hpp"
#include "foundation/stopwatch.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {

struct Occluders::Tracer {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Tracer() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

/// A ray's end is as uncertain as its direction: without the last bits of its length it does not meet the
/// surface that it was aimed at.
constexpr float segment_end = 1 - 0x1p-21F;

void fill_ray(const RayPacket& packet, RTCRay16& ray, float far) {
  for (int k = 0; k < RayPacket::size; ++k) {
    ray.org_x[k] = packet.origin_x[k];
    ray.org_y[k] = packet.origin_y[k];
    ray.org_z[k] = packet.origin_z[k];
    ray.dir_x[k] = packet.target_x[k] - packet.origin_x[k];
    ray.dir_y[k] = packet.target_y[k] - packet.origin_y[k];
    ray.dir_z[k] = packet.target_z[k] - packet.origin_z[k];
    ray.tnear[k] = 0;
    ray.tfar[k] = far;
    ray.time[k] = 0;
    ray.mask[k] = ~0U;
    ray.id[k] = 0;
    ray.flags[k] = 0;
  }
}

void initialize(RTCIntersectContext& context, bool coherent) {
  rtcInitIntersectContext(&context);
  context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

}  // namespace

std::vector<ConvexPolygon> coarse_faces(const PatchMesh& mesh, const PatchGeometry& geometry) {
  std::vector<ConvexPolygon> faces;
  for (const Face& face : mesh.scene->faces) {
    ConvexPolygon polygon;
    for (int k = 0; k < face.corner_count; ++k) polygon.add(geometry.scaled(corner(*mesh.scene, face, k)));
    faces.push_back(polygon.area_vector().norm() > 1e-16 ? polygon : ConvexPolygon{});
  }
  return faces;
}

// Face f is the triangles 2 f and 2 f + 1, degenerate where it needs fewer: so a hit names its face.
Occluders::Occluders(const std::vector<ConvexPolygon>& faces) : tracer_(std::make_unique<Tracer>()) {
  // A number of threads given here would hold for the whole process as long as the device lives.
  tracer_->device = rtcNewDevice(nullptr);
  if (!tracer_->device)
    fail("the ray tracer (Embree) did not start: error {}", static_cast<int>(rtcGetDeviceError(nullptr)));
  tracer_->scene = rtcNewScene(tracer_->device);
  rtcSetSceneFlags(tracer_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tracer_->scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry triangles = rtcNewGeometry(tracer_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t count = std::max<std::size_t>(1, faces.size());
  auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * count));
  auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 2 * count));
  std::fill(vertices, vertices + 12 * count, 0.0F);
  std::fill(indices, indices + 6 * count, 0U);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const ConvexPolygon& face = faces[f];
    const auto first = static_cast<unsigned>(4 * f);
    for (int k = 0; k < face.corner_count(); ++k)
      for (int axis = 0; axis < 3; ++axis)
        vertices[12 * f + static_cast<std::size_t>(3 * k + axis)] = static_cast<float>(face[k][axis]);
    for (int t = 0; t + 2 < face.corner_count(); ++t)
      for (unsigned c = 0; c < 3; ++c)
        indices[6 * f + 3 * static_cast<std::size_t>(t) + c] =
            first + (c == 0 ? 0U : static_cast<unsigned>(t) + c);
    const Eigen::Vector3d area = face.area_vector();
    face_normals_.push_back(area.norm() > 0 ? Eigen::Vector3f(area.normalized().cast<float>())
                                            : Eigen::Vector3f(Eigen::Vector3f::Zero()));
  }
  rtcCommitGeometry(triangles);
  rtcAttachGeometry(tracer_->scene, triangles);
  rtcReleaseGeometry(triangles);
  rtcCommitScene(tracer_->scene);
  find_blockers(faces);
}

Occluders::~Occluders() = default;

// A face whose plane has all faces on one side is never crossed between two of their points.
void Occluders::find_blockers(const std::vector<ConvexPolygon>& faces) {
  std::vector<Eigen::Vector3d> points;
  for (const ConvexPolygon& face : faces)
    for (int k = 0; k < face.corner_count(); ++k) points.push_back(face[k]);
  for (const ConvexPolygon& face : faces) {
    if (face.corner_count() < 3) continue;
    Plane plane{face.area_vector().normalized(), 0};
    plane.offset = plane.normal.dot(face[0]);
    bool in_front = false, behind = false;
    for (const Eigen::Vector3d& point : points) {
      const double height = plane.height(point);
      in_front |= height > coplanar_slack;
      behind |= height < -coplanar_slack;
      if (in_front && behind) break;
    }
    if (in_front && behind) blockers_.emplace_back(face);
  }
}

void Occluders::trace(RayPacket& packet) const {
  RTCRay16 ray;
  fill_ray(packet, ray, segment_end);
  RTCIntersectContext context;
  initialize(context, true);
  rtcOccluded16(packet.active, tracer_->scene, &context, &ray);
  for (int k = 0; k < RayPacket::size; ++k) packet.blocked[k] = ray.tfar[k] < 0 ? 1 : 0;
}

double Occluders::tracing_seconds(std::span<const RayPacket> packets) const {
  constexpr std::size_t batch = 512;  // stays in the cache
  std::vector<RTCRay16> rays(std::min(batch, packets.size()));
  double seconds = 0;
  for (std::size_t begin = 0; begin < packets.size(); begin += batch) {
    const std::size_t count = std::min(batch, packets.size() - begin);
    for (std::size_t k = 0; k < count; ++k) fill_ray(packets[begin + k], rays[k], segment_end);
    RTCIntersectContext context;
    initialize(context, true);
    const Stopwatch watch;
    for (std::size_t k = 0; k < count; ++k)
      rtcOccluded16(packets[begin + k].active, tracer_->scene, &context, &rays[k]);
    seconds += watch.thread_cpu_seconds();
  }
  return seconds;
}

void Occluders::first_hits(const RayPacket& packet, RayHit* hits) const {
  RTCRayHit16 query;
  fill_ray(packet, query.ray, std::numeric_limits<float>::infinity());
  for (int k = 0; k < RayPacket::size; ++k) {
    query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  initialize(context, false);
  rtcIntersect16(packet.active, tracer_->scene, &context, &query);
  for (int k = 0; k < RayPacket::size; ++k) {
    hits[k] = {};
    if (!packet.active[k] || query.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
    hits[k].face = static_cast<int>(query.hit.primID[k] / 2);
    const Eigen::Vector3f& normal = face_normals_[static_cast<std::size_t>(hits[k].face)];
    const Eigen::Vector3f direction(query.ray.dir_x[k], query.ray.dir_y[k], query.ray.dir_z[k]);
    hits[k].front = direction.dot(normal) < 0;
  }
}

}  // namespace radiosity
