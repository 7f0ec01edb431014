// Embree used directly for collisions: user geometry, the only kind that rtcCollide takes, in scenes that are refitted
// (dynamic, of low build quality, geometry of refit quality: other settings rebuild in every commit). Boxes are rounded
// outward to floats without nextafterf(), which would cost twice the rest. What rtcCollide proposes is decided exactly.
#include "narrowphase/pairs/embree.h"

#include <emmintrin.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "bench/meeting_lists.h"
#include "bench/rivals/rival.h"

namespace tact::bench {
namespace {

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree reports error " + std::to_string(error));
}

class Device {
 public:
  explicit Device(int threads) : device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())) {
    check(device_);
  }
  ~Device() { rtcReleaseDevice(device_); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  operator RTCDevice() const { return device_; }

 private:
  RTCDevice device_;
};

class Scene {
 public:
  explicit Scene(const Device& device) : scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
  }
  ~Scene() { rtcReleaseScene(scene_); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  operator RTCScene() const { return scene_; }

  // The geometry's number is the count of those attached before.
  RTCGeometry attach(const Device& device, int primitives, RTCBoundsFunction bounds, void* data) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(primitives));
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcSetGeometryUserData(geometry, data);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);  // the scene holds it
    return geometry;
  }

 private:
  RTCScene scene_;
};

// The two nearest floats may lie half a step inside; |f| / 2^23 is at least a whole step, and the least normal number
// stands in where that vanishes.
void store_outward(__m128 lower, __m128 upper, RTCBounds& bounds) {
  const __m128 sign = _mm_set1_ps(-0.0F), step = _mm_set1_ps(0x1p-23F), least = _mm_set1_ps(0x1p-126F);
  const auto margin = [&](__m128 f) { return _mm_add_ps(_mm_mul_ps(_mm_andnot_ps(sign, f), step), least); };
  _mm_storeu_ps(&bounds.lower_x, _mm_sub_ps(lower, margin(lower)));
  _mm_storeu_ps(&bounds.upper_x, _mm_add_ps(upper, margin(upper)));
}

void facet_bounds(const RTCBoundsFunctionArguments* arguments) {
  const MeshView& mesh = *static_cast<const MeshView*>(arguments->geometryUserPtr);
  const int* corner = mesh.facets + 3 * static_cast<std::ptrdiff_t>(arguments->primID);
  const double* p = mesh.positions + 3 * corner[0];
  const double* q = mesh.positions + 3 * corner[1];
  const double* r = mesh.positions + 3 * corner[2];
  const __m128d pxy = _mm_loadu_pd(p), qxy = _mm_loadu_pd(q), rxy = _mm_loadu_pd(r);
  const __m128d pz = _mm_load_sd(p + 2), qz = _mm_load_sd(q + 2), rz = _mm_load_sd(r + 2);
  const __m128 lower = _mm_movelh_ps(_mm_cvtpd_ps(_mm_min_pd(_mm_min_pd(pxy, qxy), rxy)),
                                     _mm_cvtpd_ps(_mm_min_pd(_mm_min_pd(pz, qz), rz)));
  const __m128 upper = _mm_movelh_ps(_mm_cvtpd_ps(_mm_max_pd(_mm_max_pd(pxy, qxy), rxy)),
                                     _mm_cvtpd_ps(_mm_max_pd(_mm_max_pd(pz, qz), rz)));
  store_outward(lower, upper, *arguments->bounds_o);
}

// What rtcCollide proposes, decided and kept. Embree may call back from several threads.
class Answers {
 public:
  Answers(const std::vector<MeshView>& meshes, TriangleTest test) : meshes_(meshes), test_(test) {}

  void clear() {
    for (std::vector<FacetMeeting>& list : lists_) list.clear();
  }
  std::vector<FacetMeeting> sorted() const {
    std::vector<FacetMeeting> all;
    for (const std::vector<FacetMeeting>& list : lists_) all.insert(all.end(), list.begin(), list.end());
    std::sort(all.begin(), all.end());
    return all;
  }
  void decide(int body_a, int facet_a, int body_b, int facet_b, std::vector<FacetMeeting>& list) const {
    const MeshView& a = meshes_[body_a];
    const MeshView& b = meshes_[body_b];
    if (facets_meet(a, facet_a, b, facet_b, test_)) list.push_back({body_a, body_b, facet_a, facet_b});
  }
  std::vector<FacetMeeting>& of_this_thread() { return lists_.local(); }
  const MeshView& mesh(int body) const { return meshes_[body]; }

