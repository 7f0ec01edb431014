// Embree asked for rays and nearest points as its manual says for deforming meshes: triangles in a dynamic scene of low
// build quality, geometry of refit quality, vertices in its own buffer of floats. rtcPointQuery() leaves the distance
// from a triangle to the caller: it is computed in floats, as the rest of Embree is.
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "bench/rivals/nearest_in_triangle.h"
#include "bench/rivals/query_rival.h"
#include "narrowphase/pairs/embree.h"

namespace tact::bench {
namespace {

using Eigen::Vector3f;

class EmbreeQueries : public QueryRival {
 public:
  EmbreeQueries(const WorkloadBody& body, int threads)
      : body_(body),
        threads_(threads),
        device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())),
        scene_(rtcNewScene(device_)),
        geometry_(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryBuildQuality(geometry_, RTC_BUILD_QUALITY_REFIT);
    const auto vertices = static_cast<std::size_t>(body.frames[0].cols());
    const auto facets = static_cast<std::size_t>(body.facets.cols());
    vertices_ = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
    auto* corners = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), facets));
    if (!vertices_ || !corners) throw std::runtime_error("Embree has no memory for its buffers");
    std::copy_n(body.facets.data(), 3 * facets, corners);
    rtcAttachGeometry(scene_, geometry_);
    refit(body.frames[0]);
  }
  ~EmbreeQueries() override {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void refit(const Eigen::Matrix3Xd& positions) override {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
    const double* from = positions.data();
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, positions.size(), 4096), [&](const auto& range) {
      for (Eigen::Index i = range.begin(); i < range.end(); ++i) vertices_[i] = static_cast<float>(from[i]);
    });
    rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree reports an error");
  }

  bool ask(std::span<const Ray> rays) override {
    for_each(rays.size(), [&](std::size_t i) {
      const Vector3f from = rays[i].from.cast<float>(), way = (rays[i].to - rays[i].from).cast<float>();
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit one{};
      one.ray.org_x = from.x(), one.ray.org_y = from.y(), one.ray.org_z = from.z();
      one.ray.dir_x = way.x(), one.ray.dir_y = way.y(), one.ray.dir_z = way.z();
      one.ray.tfar = 1.0F;
      one.ray.mask = ~0U;
      one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &one);
      if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        answers_[i] = {};
      } else {
        answers_[i] = {static_cast<int>(one.hit.primID), static_cast<double>(one.ray.tfar * way.norm())};
      }
    });
    return true;
  }

  void ask(std::span<const PointQuery> points) override {
    for_each(points.size(), [&](std::size_t i) {
      const Vector3f p = points[i].point.cast<float>();
      RTCPointQuery query{p.x(), p.y(), p.z(), 0.0F, std::numeric_limits<float>::infinity()};
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      Nearest nearest{this, -1};
      rtcPointQuery(scene_, &query, &context, take_nearer, &nearest);
      answers_[i] = {nearest.facet, static_cast<double>(query.radius)};
    });
  }

  const std::vector<QueryAnswer>& answers() const override { return answers_; }

 private:
  struct Nearest {
    const EmbreeQueries* self;
    int facet;
  };

  static bool take_nearer(RTCPointQueryFunctionArguments* arguments) {
    Nearest& nearest = *static_cast<Nearest*>(arguments->userPtr);
    const EmbreeQueries& self = *nearest.self;
    const int* corner = self.body_.facets.data() + 3 * static_cast<std::ptrdiff_t>(arguments->primID);
    const auto at = [&](int k) { return Eigen::Map<const Vector3f>(self.vertices_ + 3 * corner[k]); };
    RTCPointQuery& query = *arguments->query;
    const Vector3f p(query.x, query.y, query.z);
    const float distance = (nearest_in_triangle<float>(p, at(0), at(1), at(2)) - p).norm();
    if (distance >= query.radius) return false;
    query.radius = distance;
    nearest.facet = static_cast<int>(arguments->primID);
    return true;
  }

  template <class Answer>
  void for_each(std::size_t count, const Answer& answer) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
    answers_.resize(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) answer(i);
    });
  }

  const WorkloadBody& body_;
  int threads_;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_;
  float* vertices_ = nullptr;
  std::vector<QueryAnswer> answers_;
};

}  // namespace

std::unique_ptr<QueryRival> make_embree_queries(const WorkloadBody& body, int threads) {
  return std::make_unique<EmbreeQueries>(body, threads);
}

}  // namespace tact::bench
