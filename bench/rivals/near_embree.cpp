// Contact points from trees of facets' boxes by Embree.
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "bench/meeting_lists.h"
#include "bench/rivals/near_bodies.h"
#include "bench/rivals/nearest_in_triangle.h"
#include "narrowphase/pairs/embree.h"

namespace tact::bench {
namespace {

void store_outward(const Box& box, RTCBounds& bounds) {
  const auto out = [](double x, double sign) {
    const auto f = static_cast<float>(x);
    return static_cast<float>(f + sign * (std::abs(f) * 0x1p-23 + 0x1p-126));
  };
  bounds.lower_x = out(box.lower.x, -1.0), bounds.upper_x = out(box.upper.x, 1.0);
  bounds.lower_y = out(box.lower.y, -1.0), bounds.upper_y = out(box.upper.y, 1.0);
  bounds.lower_z = out(box.lower.z, -1.0), bounds.upper_z = out(box.upper.z, 1.0);
}

// A tree a body, refitted in every frame. rtcCollide calls back from as many threads as it likes, whatever the device
// was told, so they are limited: the list is not made for two, and what is timed is one thread.
class EmbreeNear : public NearBase {
 public:
  EmbreeNear(const Workload& workload, const std::vector<double>& margins)
      : NearBase(workload, margins), device_(rtcNewDevice("threads=1")) {
    for (const auto& body : bodies_) {
      const RTCScene scene = rtcNewScene(device_);
      rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
      rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
      const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
      rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(body->mesh.facet_count()));
      rtcSetGeometryUserData(geometry, body.get());
      rtcSetGeometryBoundsFunction(
          geometry,
          [](const RTCBoundsFunctionArguments* arguments) {
            store_outward(static_cast<const NearBody*>(arguments->geometryUserPtr)->boxes[arguments->primID],
                          *arguments->bounds_o);
          },
          nullptr);
      rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);  // the scene holds it
      rtcCommitScene(scene);
      scenes_.push_back(scene);
      geometries_.push_back(geometry);
    }
    check();
  }
  ~EmbreeNear() override {
    for (const RTCScene scene : scenes_) rtcReleaseScene(scene);
    rtcReleaseDevice(device_);
  }

  void step(int frame) override {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    NearBase::step(frame);
  }

 protected:
  void check() const {
    const RTCError error = rtcGetDeviceError(device_);
    if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree reports error " + std::to_string(error));
  }
  void moved(std::size_t body) override {
    rtcCommitGeometry(geometries_[body]);
    rtcCommitScene(scenes_[body]);
  }
  void propose(std::size_t a, std::size_t b, FacetPoints& points) override { collide(a, b, points, nullptr); }
  /// Finds the points of two bodies; and if it is asked, whether any of their facets meet.
  void collide(std::size_t a, std::size_t b, FacetPoints& points, bool* meet) {
    struct Query {
      const NearBody &a, &b;
      FacetPoints& points;
      bool* meet;
    } query{*bodies_[a], *bodies_[b], points, meet};
    for (int f = 0; a == b && f < query.a.mesh.facet_count(); ++f) points.find(f, f);
    rtcCollide(
        scenes_[a], scenes_[b],
        [](void* data, RTCCollision* collisions, unsigned count) {
          const Query& q = *static_cast<const Query*>(data);
          for (unsigned k = 0; k < count; ++k) {
            const unsigned i = collisions[k].primID0, j = collisions[k].primID1;
            if (&q.a == &q.b && i >= j) continue;  // of one scene both orders come
            if (!base::overlaps(q.a.boxes[i], q.b.boxes[j])) continue;
            const auto f = static_cast<int>(i), g = static_cast<int>(j);
            q.points.find(f, g);
            if (q.meet != nullptr && !*q.meet)
              *q.meet = facets_meet_plainly(q.a.mesh.triangle(f), q.b.mesh.triangle(g));
          }
        },
        &query);
    check();
  }

  RTCDevice device_;
  std::vector<RTCScene> scenes_;
  std::vector<RTCGeometry> geometries_;
};

// Does a segment cross a triangle? By the signs of plain doubles: right where nothing hangs on rounding.
bool crosses(const Vec3& p, const Vec3& q, const narrowphase::Triangle& t) {
  if ((volume(t[0], t[1], t[2], p) > 0.0) == (volume(t[0], t[1], t[2], q) > 0.0)) return false;
  const bool first = volume(p, q, t[0], t[1]) > 0.0;
  return (volume(p, q, t[1], t[2]) > 0.0) == first && (volume(p, q, t[2], t[0]) > 0.0) == first;
}

