#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "narrowphase/triangles/lattice.h"
#include "narrowphase/triangles/triangle_triangle.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_blocks.h"

namespace tact::narrowphase {
namespace {

using tests::all_with;
using tests::block_of;
using tests::bodies;
using tests::bounds_of;
using tests::clustered;
using tests::decide_all;
using tests::Decisions;
using tests::Digits;
using tests::expect_right;
using tests::kAnywhere;
using tests::kSpace;
using tests::merged;
using tests::Mesh;
using tests::MeshBuilder;

TEST(FacetDecisions, DecisionsAreRight) {
  for (int seed = 0; seed < 16; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    SCOPED_TRACE(seed);
    for (const Kernels* kernels : tests::available_kernels()) {
      for (const Digits digits : {Digits::few, Digits::simple, Digits::wide}) expect_right(*kernels, a, b, digits);
    }
  }
}

// A triangle with edges along the diagonals of a cube, and others with a corner next to its plane: the products of a
// determinant come as near as can be to those of the cube's sides.
std::pair<Mesh, Mesh> corners_next_to_a_plane() {
  MeshBuilder a, b;
  a.triangle({0, 0, 1}, {1, 1, 0}, {1, 0.9, 0.8});
  for (int k = -30; k <= 30; ++k) {
    b.triangle({1, 0.95, 0.4 + k * 0x1p-49}, {0.2, 0.9, 0.9}, {0.9, 0.1, 0.1});
  }
  return {a.mesh(), b.mesh()};
}

// Where rounding is bounded for all pairs at once, that is no tighter than the bound of each determinant: the same is
// decided with the tightest box of a pair as with one that tells nothing.
TEST(FacetDecisions, DecisionsDoNotDependOnTheBounds) {
  std::size_t undecided = 0, decided = 0;
  for (int seed = 0; seed < 17; ++seed) {
    for (const double scale : {1.0, 0x1p-260}) {
      auto [mesh_a, mesh_b] = seed < 16 ? bodies(seed) : corners_next_to_a_plane();
      mesh_a.positions *= scale;
      mesh_b.positions *= scale;
      const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
      for (const Kernels* kernels : tests::available_kernels()) {
        const FacetBlock block_a = block_of(*kernels, a, 0), block_b = block_of(*kernels, b, 0);
        for (int f = 0; f < block_a.count; ++f) {
          for (int g = 0; g < block_b.count; ++g) {
            FacetPairList pair;
            pair.count = 1;
            pair.a[0] = static_cast<std::uint8_t>(f);
            pair.b[0] = static_cast<std::uint8_t>(g);
            const BoxBounds bounds = bounds_of(pair, block_a, block_b);
            const PairMatches tight = tests::match_pairs(*kernels, block_a, block_b, pair, bounds);
            const PairMatches loose = tests::match_pairs(*kernels, block_a, block_b, pair, kSpace);
            ASSERT_FALSE(tests::on_lattice(*kernels, block_a, block_b, kSpace));
            if (tests::on_lattice(*kernels, block_a, block_b, bounds)) {  // more is decided
              ASSERT_EQ(tight.undecided & ~loose.undecided, 0u);
              continue;
            }
            ASSERT_EQ(tight.meeting, loose.meeting) << kernels->name << " seed " << seed << ": " << f << ' ' << g;
            ASSERT_EQ(tight.undecided, loose.undecided) << kernels->name << " seed " << seed << ": " << f << ' ' << g;
            ASSERT_EQ(tight.flat, loose.flat) << kernels->name << " seed " << seed << ": " << f << ' ' << g;
            (tight.undecided != 0 ? undecided : decided) += 1;
          }
        }
      }
    }
  }
  EXPECT_GT(undecided, 5'000u);
  EXPECT_GT(decided, 10'000u);
}

// Products of tiny differences vanish: that is no zero.
TEST(FacetDecisions, DecisionsAreRightOfTinyFacets) {
  for (int seed = 0; seed < 16; ++seed) {
    auto [mesh_a, mesh_b] = bodies(seed);
    for (const double scale : {0x1p-190, 0x1p-280, 0x1p-350, 0x1p-500, 0x1p-1000}) {
      Mesh small_a = mesh_a, small_b = mesh_b;
      small_a.positions *= scale;
      small_b.positions *= scale;
      const ClusteredMesh a = clustered(small_a), b = clustered(small_b);
      SCOPED_TRACE(::testing::Message() << "seed " << seed << " scale " << scale);
      for (const Kernels* kernels : tests::available_kernels()) {
        for (const Digits digits : {Digits::few, Digits::simple, Digits::wide}) expect_right(*kernels, a, b, digits);
      }
    }
  }
}

// A lattice whose zeros are off by so little that products with them vanish: what looks like zero is none.
TEST(FacetDecisions, DecisionsAreRightWhereProductsVanish) {
  const auto disturbed = [](Mesh mesh, double by, std::uint64_t seed) {
    tests::Random random(seed);
    for (double& x : mesh.positions.reshaped()) x = x == 0.0 ? (random.below(3) - 1) * by : x;
    return mesh;
  };
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const double by : {0x1p-190, 0x1p-540, 0x1p-1000, 0x1p-1074}) {
      const ClusteredMesh a = clustered(disturbed(tests::lattice_soup(60, 1, seed), by, seed));
      const ClusteredMesh b = clustered(disturbed(tests::lattice_soup(60, 1, seed + 99), by, seed + 1));
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", zeros off by " << by);
      for (const Kernels* kernels : tests::available_kernels()) {
        for (const Digits digits : {Digits::few, Digits::simple, Digits::wide}) expect_right(*kernels, a, b, digits);
      }
    }
  }
}

bool share_a_corner(const Triangle& a, const Triangle& b) {
  for (const Vec3& p : a) {
    if (std::find(b.begin(), b.end(), p) != b.end()) return true;
  }
  return false;
}

// Double-double tells on which side a corner lies that rounding alone keeps from a plane.
TEST(FacetDecisions, WideDecidesWhatRoundingPutsNextToAPlane) {
  for (const int seed : {3, 7, 11, 15}) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const auto undecided = [&](Digits digits) {
      const std::vector<FacetPair> pairs = decide_all(*scalar_kernels(), a, b, digits).undecided;
      return std::count_if(pairs.begin(), pairs.end(), [&](const FacetPair& pair) {
        return !share_a_corner(a.triangle(pair.a), b.triangle(pair.b));
      });
    };
    EXPECT_GT(undecided(Digits::simple), 100);
    EXPECT_LT(3 * undecided(Digits::wide), undecided(Digits::simple));
  }
}

