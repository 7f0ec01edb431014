// The oracle and the generators are held against the plain loop and against closed forms before they judge the engine.
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"

namespace tact::tests {
namespace {

class OracleOnKind : public ::testing::TestWithParam<BodyPairKind> {};

// Every edge of a closed mesh has two facets, in opposite directions.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> balance;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    for (int corner = 0; corner < 3; ++corner) {
      const int i = mesh.facets(corner, f), j = mesh.facets((corner + 1) % 3, f);
      balance[std::minmax(i, j)] += i < j ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) {
    if (sum != 0) return false;
  }
  return true;
}

double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Vec3 p = mesh.position(mesh.facets(0, f)), q = mesh.position(mesh.facets(1, f));
    sum += dot(p, cross(q, mesh.position(mesh.facets(2, f)))) / 6.0;
  }
  return sum;
}

TEST_P(OracleOnKind, EqualsPlainLoop) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const std::vector<Mesh> bodies = GetParam().make(seed);
    EXPECT_TRUE(
        same_facet_pairs(facet_pairs_by_brute_force(bodies[0], bodies[1]), facet_pairs_by_oracle(bodies[0], bodies[1])))
        << "seed " << seed;
  }
}

TEST_P(OracleOnKind, ManyBodiesAreAsTwo) {
  const std::vector<Mesh> bodies = GetParam().make(3);
  const std::vector<FacetPair> expected = facet_pairs_by_oracle(bodies[0], bodies[1]);
  const std::vector<MeetingBodies> found = meeting_bodies_by_oracle(bodies);
  EXPECT_TRUE(same_facet_pairs(expected, found.empty() ? std::vector<FacetPair>{} : found[0].facet_pairs));
}

INSTANTIATE_TEST_SUITE_P(Kinds, OracleOnKind, ::testing::ValuesIn(body_pair_kinds().begin(), body_pair_kinds().end()),
                         [](const auto& instance) { return instance.param.name; });

TEST(Generators, SolidsAreClosedAndRightSideOut) {
  const std::pair<Mesh, double> solids[] = {
      {box({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}), 6.0},
      {gridded_box({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}, 3), 6.0},
      {icosphere(3), 4.15},
      {torus(32, 16, 1.0, 0.3), 1.75},
      {tool(), 0.0063},
      {organ(1), 0.12},
      {blob(2, 1.0, 0.3, 1), 4.0},
      {random_hull(20, 1), 2.0},
      {spike({0.0, 0.0, 1.0}, 0.1), 0.0037},
  };
  for (const auto& [mesh, about] : solids) {
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume(mesh), about, 0.5 * about);
  }
}

TEST(Generators, HaveTheFacetsThatTheirNamesPromise) {
  EXPECT_EQ(icosphere(2).facet_count(), 320);
  EXPECT_EQ(organ(1).facet_count(), 512);
  EXPECT_EQ(tool().facet_count(), 96);
  EXPECT_EQ(torus(16, 8, 1.0, 0.3).facet_count(), 256);
  EXPECT_EQ(gridded_box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 4).facet_count(), 192);
}

TEST(Generators, KindsMeetInMostSeeds) {
  for (const BodyPairKind& kind : body_pair_kinds()) {
    int meeting = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const std::vector<Mesh> bodies = kind.make(seed);
      if (!facet_pairs_by_oracle(bodies[0], bodies[1]).empty()) ++meeting;
    }
    if (std::string(kind.name) == "nested") {
      EXPECT_EQ(meeting, 0);
    } else if (std::string(kind.name) != "single_facets") {
      EXPECT_GE(meeting, 8) << kind.name;
    }
  }
}

TEST(Components, SplitWhatMergedJoined) {
  const std::vector<Mesh> parts = {icosphere(0), translated(tool(), {3.0, 0.0, 0.0}), sheet(2, 2, 1.0, 1.0)};
  const std::vector<Mesh> found = components(merged(parts));
  ASSERT_EQ(found.size(), parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(found[i].positions, parts[i].positions);
    EXPECT_EQ(found[i].facets, parts[i].facets);
  }
}

}  // namespace
}  // namespace tact::tests
