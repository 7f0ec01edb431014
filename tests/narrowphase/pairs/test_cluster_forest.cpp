// Embree as a source of faults: whatever goes wrong inside it is an error by name, and the next call works.
#include <gtest/gtest.h>
#include <tact/error.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "narrowphase/pairs/cluster_forest.h"
#include "narrowphase/pairs/embree.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/random.h"

namespace tact::narrowphase {
namespace {

constexpr int kBoxes = 1300;  // three trees

struct BoxList {
  BoxArrays boxes;
  int count = 0;
};

BoxList random_boxes(int count, double size) {
  tests::Random random(7);
  BoxList list{.boxes = {}, .count = count};
  list.boxes.resize(count);
  for (int i = 0; i < count; ++i) {
    const Vec3 lower = size * random.in_cube(1.0), edges = random.in_cube(0.1);
    const Vec3 upper = lower + size * Vec3{std::abs(edges.x), std::abs(edges.y), std::abs(edges.z)};
    list.boxes.set(static_cast<std::size_t>(i), {lower, upper});
  }
  return list;
}

// Does a query with each box find what a loop finds?
::testing::AssertionResult finds_all_overlaps(const ClusterForest& forest, const BoxList& list) {
  std::vector<std::int32_t> stack, found;
  for (int i = 0; i < list.count; ++i) {
    const Box box = list.boxes[i];
    found.clear();
    forest.query(box, stack, found);
    std::sort(found.begin(), found.end());
    std::vector<std::int32_t> expected;
    for (int k = 0; k < list.count; ++k) {
      if (overlaps(list.boxes[k], box)) expected.push_back(k);
    }
    if (found != expected) {
      return ::testing::AssertionFailure()
             << "box " << i << ": " << found.size() << " boxes found, " << expected.size() << " expected";
    }
  }
  return ::testing::AssertionSuccess();
}

// What build() throws, "" if nothing.
std::string error_of_build(ClusterForest& forest, EmbreeDevice& device, const BoxList& list) {
  try {
    forest.build(device, list.boxes.view(), list.count);
  } catch (const std::bad_alloc&) {
    return "bad_alloc";
  } catch (const Error& error) {
    return error_code_name(error.code());
  }
  return "";
}

// Embree itself loses a few bytes where an allocation fails half-way through its start: not for a sanitizer to report.
struct EmbreeMayLeak {
#if defined(__SANITIZE_ADDRESS__)
  __lsan::ScopedDisabler disabler;
#endif
};

// Beyond the range of floats, in a point, and where Embree drops what is not a number.
TEST(ClusterForest, FindsAllOverlapsAtEverySize) {
  EmbreeDevice device;
  for (const double size : {1.0, 0.0, 0x1p-1060, 1e-200, 1e18, 1e19, 1e38, 1e39, 0x1p299}) {
    for (const int count : {1, 2, 3, 600}) {
      const BoxList list = random_boxes(count, size);
      ClusterForest forest;
      forest.build(device, list.boxes.view(), list.count);
      EXPECT_TRUE(finds_all_overlaps(forest, list)) << count << " boxes of size " << size;
    }
  }
}

// Boxes that halve their distance from a point again and again, along each axis: cuts of space find one at a time, and
// Embree's builder comes to its greatest depth.
TEST(ClusterForest, FindsAllOverlapsWhereBoxesGatherAboutAPoint) {
  EmbreeDevice device;
  for (const int ratio : {1, 2, 5, 8}) {
    BoxList list{.boxes = {}, .count = 600};
    list.boxes.resize(list.count);
    for (int i = 0; i < list.count; ++i) {
      Vec3 lower{};
      if (i < 3) {
        lower[i] = -1.0 - 0x1p-10;  // so that the point is in the middle of all, where floats are finest
      } else if (const int power = (i / 3 - 1) * ratio; power < 110) {
        lower[i % 3] = std::ldexp(1.0, -power);
      } else {
        lower = std::ldexp(static_cast<double>(i), -140) * Vec3{1.0, 1.0, 1.0};
      }
      const double size = 0x1p-10 * std::max({std::abs(lower.x), std::abs(lower.y), std::abs(lower.z)});
      list.boxes.set(static_cast<std::size_t>(i), {lower, lower + size * Vec3{1.0, 1.0, 1.0}});
    }
    ClusterForest forest;
    EXPECT_EQ(error_of_build(forest, device, list), "") << "ratio " << ratio;
    EXPECT_TRUE(finds_all_overlaps(forest, list)) << "ratio " << ratio;
  }
}

TEST(ClusterForest, FailingAllocationInsideEmbreeIsAnErrorAndTheNextBuildWorks) {
  const BoxList list = random_boxes(kBoxes, 1.0);
  for (const bool for_good : {false, true}) {
    int failures = 0;
    for (long number = 0;; ++number) {
      ASSERT_LT(number, 1000);
      EmbreeDevice device;
      ClusterForest forest;
      std::string error;
      {
        [[maybe_unused]] const EmbreeMayLeak may_leak;
        tests::fail_allocation(number, for_good);
        error = error_of_build(forest, device, list);
      }
      const bool has_failed = tests::stop_failing();
      // Where not even Embree's code finds memory, it is unknown.
      ASSERT_TRUE(error.empty() || error == "bad_alloc" || error == "out_of_memory" ||
                  (for_good && error == "backend_failure"))
          << "allocation " << number << ": " << error;
      failures += error.empty() ? 0 : 1;
      if (!error.empty()) {
        ASSERT_EQ(error_of_build(forest, device, list), "") << "allocation " << number;
      }
      ASSERT_TRUE(finds_all_overlaps(forest, list)) << "allocation " << number;
      if (!has_failed) break;
    }
    EXPECT_GT(failures, 10);
  }
}

// What Embree reports in a build is not lost, even if the tree is there, and does not come up again.
TEST(ClusterForest, ErrorCodeOfEmbreeBecomesAnErrorOnce) {
  const BoxList list = random_boxes(kBoxes, 1.0);
  EmbreeDevice device;
  ClusterForest forest;
  EXPECT_EQ(rtcNewGeometry(static_cast<RTCDevice>(device.get()), static_cast<RTCGeometryType>(250)), nullptr);
  EXPECT_EQ(error_of_build(forest, device, list), "backend_failure");
  EXPECT_EQ(error_of_build(forest, device, list), "");
  EXPECT_TRUE(finds_all_overlaps(forest, list));
}

// Embree asks its memory monitor before what it allocates for scenes and trees. Ours takes the nodes into its own
// memory: Embree 3.13 asks for nothing; a version that asks must say what it lacks.
TEST(ClusterForest, MemoryMonitorThatRefusesAllIsAnErrorIfItIsAsked) {
  const BoxList list = random_boxes(kBoxes, 1.0);
  EmbreeDevice device;
  const auto embree = static_cast<RTCDevice>(device.get());
  int asked = 0;
  const auto refuse = [](void* count, ssize_t bytes, bool) {
    *static_cast<int*>(count) += bytes > 0 ? 1 : 0;
    return bytes <= 0;
  };
  rtcSetDeviceMemoryMonitorFunction(embree, refuse, &asked);
  ClusterForest forest;
  EXPECT_EQ(error_of_build(forest, device, list), asked > 0 ? "out_of_memory" : "");
  rtcSetDeviceMemoryMonitorFunction(embree, nullptr, nullptr);
  EXPECT_EQ(error_of_build(forest, device, list), "");
  EXPECT_TRUE(finds_all_overlaps(forest, list));
}

}  // namespace
}  // namespace tact::narrowphase
