// Pairs within reach are those of brute force, each once, with the places that are nearest.
#include <gtest/gtest.h>
#include <tact/world.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/folds.h"
#include "tests/support/generators/messy_soups.h"
#include "tests/support/oracles/reach_oracle.h"

namespace tact::tests {
namespace {

Eigen::Vector3d reach_place(const Mesh& mesh, const std::array<int, 3>& vertices,
                            const std::array<double, 3>& weights) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double all = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(weights[k] >= 0.0 && (vertices[k] >= 0 || weights[k] == 0.0));
    if (vertices[k] >= 0) sum += weights[k] * mesh.positions.col(vertices[k]);
    all += weights[k];
  }
  EXPECT_NEAR(all, 1.0, 1e-12);
  return sum;
}

// What lies in a band of `band` metres around the reach may be there or not.
void expect_pairs(const Contact* contact, const Mesh& a, const Mesh& b, const std::map<ReachKey, long double>& expected,
                  double reach, double band, const std::string& what) {
  std::set<ReachKey> seen;
  const ReachPair* last = nullptr;
  const auto key_of = [](const ReachPair& pair) { return ReachKey{pair.kind, pair.a_vertices, pair.b_vertices}; };
  for (const ReachPair& pair : contact == nullptr ? std::span<const ReachPair>() : contact->within_reach()) {
    ASSERT_LT(pair.distance, reach) << what;
    ASSERT_TRUE(seen.insert(key_of(pair)).second) << what;
    ASSERT_TRUE(last == nullptr || key_of(*last) < key_of(pair)) << what;
    last = &pair;
    const auto known = expected.find(key_of(pair));
    ASSERT_NE(known, expected.end()) << what << ", distance " << pair.distance;
    ASSERT_NEAR(pair.distance, static_cast<double>(known->second), band) << what;
    const Eigen::Vector3d way = reach_place(b, pair.b_vertices, pair.b_weights) -  //
                                reach_place(a, pair.a_vertices, pair.a_weights);
    ASSERT_NEAR(way.norm(), pair.distance, 10 * band) << what;
    const Eigen::Vector3d normal = Eigen::Vector3d::Map(pair.normal.data());
    if (pair.distance > 1e6 * band) {
      ASSERT_LT((way / way.norm() - normal).norm(), 1e-5) << what;
    }
    ASSERT_TRUE(pair.distance == 0.0 ? normal.norm() == 0.0 : std::abs(normal.norm() - 1.0) < 1e-12) << what;
  }
  for (const auto& [key, distance] : expected)
    ASSERT_TRUE(distance > reach - band || seen.contains(key))
        << what << ", distance " << static_cast<double>(distance);
}

void expect_pairs_of_two(const Mesh& a, const Mesh& b, double margin, const std::string& what, int threads = 1) {
  World world({.threads = threads, .outputs = {.within_reach = true}});
  for (const Mesh* mesh : {&a, &b})
    world.add_body({.positions = mesh->positions, .facets = mesh->facets, .surface = Surface::sheet, .margin = margin});
  const Report& report = world.detect();
  const double reach = 2.0 * margin, band = 1e-13 * std::max({extent(a), extent(b), a.positions.cwiseAbs().maxCoeff()});
  const auto expected = pairs_within_reach(a, b, reach + band);
  expect_pairs(report.contacts().empty() ? nullptr : &report.contacts()[0], a, b, expected, reach, band, what);
}

std::size_t expect_own_pairs(const Mesh& mesh, double margin, const std::string& what, int threads = 1) {
  World world({.threads = threads, .outputs = {.within_reach = true}});
  world.add_body({.positions = mesh.positions,
                  .facets = mesh.facets,
                  .surface = Surface::sheet,
                  .margin = margin,
                  .self_contact = true});
  const Report& report = world.detect();
  const double reach = 2.0 * margin, band = 1e-13 * std::max(extent(mesh), mesh.positions.cwiseAbs().maxCoeff());
  const auto expected = own_pairs_within_reach(mesh, reach + band);
  expect_pairs(report.contacts().empty() ? nullptr : &report.contacts()[0], mesh, mesh, expected, reach, band, what);
  return expected.size();
}

TEST(WithinReach, OfTwoBodiesAreThoseOfBruteForce) {
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const Mesh a = blob(2, 0.5, 0.3, seed), b = translated(blob(2, 0.5, 0.3, seed + 10), {0.7, 0.4, 0.1});
    const Mesh cloth = translated(wrinkled_sheet(9, 1.2, 0.1, seed), {0.0, 0.0, 0.45});
    for (const double margin : {0.003, 0.04, 0.15}) {
      const std::string what = "seed " + std::to_string(seed) + ", margin " + std::to_string(margin);
      expect_pairs_of_two(a, b, margin, "blobs, " + what);
      expect_pairs_of_two(a, cloth, margin, "cloth, " + what);
    }
  }
}

TEST(WithinReach, OfOneBodyAreThoseOfBruteForce) {
  std::size_t pairs = 0;
  for (const auto& [name, mesh] : folded_meshes(8, 1)) {
    for (const double margin : {0.002, 0.05})
      pairs += expect_own_pairs(mesh, margin, name + ", margin " + std::to_string(margin));
  }
  EXPECT_GT(pairs, 10000u);
}

