#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "narrowphase/mesh/cluster_quality.h"
#include "narrowphase/mesh/refit.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/surfaces.h"
#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::clustered;
using tests::Mesh;
using tests::Random;
using tests::SurfaceSearch;

// A sheet that lies on the unit sphere about the origin, wrinkled so that it crosses it in patches.
Mesh draped(int cells, double phase) {
  Mesh cloth = tests::sheet(cells, cells, 1.6, 1.6);
  for (int v = 0; v < cloth.vertex_count(); ++v) {
    const double x = cloth.positions(0, v), y = cloth.positions(1, v), along = 4.0 + x * x + y * y;
    const double height = 0.004 + 0.006 * std::sin(9.0 * x + 4.0 * y + phase) * std::sin(7.0 * y - 3.0 * x);
    const Vec3 on{4.0 * x / along, 4.0 * y / along, (8.0 - along) / along};
    cloth.positions.col(v) << (1.0 + height) * on.x, (1.0 + height) * on.y, (1.0 + height) * on.z;
  }
  return cloth;
}

std::vector<FacetPair> swapped(std::vector<FacetPair> pairs) {
  for (FacetPair& pair : pairs) std::swap(pair.a, pair.b);
  std::ranges::sort(pairs);
  return pairs;
}

// Soups full of coplanar, touching and degenerate facets, needles, spheres: nothing of which lies on anything.
TEST(SurfacePairs, AreThoseOfTheOracleWhateverTheBodies) {
  SurfaceSearch search;
  std::size_t meeting = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Mesh a = seed % 3 == 0   ? tests::lattice_soup(150, 2, seed)
                   : seed % 3 == 1 ? tests::blob(2, 1.0, 0.4, seed)
                                   : tests::needles(150, 1e-3, seed);
    const Mesh b = seed % 2 == 0 ? tests::lattice_soup(200, 2, seed + 50) : tests::wrinkled_sheet(12, 2.0, 0.5, seed);
    const std::vector<FacetPair> expected = tests::facet_pairs_by_oracle(a, b);
    meeting += expected.size();
    for (const double scale : {1.0, 0x1p-200, 0x1p200}) {
      const ClusteredMesh one = clustered(tests::scaled(a, scale)), other = clustered(tests::scaled(b, scale));
      EXPECT_EQ(search(one, other), expected) << "seed " << seed << " scale " << scale;
      EXPECT_EQ(swapped(search(other, one)), expected) << "seed " << seed << " scale " << scale;
    }
  }
  EXPECT_GT(meeting, 10000u);
}

// Far from the origin, too, where a coordinate has fewer digits than the cloth is thick: then by the tests' own loop.
TEST(SurfacePairs, AreThoseOfTheOracleOnDrapes) {
  SurfaceSearch search;
  const Mesh body = tests::icosphere(5);
  for (const double offset : {0.0, 1e6}) {
    for (const double phase : {0.0, 1.0, 2.0}) {
      const Mesh a = tests::translated(draped(48, phase), {offset, 0.0, 0.0});
      const Mesh b = tests::translated(body, {offset, 0.0, 0.0});
      const std::vector<FacetPair> expected = tests::facet_pairs_by_oracle(a, b);
      EXPECT_GT(expected.size(), 500u);
      const ClusteredMesh cloth = clustered(a), sphere = clustered(b);
      EXPECT_EQ(search(cloth, sphere), expected);
      // The point of it: few clusters are opened, few facets paired.
      EXPECT_GT(search.cluster_pairs(), 150u);
      EXPECT_LT(search.counts().facet_box_pairs, 16 * static_cast<std::int64_t>(expected.size()));
      EXPECT_EQ(search(cloth, sphere, nullptr, 7), expected);
      EXPECT_EQ(swapped(search(sphere, cloth)), expected);
    }
  }
}

// A cloth on a sphere from step to step, with a history.
class Resting : public testing::Test {
 protected:
  Resting() {
    body_.keep_travel(true);
    cloth_.keep_travel(true);
  }
  void move(ClusteredMesh& mesh, const Mesh& to) { refit(mesh, to.positions.data()); }
  // Every vertex by up to `most`.
  void jitter(double most) {
    at_ = tests::jittered(at_, most, ++seed_);
    move(cloth_, at_);
  }
  void expect_right(const char* after) {
    const std::vector<FacetPair> expected = fresh_(cloth_, body_);
    EXPECT_EQ(search_(cloth_, body_, &history_, 3), expected) << after;
    if (history_.wants_travel_of_a()) cloth_.keep_travel(true);
    if (history_.wants_travel_of_b()) body_.keep_travel(true);
    opened_ = search_.opened();
    still_apart_ += search_.counts().still_apart;
    fresh_opened_ = fresh_.opened();
  }

  std::uint64_t seed_ = 0;
  Mesh at_ = draped(40, 0.0), sphere_ = tests::icosphere(5);
  ClusteredMesh cloth_ = clustered(at_), body_ = clustered(sphere_);
  SurfaceHistory history_;
  SurfaceSearch search_, fresh_;
  std::size_t opened_ = 0, fresh_opened_ = 0;
  std::int64_t still_apart_ = 0;  // in all steps
};

