// Contact points of two bodies through the engine against brute force: in long doubles bodies of all kinds that come
// near, and closed ones that sink into each other; in rational numbers small ones, whole sets of points by the rule of
// the manual. Not part of the ordinary tests: how many pairs is read from the environment.
//   TACT_LONG_POINT_PAIRS        40 if not set; some ten a second
//   TACT_LONG_EXACT_POINT_PAIRS  in rational numbers, 40 if not set; some forty a second
//   TACT_LONG_SEED               which, 1 if not set
#include <gtest/gtest.h>
#include <tact/world.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>

#include "tests/support/checks/sinking_bodies.h"
#include "tests/support/environment/environment.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/oracles/exact_point_oracle.h"
#include "tests/support/oracles/point_oracle.h"

namespace tact::tests {
namespace {

template <class Check>
void for_pairs(const Check& check) {
  for_seeds("TACT_LONG_POINT_PAIRS", 40, check);
}

struct Shape {
  const char* name;
  Mesh mesh;
  Surface surface = Surface::sheet;
};

// About the origin, some metres wide at most.
Shape any_shape(Random& random) {
  const std::uint64_t seed = random.below(1 << 30);
  switch (random.below(11)) {
    case 0: return {"blob", blob(1 + random.below(2), 1.0, random.uniform(0.0, 0.4), seed), Surface::closed};
    case 1: return {"hull", random_hull(4 + random.below(36), seed), Surface::closed};
    case 2: return {"torus", torus(16, 8, 1.0, random.uniform(0.1, 0.4)), Surface::closed};
    case 3: return {"box", gridded_box({-1, -1, -0.5}, {1, 1, 0.5}, 1 + random.below(5)), Surface::closed};
    case 4: return {"spike", spike(random.uniform(0.1, 2.0) * random.direction(), 0.3), Surface::closed};
    case 5: return {"sheet", sheet(1 + random.below(12), 1 + random.below(12), 2.0, 1.5)};
    case 6: return {"wrinkles", wrinkled_sheet(4 + random.below(12), 2.0, random.uniform(0.0, 0.3), seed)};
    case 7: return {"soup", soup(10 + random.below(40), 1.0, seed)};
    case 8: return {"lattice", lattice_soup(10 + random.below(40), 1 + random.below(3), seed)};
    case 9: return {"needles", needles(10 + random.below(20), std::pow(10.0, -random.uniform(0.0, 5.0)), seed)};
    default: return {"crumple", crumpled(icosphere(1), seed)};
  }
}

BodyDefinition body_of(const Mesh& mesh, Surface surface, double margin) {
  return {.positions = mesh.positions, .facets = mesh.facets, .surface = surface, .margin = margin};
}

// Those of certain points that are missing, those that are none, and gaps that differ.
void expect_points(const Contact* contact, const Mesh& a, const Mesh& b, double reach, const std::string& what) {
  const double size = std::max(extent(a), extent(b));
  const auto expected = points_by_brute_force(a, b, reach, 1e-12 * size);
  const double farthest = std::max(a.positions.cwiseAbs().maxCoeff(), b.positions.cwiseAbs().maxCoeff());
  std::set<PointKey> seen;
  for (const ContactPoint& point : contact == nullptr ? std::span<const ContactPoint>() : contact->points()) {
    const PointKey key{point.kind, point.a_vertices, point.b_vertices};
    ASSERT_TRUE(seen.insert(key).second) << what << ": twice";
    const auto known = expected.find(key);
    ASSERT_NE(known, expected.end()) << what << ": " << point.a_vertices[0] << " of a and " << point.b_vertices[0]
                                     << " of b have none, gap " << point.gap;
    ASSERT_NEAR(point.gap, known->second.gap, 1e-11 * size) << what;
    const Vec3 way = weighted(b, point.b_vertices, point.b_weights) - weighted(a, point.a_vertices, point.a_weights);
    ASSERT_NEAR(norm(way), point.gap, 1e-11 * size + 1e-15 * farthest) << what;
  }
  for (const auto& [key, point] : expected)
    ASSERT_TRUE(!point.certain || seen.contains(key)) << what << ": lacks one, gap " << point.gap;
}

TEST(PointsLong, OfBodiesThatDoNotCrossEqualBruteForce) {
  int near = 0, crossing = 0, apart = 0;
  for_pairs([&](std::uint64_t seed) {
    Random random(seed);
    const Shape first = any_shape(random), second = any_shape(random);
    const double scale = random.chance(0.3) ? std::ldexp(1.0, random.below(200) - 100) : 1.0;
    const Vec3 far =
        random.chance(0.2) ? scale * std::pow(10.0, random.uniform(0.0, 6.0)) * random.direction() : Vec3{};
    const bool turned = random.chance(0.7);
    const Mesh one = turned ? rotated(first.mesh, random.rotation()) : first.mesh;
    const Mesh other = turned ? rotated(second.mesh, random.rotation()) : second.mesh;
    const Vec3 way = random.chance(0.7) ? random.direction() : Vec3{0, 0, 1};
    const double reach = std::pow(10.0, random.uniform(-2.0, 0.0));
    // Corner to corner; or hulls overlap, as surfaces then may.
    const double gap = random.chance(0.8) ? random.uniform(0.0, 1.2) * reach : -random.uniform(0.0, 0.5);
    const Vec3 beside = highest(one, way) - highest(other, -way);
    const Mesh a = translated(scaled(one, scale), far),
               b = translated(scaled(translated(other, beside + gap * way), scale), far);
    const std::string what = std::string(first.name) + " and " + second.name + ", seed " + std::to_string(seed);
    World world({.threads = 1 + random.below(2), .outputs = {.points = true}});
    const double part = random.uniform(0.0, 1.0);
    // Sheets, as points through the inside of a solid are none.
    world.add_body(body_of(a, Surface::sheet, part * reach * scale));
    world.add_body(body_of(b, Surface::sheet, (reach - part * reach) * scale));
    const Report& report = world.detect();
    const Contact* contact = report.contacts().empty() ? nullptr : &report.contacts()[0];
    if (contact != nullptr && (!contact->facet_pairs().empty() || contact->containment != Containment::none)) {
      ++crossing;
      return;
    }
    ++(contact == nullptr ? apart : near);
    expect_points(contact, a, b, part * reach * scale + (reach - part * reach) * scale, what);
  });
  std::printf("%d near, %d apart, %d cross\n", near, apart, crossing);
  EXPECT_GT(near, crossing / 4);
}

TEST(PointsLong, GapsOfClosedBodiesEqualBruteForce) {
  std::size_t points = 0;
  for_pairs([&](std::uint64_t seed) { points += sink_and_compare(seed); });
  std::printf("%zu points that have crossed\n", points);
  EXPECT_GT(points, 100u);
}

// Calls check(random, what) for each seed of the pairs in rational numbers.
template <class Check>
void for_exact_pairs(const Check& check) {
  std::uint64_t first = 0, last = 0;
  for_seeds("TACT_LONG_EXACT_POINT_PAIRS", 40, [&](std::uint64_t seed) {
    if (first == 0) first = seed;
    last = seed;
    Random random(seed);
    check(random, "seed " + std::to_string(seed));
  });
  std::printf("seeds %llu to %llu\n", static_cast<unsigned long long>(first), static_cast<unsigned long long>(last));
}

std::string words_of(const PointKey& key) {
  std::string words = "kind " + std::to_string(static_cast<int>(std::get<0>(key))) + ", vertices";
  for (const int v : std::get<1>(key)) words += " " + std::to_string(v);
  words += " of a and";
  for (const int v : std::get<2>(key)) words += " " + std::to_string(v);
  return words + " of b";
}

struct NearPair {
  Mesh a, b;
  double margin;  // of each
};

// Those that are missing, those that are none, gaps that differ. False if the bodies cross.
bool expect_exact_points(const NearPair& pair, double band, std::size_t& points, const std::string& what) {
  World world({.threads = 1, .outputs = {.points = true}});
  for (const Mesh* mesh : {&pair.a, &pair.b}) world.add_body(body_of(*mesh, Surface::sheet, pair.margin));
  const Report& report = world.detect();
  const Contact* contact = report.contacts().empty() ? nullptr : &report.contacts()[0];
  if (contact != nullptr && !contact->facet_pairs().empty() && contact->depth > 0.0) return false;
  const auto expected = exact_points(pair.a, pair.b, 2.0 * pair.margin, band);
  const double size = std::max(extent(pair.a), extent(pair.b));
  std::set<PointKey> seen;
  for (const ContactPoint& point : contact == nullptr ? std::span<const ContactPoint>() : contact->points()) {
    const PointKey key{point.kind, point.a_vertices, point.b_vertices};
    EXPECT_TRUE(seen.insert(key).second) << what << ": twice";
    const auto known = expected.find(key);
    EXPECT_TRUE(known != expected.end() && (known->second.there || !known->second.certain))
        << what << ": " << words_of(key) << " have none, gap " << point.gap;
    EXPECT_NEAR(point.normal.norm(), 1.0, 1e-12) << what;
    if (known == expected.end()) continue;
    EXPECT_NEAR(point.gap, known->second.gap, 1e-12 * size) << what;
  }
  for (const auto& [key, point] : expected) {
    EXPECT_TRUE(!point.there || !point.certain || seen.contains(key))
        << what << ": lacks " << words_of(key) << ", gap " << point.gap;
  }
  points += seen.size();
  return true;
}

// At whole numbers: full of ties, of facets that lie in one plane, stand across each other or repeat each other.
Mesh whole_numbers(Random& random) {
  const std::uint64_t seed = random.below(1 << 30);
  switch (random.below(4)) {
    case 0: return lattice_soup(3 + random.below(12), 1 + random.below(3), seed);
    case 1: return gridded_box({-2, -1, 0}, {2, 1, 2}, 1 + random.below(2));
    case 2: {
      const int cells = 1 + random.below(3), across = 1 + random.below(3);
      return sheet(cells, across, 2.0 * cells, 2.0 * across);
    }
    default: {
      Mesh mesh = icosphere(0);
      for (int v = 0; v < mesh.vertex_count(); ++v)
        mesh.set_position(v, {1.0 * random.below(7) - 3, 1.0 * random.below(7) - 3, 1.0 * random.below(7) - 3});
      return mesh;
    }
  }
}

TEST(ExactPoints, OfMeshesAtWholeNumbersEqualTheRule) {
  int near = 0, crossing = 0;
  std::size_t points = 0;
  for_exact_pairs([&](Random& random, const std::string& what) {
    NearPair pair{whole_numbers(random), whole_numbers(random), 0.0};
    const int axis = random.below(3);
    const double above = pair.a.positions.row(axis).maxCoeff(), below = pair.b.positions.row(axis).minCoeff();
    Vec3 by{1.0 * random.below(3) - 1, 1.0 * random.below(3) - 1, 1.0 * random.below(3) - 1};
    by[axis] = above - below + random.below(3) - (random.chance(0.3) ? 1.0 : 0.0);
    pair.b = translated(pair.b, by);
    pair.margin = 0.3 + 0.41 * random.below(4);
    ++(expect_exact_points(pair, 0.0, points, what) ? near : crossing);
  });
  std::printf("%d near, %d cross, %zu points\n", near, crossing, points);
  EXPECT_GT(points, 10u);
}

TEST(ExactPoints, OfSmallMeshesEqualTheRuleOutsideABand) {
  int near = 0, crossing = 0;
  std::size_t points = 0;
  for_exact_pairs([&](Random& random, const std::string& what) {
    const auto shape = [&]() -> Mesh {
      const std::uint64_t seed = random.below(1 << 30);
      switch (random.below(6)) {
        case 0: return random_hull(4 + random.below(8), seed);
        case 1: return soup(4 + random.below(10), 1.0, seed);
        case 2: return needles(4 + random.below(8), std::pow(10.0, random.uniform(0.0, 6.0)), seed);
        case 3: return crumpled(icosphere(0), seed);
        case 4: return wrinkled_sheet(2 + random.below(2), 2.0, random.uniform(0.0, 0.3), seed);
        default: return spike(random.uniform(0.1, 2.0) * random.direction(), random.chance(0.3) ? 1e-9 : 0.3);
      }
    };
    const Mesh a = rotated(shape(), random.rotation()), b = rotated(shape(), random.rotation());
    const Vec3 way = random.direction();
    const double reach = std::pow(10.0, random.uniform(-2.0, 0.0)), scale = std::ldexp(1.0, random.below(200) - 100);
    const Vec3 beside = highest(a, way) - highest(b, -way) + random.uniform(0.0, 0.9) * reach * way;
    const NearPair pair{scaled(a, scale), scaled(translated(b, beside), scale), 0.5 * reach * scale};
    const double band = 1e-12 * std::max(extent(pair.a), extent(pair.b));
    ++(expect_exact_points(pair, band, points, what) ? near : crossing);
  });
  std::printf("%d near, %d cross, %zu points\n", near, crossing, points);
  EXPECT_GT(points, 10u);
}

}  // namespace
}  // namespace tact::tests