TEST(FacetDecisions, SharingPairsHaveACornerInCommon) {
  const auto [mesh_a, mesh_b] = bodies(0);
  const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
  std::size_t sharing = 0;
  for (const Kernels* kernels : tests::available_kernels()) {
    const FacetBlock block_a = block_of(*kernels, a, 0), block_b = block_of(*kernels, b, 0);
    for (int f = 0; f < a.facet_end(0); ++f) {
      FacetPairList pairs;
      std::uint64_t expected = 0;
      for (int g = 0; g < b.facet_end(0); ++g) {
        pairs.a[pairs.count] = static_cast<std::uint8_t>(f);
        pairs.b[pairs.count++] = static_cast<std::uint8_t>(g);
        expected |= static_cast<std::uint64_t>(share_a_corner(a.triangle(f), b.triangle(g))) << g;
      }
      constexpr std::uint64_t kSome = 0xfedcba9876543210;
      EXPECT_EQ(kernels->sharing_pairs(block_a, block_b, pairs, kSome), expected & kSome) << kernels->name;
      sharing += static_cast<std::size_t>(std::popcount(expected & kSome));
    }
  }
  EXPECT_GT(sharing, 100u);
}

TEST(FacetDecisions, TouchingPairsOfALatticeAreDecided) {
  const ClusteredMesh a = clustered(tests::lattice_soup(60, 2, 1)), b = clustered(tests::lattice_soup(60, 2, 8));
  std::size_t touching_and_decided = 0;
  for (const FacetPair& pair : decide_all(*scalar_kernels(), a, b).meeting) {
    const Triangle p = a.triangle(pair.a), q = b.triangle(pair.b);
    PredicateCounts counts;
    const std::array<int, 3> sides = sides_of_plane(p[0], p[1], p[2], q, counts);
    if (sides[0] == 0 || sides[1] == 0 || sides[2] == 0) ++touching_and_decided;
  }
  EXPECT_GT(touching_and_decided, 20u);
}

