// Worlds among other threads, and callers with a floating-point mode of their own.
#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <cfenv>
#include <limits>
#include <thread>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/environment/floating_point_state.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/work_hash.h"

namespace tact::tests {
namespace {

// The hashes of a few steps of a crowd, everything done in the calling thread's mode.
std::vector<std::uint64_t> hashes_of_crowd(std::uint64_t seed, int threads) {
  World world({.threads = threads, .outputs = {.zones = true, .patches = true}});
  std::vector<Mesh> bodies = crowd_of_blobs(24, seed);
  bodies.push_back(wrinkled_sheet(12, 4.0, 0.5, seed));
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  std::vector<std::uint64_t> hashes;
  for (int step = 0; step < 5; ++step) {
    const Report& report = world.detect();
    hashes.push_back(report.hash());
    hashes.push_back(work_hash(report));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i] = translated(bodies[i], {0.03125, 0.0625, -0.03125 * static_cast<double>(i % 3)});
      world.set_positions(ids[i], bodies[i].positions);
    }
  }
  return hashes;
}

TEST(Threads, WorldsInThreadsOfTheirOwnDoNotDisturbEachOther) {
  std::vector<std::vector<std::uint64_t>> expected, found(4);
  for (std::uint64_t seed = 0; seed < 4; ++seed) expected.push_back(hashes_of_crowd(seed, 2));
  std::vector<std::thread> threads;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    threads.emplace_back([&, seed] { found[seed] = hashes_of_crowd(seed, 2); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(found, expected);
}

// The caller's regions leave the worlds' own regions one thread, or two where the caller allows nesting.
TEST(Threads, WorldsInRegionsOfTheCallerAnswerAsAlone) {
  std::vector<std::vector<std::uint64_t>> expected;
  for (std::uint64_t seed = 0; seed < 4; ++seed) expected.push_back(hashes_of_crowd(seed, 1));
  const int levels_before = omp_get_max_active_levels();
  for (const int levels : {1, 2}) {
    omp_set_max_active_levels(levels);
    std::vector<std::vector<std::uint64_t>> found(4), by_tasks(4);
#pragma omp parallel for num_threads(3)
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = hashes_of_crowd(i, 2);
#pragma omp parallel num_threads(3)
#pragma omp single
    for (std::size_t i = 0; i < by_tasks.size(); ++i) {
#pragma omp task firstprivate(i) shared(by_tasks)
      by_tasks[i] = hashes_of_crowd(i, 2);
    }
    EXPECT_EQ(found, expected) << levels << " levels";
    EXPECT_EQ(by_tasks, expected) << levels << " levels";
  }
  omp_set_max_active_levels(levels_before);
}

TEST(Threads, WorldCanPassFromThreadToThread) {
  const std::vector<Mesh> bodies = crowd_of_blobs(12, 1);
  World world;
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  std::uint64_t here = 0, there = 0;
  std::thread([&] {
    world.detect();
    world.set_settings(world.settings());
    there = world.detect().hash();
  }).join();
  world.set_settings(world.settings());
  here = world.detect().hash();
  EXPECT_EQ(here, there);
}

TEST(Threads, ReportIsReadByManyThreads) {
  const std::vector<Mesh> bodies = crowd_of_blobs(40, 1);
  World world;
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  const Report& report = world.detect();
  const std::uint64_t expected = report.hash();
  std::array<std::uint64_t, 8> hashes{};
  std::array<std::size_t, 8> pairs{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      hashes[i] = report.hash();
      for (const Contact& contact : report.contacts()) pairs[i] += contact.facet_pairs().size();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, expected);
  for (const std::size_t count : pairs) EXPECT_EQ(count, pairs[0]);
}

// Sets a rounding mode for as long as it lives.
class Rounding {
 public:
  explicit Rounding(int mode) : saved_(std::fegetround()) { std::fesetround(mode); }
  ~Rounding() { std::fesetround(saved_); }
  Rounding(const Rounding&) = delete;
  Rounding& operator=(const Rounding&) = delete;

 private:
  int saved_;
};

// Meshes are made beforehand: only the engine computes in the caller's mode.
struct PreparedSteps {
  explicit PreparedSteps(double scale) {
    std::vector<Mesh> moving = crowd_of_blobs(16, 3);
    moving.push_back(wrinkled_sheet(12, 3.0, 0.5, 3));
    for (Mesh& body : moving) body = scaled(body, scale);
    for (int step = 0; step < 4; ++step) {
      steps.push_back(moving);
      for (Mesh& body : moving) body = translated(body, {0.0625 * scale, 0.03125 * scale, 0.0});
    }
  }

  std::vector<std::uint64_t> hashes(int threads) const {
    World world({.threads = threads, .outputs = {.zones = true, .patches = true}});
    const std::vector<BodyId> ids = add_bodies(world, steps[0]);
    std::vector<std::uint64_t> result;
    for (const std::vector<Mesh>& bodies : steps) {
      for (std::size_t i = 0; i < bodies.size(); ++i) world.set_positions(ids[i], bodies[i].positions);
      result.push_back(world.detect().hash());
    }
    return result;
  }

  std::vector<std::vector<Mesh>> steps;
};

TEST(Threads, RoundingModeOfTheCallerChangesNothing) {
  const PreparedSteps steps(1.0);
  const std::vector<std::uint64_t> expected = steps.hashes(2);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    for (const int threads : {1, 2}) {
      const Rounding rounding(mode);
      EXPECT_EQ(steps.hashes(threads), expected) << "mode " << mode << ", " << threads << " threads";
      EXPECT_EQ(std::fegetround(), mode) << "the caller's mode was not given back";
    }
  }
}

constexpr int kWorkers = 2;

std::array<int, kWorkers> rounding_of_workers() {
  std::array<int, kWorkers> modes{};
#pragma omp parallel num_threads(kWorkers)
  modes[omp_get_thread_num()] = std::fegetround();
  return modes;
}

// The workers are the caller's as well: OpenMP lends the same threads to both. libgomp leaves a mode set in one of them
// as it is; libomp gives them the caller's at the start of every region.
TEST(Threads, WorkersKeepTheModeThatTheCallerGaveThem) {
  const PreparedSteps steps(1.0);
  const std::vector<std::uint64_t> expected = steps.hashes(kWorkers);
#pragma omp parallel num_threads(kWorkers)
  std::fesetround(FE_UPWARD);
  const std::array<int, kWorkers> before = rounding_of_workers();
  const std::vector<std::uint64_t> found = steps.hashes(kWorkers);
  const std::array<int, kWorkers> after = rounding_of_workers();
#pragma omp parallel num_threads(kWorkers)
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(after, before);
  EXPECT_EQ(found, expected);
}

// The positions are subnormal, so that it would show.
TEST(Threads, FlushToZeroOfTheCallerChangesNothing) {
  if (!kCanFlushSubnormals) GTEST_SKIP() << "this processor cannot flush subnormal numbers";
  for (const double scale : {1.0, 0x1p-1060}) {
    const PreparedSteps steps(scale);
    const std::vector<std::uint64_t> expected = steps.hashes(2);
    for (const int threads : {1, 2}) {
      std::vector<std::uint64_t> found;
      bool still_flushes = false;
      {
        const SavedFloatingPointState saved;
        flush_subnormals();
        found = steps.hashes(threads);
        still_flushes = flushes_subnormals();
      }
      EXPECT_EQ(found, expected) << "scale " << scale << ", " << threads << " threads";
      EXPECT_TRUE(still_flushes) << "the caller's mode was not given back";
    }
  }
}

// Several blocks of small bodies, which threads turn over side by side; and back, as the last one is bad.
TEST(Threads, BatchesOfSmallBodiesMoveAllOrNone) {
  const auto hashes = [](int threads, bool tries_bad_batches) {
    std::vector<Mesh> bodies = crowd_of_blobs(150, 3);
    World world({.threads = threads});
    const std::vector<BodyId> ids = add_bodies(world, bodies);
    std::vector<std::uint64_t> all;
    for (int step = 0; step < 6; ++step) {
      std::vector<Mesh> moved;
      std::vector<PositionsUpdate> batch;
      moved.reserve(bodies.size());
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        moved.push_back(translated(bodies[i], {0.03125, 0.0625, -0.03125 * static_cast<double>(i % 3)}));
        if (step % 2 == 1 && i + 1 == bodies.size())
          moved[i].positions(1, 2) = std::numeric_limits<double>::quiet_NaN();
        batch.push_back({ids[i], moved[i].positions});
      }
      if (step % 2 == 1) {
        if (tries_bad_batches) {
          EXPECT_THROW(world.set_positions(batch), Error);
        }
        world.set_settings(world.settings());  // looks at every pair anew
      } else {
        world.set_positions(batch);
        bodies = moved;
      }
      all.push_back(world.detect().hash());
    }
    return all;
  };
  EXPECT_EQ(hashes(2, true), hashes(1, false));
  EXPECT_EQ(hashes(1, true), hashes(1, false));
}

