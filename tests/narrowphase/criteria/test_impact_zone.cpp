#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "narrowphase/criteria/impact_zone.h"

namespace tact::narrowphase {
namespace {

struct Soup {
  std::vector<double> positions;
  std::vector<int> facets;

  ClusteredMesh mesh() const { return {positions, facets}; }
  Vec3 corner(std::size_t i) const {
    const auto v = 3 * static_cast<std::size_t>(facets[i]);
    return {positions[v], positions[v + 1], positions[v + 2]};
  }
  void add(Vec3 p) { positions.insert(positions.end(), {p.x, p.y, p.z}); }
};

Soup unit_cube() {
  return {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1},
          {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7}};
}

struct Long2 {
  long double x;
  long double y;
};

long double dot(Vec3 axis, Vec3 origin, Vec3 p) {
  return axis.x * (static_cast<long double>(p.x) - origin.x) + axis.y * (static_cast<long double>(p.y) - origin.y) +
         axis.z * (static_cast<long double>(p.z) - origin.z);
}

// Ends of the parts of all edges between the planes, widened by `margin`, in long double.
std::vector<Long2> true_zone(const Soup& soup, const Slab& slab, long double margin) {
  const long double planes[2] = {slab.lower - margin, slab.upper + margin};
  std::vector<Long2> zone;
  for (std::size_t i = 0; i < soup.facets.size(); ++i) {
    const Vec3 p = soup.corner(i), q = soup.corner(i % 3 == 2 ? i - 2 : i + 1);
    const long double h = dot(slab.n, slab.origin, p), k = dot(slab.n, slab.origin, q);
    const Long2 from{dot(slab.u, slab.origin, p), dot(slab.v, slab.origin, p)};
    const Long2 to{dot(slab.u, slab.origin, q), dot(slab.v, slab.origin, q)};
    if (planes[0] <= h && h <= planes[1]) zone.push_back(from);
    for (const long double plane : planes) {
      if ((h < plane) == (k < plane)) continue;
      const long double t = (plane - h) / (k - h);
      zone.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
  }
  return zone;
}

double rounding_of(const Soup& soup, Vec3 origin) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < soup.facets.size(); ++i) {
    const Vec3 p = soup.corner(i) - origin;
    farthest = std::max(farthest, std::hypot(p.x, p.y, p.z));
  }
  return 5.0 * 0x1p-53 * farthest;
}

// Holds the true zone, and is the smallest around one that is little wider.
void expect_right(const Soup& soup, const Slab& slab) {
  std::vector<Point2> scratch;
  const ImpactZone zone = impact_zone(soup.mesh(), slab, scratch);
  const std::vector<Long2> truth = true_zone(soup, slab, slab.error);
  if (zone.disk.radius < 0.0) {
    EXPECT_TRUE(truth.empty());
    return;
  }
  for (const Long2& p : truth) {
    ASSERT_LE(std::hypot(p.x - zone.disk.center.x, p.y - zone.disk.center.y), zone.disk.radius + zone.error);
  }
  std::vector<Point2> wider;
  for (const Long2& p : true_zone(soup, slab, 4.0L * slab.error)) {
    wider.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
  }
  EXPECT_LE(zone.disk.radius, smallest_enclosing_disk(wider).radius * (1.0 + 1e-12) + zone.error);
  EXPECT_LE(zone.error, 18.0 * slab.error + 16.0 * 5e-324);
}

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized(Vec3{normal(random), normal(random), normal(random)});
}

Soup random_soup(std::mt19937& random, int vertices, int facets) {
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::uniform_int_distribution<int> vertex(0, vertices - 1);
  Soup soup;
  for (int i = 0; i < vertices; ++i) soup.add({coordinate(random), coordinate(random), coordinate(random)});
  for (int i = 0; i < 3 * facets; ++i) soup.facets.push_back(vertex(random));
  return soup;
}

