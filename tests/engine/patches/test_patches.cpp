// Patches of a contact: connected sets of facet pairs, each with a point, a direction and a depth.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

// Two wrinkled sheets meet along many curves, a blob and a sphere along one or two.
std::array<Mesh, 2> meeting(std::uint64_t seed) {
  if (seed % 2 == 0) return {wrinkled_sheet(16, 2.0, 0.3, seed), wrinkled_sheet(14, 2.0, 0.3, seed + 1)};
  return {blob(2, 1.0, 0.3, seed), translated(icosphere(2), {1.3, 0.4, 0.2})};
}

// A patch whose members are kept.
struct KeptPatch : Patch {
  explicit KeptPatch(const Patch& patch) : Patch(patch), members(patch.facet_pairs.begin(), patch.facet_pairs.end()) {
    facet_pairs = members;
  }
  KeptPatch(const KeptPatch& other) : KeptPatch(static_cast<const Patch&>(other)) {}
  KeptPatch& operator=(const KeptPatch&) = delete;
  std::vector<int> members;
};

struct FoundPatches {
  std::vector<FacetPair> pairs;
  std::vector<KeptPatch> patches;
};

FoundPatches patches_of(const std::array<Mesh, 2>& bodies) {
  World world({.threads = 1, .outputs = {.patches = true}});
  for (const Mesh& mesh : bodies) world.add_body({.positions = mesh.positions, .facets = mesh.facets});
  FoundPatches found;
  const auto contacts = world.detect().contacts();
  EXPECT_EQ(contacts.size(), 1u);
  if (contacts.empty()) return found;
  found.pairs.assign(contacts[0].facet_pairs().begin(), contacts[0].facet_pairs().end());
  for (const Patch& patch : contacts[0].patches()) found.patches.emplace_back(patch);
  return found;
}

// By painting: a set grows by all pairs that share a facet with one in it, until there is none.
std::set<std::set<int>> connected_sets(const std::vector<FacetPair>& pairs) {
  std::set<std::set<int>> sets;
  std::vector<bool> painted(pairs.size(), false);
  for (std::size_t first = 0; first < pairs.size(); ++first) {
    if (painted[first]) continue;
    std::set<int> members;
    std::vector<std::size_t> border{first};
    painted[first] = true;
    while (!border.empty()) {
      const std::size_t i = border.back();
      border.pop_back();
      members.insert(static_cast<int>(i));
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (painted[k] || (pairs[k].a != pairs[i].a && pairs[k].b != pairs[i].b)) continue;
        painted[k] = true;
        border.push_back(k);
      }
    }
    sets.insert(members);
  }
  return sets;
}

Eigen::Matrix3d corners(const Mesh& mesh, int facet) {
  Eigen::Matrix3d all;
  for (int k = 0; k < 3; ++k) all.col(k) = mesh.positions.col(mesh.facets(k, facet));
  return all;
}

Eigen::Vector3d area_normal(const Mesh& mesh, int facet) {
  const Eigen::Matrix3d c = corners(mesh, facet);
  return (c.col(1) - c.col(0)).cross(c.col(2) - c.col(0));
}

TEST(Patches, AreTheConnectedSetsOfFacetPairs) {
  std::size_t most = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const FoundPatches found = patches_of(meeting(seed));
    ASSERT_FALSE(found.pairs.empty()) << seed;
    std::set<std::set<int>> sets;
    for (const Patch& patch : found.patches) {
      EXPECT_TRUE(std::ranges::is_sorted(patch.facet_pairs));
      sets.insert(std::set<int>(patch.facet_pairs.begin(), patch.facet_pairs.end()));
    }
    EXPECT_EQ(sets, connected_sets(found.pairs)) << seed;
    EXPECT_EQ(sets.size(), found.patches.size()) << seed;
    EXPECT_TRUE(std::ranges::is_sorted(found.patches, {}, [](const Patch& patch) { return patch.facet_pairs[0]; }));
    most = std::max(most, found.patches.size());
  }
  EXPECT_GT(most, 3u);
}

// The depth is the least with which a plane across the direction parts each pair by itself.
TEST(Patches, MovingByTheirDepthPartsTheirFacetPairsAndByNoLess) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::array<Mesh, 2> bodies = meeting(seed);
    const FoundPatches found = patches_of(bodies);
    for (const Patch& patch : found.patches) {
      EXPECT_NEAR(patch.direction.norm(), 1.0, 1e-15);
      double needed = 0.0;
      Eigen::AlignedBox3d around;
      for (const int i : patch.facet_pairs) {
        const FacetPair pair = found.pairs[i];
        const Eigen::Matrix3d a = corners(bodies[0], pair.a), b = corners(bodies[1], pair.b);
        needed = std::max(needed,
                          (patch.direction.transpose() * a).maxCoeff() - (patch.direction.transpose() * b).minCoeff());
        for (int k = 0; k < 3; ++k) around.extend(a.col(k)).extend(b.col(k));
      }
      EXPECT_NEAR(patch.depth, needed, 1e-14) << seed;
      EXPECT_TRUE(around.contains(patch.point)) << seed;
    }
  }
}

TEST(Patches, OfClosedBodiesPointAlongTheMeanNormal) {
  const std::array<Mesh, 2> bodies = meeting(1);
  const FoundPatches found = patches_of(bodies);
  for (const Patch& patch : found.patches) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int i : patch.facet_pairs) {
      const FacetPair pair = found.pairs[i];
      sum += area_normal(bodies[0], pair.a) - area_normal(bodies[1], pair.b);
    }
    EXPECT_LT((patch.direction - sum.normalized()).norm(), 1e-14);
  }
}

// A power of two changes no digit: nothing vanishes or overflows where areas would.
TEST(Patches, AreTheSameAtEverySize) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const std::array<Mesh, 2> bodies = meeting(seed);
    const FoundPatches expected = patches_of(bodies);
    for (const double size : {0x1p-900, 0x1p-600, 0x1p-300, 0x1p-200, 0x1p200, 0x1p270, 0x1p290}) {
      const FoundPatches found = patches_of({scaled(bodies[0], size), scaled(bodies[1], size)});
      ASSERT_EQ(found.patches.size(), expected.patches.size()) << size;
      for (std::size_t i = 0; i < found.patches.size(); ++i) {
        EXPECT_EQ(found.patches[i].direction, expected.patches[i].direction) << size;
        EXPECT_EQ(found.patches[i].depth, size * expected.patches[i].depth) << size;
        EXPECT_EQ(found.patches[i].members, expected.patches[i].members) << size;
      }
    }
  }
}

// Far from the origin only the coordinates are coarser. Both bodies stand on the grid that is left there.
TEST(Patches, KeepTheirDepthFarFromTheOrigin) {
  std::array<Mesh, 2> bodies = meeting(1);
  for (Mesh& mesh : bodies) mesh = snapped(mesh, 0x1p-20);
  const FoundPatches expected = patches_of(bodies);
  for (const double offset : {0x1p10, 0x1p20, 0x1p30}) {
    const Vec3 by{offset, -offset, offset};
    const FoundPatches found = patches_of({translated(bodies[0], by), translated(bodies[1], by)});
    ASSERT_EQ(found.patches.size(), expected.patches.size()) << offset;
    for (std::size_t i = 0; i < found.patches.size(); ++i) {
      EXPECT_EQ(found.patches[i].direction, expected.patches[i].direction) << offset;
      EXPECT_NEAR(found.patches[i].depth, expected.patches[i].depth, 1e-14) << offset;
    }
  }
}

}  // namespace
}  // namespace tact::tests