// The boxes of a body so large that it is refreshed in ranges, in a batch.
TEST(Threads, FlushToZeroOfTheCallerChangesNoLargeBody) {
  if (!kCanFlushSubnormals) GTEST_SKIP() << "this processor cannot flush subnormal numbers";
  Mesh sheet = wrinkled_sheet(130, 4.0, 0.5, 1), ball = icosphere(2);
  ASSERT_GT(sheet.facets.cols(), 32768);
  for (Mesh* mesh : {&sheet, &ball}) mesh->positions *= 0x1p-1060;
  const auto meeting = [&](bool flushes) {
    World world({.threads = 2});
    const std::vector<BodyId> ids = add_bodies(world, std::array{ball, sheet});
    const Mesh moved_sheet = translated(sheet, {0.0, 0.0, 0x1p-1064}),
               moved_ball = translated(ball, {0x1p-1064, 0.0, 0.0});
    const SavedFloatingPointState saved;
    if (flushes) flush_subnormals();
    world.set_positions(
        std::array{PositionsUpdate{ids[0], moved_ball.positions}, PositionsUpdate{ids[1], moved_sheet.positions}});
    const Report& report = world.detect();
    return report.contacts().empty() ? std::vector<FacetPair>{}
                                     : std::vector<FacetPair>(report.contacts()[0].facet_pairs().begin(),
                                                              report.contacts()[0].facet_pairs().end());
  };
  EXPECT_GT(meeting(false).size(), 100u);
  EXPECT_EQ(meeting(true), meeting(false));
}

#if defined(__SSE2__)  // most ARM processors cannot trap
// A caller that has unmasked floating-point exceptions must not be stopped by one of ours.
TEST(Threads, TrapsOfTheCallerAreNotSprung) {
  const PreparedSteps steps(1.0);
  const std::vector<std::uint64_t> expected = steps.hashes(1);
  const unsigned before = _mm_getcsr();
  _mm_setcsr((before & ~0x3fu) & ~(_MM_MASK_INVALID | _MM_MASK_DIV_ZERO | _MM_MASK_OVERFLOW));
  const std::vector<std::uint64_t> found = steps.hashes(2);
  _mm_setcsr(before);
  EXPECT_EQ(found, expected);
}
#endif

}  // namespace
}  // namespace tact::tests
