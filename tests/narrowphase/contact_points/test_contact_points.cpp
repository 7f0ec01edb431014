#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <tuple>

#include "narrowphase/contact_points/contact_points.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/oracles/point_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::Mesh;
using tests::PointKey;
using tests::Random;
using tests::weighted;

std::vector<FeaturePoint> sorted(std::vector<FeaturePoint> points) {
  std::ranges::sort(points, {}, &FeaturePoint::features);
  return points;
}

void expect_same_bits(const std::vector<FeaturePoint>& points, const std::vector<FeaturePoint>& others) {
  const auto all_of = [](const FeaturePoint& p) {
    return std::tie(p.kind, p.a, p.b, p.weight_a, p.weight_b, p.normal, p.gap, p.edge_a, p.edge_b);
  };
  ASSERT_EQ(points.size(), others.size());
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_TRUE(all_of(points[i]) == all_of(others[i])) << i;
}

// The same whether clusters are searched pair by pair or, where all pairs are known, few of them together.
std::vector<FeaturePoint> points_between(const ClusteredMesh& a, const ClusteredMesh& b, double reach) {
  const Features features_a(a), features_b(b);
  const FeaturedMesh featured_a{&a, &features_a}, featured_b{&b, &a == &b ? &features_a : &features_b};
  EmbreeDevice device;
  ClusterPairFinder near;
  const std::span<const ClusterPair> pairs = near.find({.mesh = &a}, {.mesh = &b}, reach, base::kTuning, device);
  std::vector<FeaturePoint> found, together;
  ContactPointSearch search;
  search.run(featured_a, featured_b, reach, pairs, found);
  search.run(featured_a, featured_b, reach, pairs, together, {}, ContactPointSearch::Given::all);
  expect_same_bits(sorted(found), sorted(together));
  return found;
}

std::vector<FeaturePoint> points_between(const Mesh& a, const Mesh& b, double reach) {
  return points_between(tests::clustered(a), tests::clustered(b), reach);
}

std::vector<FeaturePoint> points_of_itself(const Mesh& mesh, double reach) {
  const ClusteredMesh clustered = tests::clustered(mesh);
  return points_between(clustered, clustered, reach);
}

double size_of(const Mesh& a, const Mesh& b) { return std::max({tests::extent(a), tests::extent(b), 1e-300}); }

// The sets are equal outside the band, and each point lies where the oracle says.
void expect_points_of_brute_force(const Mesh& a, const Mesh& b, double reach, const std::string& what) {
  const double size = size_of(a, b), tolerance = 1e-12 * size;
  const auto expected = tests::points_by_brute_force(a, b, reach, tolerance);
  std::map<PointKey, int> seen;
  for (const FeaturePoint& point : points_between(a, b, reach)) {
    const PointKey key{point.kind, point.a, point.b};
    ASSERT_EQ(++seen[key], 1) << what << ": reported twice";
    const auto known = expected.find(key);
    ASSERT_NE(known, expected.end()) << what << ": kind " << static_cast<int>(point.kind) << " a " << point.a[0]
                                     << " b " << point.b[0];
    EXPECT_NEAR(point.gap, known->second.gap, 10 * tolerance) << what;
    EXPECT_LE(norm(weighted(a, point.a, point.weight_a) - known->second.a), 1e-9 * size) << what;
    EXPECT_LE(norm(weighted(b, point.b, point.weight_b) - known->second.b), 1e-9 * size) << what;
    if (point.gap > 1e-6 * size) {
      const Vec3 way = known->second.b - known->second.a;
      EXPECT_LE(norm(point.normal - (1.0 / norm(way)) * way), 1e-6) << what;
    }
  }
  for (const auto& [key, point] : expected) {
    ASSERT_TRUE(!point.certain || seen.contains(key))
        << what << ": missing, kind " << static_cast<int>(std::get<0>(key)) << " a " << std::get<1>(key)[0] << " b "
        << std::get<2>(key)[0] << " gap " << point.gap;
  }
}

TEST(ContactPoints, OfACornerAboveAFloorIsOne) {
  const Mesh floor = tests::sheet(4, 4, 4.0, 4.0);
  const Mesh spike = tests::translated(tests::spike({0.1, 0.2, -1.0}, 0.3), {0.0, 0.0, 1.25});
  const auto points = points_between(floor, spike, 0.3);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].kind, FeaturePair::facet_vertex);
  EXPECT_NEAR(points[0].gap, 0.25, 1e-15);
  EXPECT_EQ(points[0].normal, (Vec3{0.0, 0.0, 1.0}));
}

TEST(ContactPoints, OfCrossedBarsIsBetweenTheirEdges) {
  const auto turned = tests::rotation(std::cos(std::numbers::pi / 8), std::sin(std::numbers::pi / 8), 0.0, 0.0);
  const Mesh lower = tests::rotated(tests::centered_box({2.0, 0.1, 0.1}), turned);
  const auto across = tests::rotation(1.0, 0.0, 0.0, 1.0);
  const Mesh upper = tests::translated(tests::rotated(lower, across), {0.0, 0.0, 0.3});
  const auto points = points_between(lower, upper, 0.05);
  const auto edges = std::ranges::count(points, FeaturePair::edge_edge, &FeaturePoint::kind);
  ASSERT_EQ(edges, 1);
  EXPECT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].gap, 0.3 - 0.2 * std::numbers::sqrt2, 1e-12);
}

TEST(ContactPoints, EqualBruteForceOnSmoothBodies) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Mesh a = tests::blob(3, 1.0, 0.2, seed),
               b = tests::translated(tests::blob(2, 0.8, 0.3, seed + 50), {1.75, 0.1, 0.05});
    for (const double reach : {0.1, 0.4}) expect_points_of_brute_force(a, b, reach, "blobs " + std::to_string(seed));
  }
}

