#include "bench/rivals/box_rival.h"

#include <CGAL/box_intersection_d.h>
#include <CGAL/tags.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "bench/rivals/cgal_box.h"
#include "broadphase/sweep_and_prune.h"
#include "engine/base/parallel.h"
#include "narrowphase/pairs/embree.h"

namespace tact::bench {
namespace {

using broadphase::IndexPair;
using PairLists = tbb::enumerable_thread_specific<std::vector<IndexPair>>;

void clear(PairLists& lists) {
  for (std::vector<IndexPair>& list : lists) list.clear();
}

std::vector<IndexPair> sorted(const PairLists& lists) {
  std::vector<IndexPair> all;
  for (const std::vector<IndexPair>& list : lists) all.insert(all.end(), list.begin(), list.end());
  std::ranges::sort(all);
  return all;
}

enum class Memory { kept, forgotten };

class Tact : public BoxRival {
 public:
  Tact(std::size_t count, int threads, Memory memory)
      : filters_(count), all_(count), threads_(threads), memory_(memory) {
    std::iota(all_.begin(), all_.end(), 0u);
  }

  void step(const BoxFrame& frame) override {
    if (memory_ == Memory::forgotten) sweep_ = {};
    sweep_.update(frame.boxes, filters_, memory_ == Memory::kept ? frame.changed : all_, threads_);
  }
  std::vector<IndexPair> pairs() const override { return {sweep_.pairs().begin(), sweep_.pairs().end()}; }

 private:
  broadphase::SweepAndPrune sweep_;
  std::vector<broadphase::Filter> filters_;
  std::vector<std::uint32_t> all_;
  int threads_;
  Memory memory_;
};

// rtcCollide of a scene with itself, a user primitive a box. The settings are those under which a commit refits; with a
// geometry of medium quality it rebuilds. Boxes are rounded outward to floats by a multiplication: nextafterf() would
// cost more than the rest of the callback. What Embree proposes, each pair twice, is decided by the doubles.
class Embree : public BoxRival {
 public:
  Embree(std::size_t count, int threads, RTCBuildQuality quality)
      : threads_(threads),
        device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())),
        scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(count));
    rtcSetGeometryBuildQuality(geometry_, quality);
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, bounds_of_box, nullptr);
    rtcAttachGeometry(scene_, geometry_);
  }
  ~Embree() override {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void step(const BoxFrame& frame) override {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
    boxes_ = frame.boxes;
    clear(found_);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
    rtcCollide(scene_, scene_, collect, this);
    const RTCError error = rtcGetDeviceError(device_);
    if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree reports error " + std::to_string(error));
  }
  std::vector<IndexPair> pairs() const override { return sorted(found_); }

 private:
  static float outward(double x, float direction) {
    const auto nearest = static_cast<float>(x);
    return nearest + direction * (std::fabs(nearest) * 0x1p-23f + 0x1p-126f);
  }
  static void bounds_of_box(const RTCBoundsFunctionArguments* arguments) {
    const base::Box& box = static_cast<const Embree*>(arguments->geometryUserPtr)->boxes_[arguments->primID];
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = outward(box.lower.x, -1.0f);
    bounds.lower_y = outward(box.lower.y, -1.0f);
    bounds.lower_z = outward(box.lower.z, -1.0f);
    bounds.upper_x = outward(box.upper.x, 1.0f);
    bounds.upper_y = outward(box.upper.y, 1.0f);
    bounds.upper_z = outward(box.upper.z, 1.0f);
  }
  static void collect(void* user, RTCCollision* collisions, unsigned count) {
    auto& self = *static_cast<Embree*>(user);
    std::vector<IndexPair>& list = self.found_.local();
    for (unsigned i = 0; i < count; ++i) {
      const IndexPair pair{collisions[i].primID0, collisions[i].primID1};
      if (pair.a < pair.b && base::overlaps(self.boxes_[pair.a], self.boxes_[pair.b])) list.push_back(pair);
    }
  }

  int threads_;
  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry geometry_;
  std::span<const base::Box> boxes_;
  PairLists found_;
};

// box_self_intersection_d over pointers, which its manual finds faster than boxes. Nothing is kept from step to step.
class Cgal : public BoxRival {
 public:
  Cgal(std::size_t count, int threads) : threads_(threads), boxes_(count) {}

  void step(const BoxFrame& frame) override {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
    base::parallel_for(boxes_.size(), 4096, threads_, [&](std::size_t i) { boxes_[i] = {frame.boxes[i], i}; });
    pointers_.clear();
    for (const CgalBox& box : boxes_) {
      if (!box.box.empty()) pointers_.push_back(&box);
    }
    clear(found_);
    const auto collect = [&](const CgalBox* a, const CgalBox* b) {
      const auto [first, second] = std::minmax(a->number, b->number);
      found_.local().push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)});
    };
    if (threads_ > 1) {
      CGAL::box_self_intersection_d<CGAL::Parallel_tag>(pointers_.begin(), pointers_.end(), collect);
    } else {
      CGAL::box_self_intersection_d<CGAL::Sequential_tag>(pointers_.begin(), pointers_.end(), collect);
    }
  }
  std::vector<IndexPair> pairs() const override { return sorted(found_); }

 private:
  int threads_;
  std::vector<CgalBox> boxes_;
  std::vector<const CgalBox*> pointers_;
  PairLists found_;
};

}  // namespace

std::unique_ptr<BoxRival> make_box_tact(std::size_t count, int threads) {
  return std::make_unique<Tact>(count, threads, Memory::kept);
}
std::unique_ptr<BoxRival> make_box_tact_from_scratch(std::size_t count, int threads) {
  return std::make_unique<Tact>(count, threads, Memory::forgotten);
}
std::unique_ptr<BoxRival> make_box_embree_refit(std::size_t count, int threads) {
  return std::make_unique<Embree>(count, threads, RTC_BUILD_QUALITY_REFIT);
}
std::unique_ptr<BoxRival> make_box_embree_rebuild(std::size_t count, int threads) {
  return std::make_unique<Embree>(count, threads, RTC_BUILD_QUALITY_MEDIUM);
}
std::unique_ptr<BoxRival> make_box_cgal(std::size_t count, int threads) {
  return std::make_unique<Cgal>(count, threads);
}

std::span<const BoxRivalKind> box_rivals() {
  static constexpr std::array kKinds{
      BoxRivalKind{"tact", make_box_tact},
      BoxRivalKind{"tact from scratch", make_box_tact_from_scratch},
      BoxRivalKind{"Embree refit", make_box_embree_refit, false},
      BoxRivalKind{"Embree rebuild", make_box_embree_rebuild},
      BoxRivalKind{"CGAL", make_box_cgal},
  };
  return kKinds;
}

}  // namespace tact::bench