bool has_area(const Triangle& t) {
  return cross(t[1] - t[0], t[2] - t[0]) != Vec3{};  // exact on a lattice
}

// All pairs but those with a facet that has no area are decided, and rightly. Returns how many.
int expect_all_decided(const PairMatches& matches, const ClusteredMesh& a, int f, const ClusteredMesh& b) {
  int decided = 0;
  for (int g = 0; g < b.facet_end(0); ++g) {
    if ((matches.undecided >> g & 1) != 0) {
      EXPECT_FALSE(has_area(a.triangle(f)) && has_area(b.triangle(g))) << f << ' ' << g;
      continue;
    }
    PredicateCounts counts;
    EXPECT_EQ((matches.meeting >> g & 1) != 0, triangle_triangle_meet(a.triangle(f), b.triangle(g), counts))
        << f << ' ' << g;
    ++decided;
  }
  return decided;
}

// All pairs of two lattices, offset and scaled in a way that leaves them lattices.
TEST(FacetDecisions, PairsOnALatticeAreAllDecided) {
  int decided = 0, in_plane = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (const auto& [scale, offset] :
         {std::pair{1.0, 0.0}, {0x1p-6, 0x1p20}, {0x1p-100, -0x1p-80}, {3.0, 0x1p36}, {1000.0, 5e8}}) {
      const auto placed = [scale = scale, offset = offset](std::uint64_t of) {
        Mesh mesh = tests::lattice_soup(60, of % 2 == 0 ? 1 : 3, of);
        mesh.positions = (scale * mesh.positions).array() + offset;
        return mesh;
      };
      const ClusteredMesh a = clustered(placed(seed)), b = clustered(placed(seed + 50));
      const BoxBounds bounds = narrowphase::bounds_of(base::merged(a.box(), b.box()));
      for (const Kernels* kernels : tests::available_kernels()) {
        SCOPED_TRACE(::testing::Message() << kernels->name << " scale " << scale << " offset " << offset);
        const FacetBlock block_a = block_of(*kernels, a, 0, kAnywhere), block_b = block_of(*kernels, b, 0, kAnywhere);
        ASSERT_TRUE(tests::on_lattice(*kernels, block_a, block_b, bounds));
        for (int f = 0; f < a.facet_end(0); ++f) {
          const FacetPairList pairs = all_with(f, b.facet_end(0));
          for (int g = 0; g < b.facet_end(0); ++g) {
            const bool areas = has_area(a.triangle(f)) && has_area(b.triangle(g));
            in_plane += areas && tests::lies_in_plane(a.triangle(f), b.triangle(g)) ? 1 : 0;
          }
          decided += expect_all_decided(kernels->match_exact_pairs(block_a, block_b, pairs), a, f, b);
          const auto in_floats = tests::match_exact_float_pairs(*kernels, block_a, block_b, pairs, bounds);
          ASSERT_EQ(in_floats.has_value(), scale != 1000.0);  // 8, and not 1000, is the largest power of two in it
          if (in_floats) decided += expect_all_decided(*in_floats, a, f, b);
        }
      }
    }
  }
  EXPECT_GT(decided, 100'000);
  EXPECT_GT(in_plane, 1000);
}

