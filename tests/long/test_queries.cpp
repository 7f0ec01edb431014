// Rays, nearest points, boxes and what is inside, hard ones, against brute force: sets from CGAL's exact predicates,
// places and distances in long doubles. Rays that are asked together are held, bit for bit, against each asked alone.
// Not part of the ordinary tests: how many is read from the environment.
//   TACT_LONG_QUERIES  4000 if not set
//   TACT_LONG_SEED       which queries, 1 if not set
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "tests/support/environment/environment.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/oracles/query_oracle.h"

namespace tact::tests {
namespace {

constexpr std::uint64_t kBlock = 200;      // queries
constexpr std::uint64_t kTogether = 2000;  // rays to meshes that are too large for brute force
constexpr std::size_t kFailuresShown = 10;
enum QueryKind : std::size_t { kRay, kPoint, kBox, kInside, kKinds };

struct BlockResult {
  std::array<std::uint64_t, kKinds> asked{}, found{};  // found: that have an answer, or a distance of zero
  double worst_place = 0.0, worst_distance = 0.0;      // relative to the sizes in query
  std::vector<std::string> failures;
};

// How many of the answers to rays asked together are not those, to the last bit, to each asked alone.
std::size_t differing_together(const World& world, std::span<const Ray> rays) {
  std::vector<RayHit> hits(rays.size());
  world.cast_rays(rays, hits);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayHit &one = hits[i], alone = world.cast_ray(rays[i]);
    differing += !(one.body == alone.body && one.facet == alone.facet && one.fraction == alone.fraction &&
                   one.barycentric == alone.barycentric);
  }
  return differing;
}

// Small ones, for brute force, closed or not.
Mesh some_mesh(Random& random) {
  const std::uint64_t seed = random.bits() % 1000;
  switch (random.below(8)) {
    case 0: return blob(1, 1.0, 0.3, seed);
    case 1: return torus(8, 8, 1.0, 0.4);
    case 2: return gridded_box({-1, -1, -1}, {1, 1, 1}, 3);
    case 3: return soup(100, 2.0, seed);
    case 4: return lattice_soup(80, 3, seed);
    case 5: return needles(60, 1e4, seed);
    case 6: return wrinkled_sheet(7, 2.0, 0.3, seed);
    default: return blob(2, 1.0, 0.3, seed);
  }
}

// Closed ones that do not meet themselves.
Mesh some_solid(Random& random) {
  switch (random.below(4)) {
    case 0: return torus(8, 8, 1.0, 0.4);
    case 1: return gridded_box({-1, -1, -1}, {1, 1, 1}, 3);
    case 2: return icosphere(2);
    default: return random_hull(30, random.bits() % 1000);
  }
}

class Block {
 public:
  Block(std::uint64_t seed, BlockResult& result)
      : random_(seed), result_(result), mesh_(some_mesh(random_)), solid_(some_solid(random_)) {
    body_ =
        world_.add_body({.positions = mesh_.positions, .facets = mesh_.facets, .surface = Surface::sheet, .layer = 1});
    extent_ = mesh_.positions.colwise().norm().maxCoeff();
    closed_ = world_.add_body({.positions = solid_.positions, .facets = solid_.facets, .layer = 2});
  }

  void ask_all() {
    for (std::uint64_t k = 0; k < kBlock; ++k) ask();
    expect(differing_together(world_, rays_) == 0, "rays asked together have other answers");
  }

 private:
  static constexpr QueryFilter kMesh{.mask = 1}, kSolid{.mask = 2};

  void ask() {
    const int kind = random_.below(8);
    if (kind < 4) return ask_ray();
    if (kind < 6) return ask_point();
    kind == 6 ? ask_box() : ask_inside();
  }

  void note(QueryKind kind, bool found) {
    ++result_.asked[kind];
    result_.found[kind] += found;
  }
  void expect(bool holds, const std::string& what) {
    if (!holds) result_.failures.push_back("query " + std::to_string(result_.asked[kRay]) + ", " + what);
  }

