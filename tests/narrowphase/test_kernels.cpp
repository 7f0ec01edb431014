#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include "narrowphase/clustered_mesh.h"
#include "narrowphase/confirm.h"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/triangle_triangle.h"
#include "tests/support/clustered.h"
#include "tests/support/facet_filters.h"
#include "tests/support/generators.h"
#include "tests/support/random.h"

namespace tact::narrowphase {
namespace {

using tests::box_of;
using tests::clustered;
using tests::merged;
using tests::Mesh;
using tests::MeshBuilder;

constexpr CullPlanes kAll{{0, 0, 1, 0, 0, 0}, -9, {{-9, -9, -9}, {9, 9, 9}}};

FacetBlock block_of(const Kernels& kernels, const ClusteredMesh& mesh, int cluster, const CullPlanes& planes = kAll) {
  FacetBlock block{};
  kernels.open_cluster(mesh.facets_of(cluster), planes, &block);
  return block;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr BoxBounds kSpace{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
constexpr CullPlanes kAnywhere{{0, 0, 1, 0, 0, 0}, -kInfinity, kSpace};

constexpr BoxBounds kEverything{{-9, -9, -9}, {9, 9, 9}};

// What becomes of all pairs of a facet of `a` and one of `b`.
struct Decisions {
  std::vector<FacetPair> meeting, undecided, flat;
};

enum class Digits { simple, wide };

BoxBounds bounds_of(const FacetPairList& pairs, const FacetBlock& a, const FacetBlock& b) {
  BoxBounds bounds = box_of(a, pairs.a[0]);
  for (int k = 0; k < pairs.count; ++k) bounds = merged(merged(bounds, box_of(a, pairs.a[k])), box_of(b, pairs.b[k]));
  return bounds;
}

FacetPairList all_with(int facet, int count) {
  FacetPairList pairs;
  for (int g = 0; g < count; ++g) {
    pairs.a[pairs.count] = static_cast<std::uint8_t>(facet);
    pairs.b[pairs.count++] = static_cast<std::uint8_t>(g);
  }
  return pairs;
}

Decisions decide_all(const Kernels& kernels, const ClusteredMesh& a, const ClusteredMesh& b,
                     Digits digits = Digits::simple) {
  const FacetBlock block_a = block_of(kernels, a, 0), block_b = block_of(kernels, b, 0);
  Decisions decisions;
  for (int f = 0; f < a.facet_end(0); ++f) {
    const FacetPairList pairs = all_with(f, b.facet_end(0));
    const std::uint64_t all = pairs.count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << pairs.count) - 1;
    const PairMatches matches = digits == Digits::simple
                                    ? kernels.match_pairs(block_a, block_b, pairs, bounds_of(pairs, block_a, block_b))
                                    : kernels.match_pairs_wide(block_a, block_b, pairs, all);
    EXPECT_EQ(matches.meeting & matches.undecided, 0u);
    EXPECT_EQ(matches.flat & ~matches.undecided, 0u);
    for (int g = 0; g < b.facet_end(0); ++g) {
      if ((matches.meeting >> g & 1) != 0) decisions.meeting.push_back({f, g});
      if ((matches.undecided >> g & 1) != 0) decisions.undecided.push_back({f, g});
      if ((matches.flat >> g & 1) != 0) decisions.flat.push_back({f, g});
    }
  }
  return decisions;
}

bool lies_in_plane(const Triangle& a, const Triangle& b) {
  PredicateCounts counts;
  return sides_of_plane(b[0], b[1], b[2], a, counts) == std::array<int, 3>{0, 0, 0};
}

std::vector<FacetPair> meeting_in_truth(const ClusteredMesh& a, const ClusteredMesh& b) {
  std::vector<FacetPair> pairs;
  PredicateCounts counts;
  for (int f = 0; f < a.facet_end(0); ++f) {
    for (int g = 0; g < b.facet_end(0); ++g) {
      if (triangle_triangle_meet(a.triangle(f), b.triangle(g), counts)) pairs.push_back({f, g});
    }
  }
  return pairs;
}

std::uint64_t all_bits(int count) { return count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1; }

Mesh turned(Mesh mesh) {
  mesh.positions =
      (Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.36, 0.48, 0.8)).toRotationMatrix() * mesh.positions).eval();
  return mesh;
}

// Seeded pairs of bodies: lattices where everything is coplanar or touches, soups, smooth ones, and lattices that were
// turned, so that rounding alone keeps corners from planes.
std::pair<Mesh, Mesh> bodies(int seed) {
  const auto s = static_cast<std::uint64_t>(seed);
  const auto lattice = [](std::uint64_t one) { return tests::lattice_soup(100, 2, one); };
  if (seed % 4 == 0) return {lattice(s), lattice(s + 7)};
  if (seed % 4 == 1) return {tests::soup(100, 1.0, s), tests::soup(100, 1.0, s + 7)};
  if (seed % 4 == 3) return {turned(lattice(s)), turned(lattice(s + 7))};
  return {tests::blob(1, 0.5, 0.3, s), tests::translated(tests::blob(1, 0.5, 0.3, s + 9), {0.3, 0.2, 0.1})};
}

void expect_right(const Kernels& kernels, const ClusteredMesh& a, const ClusteredMesh& b, Digits digits) {
  const Decisions decisions = decide_all(kernels, a, b, digits);
  std::vector<FacetPair> decided;
  for (const FacetPair& pair : meeting_in_truth(a, b)) {
    if (!std::binary_search(decisions.undecided.begin(), decisions.undecided.end(), pair)) decided.push_back(pair);
  }
  EXPECT_EQ(decisions.meeting, decided) << kernels.name;
  for (const FacetPair& pair : decisions.flat) {
    EXPECT_TRUE(lies_in_plane(a.triangle(pair.a), b.triangle(pair.b))) << kernels.name;
  }
}

TEST(Kernels, DecisionsAreRight) {
  for (int seed = 0; seed < 16; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    SCOPED_TRACE(seed);
    for (const Kernels* kernels : tests::available_kernels()) {
      expect_right(*kernels, a, b, Digits::simple);
      expect_right(*kernels, a, b, Digits::wide);
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
TEST(Kernels, DecisionsDoNotDependOnTheBounds) {
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
            const PairMatches tight = kernels->match_pairs(block_a, block_b, pair, bounds_of(pair, block_a, block_b));
            const PairMatches loose = kernels->match_pairs(block_a, block_b, pair, kSpace);
            ASSERT_FALSE(loose.on_lattice);
            if (tight.on_lattice) {  // more is decided
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
TEST(Kernels, DecisionsAreRightOfTinyFacets) {
  for (int seed = 0; seed < 16; ++seed) {
    auto [mesh_a, mesh_b] = bodies(seed);
    for (const double scale : {0x1p-190, 0x1p-280, 0x1p-350, 0x1p-500, 0x1p-1000}) {
      Mesh small_a = mesh_a, small_b = mesh_b;
      small_a.positions *= scale;
      small_b.positions *= scale;
      const ClusteredMesh a = clustered(small_a), b = clustered(small_b);
      SCOPED_TRACE(::testing::Message() << "seed " << seed << " scale " << scale);
      for (const Kernels* kernels : tests::available_kernels()) {
        expect_right(*kernels, a, b, Digits::simple);
        expect_right(*kernels, a, b, Digits::wide);
      }
    }
  }
}

// A lattice whose zeros are off by so little that products with them vanish: what looks like zero is none.
TEST(Kernels, DecisionsAreRightWhereProductsVanish) {
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
        expect_right(*kernels, a, b, Digits::simple);
        expect_right(*kernels, a, b, Digits::wide);
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

// Twice the digits tell on which side a corner lies that rounding alone keeps from a plane.
TEST(Kernels, WideDecidesWhatRoundingPutsNextToAPlane) {
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

TEST(Kernels, SharingPairsHaveACornerInCommon) {
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

TEST(Kernels, TouchingPairsOfALatticeAreDecidedUnlessCoplanar) {
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

// All pairs of two lattices, offset and scaled in a way that leaves them lattices.
TEST(Kernels, PairsOnALatticeAreAllDecided) {
  std::size_t in_plane = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (const auto& [scale, offset] :
         {std::pair{1.0, 0.0}, {0x1p-6, 0x1p20}, {0x1p-100, -0x1p-80}, {3.0, 0x1p36}, {1000.0, 5e8}}) {
      const auto placed = [&](std::uint64_t of) {
        Mesh mesh = tests::lattice_soup(60, of % 2 == 0 ? 1 : 3, of);
        mesh.positions = (scale * mesh.positions).array() + offset;
        return mesh;
      };
      const ClusteredMesh a = clustered(placed(seed)), b = clustered(placed(seed + 50));
      for (const Kernels* kernels : tests::available_kernels()) {
        const FacetBlock block_a = block_of(*kernels, a, 0, kAnywhere), block_b = block_of(*kernels, b, 0, kAnywhere);
        const BoxBounds bounds = narrowphase::bounds_of(base::merged(a.box(), b.box()));
        for (int f = 0; f < a.facet_end(0); ++f) {
          const FacetPairList pairs = all_with(f, b.facet_end(0));
          const PairMatches matches = kernels->match_pairs(block_a, block_b, pairs, bounds);
          ASSERT_TRUE(matches.on_lattice) << kernels->name << " scale " << scale << " offset " << offset;
          const PairMatches flat = kernels->match_flat_pairs(block_a, block_b, pairs, matches.flat, true);
          for (int g = 0; g < b.facet_end(0); ++g) {
            const bool areas = has_area(a.triangle(f)) && has_area(b.triangle(g)),
                       is_flat = (matches.flat >> g & 1) != 0;
            const std::uint64_t undecided = is_flat ? flat.undecided : matches.undecided;
            if ((undecided >> g & 1) != 0) {
              ASSERT_FALSE(areas) << kernels->name << ": " << f << ' ' << g;
              continue;
            }
            PredicateCounts counts;
            const bool meet = (((is_flat ? flat : matches).meeting >> g) & 1) != 0;
            ASSERT_EQ(meet, triangle_triangle_meet(a.triangle(f), b.triangle(g), counts)) << f << ' ' << g;
            in_plane += is_flat ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_GT(in_plane, 1000u);
}

// A coordinate next to one of a lattice is none.
TEST(Kernels, ACoordinateBesideALatticeIsNoticed) {
  Mesh mesh = tests::lattice_soup(20, 3, 5);
  const ClusteredMesh b = clustered(mesh);
  for (Eigen::Index i = 0; i < 3 * mesh.facets.size(); ++i) {
    Mesh other = mesh;
    double& x = other.positions(i % 3, mesh.facets.reshaped()[i / 3]);
    x = x == 0.0 ? 0x1p-1074 : std::nextafter(x, 1e300);
    const ClusteredMesh a = clustered(other);
    const BoxBounds bounds = narrowphase::bounds_of(base::merged(a.box(), b.box()));
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block_a = block_of(*kernels, a, 0, kAnywhere), block_b = block_of(*kernels, b, 0, kAnywhere);
      const FacetPairList pairs = all_with(0, b.facet_end(0));
      EXPECT_FALSE(kernels->match_pairs(block_a, block_b, pairs, bounds).on_lattice) << kernels->name << ' ' << i;
      EXPECT_FALSE(kernels->match_pairs(block_b, block_a, pairs, bounds).on_lattice) << kernels->name << ' ' << i;
      EXPECT_TRUE(kernels->match_pairs(block_b, block_b, pairs, bounds).on_lattice) << kernels->name << ' ' << i;
    }
  }
}

// Coordinates of more digits than a lattice of 2^16 steps has are none.
TEST(Kernels, ALatticeHasFewSteps) {
  for (const double last : {0x1p-15, 0x1p-16, 0x1p-17}) {
    MeshBuilder builder;
    builder.triangle({0, 0, 0}, {1, 0, last}, {0, 1, 0});
    const ClusteredMesh mesh = clustered(builder.mesh());
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, mesh, 0, kAnywhere);
      const PairMatches matches =
          kernels->match_pairs(block, block, all_with(0, 1), narrowphase::bounds_of(mesh.box()));
      EXPECT_EQ(matches.on_lattice, last == 0x1p-15) << kernels->name;
    }
  }
}

TEST(Kernels, PairsOfSmoothBodiesAreDecided) {
  const auto [mesh_a, mesh_b] = bodies(2);
  for (const Kernels* kernels : tests::available_kernels()) {
    EXPECT_TRUE(decide_all(*kernels, clustered(mesh_a), clustered(mesh_b)).undecided.empty()) << kernels->name;
  }
}

// All pairs that boxes, and planes where they are asked, leave of two blocks, b's facets held against a's if
// `few_are_b`.
std::vector<FacetPair> paired(const Kernels& kernels, const FacetBlock& a, const FacetBlock& b, bool few_are_b,
                              int plane_from, std::int64_t& box_pairs) {
  std::vector<FacetPair> all;
  const FacetBlock &few = few_are_b ? b : a, &many = few_are_b ? a : b;
  const std::uint64_t others = kernels.near_facets(many, all_bits(many.count), kEverything, kEverything).facets;
  for (std::uint64_t left = all_bits(few.count); left != 0;) {
    FacetPairList pairs;
    const PairedFacets found = kernels.pair_facets(few, left, many, others, kEverything, few_are_b, plane_from, &pairs);
    EXPECT_LT(std::popcount(found.left_over), std::popcount(left));
    EXPECT_LE(pairs.count, FacetPairList::kCapacity);
    left = found.left_over;
    box_pairs += found.box_pairs;
    for (int k = 0; k < pairs.count; ++k) all.push_back({pairs.a[k], pairs.b[k]});
  }
  std::sort(all.begin(), all.end());
  return all;
}

constexpr int kAlways = 0, kNever = 65;  // is the plane asked

// Neither by the box of the others, nor by planes and boxes, is a facet lost that meets one.
TEST(Kernels, FacetsThatMeetAreNearAndPaired) {
  for (int seed = 0; seed < 30; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const std::vector<FacetPair> meeting = meeting_in_truth(a, b);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block_a = block_of(*kernels, a, 0), block_b = block_of(*kernels, b, 0);
      for (const FacetPair& pair : meeting) {
        const BoxBounds box = box_of(block_a, pair.a);
        EXPECT_NE(kernels->near_facets(block_b, all_bits(block_b.count), box, kEverything).facets >> pair.b & 1, 0u);
        EXPECT_TRUE(kernels->any_near(block_b, std::uint64_t{1} << pair.b, box, merged(box, box_of(block_b, pair.b))));
      }
      for (const bool few_are_b : {false, true}) {
        for (const int plane_from : {kAlways, 6, kNever}) {
          std::int64_t box_pairs = 0;
          const std::vector<FacetPair> left = paired(*kernels, block_a, block_b, few_are_b, plane_from, box_pairs);
          EXPECT_TRUE(std::includes(left.begin(), left.end(), meeting.begin(), meeting.end()))
              << kernels->name << " seed " << seed << " plane from " << plane_from;
          EXPECT_EQ(std::adjacent_find(left.begin(), left.end()), left.end());
        }
      }
    }
  }
}

TEST(Kernels, FacetsArePairedByTheirBoxesAndPlanes) {
  std::size_t left_aside = 0;
  for (int seed = 0; seed < 12; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const FacetBlock block_a = block_of(*scalar_kernels(), a, 0), block_b = block_of(*scalar_kernels(), b, 0);
    std::vector<FacetPair> overlapping;
    const auto box = [](const BoxBounds& bounds) {
      return Box{{bounds.lower[0], bounds.lower[1], bounds.lower[2]},
                 {bounds.upper[0], bounds.upper[1], bounds.upper[2]}};
    };
    for (int f = 0; f < block_a.count; ++f) {
      for (int g = 0; g < block_b.count; ++g) {
        if (overlaps(box(box_of(block_a, f)), box(box_of(block_b, g)))) overlapping.push_back({f, g});
      }
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      for (const bool few_are_b : {false, true}) {
        std::int64_t box_pairs = 0;
        EXPECT_EQ(paired(*kernels, block_a, block_b, few_are_b, kNever, box_pairs), overlapping) << kernels->name;
        EXPECT_EQ(box_pairs, static_cast<std::int64_t>(overlapping.size()));
        left_aside += overlapping.size() - paired(*kernels, block_a, block_b, few_are_b, kAlways, box_pairs).size();
        EXPECT_EQ(box_pairs, 2 * static_cast<std::int64_t>(overlapping.size()));
      }
    }
  }
  EXPECT_GT(left_aside, 1000u);
}

// Points of few heights in some ranges: wherever the first of the highest stands, it is found, and whether it is alone.
TEST(Kernels, OfEquallyHighPointsTheFirstIsTheHighest) {
  tests::Random random(4);
  const std::vector<double> zero(60, 0.0);
  for (int repeat = 0; repeat < 2000; ++repeat) {
    std::vector<double> x(60, 9.0);  // outside of the ranges it is higher
    std::vector<IndexRange> ranges;
    std::vector<int> inside;
    for (int begin = random.below(4); begin < 40 && repeat % 50 != 49;) {  // none, once in a while
      const int end = std::min(begin + random.below(20), 40);
      ranges.push_back({begin, end});
      for (int i = begin; i < end; ++i) inside.push_back(i);
      begin = end + random.below(5);
    }
    for (const int i : inside) x[static_cast<std::size_t>(i)] = random.below(1 + repeat % 40) - 1.0;
    const auto height = [&](int i) { return x[static_cast<std::size_t>(i)]; };
    const auto first = std::ranges::max_element(inside, {}, height);
    const int index = first == inside.end() ? -1 : *first;
    const bool several = index >= 0 && std::ranges::count(inside, height(index), height) > 1;
    const double least = repeat % 2 == 0 ? -1.0 : -std::numeric_limits<double>::infinity();
    for (const Kernels* kernels : tests::available_kernels()) {
      const HighestPoint top = kernels->highest_point({x.data(), zero.data(), zero.data()}, ranges.data(),
                                                      static_cast<int>(ranges.size()), {1, 0, 0, 0, 0, 0}, least);
      EXPECT_EQ(top.index, index) << kernels->name;
      EXPECT_EQ(top.several, several) << kernels->name;
      EXPECT_EQ(top.height, index < 0 ? -std::numeric_limits<double>::infinity() : height(index)) << kernels->name;
    }
  }
}

TEST(Kernels, SortsPairs) {
  tests::Random random(3);
  for (int count = 0; count <= kMostSorted; ++count) {
    std::vector<FacetPair> sorted, shuffled;
    for (int i = 0; i < count; ++i) sorted.push_back({i / 5 * 70'000'000, 2'147'483'640 + i % 5});
    std::sort(sorted.begin(), sorted.end());
    shuffled = sorted;
    for (std::size_t i = shuffled.size(); i > 1; --i) {
      std::swap(shuffled[i - 1], shuffled[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    }
    for (const Kernels* kernels : tests::available_kernels()) {
      std::vector<FacetPair> pairs = shuffled;
      kernels->sort_pairs(pairs.data(), count);
      EXPECT_EQ(pairs, sorted) << kernels->name;
    }
  }
}

TEST(Kernels, EveryInstructionSetGivesTheSameBits) {
  for (int seed = 0; seed < 12; ++seed) {
    const auto [mesh_a, mesh_b] = bodies(seed);
    const ClusteredMesh a = clustered(mesh_a), b = clustered(mesh_b);
    const HeightAxis axis{0.48, -0.6, 0.64, 0.01, 0.02, -0.03};
    const CullPlanes planes{.axis = axis, .lowest = 0.1, .box = {{-0.4, -0.3, -0.5}, {0.5, 0.4, 0.6}}};
    const FacetBlock expected = block_of(*scalar_kernels(), b, 0), own = block_of(*scalar_kernels(), a, 0);
    const FacetBlock left = block_of(*scalar_kernels(), b, 0, planes);
    const std::uint64_t away = scalar_kernels()->facing_away(expected, axis);
    const IndexRange all{0, b.vertex_count()};
    const HighestPoint highest = scalar_kernels()->highest_point(b.points(), &all, 1, axis, -1e300);
    const NearFacets near = scalar_kernels()->near_facets(expected, all_bits(b.facet_end(0)), planes.box, kEverything);
    for (const Kernels* kernels : tests::available_kernels()) {
      const FacetBlock block = block_of(*kernels, b, 0);
      for (int axis_index = 0; axis_index < 3; ++axis_index) {
        for (int f = 0; f < b.facet_end(0); ++f) {
          EXPECT_EQ(block.lower[axis_index][f], expected.lower[axis_index][f]);
          EXPECT_EQ(block.upper[axis_index][f], expected.upper[axis_index][f]);
        }
      }
      EXPECT_EQ(kernels->facing_away(block, axis), away) << kernels->name;
      const FacetBlock others_left = block_of(*kernels, b, 0, planes);
      EXPECT_EQ(std::vector(others_left.facet, others_left.facet + others_left.count),
                std::vector(left.facet, left.facet + left.count))
          << kernels->name;
      const HighestPoint top = kernels->highest_point(b.points(), &all, 1, axis, highest.height);
      EXPECT_EQ(top.height, highest.height) << kernels->name;
      EXPECT_EQ(top.index, highest.index) << kernels->name;
      const double above = std::nextafter(highest.height, 1e300);
      EXPECT_EQ(kernels->highest_point(b.points(), &all, 1, axis, above).index, -1) << kernels->name;
      const NearFacets others = kernels->near_facets(block, all_bits(b.facet_end(0)), planes.box, kEverything);
      EXPECT_EQ(others.facets, near.facets) << kernels->name;
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(others.box.lower[k], near.box.lower[k]) << kernels->name;
        EXPECT_EQ(others.box.upper[k], near.box.upper[k]) << kernels->name;
      }
      for (const int plane_from : {kAlways, 6}) {
        std::int64_t box_pairs = 0;
        EXPECT_EQ(paired(*kernels, own, block, false, plane_from, box_pairs),
                  paired(*scalar_kernels(), own, expected, false, plane_from, box_pairs))
            << kernels->name;
      }
      for (const Digits digits : {Digits::simple, Digits::wide}) {
        const Decisions one = decide_all(*kernels, a, b, digits), other = decide_all(*scalar_kernels(), a, b, digits);
        EXPECT_EQ(one.meeting, other.meeting) << kernels->name;
        EXPECT_EQ(one.undecided, other.undecided) << kernels->name;
        EXPECT_EQ(one.flat, other.flat) << kernels->name;
      }
    }
  }
}

TEST(Kernels, OpenClusterLeavesOutWhatOneSideRulesOut) {
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = clustered(bodies(seed).first);
    const CullPlanes planes{{0.48, -0.6, 0.64, 0.1, 0.2, 0.3}, -0.2, {{-0.3, -0.2, -0.4}, {0.3, 0.5, 0.2}}};
    for (int c = 0; c < mesh.cluster_count(); ++c) {
      std::vector<std::int32_t> expected;
      for (int f = mesh.facet_begin(c); f < mesh.facet_end(c); ++f) {
        Box box;
        double top = -9.0;
        for (const Vec3& p : mesh.triangle(f)) {
          box = extended(box, p);
          top = std::max(top, (0.48 * (p.x - 0.1) + -0.6 * (p.y - 0.2)) + 0.64 * (p.z - 0.3));
        }
        if (top >= planes.lowest && overlaps(box, Box{{-0.3, -0.2, -0.4}, {0.3, 0.5, 0.2}})) expected.push_back(f);
      }
      for (const Kernels* kernels : tests::available_kernels()) {
        const FacetBlock block = block_of(*kernels, mesh, c, planes);
        EXPECT_EQ(std::vector(block.facet, block.facet + block.count), expected) << kernels->name << " seed " << seed;
        for (int i = 0; i < block.count; ++i) {
          const Triangle t = mesh.triangle(block.facet[i]);
          for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 corner{block.corner[k][0][i], block.corner[k][1][i], block.corner[k][2][i]};
            EXPECT_EQ(corner, t[k]) << kernels->name << " seed " << seed;
          }
        }
      }
    }
  }
}

class RefreshCluster : public testing::Test {
 protected:
  RefreshCluster() {
    for (int v = 0; v < mesh_.vertex_count(); ++v) (v % 3 == 1 ? borrowed_ : owned_).push_back(v);
    for (std::vector<double>* axis : {&x_, &y_, &z_, &before_x_, &before_y_, &before_z_})
      axis->assign(owned_.size(), 0.0);
  }

  RefreshedCluster refresh(const Kernels& kernels, bool changed = false) {
    return kernels.refresh_cluster({.source = mesh_.positions.data(),
                                    .owned = owned_.data(),
                                    .owned_count = static_cast<std::int32_t>(owned_.size()),
                                    .borrowed = borrowed_.data(),
                                    .borrowed_count = static_cast<std::int32_t>(borrowed_.size()),
                                    .ahead = 0,
                                    .before = {before_x_.data(), before_y_.data(), before_z_.data()},
                                    .changed = changed,
                                    .x = x_.data(),
                                    .y = y_.data(),
                                    .z = z_.data()});
  }
  void keep() {
    before_x_ = x_;
    before_y_ = y_;
    before_z_ = z_;
  }

  Mesh mesh_ = tests::blob(1, 1.0, 0.3, 5);
  std::vector<std::int32_t> owned_, borrowed_;
  std::vector<double> x_, y_, z_, before_x_, before_y_, before_z_;
};

TEST_F(RefreshCluster, CopiesWidensAndNoticesChanges) {
  for (const Kernels* kernels : tests::available_kernels()) {
    before_x_.assign(owned_.size(), 0.0);
    const RefreshedCluster first = refresh(*kernels);
    EXPECT_TRUE(first.changed);
    EXPECT_FALSE(first.not_a_number);
    keep();
    EXPECT_FALSE(refresh(*kernels).changed) << kernels->name;
    EXPECT_TRUE(refresh(*kernels, true).changed) << kernels->name;
    for (std::size_t i = 0; i < owned_.size(); ++i) {
      EXPECT_EQ((Vec3{x_[i], y_[i], z_[i]}), mesh_.position(owned_[i])) << kernels->name;
      for (std::vector<double>* axis : {&before_x_, &before_y_, &before_z_}) {
        keep();
        (*axis)[i] += 1.0;
        EXPECT_TRUE(refresh(*kernels).changed) << kernels->name << " vertex " << i;
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(first.box.lower[axis], mesh_.positions.row(axis).minCoeff());
      EXPECT_EQ(first.box.upper[axis], mesh_.positions.row(axis).maxCoeff());
    }
  }
}

TEST_F(RefreshCluster, NoticesEveryOwnedCoordinateThatIsNoNumber) {
  for (const Kernels* kernels : tests::available_kernels()) {
    for (const std::int32_t v : owned_) {
      for (int axis = 0; axis < 3; ++axis) {
        const Mesh sound = mesh_;
        mesh_.positions(axis, v) = std::numeric_limits<double>::quiet_NaN();
        EXPECT_TRUE(refresh(*kernels).not_a_number) << kernels->name << " vertex " << v;
        mesh_ = sound;
      }
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
