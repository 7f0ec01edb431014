// Which ways are taken is what the environment says: else the tests that run with each value would all be the same.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <vector>

#include "tests/support/detection.h"
#include "tests/support/environment.h"
#include "tests/support/generators.h"

namespace tact::tests {
namespace {

TEST(FastPaths, AreTakenAsTheEnvironmentSays) {
  World world({.threads = 1});
  const Mesh ball = icosphere(2);
  // One that overlaps the first, one that is apart along a diagonal, and one that is apart along no diagonal.
  const std::array offsets{Vec3{0.0, 0.0, 0.0}, Vec3{1.7, 0.1, 0.0}, Vec3{-1.6, -1.6, 0.0}, Vec3{-1.17, 1.17, 1.17}};
  std::vector<Mesh> balls;
  for (const Vec3& offset : offsets) balls.push_back(translated(ball, offset));
  const std::vector<BodyId> ids = add_bodies(world, balls);
  world.detect();
  StepStats seen;
  for (int step = 1; step <= 3; ++step) {
    world.set_positions(ids[0], translated(ball, {0.0, 0.0, 0x1p-10 * step}).positions);
    const StepStats& stats = world.detect().stats();
    ASSERT_EQ(stats.candidate_pairs, 3);
    ASSERT_EQ(stats.touching_contacts, 1);
    seen.parted_pairs += stats.parted_pairs;
    seen.still_separated_pairs += stats.still_separated_pairs;
    seen.still_overlapping_pairs += stats.still_overlapping_pairs;
    seen.tree_pairs += stats.tree_pairs;
  }
  const bool off = fast_paths_are("off"), always = fast_paths_are("always");
  EXPECT_EQ(seen.parted_pairs > 0, !off);
  EXPECT_EQ(seen.still_separated_pairs > 0, !off);
  EXPECT_EQ(seen.still_overlapping_pairs > 0, !off);
  EXPECT_EQ(seen.tree_pairs, always ? 3 : 0);
}

}  // namespace
}  // namespace tact::tests
