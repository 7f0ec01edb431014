// A world whose Embree fails: it does not start, it reports an error, its memory monitor refuses. Each is an error by
// name, and the next step answers as a fresh world's. Where its floats end, nothing does. Allocations that fail inside
// Embree stand in test_allocation.cpp.
//
// rtcNewDevice is wrapped by the linker for the whole test program, which gives the tests the device of a world.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/world_tuning.h"
#include "narrowphase/pairs/embree.h"
#include "tests/support/checks/detection.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/environment/allocation_hook.h"
#include "tests/support/generators/bodies.h"

namespace {

bool refuse_to_start = false;
long failing_in_start = -1;  // an allocation; negative: none
bool fails_for_good = false, has_failed = false;
RTCDevice last_device = nullptr;

// While Embree starts, which may throw.
struct ShortOfMemory {
  ShortOfMemory() {
    if (failing_in_start >= 0) tact::tests::fail_allocation(failing_in_start, fails_for_good);
  }
  ~ShortOfMemory() { has_failed = tact::tests::stop_failing(); }
};

}  // namespace

extern "C" RTCDevice __real_rtcNewDevice(const char* config);
extern "C" RTCDevice __wrap_rtcNewDevice(const char* config) {
  const ShortOfMemory short_of_memory;
  last_device = refuse_to_start ? nullptr : __real_rtcNewDevice(config);
  return last_device;
}

namespace tact::tests {
namespace {

// Two bodies of so many clusters that Embree's trees find their pairs. One thread: the error is that of the caller's.
class WorldWithEmbree : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Mesh a = icosphere(6);
    bodies_ = {a, translated(scaled(a, 0.98), {0.03, 0.01, 0.0})};
    World fresh({.threads = 1});
    add_bodies(fresh, bodies_);
    hash_ = fresh.detect().hash();
    ASSERT_EQ(fresh.detect().contacts().size(), 1u);
  }

  void SetUp() override { ids_ = add_bodies(world_, bodies_); }

  void detect_again() { world_.set_settings(world_.settings()); }

  // After an error the world starts from scratch.
  void expect_fresh_answer() {
    const Report& report = world_.detect();
    EXPECT_EQ(report.stats().tree_pairs, 1);
    EXPECT_EQ(report.stats().kept_pairs, 0);
    EXPECT_EQ(report.hash(), hash_);
  }

  inline static std::vector<Mesh> bodies_;
  inline static std::uint64_t hash_ = 0;
  World world_{{.threads = 1}};
  std::vector<BodyId> ids_;
};

TEST_F(WorldWithEmbree, ThatDoesNotStart) {
  refuse_to_start = true;
  EXPECT_TRUE(throws_error([&] { world_.detect(); }, ErrorCode::backend_failure, {"Embree"}));
  EXPECT_TRUE(throws_error([&] { world_.detect(); }, ErrorCode::backend_failure, {"Embree"}));
  refuse_to_start = false;
  expect_fresh_answer();
}

TEST_F(WorldWithEmbree, ThatReportsAnErrorOnce) {
  world_.detect();
  detect_again();
  rtcNewGeometry(last_device, static_cast<RTCGeometryType>(250));  // there is none: an error that waits to be read
  EXPECT_TRUE(throws_error([&] { world_.detect(); }, ErrorCode::backend_failure, {"Embree", "error"}));
  expect_fresh_answer();
}

// Embree asks its monitor before what it allocates for scenes and trees. The engine takes the nodes into memory of its
// own: Embree 3.13 asks for nothing. A version that asks must say what it lacks.
TEST_F(WorldWithEmbree, WhoseMemoryMonitorRefusesAll) {
  world_.detect();
  detect_again();
  int asked = 0;
  const auto refuse = [](void* count, ssize_t bytes, bool) {
    *static_cast<int*>(count) += bytes > 0 ? 1 : 0;
    return bytes <= 0;
  };
  rtcSetDeviceMemoryMonitorFunction(last_device, refuse, &asked);
  const auto detected = throws_error([&] { world_.detect(); }, ErrorCode::out_of_memory, {"Embree"});
  EXPECT_EQ(detected == true, asked > 0) << detected.message();
  rtcSetDeviceMemoryMonitorFunction(last_device, nullptr, nullptr);
  detect_again();
  EXPECT_EQ(meeting_bodies(world_.detect(), ids_), meeting_bodies_by_engine(bodies_));
}