// Facets as large as a box on the finest lattice for floats, and others with corners next to their planes: no
// determinant is rounded.
TEST(FacetDecisions, FloatsRoundNothingOnTheFinestLattice) {
  tests::Random random(5);
  int decided = 0, touching = 0;
  for (int repeat = 0; repeat < 300; ++repeat) {
    const auto side = [&] { return repeat % 2 == 0 ? 139.0 : random.uniform(1.0, 200.0); };  // 6 * 139³ < 2^24
    const std::array<double, 3> most{side(), side(), side()};
    const double step = finest_lattice_in_floats({{0, 0, 0}, {most[0], most[1], most[2]}}).step;
    const auto rounded = [&](double x) { return std::floor(x / step) * step; };
    const auto point = [&](Vec3 p) { return Vec3{rounded(p.x), rounded(p.y), rounded(p.z)}; };
    const auto coordinate = [&](double last) { return random.uniform(-0.3, 1.3) < 0.5 ? 0.0 : last; };
    const auto corner = [&] {
      const double x = random.below(3) == 0 ? random.uniform(0.0, most[0]) : coordinate(most[0]);
      const double y = random.below(3) == 0 ? random.uniform(0.0, most[1]) : coordinate(most[1]);
      return point({x, y, random.below(3) == 0 ? random.uniform(0.0, most[2]) : coordinate(most[2])});
    };
    MeshBuilder a, b;
    const Vec3 p = corner(), q = corner(), r = corner();
    a.triangle(p, q, r);
    a.triangle({}, point({most[0], 0, 0}), point({most[0], most[1], most[2]}));
    for (int k = 0; k < 60; ++k) {
      const double s = random.uniform(0.0, 1.0), t = random.uniform(0.0, 1.0 - s);
      b.triangle(point(p + s * (q - p) + t * (r - p)), corner(), point(p + t * (q - p)));
    }
    const ClusteredMesh mesh_a = clustered(a.mesh()), mesh_b = clustered(b.mesh());
    const BoxBounds bounds = narrowphase::bounds_of(base::merged(mesh_a.box(), mesh_b.box()));
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block_a = block_of(*kernels, mesh_a, 0, kAnywhere);
      const FacetBlock block_b = block_of(*kernels, mesh_b, 0, kAnywhere);
      for (int f = 0; f < mesh_a.facet_end(0); ++f) {
        const FacetPairList pairs = all_with(f, mesh_b.facet_end(0));
        const auto matches = tests::match_exact_float_pairs(*kernels, block_a, block_b, pairs, bounds);
        ASSERT_TRUE(matches.has_value());
        decided += expect_all_decided(*matches, mesh_a, f, mesh_b);
      }
    }
    PredicateCounts counts;
    for (int g = 0; g < mesh_b.facet_end(0); ++g) {
      const std::array<int, 3> sides = sides_of_plane(p, q, r, mesh_b.triangle(g), counts);
      touching += std::count(sides.begin(), sides.end(), 0) > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(decided, 30'000);
  EXPECT_GT(touching, 1000);
}

// A coordinate next to one of a lattice is none.
TEST(FacetDecisions, ACoordinateBesideALatticeIsNoticed) {
  Mesh mesh = tests::lattice_soup(20, 3, 5);
  const ClusteredMesh b = clustered(mesh);
  for (Eigen::Index i = 0; i < 3 * mesh.facets.size(); ++i) {
    Mesh other = mesh;
    double& x = other.positions(i % 3, mesh.facets.reshaped()[i / 3]);
    x = x == 0.0 ? 0x1p-1074 : std::nextafter(x, 1e300);
    const ClusteredMesh a = clustered(other);
    const double step = finest_lattice_in_doubles(narrowphase::bounds_of(base::merged(a.box(), b.box()))).step;
    ASSERT_GT(step, 0.0);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block_a = block_of(*kernels, a, 0, kAnywhere), block_b = block_of(*kernels, b, 0, kAnywhere);
      EXPECT_FALSE(kernels->on_lattice(block_a, step)) << kernels->name << ' ' << i;
      EXPECT_TRUE(kernels->on_lattice(block_b, step)) << kernels->name << ' ' << i;
    }
  }
}

// Coordinates of more digits than a lattice has are none: of 2^16 steps for doubles, and 2^7 for floats in a cube.
TEST(FacetDecisions, ALatticeHasFewSteps) {
  for (int digits = 1; digits < 20; ++digits) {
    MeshBuilder builder;
    builder.triangle({0, 0, 0}, {1, 0, std::ldexp(1.0, -digits)}, {0, 1, 1});
    const ClusteredMesh mesh = clustered(builder.mesh());
    const BoxBounds bounds = narrowphase::bounds_of(mesh.box());
    const double in_doubles = finest_lattice_in_doubles(bounds).step, in_floats = finest_lattice_in_floats(bounds).step;
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, mesh, 0, kAnywhere);
      EXPECT_EQ(kernels->on_lattice(block, in_doubles), digits <= 15) << kernels->name << ' ' << digits;
      EXPECT_EQ(kernels->on_lattice(block, in_floats), digits <= 7) << kernels->name << ' ' << digits;
    }
  }
}