// A sphere of radius 1 about the origin: rings of a torus-like grid with its poles.
Soup sphere(int rings) {
  Soup soup;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < 2 * rings; ++j) {
      const double polar = std::numbers::pi * i / rings, turn = std::numbers::pi * j / rings;
      soup.add({std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)});
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < 2 * rings; ++j) {
      const int a = 2 * rings * i + j, b = 2 * rings * i + (j + 1) % (2 * rings);
      soup.facets.insert(soup.facets.end(), {a, a + 2 * rings, b, b, a + 2 * rings, b + 2 * rings});
    }
  }
  return soup;
}

}  // namespace

TEST(ImpactZone, SlabHasARightHandedFrame) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    Vec3 n = random_direction(random);
    if (i < 6)
      n = Vec3{i / 2 == 0 ? 1.0 : 0.0, i / 2 == 1 ? 1.0 : 0.0, i / 2 == 2 ? 1.0 : 0.0} * (i % 2 == 0 ? 1.0 : -1.0);
    const Slab slab = make_slab(n, {1, 2, 3}, -1.0, 2.0, 1e-16);
    EXPECT_NEAR(dot(slab.u, slab.v), 0.0, 1e-15);
    EXPECT_NEAR(norm(slab.u), 1.0, 1e-15);
    EXPECT_LT(norm(cross(slab.u, slab.v) - n), 1e-15);
  }
}

TEST(ImpactZone, CubeCutByBothPlanesIsItsCrossSection) {
  std::vector<Point2> scratch;
  const Slab slab = make_slab({0, 0, 1}, {0, 0, 0}, 0.25, 0.5, 1e-16);
  const ImpactZone zone = impact_zone(unit_cube().mesh(), slab, scratch);  // no vertex lies in the slab
  EXPECT_NEAR(zone.disk.radius, std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(zone.disk.center.x, 0.5, 1e-15);
  EXPECT_NEAR(zone.disk.center.y, 0.5, 1e-15);
}

TEST(ImpactZone, TipOfAPyramidIsAsWideAsItsCut) {
  const Soup pyramid{{1, 1, 0, -1, 1, 0, -1, -1, 0, 1, -1, 0, 0, 0, 2},
                     {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 2, 1, 0, 3, 2}};
  std::vector<Point2> scratch;
  for (const double below : {1.0, 1e-3, 1e-9}) {
    const Slab slab = make_slab({0, 0, 1}, {0, 0, 0}, 2.0 - below, 3.0, 1e-15);
    EXPECT_NEAR(impact_zone(pyramid.mesh(), slab, scratch).disk.radius, below / std::sqrt(2.0), 1e-14) << below;
  }
}

TEST(ImpactZone, FacetThatCrossesWithAllCornersOutsideCounts) {
  const Soup facet{{0, 0, -1, 0, 0, 1, 4, 0, 0}, {0, 1, 2}};
  std::vector<Point2> scratch;
  // The part in the slab runs from x = 0 to x = 3.9 at height 0.025, and the corner at x = 4 lies below it.
  const Slab slab = make_slab({0, 0, 1}, {0, 0, 0}, 0.025, 0.75, 1e-16);
  EXPECT_NEAR(impact_zone(facet.mesh(), slab, scratch).disk.radius, 1.95, 1e-14);
}

TEST(ImpactZone, BordersAreClosed) {
  const ClusteredMesh cube = unit_cube().mesh();
  std::vector<Point2> scratch;
  const auto radius = [&](double lower, double upper, double error) {
    return impact_zone(cube, make_slab({0, 0, 1}, {0, 0, 0}, lower, upper, error), scratch).disk.radius;
  };
  EXPECT_NEAR(radius(1.0, 2.0, 0.0), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(radius(1.0 - 1e-12, 2.0, 0.0), std::sqrt(0.5), 1e-14);
  EXPECT_LT(radius(1.0 + 1e-12, 2.0, 0.0), 0.0);
  EXPECT_NEAR(radius(1.0 + 1e-12, 2.0, 1e-12), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(radius(-1.0, 0.0, 0.0), std::sqrt(0.5), 1e-14);
  EXPECT_LT(radius(-1.0, -1e-12, 0.0), 0.0);
}

TEST(ImpactZone, EnclosesAndIsSmallestOnRandomSoups) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> height(-1.5, 1.5);
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    Soup soup = random_soup(random, 4 + i % 20, 1 + i % 12);
    const double offset = i % 3 == 0 ? 1e6 : 0.0;
    for (double& x : soup.positions) x = std::ldexp(x + offset, i % 7 == 0 ? -900 : 0);
    const double scale = std::ldexp(1.0, i % 7 == 0 ? -900 : 0);
    const Vec3 origin{offset * scale, offset * scale, offset * scale};
    double planes[2] = {height(random) * scale, height(random) * scale};
    std::sort(planes, planes + 2);
    expect_right(soup, make_slab(random_direction(random), origin, planes[0], planes[1], rounding_of(soup, origin)));
  }
}

// Facets within rounding of a plane: the crossing points of their edges are anywhere along them.
TEST(ImpactZone, EnclosesFacetsThatLieInAPlane) {
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    Soup soup = random_soup(random, 6, 5);
    const Slab frame = make_slab(random_direction(random), {0, 0, 0}, 0, 0, 0);
    const double thickness = std::pow(10.0, -10.0 - i % 8);
    for (std::size_t v = 0; v < soup.positions.size(); v += 3) {
      const double x = soup.positions[v], y = soup.positions[v + 1], z = thickness * soup.positions[v + 2];
      const Vec3 p = x * frame.u + y * frame.v + (0.5 + z) * frame.n;
      for (int axis = 0; axis < 3; ++axis) soup.positions[v + static_cast<std::size_t>(axis)] = p[axis];
    }
    expect_right(soup,
                 make_slab(frame.n, {0, 0, 0}, i % 2 == 0 ? 0.5 : 0.0, i % 2 == 0 ? 1.0 : 0.5, rounding_of(soup, {})));
  }
}