  void ask_ray() {
    Ray ray = hard_ray(mesh_, random_);
    ray.filter = kMesh;
    rays_.push_back(ray);
    const std::vector<RayHit> all = world_.cast_ray_all(ray);
    std::vector<int> facets;
    for (const RayHit& hit : all) {
      facets.push_back(hit.facet);
      check_place(ray, hit);
    }
    std::ranges::sort(facets);
    note(kRay, !facets.empty());
    expect(facets == hit_facets(mesh_, ray), "a ray meets other facets");
    const RayHit first = world_.cast_ray(ray), any = world_.cast_ray(ray, RayHits::any);
    expect((first.facet < 0) == all.empty() && (any.facet < 0) == all.empty(), "a ray hits and does not");
    if (all.empty()) return;
    expect(first.facet == all[0].facet && first.fraction == all[0].fraction, "the first hit is not the first of all");
    expect(std::ranges::count(facets, any.facet) == 1, "any hit is none of all");
  }

  // The place on the ray is that on the facet.
  void check_place(const Ray& ray, const RayHit& hit) {
    using Vector = Eigen::Matrix<long double, 3, 1>;
    const Triangle t = facet_at(mesh_, hit.facet);
    const Vector from = ray.from.cast<long double>(), way = ray.to.cast<long double>() - from;
    Vector on_facet = Vector::Zero();
    long double size = way.norm(), sum = 0.0L;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector corner = vector_of(t[k]).cast<long double>();
      on_facet += static_cast<long double>(hit.barycentric[k]) * corner;
      size = std::max(size, (corner - from).norm());
      sum += hit.barycentric[k];
      expect(hit.barycentric[k] >= 0.0, "a weight is negative");
    }
    const Vector on_ray = from + static_cast<long double>(hit.fraction) * way;
    const double off = size > 0 ? static_cast<double>((on_ray - on_facet).norm() / size) : 0.0;
    result_.worst_place = std::max(result_.worst_place, off);
    expect(off <= 1e-12, "a hit is off by " + std::to_string(off * 1e12) + "e-12");
    expect(std::abs(sum - 1.0L) <= 1e-12L, "weights do not add up to 1");
    expect(hit.fraction >= 0.0 && hit.fraction <= 1.0, "a time is " + std::to_string(hit.fraction));
  }

  void ask_point() {
    const Vec3 p = hard_point(mesh_, random_);
    const ClosestPoint answer = world_.closest_point({.point = vector_of(p), .filter = kMesh});
    const long double exact = distance_by_brute_force(mesh_, p);
    const double size = norm(p) + extent_;
    note(kPoint, exact < 1e-12L);
    const double off = static_cast<double>(std::abs(answer.distance - exact)) / size;
    const double place =
        std::abs(norm(weighted(facet_at(mesh_, answer.facet), answer.barycentric) - p) - static_cast<double>(exact)) /
        size;
    result_.worst_distance = std::max({result_.worst_distance, off, place});
    expect(off <= 1e-12 && place <= 1e-12,
           "a nearest point is off by " + std::to_string(std::max(off, place) * 1e12) + "e-12");
  }

  void ask_box() {
    BoxQuery box = hard_box(mesh_, random_);
    box.filter = kMesh;
    std::vector<int> facets;
    for (const FacetOfBody& one : world_.overlap_box(box)) facets.push_back(one.facet);
    note(kBox, !facets.empty());
    expect(facets == facets_in(mesh_, box), "a box meets other facets");
  }

  void ask_inside() {
    const Vec3 p = random_.chance(0.5) ? hard_point(solid_, random_) : 1.2 * random_.in_cube(1.0);
    const std::vector<BodyId> found = world_.bodies_containing({.point = vector_of(p), .filter = kSolid});
    const bool expected = is_inside(solid_, p, random_);
    note(kInside, expected);
    expect(expected ? found == std::vector{closed_} : found.empty(),
           expected ? "a point is not inside" : "a point is inside");
  }