TEST_F(Resting, JitterOpensFewClusters) {
  std::size_t opened = 0, fresh = 0;
  for (int step = 0; step < 60; ++step) {
    jitter(2e-5);  // a two-thousandth of an edge
    expect_right("jitter");
    if (step >= 2) opened += opened_, fresh += fresh_opened_;
  }
  EXPECT_LT(10 * opened, 9 * fresh);
  EXPECT_GT(opened, 0u);
}

// By counts alone: where floats leave many facet pairs open and few clusters are apart, the next steps do without,
// twice as many after each failure.
TEST(SurfaceHistory, PausesWhereSurfacesSaveLittle) {
  SurfaceHistory history;
  const auto steps_without = [&] {
    int steps = 0;
    while (!history.takes_as_surfaces()) ++steps;
    return steps;
  };
  ConfirmCounts saves, costs;
  saves.plane_apart = 90;
  saves.still_apart = 10;
  saves.left_open = 2000;
  costs.plane_apart = 20;
  costs.left_open = 2000;
  EXPECT_EQ(steps_without(), 0);
  history.weigh(saves);
  EXPECT_EQ(steps_without(), 0);
  for (const int steps : {16, 32, 64, 128, 256, 256}) {
    history.weigh(costs);
    EXPECT_EQ(steps_without(), steps);
  }
  history.weigh(saves);
  EXPECT_EQ(steps_without(), 0);
  history.weigh(costs);
  EXPECT_EQ(steps_without(), 16);
}

// What is certified ends when it must: steps of all lengths, of one body or both, in any order.
TEST_F(Resting, CertificatesAreNeverStale) {
  Random random(5);
  for (int step = 0; step < 240; ++step) {
    const double length = std::pow(10.0, random.uniform(-7.0, -2.0));
    switch (random.below(6)) {
      case 0: jitter(length); break;
      case 1: move(body_, sphere_ = tests::jittered(sphere_, length, ++seed_)); break;
      case 2: move(cloth_, at_ = tests::translated(at_, length * random.direction())); break;
      case 3:  // twice between two looks
        jitter(length);
        jitter(length);
        break;
      case 4:  // refused
        move(cloth_, tests::translated(at_, {0.0, 0.0, 0.01}));
        undo_refit(cloth_);
        break;
      default: {  // a single vertex, far
        const int v = random.below(at_.vertex_count());
        const Eigen::Vector3d back = at_.positions.col(v);
        at_.positions.col(v) *= random.uniform(0.97, 1.03);
        move(cloth_, at_);
        expect_right("one vertex out");
        at_.positions.col(v) = back;
        move(cloth_, at_);
      }
    }
    expect_right("a step");
    if (history_.pauses()) history_ = {};  // many steps here are long: do not wait
  }
  EXPECT_GT(still_apart_, 2000);
}

TEST_F(Resting, WhatIsNotTheSameMeshIsLookedAtAnew) {
  for (int step = 0; step < 4; ++step) {
    jitter(1e-5);
    expect_right("jitter");
  }
  EXPECT_LT(opened_, fresh_opened_);
  cloth_ = clustered_anew(cloth_);  // other clusters
  cloth_.keep_travel(true);
  expect_right("clusters made anew");
  EXPECT_EQ(opened_, fresh_opened_);
  jitter(1e-5);
  expect_right("jitter");
  cloth_.keep_travel(false);  // moves that nobody saw
  move(cloth_, at_ = tests::translated(at_, {0.0, 0.0, -0.004}));
  expect_right("moved without travel");
  cloth_.keep_travel(true);
  move(cloth_, at_ = tests::translated(at_, {0.0, 0.0, 1e-6}));
  expect_right("travel kept again");
}

// Steps in which certificates tell of little: travel is not wanted then but for a few steps, ever more rarely.
TEST_F(Resting, CertificatesThatSaveLittleAreLeftAlone) {
  int wanted = 0;
  for (int step = 0; step < 120; ++step) {
    jitter(6e-4);  // little beside a cluster, but more than most of them are apart
    expect_right("a long jitter");
    wanted += history_.wants_travel_of_a() ? 1 : 0;
  }
  EXPECT_GE(wanted, 4);
  EXPECT_LE(wanted, 16);
  EXPECT_EQ(cloth_.travel(), nullptr);
}

// A body that stands keeps no travel, and certificates last.
TEST_F(Resting, ABodyThatStandsNeedsNoTravel) {
  body_.keep_travel(false);
  for (int step = 0; step < 5; ++step) {
    jitter(1e-5);
    expect_right("jitter");
  }
  EXPECT_LT(opened_, fresh_opened_);
  EXPECT_TRUE(history_.wants_travel_of_a());
  move(body_, sphere_ = tests::translated(sphere_, {0.0, 0.0, 0.003}));
  expect_right("the body moved");
  EXPECT_EQ(opened_, fresh_opened_);
}

}  // namespace
}  // namespace tact::narrowphase