// Edges parallel and in line, vertices on edges, facets that are segments, points or repeated, needles.
TEST(WithinReach, OfHostileMeshesAreThoseOfBruteForce) {
  const Mesh flat = sheet(6, 6, 1.0, 1.0);
  for (const double height : {0.0, 0x1p-20, 0.01}) {
    for (const double shift : {0.0, 1.0 / 12, 0.03}) {
      const std::string what = "height " + std::to_string(height) + ", shift " + std::to_string(shift);
      expect_pairs_of_two(flat, translated(flat, {shift, 0.0, height}), 0.02, "sheets, " + what);
      expect_pairs_of_two(flat, jittered(translated(flat, {shift, 0.0, height}), 1e-9, 3), 0.02, "jittered, " + what);
    }
  }
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Mesh lattice = lattice_soup(50, 3, seed);
    expect_pairs_of_two(lattice, lattice_soup(50, 3, seed + 7), 0.3, "lattice " + std::to_string(seed));
    expect_own_pairs(lattice, 0.3, "lattice " + std::to_string(seed));
    expect_own_pairs(needles(40, 1e-7, seed), 0.02, "needles " + std::to_string(seed));
    expect_own_pairs(broken(sheet(5, 5, 1.0, 1.0), seed), 0.05, "broken " + std::to_string(seed));
    const std::vector<Mesh> messy = messy_soups(60, seed);
    expect_pairs_of_two(messy[0], messy[1], 0.05, "messy " + std::to_string(seed));
  }
}

// A fan of facets and one that stands over its middle: every facet of the fan has the middle as its nearest vertex.
TEST(WithinReach, OfOneNearestVertexAreAllItsFacets) {
  MeshBuilder fan, tip;
  const int middle = fan.vertex({0, 0, 0});
  for (const Vec3 p : {Vec3{1, 0, -1}, Vec3{0, 1, -1}, Vec3{-1, 0, -1}, Vec3{0, -1, -1}}) fan.vertex(p);
  for (int k = 0; k < 4; ++k) fan.facet(middle, 1 + k, 1 + (k + 1) % 4);
  tip.triangle({0, 0, 0.1}, {1, 0, 2}, {0, 1, 2});
  World world({.threads = 1, .outputs = {.within_reach = true}});
  for (const Mesh& mesh : {fan.mesh(), tip.mesh()})
    world.add_body({.positions = mesh.positions, .facets = mesh.facets, .surface = Surface::sheet, .margin = 0.075});
  const auto pairs = world.detect().contacts()[0].within_reach();
  int of_facets = 0, of_edges = 0;
  for (const ReachPair& pair : pairs) {
    EXPECT_EQ(pair.distance, 0.1);
    EXPECT_EQ(pair.normal, (std::array<double, 3>{0, 0, 1}));
    of_facets += pair.kind == FeaturePair::facet_vertex;
    of_edges += pair.kind == FeaturePair::edge_edge;
    EXPECT_EQ(std::ranges::count(pair.a_weights, 1.0), 1);
    EXPECT_EQ(std::ranges::count(pair.b_weights, 1.0), 1);
  }
  EXPECT_EQ(of_facets, 4);
  EXPECT_EQ(of_edges, 8);
  EXPECT_EQ(pairs.size(), 13u);  // and the middle with the facet
}

// Nothing of them depends on threads, nor on which features were found first.
TEST(WithinReach, AreTheSameForAnyNumberOfThreads) {
  const Mesh cloth = wrinkled_sheet(40, 2.0, 0.3, 1), other = translated(wrinkled_sheet(40, 2.0, 0.3, 2), {0, 0, 0.02});
  std::set<std::uint64_t> hashes;
  std::size_t pairs = 0;
  for (const int threads : {1, 2, 3}) {
    World world({.threads = threads, .outputs = {.within_reach = true}});
    for (const Mesh* mesh : {&cloth, &other})
      world.add_body({.positions = mesh->positions,
                      .facets = mesh->facets,
                      .surface = Surface::sheet,
                      .margin = 0.02,
                      .self_contact = true});
    const Report& report = world.detect();
    hashes.insert(report.hash());
    pairs = static_cast<std::size_t>(report.stats().within_reach);
  }
  EXPECT_EQ(hashes.size(), 1u);
  EXPECT_GT(pairs, 10000u);
}

// What the step did not look at keeps them; what is not asked for is not there.
TEST(WithinReach, StayWithBodiesAtRestAndGoWithTheOutput) {
  World world({.threads = 1, .outputs = {.within_reach = true}});
  const Mesh ball = icosphere(2);
  const auto add = [&](double x) {
    return world.add_body({.positions = translated(ball, {x, 0, 0}).positions, .facets = ball.facets, .margin = 0.05});
  };
  add(0.0), add(2.05);
  const BodyId last = add(4.1);
  const std::int64_t all = world.detect().stats().within_reach;
  EXPECT_GT(all, 0);
  world.set_positions(last, translated(ball, {5.0, 0, 0}).positions);
  const Report& report = world.detect();
  EXPECT_EQ(report.stats().within_reach, static_cast<std::int64_t>(report.contacts()[0].within_reach().size()));
  EXPECT_GT(report.stats().within_reach, 0);
  EXPECT_LT(report.stats().within_reach, all);
  world.set_settings({.threads = 1});
  EXPECT_EQ(world.detect().stats().within_reach, 0);
  EXPECT_TRUE(world.detect().contacts()[0].within_reach().empty());
}

}  // namespace
}  // namespace tact::tests
