#include "scenes/pictures/ray_scene.h"

#include <tact/error.h>

#include <Eigen/Geometry>
#include <limits>
#include <string>

#include "narrowphase/pairs/embree.h"

namespace tact::scenes {

struct RayScene::Implementation {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::uint32_t meshes = 0;
  bool any_facet = false;
  Eigen::AlignedBox3f box;  // around all meshes

  Implementation() : device(rtcNewDevice("threads=1")) {
    if (device == nullptr) throw_error(rtcGetDeviceError(nullptr));
    scene = rtcNewScene(device);
  }
  ~Implementation() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  // Most rays of a picture miss everything, and this tells it in a tenth of the time that Embree needs.
  bool passes(const Ray& ray) const {
    const Eigen::Array3f inverse = ray.direction.array().inverse();
    const Eigen::Array3f lower = (box.min() - ray.origin).array() * inverse;
    const Eigen::Array3f upper = (box.max() - ray.origin).array() * inverse;
    const float enter = lower.min(upper).maxCoeff();
    const float leave = lower.max(upper).minCoeff();
    // NaN, of a ray within a plane of the box, passes.
    return !(enter > leave) && !(leave < ray.nearest);
  }

  void check() const {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) throw_error(error);
  }
  [[noreturn]] static void throw_error(RTCError error) {
    if (error == RTC_ERROR_OUT_OF_MEMORY)
      throw Error(ErrorCode::out_of_memory, "Embree ran out of memory for a picture");
    throw Error(ErrorCode::backend_failure,
                "Embree failed on a picture, code " + std::to_string(static_cast<int>(error)));
  }
};

RayScene::RayScene() : implementation_(std::make_unique<Implementation>()) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::add_mesh(const Eigen::Matrix3Xf& positions, const Eigen::Matrix3Xi& facets) {
  Implementation& self = *implementation_;
  const std::uint32_t number = self.meshes++;
  if (facets.cols() == 0) return;
  RTCGeometry geometry = rtcNewGeometry(self.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(positions.cols())));
  auto* indices = static_cast<int*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                            3 * sizeof(int), static_cast<std::size_t>(facets.cols())));
  if (vertices != nullptr && indices != nullptr) {
    Eigen::Map<Eigen::Matrix3Xf>(vertices, 3, positions.cols()) = positions;
    Eigen::Map<Eigen::Matrix3Xi>(indices, 3, facets.cols()) = facets;
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(self.scene, geometry, number);
  }
  rtcReleaseGeometry(geometry);
  self.check();
  self.any_facet = true;
  self.box.extend(positions.rowwise().minCoeff());
  self.box.extend(positions.rowwise().maxCoeff());
}

void RayScene::commit() {
  // Room for rounding in the test against the box.
  constexpr float kRoom = 1e-4f;
  if (!empty()) {
    const Eigen::Vector3f room = Eigen::Vector3f::Constant(kRoom * (1.0f + implementation_->box.sizes().maxCoeff()));
    implementation_->box.min() -= room;
    implementation_->box.max() += room;
  }
  rtcCommitScene(implementation_->scene);
  implementation_->check();
}

bool RayScene::empty() const { return !implementation_->any_facet; }

std::optional<RayHit> RayScene::closest(const Ray& ray) const {
  if (empty() || !implementation_->passes(ray)) return std::nullopt;
  RTCRayHit query{};
  query.ray.org_x = ray.origin.x();
  query.ray.org_y = ray.origin.y();
  query.ray.org_z = ray.origin.z();
  query.ray.dir_x = ray.direction.x();
  query.ray.dir_y = ray.direction.y();
  query.ray.dir_z = ray.direction.z();
  query.ray.tnear = ray.nearest;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(implementation_->scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1(implementation_->scene, &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return RayHit{.distance = query.ray.tfar,
                .mesh = query.hit.geomID,
                .facet = query.hit.primID,
                .weights = {1.0f - query.hit.u - query.hit.v, query.hit.u, query.hit.v},
                .normal = Eigen::Vector3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized()};
}

unsigned RayScene::hits(const RayBundle& bundle) const {
  if (empty()) return 0;
  alignas(32) int valid[kBundle];
  RTCRay8 rays{};
  for (int i = 0; i < kBundle; ++i) {
    valid[i] = -1;
    rays.org_x[i] = bundle.origin.x();
    rays.org_y[i] = bundle.origin.y();
    rays.org_z[i] = bundle.origin.z();
    const Eigen::Vector3f& direction = bundle.directions[i];
    rays.dir_x[i] = direction.x();
    rays.dir_y[i] = direction.y();
    rays.dir_z[i] = direction.z();
    rays.tfar[i] = bundle.farthest;
    rays.mask[i] = ~0u;
  }
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded8(valid, implementation_->scene, &rays);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded8(valid, implementation_->scene, &context, &rays);
#endif
  unsigned hit = 0;
  for (int i = 0; i < kBundle; ++i) hit |= rays.tfar[i] < 0.0f ? 1u << i : 0u;
  return hit;
}

}  // namespace tact::scenes