// Few clusters with few facets there each, with many, and more than are searched together.
TEST(ContactPoints, AreTheSameHoweverManyClustersAreNear) {
  const Mesh a = tests::blob(4, 1.0, 0.1, 1), b = tests::translated(tests::blob(3, 1.0, 0.1, 2), {1.93, 0.2, 0.05});
  std::size_t last = 0;
  for (const double reach : {0.03, 0.1, 0.3, 0.8}) {
    const std::size_t count = points_between(a, b, reach).size();
    EXPECT_EQ(points_between(b, a, reach).size(), count) << reach;
    EXPECT_GT(count, last) << reach;
    last = count;
  }
  EXPECT_GT(last, 300u);
}

TEST(ContactPoints, EqualBruteForceOfSheetsThatLieOnEachOther) {
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const Mesh a = tests::wrinkled_sheet(14, 2.0, 0.2, seed);
    const Mesh b =
        tests::translated(tests::jittered(tests::wrinkled_sheet(11, 1.7, 0.2, seed), 0.01, seed), {0.013, 0.02, 0.05});
    expect_points_of_brute_force(a, b, 0.08, "sheets " + std::to_string(seed));
  }
}

TEST(ContactPoints, EqualBruteForceOnSoupsNeedlesAndLattices) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const std::string which = " " + std::to_string(seed);
    expect_points_of_brute_force(tests::soup(40, 1.0, seed), tests::soup(40, 1.0, seed + 9), 0.1, "soups" + which);
    expect_points_of_brute_force(tests::needles(25, 1e-4, seed), tests::needles(25, 1e-3, seed + 9), 0.1,
                                 "needles" + which);
    expect_points_of_brute_force(tests::crumpled(tests::icosphere(1), seed), tests::soup(30, 1.0, seed), 0.1,
                                 "crumpled" + which);
  }
}

// Far from zero, tiny, huge, turned: as above.
TEST(ContactPoints, EqualBruteForceWhereverAndHoweverLarge) {
  Random random(7);
  const Mesh a = tests::blob(2, 1.0, 0.3, 3), b = tests::translated(tests::blob(2, 0.8, 0.3, 4), {1.7, 0.1, 0.0});
  for (const double scale : {0x1p-400, 0x1p-30, 0x1p40, 0x1p290})
    expect_points_of_brute_force(tests::scaled(a, scale), tests::scaled(b, scale), 0.2 * scale,
                                 "scaled by " + std::to_string(std::ilogb(scale)));
  for (int k = 0; k < 2; ++k) {
    const auto turn = random.rotation();
    const Vec3 by = 1e3 * random.direction();
    expect_points_of_brute_force(tests::translated(tests::rotated(a, turn), by),
                                 tests::translated(tests::rotated(b, turn), by), 0.2, "turned and moved");
  }
}

TEST(ContactPoints, DoNotDependOnWhichMeshIsNamedFirst) {
  const Mesh a = tests::blob(3, 1.0, 0.2, 1), b = tests::translated(tests::blob(3, 1.0, 0.2, 2), {1.95, 0.1, 0.05});
  std::map<PointKey, double> there, back;
  const auto turned = [](FeaturePair kind) {
    return kind == FeaturePair::vertex_facet   ? FeaturePair::facet_vertex
           : kind == FeaturePair::facet_vertex ? FeaturePair::vertex_facet
                                               : kind;
  };
  for (const FeaturePoint& point : points_between(a, b, 0.2)) there[{point.kind, point.a, point.b}] = point.gap;
  for (const FeaturePoint& point : points_between(b, a, 0.2)) back[{turned(point.kind), point.b, point.a}] = point.gap;
  ASSERT_GT(there.size(), 10u);
  ASSERT_EQ(there.size(), back.size());
  for (const auto& [key, gap] : there) EXPECT_NEAR(back.at(key), gap, 1e-15);
}

TEST(ContactPointsOfItself, FlatAndBentSheetsHaveNoneWhateverTheirResolution) {
  for (const int cells : {4, 16, 64}) {
    EXPECT_TRUE(points_of_itself(tests::sheet(cells, cells, 1.0, 1.0), 0.1).empty());
    EXPECT_TRUE(points_of_itself(tests::icosphere(3), 0.2).empty());
    const Mesh noisy = tests::jittered(tests::sheet(cells, cells, 1.0, 1.0), 0.02 / cells, 1);
    EXPECT_TRUE(points_of_itself(noisy, 0.1).empty());
  }
}

// A sheet folded about a cylinder: both halves see each other, at twice the radius.
TEST(ContactPointsOfItself, AFoldedSheetSeesItsOtherHalf) {
  const double radius = 0.02;
  const Mesh folded = tests::mapped(tests::sheet(60, 10, 1.2, 0.2), [&](Vec3 p) {
    const double half = 0.5 * std::numbers::pi * radius;
    if (p.x < -half) return Vec3{p.x + half, p.y, -radius};
    if (p.x > half) return Vec3{-(p.x - half), p.y, radius};
    return Vec3{radius * std::cos(p.x / radius), p.y, radius * std::sin(p.x / radius)};
  });
  const auto points = points_of_itself(folded, 0.05);
  EXPECT_GT(points.size(), 400u);
  for (const FeaturePoint& point : points) EXPECT_NEAR(point.gap, 2 * radius, 0.1 * radius);
  EXPECT_TRUE(points_of_itself(folded, 0.035).empty());
}

}  // namespace
}  // namespace tact::narrowphase