 private:
  const std::vector<MeshView>& meshes_;
  TriangleTest test_;
  tbb::enumerable_thread_specific<std::vector<FacetMeeting>> lists_;
};

std::vector<MeshView> first_views(const Workload& workload) {
  std::vector<MeshView> views;
  for (const WorkloadBody& body : workload.bodies) views.push_back(view_of(body, 0));
  return views;
}

// The bodies' boxes, in a scene of their own if there are many.
class BodySweep {
 public:
  using Pair = std::pair<int, int>;

  BodySweep(const Device& device, std::size_t count) : boxes_(count), scene_(device) {
    if (count > kFew) geometry_ = scene_.attach(device, static_cast<int>(count), bounds_of_body, boxes_.data());
  }

  RTCBounds& box(std::size_t body) { return boxes_[body]; }

  const std::vector<Pair>& find() {
    pairs_.clear();
    if (!geometry_) {
      for (std::size_t i = 0; i < boxes_.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes_.size(); ++j) add(i, j, pairs_);
      }
      return pairs_;
    }
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
    for (std::vector<Pair>& list : found_) list.clear();
    rtcCollide(scene_, scene_, collect, this);
    for (const std::vector<Pair>& list : found_) pairs_.insert(pairs_.end(), list.begin(), list.end());
    return pairs_;
  }

 private:
  static constexpr std::size_t kFew = 32;

  static void bounds_of_body(const RTCBoundsFunctionArguments* arguments) {
    *arguments->bounds_o = static_cast<const RTCBounds*>(arguments->geometryUserPtr)[arguments->primID];
  }
  static void collect(void* self, RTCCollision* collisions, unsigned count) {
    BodySweep& sweep = *static_cast<BodySweep*>(self);
    std::vector<Pair>& list = sweep.found_.local();
    for (unsigned k = 0; k < count; ++k) {  // both orders come
      if (collisions[k].primID0 < collisions[k].primID1) sweep.add(collisions[k].primID0, collisions[k].primID1, list);
    }
  }
  // Leaves are paired without a test of their boxes.
  void add(std::size_t i, std::size_t j, std::vector<Pair>& list) const {
    const RTCBounds &a = boxes_[i], &b = boxes_[j];
    if (a.lower_x <= b.upper_x && b.lower_x <= a.upper_x && a.lower_y <= b.upper_y && b.lower_y <= a.upper_y &&
        a.lower_z <= b.upper_z && b.lower_z <= a.upper_z) {
      list.push_back({static_cast<int>(i), static_cast<int>(j)});
    }
  }

  std::vector<RTCBounds> boxes_;
  Scene scene_;
  RTCGeometry geometry_ = nullptr;
  std::vector<Pair> pairs_;
  tbb::enumerable_thread_specific<std::vector<Pair>> found_;
};

class SceneABody : public Rival {
 public:
  SceneABody(const Workload& workload, int threads, TriangleTest test)
      : workload_(workload),
        threads_(useful_threads(workload, threads)),
        device_(threads_),
        views_(first_views(workload)),
        answers_(views_, test),
        sweep_(device_, views_.size()) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
    for (std::size_t k = 0; k < views_.size(); ++k) {
      scenes_.push_back(std::make_unique<Scene>(device_));
      geometries_.push_back(scenes_[k]->attach(device_, views_[k].facet_count, facet_bounds, &views_[k]));
      rtcCommitScene(*scenes_[k]);
      rtcGetSceneBounds(*scenes_[k], &sweep_.box(k));
    }
    check(device_);
  }

  void step(int frame) override {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
    tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t k) {
      if (workload_.bodies[k].fixed()) return;
      views_[k] = view_of(workload_.bodies[k], frame);
      rtcCommitGeometry(geometries_[k]);
      rtcCommitScene(*scenes_[k]);
      rtcGetSceneBounds(*scenes_[k], &sweep_.box(k));
    });
    const std::vector<BodySweep::Pair>& pairs = sweep_.find();
    answers_.clear();
    tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
      Query query{&answers_, pairs[k].first, pairs[k].second};
      rtcCollide(*scenes_[query.a], *scenes_[query.b], decide, &query);
    });
    check(device_);
  }

  std::vector<FacetMeeting> meetings() const override { return answers_.sorted(); }

 private:
  struct Query {
    Answers* answers;
    int a, b;
  };

  static void decide(void* data, RTCCollision* collisions, unsigned count) {
    const Query& query = *static_cast<const Query*>(data);
    std::vector<FacetMeeting>& list = query.answers->of_this_thread();
    for (unsigned k = 0; k < count; ++k) {
      query.answers->decide(query.a, static_cast<int>(collisions[k].primID0), query.b,
                            static_cast<int>(collisions[k].primID1), list);
    }
  }

  const Workload& workload_;
  int threads_;
  Device device_;
  std::vector<MeshView> views_;
  Answers answers_;
  BodySweep sweep_;
  std::vector<std::unique_ptr<Scene>> scenes_;
  std::vector<RTCGeometry> geometries_;
};