TEST(ImpactZone, EnclosesOnManyClusters) {
  std::mt19937 random(4);
  const Soup soup = sphere(40);
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    const double lower = 0.99 - 0.06 * i;
    expect_right(
        soup, make_slab(random_direction(random), {}, lower, i % 2 == 0 ? 2.0 : lower + 1e-3, rounding_of(soup, {})));
  }
}

TEST(ImpactZone, CapOfASphereHasItsRadius) {
  const ClusteredMesh mesh = sphere(100).mesh();
  std::vector<Point2> scratch;
  const ImpactZone zone = impact_zone(mesh, make_slab({0, 0, 1}, {0, 0, 0}, 0.5, 1.0, 1e-15), scratch);
  EXPECT_NEAR(zone.disk.radius, std::sqrt(0.75), 1e-3);
  EXPECT_NEAR(zone.disk.center.x, 0.0, 1e-12);
}

TEST(ImpactZone, OrderOfFacetsAndOldScratchDoNotMatter) {
  std::mt19937 random(5);
  Soup soup = sphere(20);
  const Slab slab = make_slab(random_direction(random), {}, 0.3, 0.7, 1e-15);
  std::vector<Point2> scratch(17, {9.0, 9.0});
  const ImpactZone zone = impact_zone(soup.mesh(), slab, scratch);
  std::vector<std::array<int, 3>> facets(soup.facets.size() / 3);
  for (std::size_t f = 0; f < facets.size(); ++f)
    facets[f] = {soup.facets[3 * f + 2], soup.facets[3 * f], soup.facets[3 * f + 1]};
  std::shuffle(facets.begin(), facets.end(), random);
  soup.facets.clear();
  for (const auto& f : facets) soup.facets.insert(soup.facets.end(), f.begin(), f.end());
  const ImpactZone shuffled = impact_zone(soup.mesh(), slab, scratch);
  EXPECT_EQ(zone.disk.radius, shuffled.disk.radius);
  EXPECT_EQ(zone.disk.center.x, shuffled.disk.center.x);
  EXPECT_EQ(zone.disk.center.y, shuffled.disk.center.y);
}

TEST(ImpactZone, MeshWithoutFacetsHasNone) {
  std::vector<Point2> scratch;
  const ClusteredMesh mesh({}, {});
  EXPECT_LT(impact_zone(mesh, make_slab({0, 0, 1}, {}, -1, 1, 0), scratch).disk.radius, 0.0);
}

}  // namespace tact::narrowphase