// A flat box has more steps along its sides, up to 2^10.
TEST(Lattice, IsTheFinestThatRoundsNothing) {
  const auto step = [](double x, double y, double z) { return finest_lattice_in_floats({{0, 0, 0}, {x, y, z}}).step; };
  EXPECT_EQ(step(1, 1, 1), 1.0 / 128);
  EXPECT_EQ(step(1.5, 1.5, 1.5), 1.0 / 64);
  EXPECT_EQ(step(0.75, 0.75, 0.0), 1.0 / 1024);
  EXPECT_EQ(step(139, 139, 139), 1.0);
  EXPECT_EQ(step(141, 141, 141), 2.0);
  EXPECT_EQ(step(0x1p-100, 0x1p-100, 0x1p-100), 0x1p-107);
  EXPECT_EQ(step(0, 0, 0), 0.0);
  EXPECT_EQ(finest_lattice_in_doubles({{0, 0, 0}, {1, 1, 1}}).step, 0x1p-15);
  // Coordinates that have no room for a part of a step beside them.
  EXPECT_EQ(finest_lattice_in_doubles({{0x1p40, 0, 0}, {0x1p40 + 1, 1, 1}}).step, 0.0);
  EXPECT_EQ(finest_lattice_in_floats({{0x1p40, 0, 0}, {0x1p40 + 1, 1, 1}}).step, 1.0 / 128);
  EXPECT_EQ(finest_lattice_in_floats({{-0x1p45, 0, 0}, {1 - 0x1p45, 1, 1}}).step, 0.0);
}

// Corners so near to a plane, and edges so near to another, that floats are just about to tell.
TEST(FacetDecisions, FloatsAreSilentWithinTheirRounding) {
  tests::Random random(12);
  const auto point = [&] { return Vec3{random.uniform(0.0, 1.0), random.uniform(0.0, 1.0), random.uniform(0.0, 1.0)}; };
  int told = 0, silent = 0;
  for (int repeat = 0; repeat < 400; ++repeat) {
    const Vec3 scale{std::ldexp(1.0, random.below(60) - 30), std::ldexp(1.0, random.below(60) - 30), 1.0};
    const double offset = repeat % 3 == 0 ? 100.0 : 0.0;
    const auto placed = [&](Vec3 p) {
      return Vec3{scale.x * (p.x + offset), scale.y * (p.y + offset), scale.z * (p.z + offset)};
    };
    MeshBuilder a, b;
    const Vec3 p = point(), q = point(), r = point();
    a.triangle(placed(p), placed(q), placed(r));
    const Vec3 n = cross(q - p, r - p);
    for (int k = 0; k < 60; ++k) {
      const double s = random.uniform(0.1, 0.4), t = k % 2 == 0 ? random.uniform(0.1, 0.4) : 0.0;  // inside, on a side
      const double away = random.uniform(-200.0, 200.0) * 0x1p-24 / dot(n, n);
      const Vec3 near = p + s * (q - p) + t * (r - p) + away * n;
      b.triangle(placed(near), placed(near + n), placed(near + n + 0.1 * (q - p)));
    }
    const ClusteredMesh mesh_a = clustered(a.mesh()), mesh_b = clustered(b.mesh());
    for (const Kernels* kernels : tests::available_kernels()) {
      expect_right(*kernels, mesh_a, mesh_b, Digits::few, kAnywhere);
      const Decisions decisions = decide_all(*kernels, mesh_a, mesh_b, Digits::few, kAnywhere);
      silent += static_cast<int>(decisions.undecided.size());
      told += 60 - static_cast<int>(decisions.undecided.size());
    }
  }
  EXPECT_GT(told, 1000);
  EXPECT_GT(silent, 1000);
}

// All pairs of facets whose boxes overlap are decided within the unit cube, one facet of `a` after the other; nothing
// that floats say is wrong.
int decided_in_unit_cube(const Kernels& kernels, const ClusteredMesh& a, const ClusteredMesh& b) {
  const FacetBlock block_a = block_of(kernels, a, 0), block_b = block_of(kernels, b, 0);
  int decided = 0;
  for (int f = 0; f < block_a.count; ++f) {
    FacetPairList pairs;
    for (int g = 0; g < block_b.count; ++g) {
      if (!overlaps(tests::facet_box(a, f), tests::facet_box(b, g))) continue;
      pairs.a[pairs.count] = static_cast<std::uint8_t>(f);
      pairs.b[pairs.count++] = static_cast<std::uint8_t>(g);
    }
    if (pairs.count == 0) continue;
    const PairMatches matches = tests::match_float_pairs(kernels, block_a, block_b, pairs, {{0, 0, 0}, {1, 1, 1}});
    for (int k = 0; k < pairs.count; ++k) {
      if ((matches.undecided >> k & 1) != 0) continue;
      PredicateCounts counts;
      EXPECT_EQ((matches.meeting >> k & 1) != 0, triangle_triangle_meet(a.triangle(f), b.triangle(pairs.b[k]), counts))
          << kernels.name << ' ' << f << ' ' << static_cast<int>(pairs.b[k]);
      ++decided;
    }
  }
  return decided;
}