// The pairs of different bodies, or those within each body of facets that share no vertex.
enum class Pairs { between_bodies, within_bodies };

class OneScene : public Rival {
 public:
  OneScene(const Workload& workload, int threads, Pairs pairs, TriangleTest test)
      : workload_(workload),
        pairs_(pairs),
        threads_(useful_threads(workload, threads)),
        device_(threads_),
        views_(first_views(workload)),
        answers_(views_, test),
        scene_(device_) {
    for (MeshView& view : views_) {
      geometries_.push_back(scene_.attach(device_, view.facet_count, facet_bounds, &view));
    }
    rtcCommitScene(scene_);
    check(device_);
  }

  void step(int frame) override {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
    for (std::size_t k = 0; k < views_.size(); ++k) {
      if (workload_.bodies[k].fixed()) continue;
      views_[k] = view_of(workload_.bodies[k], frame);
      rtcCommitGeometry(geometries_[k]);
    }
    rtcCommitScene(scene_);
    answers_.clear();
    rtcCollide(scene_, scene_, pairs_ == Pairs::between_bodies ? decide_between : decide_within, &answers_);
    check(device_);
  }

  std::vector<FacetMeeting> meetings() const override { return answers_.sorted(); }

 private:
  // Both orders come.
  static void decide_within(void* data, RTCCollision* collisions, unsigned count) {
    Answers& answers = *static_cast<Answers*>(data);
    std::vector<FacetMeeting>& list = answers.of_this_thread();
    for (unsigned k = 0; k < count; ++k) {
      const RTCCollision& c = collisions[k];
      const auto body = static_cast<int>(c.geomID0), a = static_cast<int>(c.primID0), b = static_cast<int>(c.primID1);
      if (c.geomID0 == c.geomID1 && a < b && !share_a_vertex(answers.mesh(body), a, b))
        answers.decide(body, a, body, b, list);
    }
  }
  // Both orders come, and the pairs within a body.
  static void decide_between(void* data, RTCCollision* collisions, unsigned count) {
    Answers& answers = *static_cast<Answers*>(data);
    std::vector<FacetMeeting>& list = answers.of_this_thread();
    for (unsigned k = 0; k < count; ++k) {
      const RTCCollision& c = collisions[k];
      if (c.geomID0 >= c.geomID1) continue;
      answers.decide(static_cast<int>(c.geomID0), static_cast<int>(c.primID0), static_cast<int>(c.geomID1),
                     static_cast<int>(c.primID1), list);
    }
  }

  const Workload& workload_;
  Pairs pairs_;
  int threads_;
  Device device_;
  std::vector<MeshView> views_;
  Answers answers_;
  Scene scene_;
  std::vector<RTCGeometry> geometries_;
};

}  // namespace

std::unique_ptr<Rival> make_embree_scene_a_body(const Workload& workload, int threads) {
  return std::make_unique<SceneABody>(workload, threads, TriangleTest::exact);
}

std::unique_ptr<Rival> make_embree_scene_a_body_plain(const Workload& workload, int threads) {
  return std::make_unique<SceneABody>(workload, threads, TriangleTest::plain);
}

std::unique_ptr<Rival> make_embree_one_scene(const Workload& workload, int threads) {
  return std::make_unique<OneScene>(workload, threads, Pairs::between_bodies, TriangleTest::exact);
}

std::unique_ptr<Rival> make_embree_self(const Workload& workload, int threads) {
  return std::make_unique<OneScene>(workload, threads, Pairs::within_bodies, TriangleTest::exact);
}

std::unique_ptr<Rival> make_embree_self_plain(const Workload& workload, int threads) {
  return std::make_unique<OneScene>(workload, threads, Pairs::within_bodies, TriangleTest::plain);
}

}  // namespace tact::bench