  Random random_;
  BlockResult& result_;
  Mesh mesh_, solid_;
  World world_{{.threads = 1}};
  BodyId body_, closed_;
  std::vector<Ray> rays_;  // asked so far
  double extent_ = 0.0;    // of the mesh, from the origin
};

TEST(LongQueries, EqualBruteForce) {
  const std::uint64_t count = from_environment("TACT_LONG_QUERIES", 4000);
  const std::uint64_t seed = from_environment("TACT_LONG_SEED", 1);
  std::vector<BlockResult> blocks((count + kBlock - 1) / kBlock);
  base::parallel_for(blocks.size(), 1, base::default_threads(), [&](std::size_t i) {
    Block block(seed * 1'000'000'007 + i, blocks[i]);
    block.ask_all();
  });
  BlockResult sum;
  std::size_t failed = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::size_t k = 0; k < kKinds; ++k) {
      sum.asked[k] += blocks[i].asked[k];
      sum.found[k] += blocks[i].found[k];
    }
    sum.worst_place = std::max(sum.worst_place, blocks[i].worst_place);
    sum.worst_distance = std::max(sum.worst_distance, blocks[i].worst_distance);
    for (const std::string& failure : blocks[i].failures) {
      if (++failed <= kFailuresShown) ADD_FAILURE() << "block " << i << ": " << failure;
    }
  }
  const std::array<const char*, kKinds> names{"rays, with hits", "points, on a surface", "boxes, with facets",
                                              "points, inside"};
  for (std::size_t k = 0; k < kKinds; ++k) {
    std::printf("%llu %s %llu\n", static_cast<unsigned long long>(sum.asked[k]), names[k],
                static_cast<unsigned long long>(sum.found[k]));
    EXPECT_GT(sum.found[k], sum.asked[k] / 20);
    EXPECT_LT(sum.found[k], sum.asked[k]);
  }
  std::printf("places of hits are off by %.1e at most, nearest points by %.1e; %zu failures\n", sum.worst_place,
              sum.worst_distance, failed);
  EXPECT_EQ(failed, 0u);
}

// Up to 80 nodes of a tree, and groups of them.
Mesh some_large_mesh(Random& random) {
  const std::uint64_t seed = random.bits() % 1000;
  switch (random.below(6)) {
    case 0: return blob(4, 1.0, 0.3, seed);
    case 1: return blob(5, 1.0, 0.3, seed);
    case 2: return soup(6000, 2.0, seed);
    case 3: return lattice_soup(3000, 5, seed);
    case 4: return needles(4000, 1e4, seed);
    default: return wrinkled_sheet(30 + random.below(70), 2.0, 0.3, seed);
  }
}

TEST(LongQueries, ManyRaysToLargeMeshesAnswerAsEachAlone) {
  const std::uint64_t count = from_environment("TACT_LONG_QUERIES", 4000);
  const std::uint64_t seed = from_environment("TACT_LONG_SEED", 1);
  std::vector<std::size_t> differing((count + kTogether - 1) / kTogether);
  base::parallel_for(differing.size(), 1, base::default_threads(), [&](std::size_t i) {
    Random random(seed * 1'000'000'009 + i);
    World world({.threads = 1});
    std::array<Mesh, 2> meshes;
    for (std::uint32_t k = 0; k < meshes.size(); ++k) {
      meshes[k] = some_large_mesh(random);
      world.add_body({.positions = meshes[k].positions,
                      .facets = meshes[k].facets,
                      .surface = Surface::sheet,
                      .layer = std::uint32_t{1} << k});
    }
    std::vector<Ray> rays;
    for (std::uint64_t k = 0; k < kTogether; ++k) {
      Ray ray = hard_ray(meshes[random.below(2)], random);
      ray.filter.mask = static_cast<std::uint32_t>(1 + random.below(3));
      rays.push_back(ray);
    }
    differing[i] = differing_together(world, rays);
  });
  for (std::size_t i = 0; i < differing.size(); ++i) EXPECT_EQ(differing[i], 0u) << "block " << i << ", seed " << seed;
}

}  // namespace
}  // namespace tact::tests
