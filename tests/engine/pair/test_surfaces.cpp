// Cloth at rest on a body, or moving over it: facet pairs from step to step against the oracle, whatever happens to the
// bodies in between.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

// A sheet on the unit sphere, wrinkled so that it crosses it in patches.
Mesh draped(int cells) {
  return mapped(sheet(cells, cells, 1.8, 1.8), [](Vec3 p) {
    const double along = 4.0 + p.x * p.x + p.y * p.y;
    const double height = 0.004 + 0.007 * std::sin(9.0 * p.x + 4.0 * p.y) * std::sin(7.0 * p.y - 3.0 * p.x);
    return (1.0 + height) * Vec3{4.0 * p.x / along, 4.0 * p.y / along, (8.0 - along) / along};
  });
}

class Surfaces : public ::testing::TestWithParam<int> {
 protected:
  void detect(const char* after) {
    const Report& report = world_.detect();
    EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(bodies_), meeting_bodies(report, ids_))) << after;
    stats_ = report.stats();
  }
  void move(std::size_t i, const Mesh& to) { world_.set_positions(ids_[i], (bodies_[i] = to).positions); }
  void jitter(double most) { move(0, jittered(bodies_[0], most, ++seed_)); }

  std::uint64_t seed_ = 0;
  std::vector<Mesh> bodies_{draped(56), icosphere(5)};
  World world_{{.threads = GetParam()}};
  std::vector<BodyId> ids_ = add_bodies(world_, bodies_);
  StepStats stats_;
};

INSTANTIATE_TEST_SUITE_P(Threads, Surfaces, ::testing::Values(1, 2));

TEST_P(Surfaces, AtRestAreCertified) {
  detect("the first step");
  ASSERT_GT(stats_.cluster_pairs, 256);  // or the bodies do not lie on each other
  const std::int64_t at_first = stats_.opened_clusters;
  for (int step = 0; step < 6; ++step) {
    jitter(1e-5);
    detect("jitter");
  }
  EXPECT_LT(stats_.opened_clusters, at_first);
  move(0, translated(bodies_[0], {0.0, 0.0, -0.003}));
  detect("the cloth sinks in");
  jitter(1e-5);
  detect("jitter");
}

TEST_P(Surfaces, WhateverHappensInBetween) {
  detect("the first step");
  jitter(1e-5);
  jitter(1e-5);
  detect("two moves in a step");
  Mesh bad = bodies_[0];
  bad.positions(2, 7) = std::numeric_limits<double>::quiet_NaN();
  const std::array updates{PositionsUpdate{ids_[1], translated(bodies_[1], {0.01, 0.0, 0.0}).positions},
                           PositionsUpdate{ids_[0], bad.positions}};
  EXPECT_TRUE(throws_error([&] { world_.set_positions(updates); }, ErrorCode::non_finite_position));
  jitter(1e-5);
  detect("a batch that was refused");
  move(0, translated(bodies_[0], {3.0, 0.0, 0.0}));
  detect("far away");
  move(0, translated(bodies_[0], {-3.0, 0.0, -0.002}));
  detect("back, elsewhere");
  jitter(1e-5);
  detect("jitter");
  world_.remove_body(ids_[1]);
  bodies_[1] = translated(bodies_[1], {0.0, 0.0, 0.004});
  ids_[1] = world_.add_body({.positions = bodies_[1].positions, .facets = bodies_[1].facets});
  jitter(1e-5);
  detect("another body in the place of the first");
  world_.set_margin(ids_[0], 0.001);
  jitter(1e-5);
  detect("a margin");
  world_.set_settings({.threads = GetParam(), .accuracy = Accuracy::paper});
  world_.detect();
  world_.set_settings({.threads = GetParam()});
  move(1, translated(bodies_[1], {0.0, 0.0, -0.002}));
  detect("another accuracy, and back");
}

// Clusters that lose their shape are made anew while the cloth lies there.
TEST_P(Surfaces, ClusteredAnew) {
  detect("the first step");
  const Mesh flat = bodies_[0];
  const Mesh torn = mapped(flat, [](Vec3 p) { return Vec3{p.x + 0.2 * std::sin(60.0 * p.y), p.y, p.z}; });
  for (int step = 0; step < 40; ++step) world_.set_positions(ids_[0], (step % 2 == 0 ? torn : flat).positions);
  move(0, torn);
  detect("torn");
  for (int step = 0; step < 3; ++step) {
    jitter(1e-5);
    detect("jitter");
  }
}

}  // namespace
}  // namespace tact::tests