// Status of a process that ends a test.
enum Ended { kFailedAndMended, kNothingFailed, kWrong };

// Ends a process in which Embree was not started before.
[[noreturn]] void start_short_of_memory(long allocation, bool for_good) {
  alarm(60);  // ends a process that waits for ever
  const std::vector<Mesh> bodies{icosphere(3), translated(icosphere(3), {0.3, 0.1, 0.0})};
  World world({.threads = 1});
  WorldTuning::set(world, kForced);
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  failing_in_start = allocation;
  fails_for_good = for_good;
  try {
    world.detect();  // a failure may go unnoticed: Embree reads files
  } catch (const Error& error) {
    if (error.code() != ErrorCode::out_of_memory) std::_Exit(kWrong);
  }
  failing_in_start = -1;
  if (!has_failed) std::_Exit(kNothingFailed);
  world.set_settings(world.settings());  // looks at every pair anew
  const Report& report = world.detect();
  const bool right = report.stats().tree_pairs == 1 &&
                     same_meeting_bodies(meeting_bodies_by_engine(bodies), meeting_bodies(report, ids));
  std::_Exit(right ? kFailedAndMended : kWrong);
}

// TBB sets itself up once for the process: each allocation, alone and with all that follow, fails in one of its own.
// That runs this test again, and leaves it where it started: the loops must not go by what the others found.
TEST(EmbreeDeathTest, StartedShortOfMemoryLeavesAUsableWorld) {
  if (!is_hooked()) GTEST_SKIP() << "no allocation fails";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  int failures = 0;
  bool done = false;
  const auto has_ended = [&](int status) {
    const int ended = WIFEXITED(status) ? WEXITSTATUS(status) : kWrong;
    done = ended == kNothingFailed;
    failures += ended == kFailedAndMended ? 1 : 0;
    return ended != kWrong;
  };
  for (long allocation = 0; !done && !HasFailure(); ++allocation) {
    ASSERT_LT(allocation, 1000);
    for (const bool for_good : {false, true})
      EXPECT_EXIT(start_short_of_memory(allocation, for_good), has_ended, "") << "allocation " << allocation;
  }
  EXPECT_GT(failures, 10);
}

// Its boxes are floats, and those beyond 1.8e18 it drops. A power of two changes no bit of a position but the exponent.
TEST_F(WorldWithEmbree, BeyondTheRangeOfItsFloats) {
  const std::vector<MeetingBodies> expected = meeting_bodies(world_.detect(), ids_);
  ASSERT_EQ(expected.size(), 1u);
  for (const int exponent : {-1000, -200, 60, 62, 130, 299}) {
    for (std::size_t i = 0; i < 2; ++i)
      world_.set_positions(ids_[i], scaled(bodies_[i], std::ldexp(1.0, exponent)).positions);
    const Report& report = world_.detect();
    EXPECT_EQ(report.stats().tree_pairs, 1) << exponent;
    EXPECT_TRUE(same_meeting_bodies(expected, meeting_bodies(report, ids_))) << exponent;
  }
}

// What a failed step leaves is what the bodies are, not what an earlier step was told.
TEST_F(WorldWithEmbree, ThatFailedTakesNewPositions) {
  world_.detect();
  detect_again();
  rtcNewGeometry(last_device, static_cast<RTCGeometryType>(250));
  EXPECT_TRUE(throws_error([&] { world_.detect(); }, ErrorCode::backend_failure));
  world_.set_positions(ids_[1], translated(bodies_[1], {9.0, 0.0, 0.0}).positions);
  EXPECT_TRUE(world_.detect().candidate_pairs().empty());
  world_.set_positions(ids_[1], bodies_[1].positions);
  EXPECT_EQ(world_.detect().contacts().size(), 1u);
}

}  // namespace
}  // namespace tact::tests