// Facets as small as the rounding of their corners, in a box of size one.
TEST(FacetDecisions, FloatsAreSilentOfFacetsTheySeeAsPoints) {
  for (int seed = 0; seed < 12; ++seed) {
    for (int halvings = 0; halvings < 45; ++halvings) {
      auto [mesh_a, mesh_b] = bodies(seed);
      for (Mesh* mesh : {&mesh_a, &mesh_b}) {
        mesh->positions = (std::ldexp(0.1, -halvings) * mesh->positions).array() + (seed % 2 == 0 ? 0.7 : 0.3);
      }
      for (const Kernels* kernels : tests::available_kernels()) {
        SCOPED_TRACE(::testing::Message() << "seed " << seed << ", halved " << halvings << " times");
        const int decided = decided_in_unit_cube(*kernels, clustered(mesh_a), clustered(mesh_b));
        if (halvings == 0 && seed % 4 != 0) {
          EXPECT_GT(decided, 10);
        } else if (halvings > 26) {
          EXPECT_EQ(decided, 0);
        }
      }
    }
  }
}

// All corners are a float's last bit apart, or none, by less than they are rounded.
TEST(FacetDecisions, FloatsAreSilentWhereRoundingMakesTheFacets) {
  const double u = 0x1p-24, between = double{0.7f} + 0.5 * u;  // half-way to the next float
  for (const double size : {0.01, 0.02, 0.05, 0.06, 0.1, 0.3, 1.0, 2.0}) {
    const auto at = [&](double x, double y, double z) {
      return Vec3{between + size * u * x, between + size * u * y, between + size * u * z};
    };
    const double third = -1.0 / 3.0, half = 0.2;
    MeshBuilder a, b;
    a.triangle(at(1, -1, -1), at(-1, 1, -1), at(-1, -1, 1));
    for (const double x : {-half, half}) {
      b.triangle(at(third + x, third + x, third + x), at(third - x, third - x, third), at(third - x, third, third - x));
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      EXPECT_EQ(decided_in_unit_cube(*kernels, clustered(a.mesh()), clustered(b.mesh())), 0) << kernels->name;
    }
  }
}

TEST(FacetDecisions, FloatsDecideMostPairsOfSmoothBodies) {
  const auto [mesh_a, mesh_b] = bodies(2);
  const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
  const std::size_t pairs = static_cast<std::size_t>(a.facet_end(0)) * static_cast<std::size_t>(b.facet_end(0));
  for (const Kernels* kernels : tests::available_kernels()) {
    EXPECT_LT(10 * decide_all(*kernels, a, b, Digits::few).undecided.size(), pairs) << kernels->name;
  }
}

TEST(FacetDecisions, PairsOfSmoothBodiesAreDecided) {
  const auto [mesh_a, mesh_b] = bodies(2);
  for (const Kernels* kernels : tests::available_kernels()) {
    EXPECT_TRUE(decide_all(*kernels, clustered(mesh_a), clustered(mesh_b)).undecided.empty()) << kernels->name;
  }
}

TEST(FacetDecisions, EveryInstructionSetGivesTheSameBits) {
  for (int seed = 0; seed < 12; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    for (const Kernels* kernels : tests::available_kernels()) {
      for (const Digits digits : {Digits::few, Digits::simple, Digits::wide}) {
        const Decisions one = decide_all(*kernels, a, b, digits), other = decide_all(*scalar_kernels(), a, b, digits);
        EXPECT_EQ(one.meeting, other.meeting) << kernels->name;
        EXPECT_EQ(one.undecided, other.undecided) << kernels->name;
        EXPECT_EQ(one.flat, other.flat) << kernels->name;
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