// Rays count the facets that they cross, point queries find the nearest one. Both are decided in doubles; the boxes are
// grown by the margins, which is far more than what a ray loses in floats.
class SignedEmbreeNear : public EmbreeNear {
 public:
  SignedEmbreeNear(const Workload& workload, const std::vector<double>& margins) : EmbreeNear(workload, margins) {
    for (const RTCGeometry geometry : geometries_) rtcSetGeometryOccludedFunction(geometry, count_crossing);
    for (std::size_t k = 0; k < bodies_.size(); ++k) moved(k);
    check();
  }

  void step(int frame) override {
    crossed_.clear();
    EmbreeNear::step(frame);
  }
  std::vector<CrossedVertex> crossed() const override {
    std::vector<CrossedVertex> all = crossed_;
    std::ranges::sort(all, {}, &CrossedVertex::key);
    return all;
  }

 private:
  struct Sight {
    RTCIntersectContext context;  // the first member: Embree hands it back
    Vec3 from, to;
    int count = 0;
  };
  struct Nearest {
    const NearBody& body;
    Vec3 from;
    double distance;
  };

  void propose(std::size_t a, std::size_t b, FacetPoints& points) override {
    bool meet = false;
    collide(a, b, points, &meet);
    if (!meet) return;
    find_inside(a, b, a, b, FeaturePair::vertex_facet);
    find_inside(b, a, a, b, FeaturePair::facet_vertex);
  }
  void find_inside(std::size_t own, std::size_t other, std::size_t a, std::size_t b, FeaturePair kind) {
    if (workload_.bodies[other].surface != Surface::closed) return;
    const ClusteredMesh& mesh = bodies_[own]->mesh;
    const Box& box = bodies_[other]->mesh.box();
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 at = mesh.position(v);
      if (base::contains(box, at) && is_inside(other, at))
        crossed_.push_back(
            {static_cast<int>(a), static_cast<int>(b), kind, mesh.source_vertex(v), distance_to(other, at)});
    }
  }
  bool is_inside(std::size_t body, const Vec3& from) {
    const Box& box = bodies_[body]->mesh.box();
    const Vec3 size = box.upper - box.lower;
    // Along nothing that meshes are made along, to beyond the body.
    const Vec3 way = 2.0 * (size.x + size.y + size.z) * Vec3{0.5131, 0.6211, 0.5925};
    Sight sight{.context = {}, .from = from, .to = from + way};
    rtcInitIntersectContext(&sight.context);
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x), ray.dir_x = static_cast<float>(way.x);
    ray.org_y = static_cast<float>(from.y), ray.dir_y = static_cast<float>(way.y);
    ray.org_z = static_cast<float>(from.z), ray.dir_z = static_cast<float>(way.z);
    ray.tfar = 1.0F;
    ray.mask = ~0U;
    rtcOccluded1(scenes_[body], &sight.context, &ray);
    return sight.count % 2 == 1;
  }
  static void count_crossing(const RTCOccludedFunctionNArguments* arguments) {
    Sight& sight = *reinterpret_cast<Sight*>(arguments->context);
    const NearBody& body = *static_cast<const NearBody*>(arguments->geometryUserPtr);
    sight.count += crosses(sight.from, sight.to, body.mesh.triangle(static_cast<int>(arguments->primID)));
  }
  double distance_to(std::size_t body, const Vec3& from) {
    Nearest nearest{*bodies_[body], from, std::numeric_limits<double>::infinity()};
    RTCPointQuery query{static_cast<float>(from.x), static_cast<float>(from.y), static_cast<float>(from.z), 0.0F,
                        std::numeric_limits<float>::infinity()};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scenes_[body], &query, &context, take_nearer, &nearest);
    return nearest.distance;
  }
  static bool take_nearer(RTCPointQueryFunctionArguments* arguments) {
    Nearest& nearest = *static_cast<Nearest*>(arguments->userPtr);
    const narrowphase::Triangle t = nearest.body.mesh.triangle(static_cast<int>(arguments->primID));
    const auto point = [](const Vec3& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
    const Eigen::Vector3d from = point(nearest.from);
    const double distance = (nearest_in_triangle(from, point(t[0]), point(t[1]), point(t[2])) - from).norm();
    if (distance >= nearest.distance) return false;
    nearest.distance = distance;
    arguments->query->radius = static_cast<float>(distance * (1.0 + 0x1p-20));
    return true;
  }

  std::vector<CrossedVertex> crossed_;
};

}  // namespace

std::unique_ptr<NearRival> make_near_embree(const Workload& workload, const std::vector<double>& margins) {
  return std::make_unique<EmbreeNear>(workload, margins);
}

std::unique_ptr<NearRival> make_signed_embree(const Workload& workload, const std::vector<double>& margins) {
  return std::make_unique<SignedEmbreeNear>(workload, margins);
}

}  // namespace tact::bench
