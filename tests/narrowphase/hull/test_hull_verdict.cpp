// Hulls that touch or nearly do, against a linear program in exact numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "narrowphase/hull/hull_verdict.h"
#include "tests/support/generators/random.h"
#include "tests/support/generators/touching_hulls.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/mesh_through.h"
#include "tests/support/oracles/hull_oracle.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::narrowphase {
namespace {

using tests::mesh_through;

bool apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const ClusteredMesh mesh_a = mesh_through(a), mesh_b = mesh_through(b);
  std::vector<std::int32_t> scratch;
  return hull_verdict(MinkowskiDifference(mesh_a, mesh_b), {}, scratch).apart;
}

TEST(HullOracle, KnowsPlainCases) {
  using tests::hulls_meet_by_oracle;
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_TRUE(hulls_meet_by_oracle(square, std::vector<Vec3>{{0.5, 0.5, 0.0}}));
  EXPECT_TRUE(hulls_meet_by_oracle(square, std::vector<Vec3>{{1, 1, 0}, {2, 2, 2}}));
  EXPECT_FALSE(hulls_meet_by_oracle(square, std::vector<Vec3>{{0.5, 0.5, 5e-324}}));
  EXPECT_FALSE(hulls_meet_by_oracle(square, std::vector<Vec3>{{std::nextafter(1.0, 2.0), 0.5, -1.0}, {1.5, 0.5, 1.0}}));
  EXPECT_TRUE(hulls_meet_by_oracle(square, std::vector<Vec3>{{0.5, 0.5, -0x1p300}, {0.5, 0.5, 0x1p300}}));
}

TEST(HullVerdict, TheLeastNumberPartsHulls) {
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_FALSE(apart(square, {{0.25, 0.5, 0.0}}));
  EXPECT_TRUE(apart(square, {{0.25, 0.5, 5e-324}}));
  EXPECT_TRUE(apart(square, {{0.25, 0.5, -5e-324}}));
  EXPECT_FALSE(apart(square, {{1, 1, 0}, {2, 2, 2}}));
  EXPECT_TRUE(apart(square, {{std::nextafter(1.0, 2.0), 1, 0}, {2, 2, 2}}));
  EXPECT_FALSE(apart({{1, 2, 3}}, {{1, 2, 3}}));
  EXPECT_TRUE(apart({{1, 2, 3}}, {{1, 2, std::nextafter(3.0, 4.0)}}));
  EXPECT_FALSE(apart({{-0x1p300, 0, 0}, {0x1p300, 0x1p-300, 0}}, {{0, 0x1p-301, -1}, {0, 0x1p-301, 1}}));
  EXPECT_TRUE(apart({{-0x1p300, 0, 0}, {0x1p300, 0x1p-300, 0}}, {{0, 0x1.0000000000001p-301, -1}, {0, 0x1p-300, 1}}));
}

// Is what the verdict says beside its sign right? A direction parts but for rounding, a simplex holds the origin.
void expect_witness(const MinkowskiDifference& m, const HullVerdict& verdict, std::uint64_t seed) {
  ASSERT_GE(verdict.simplex.count, 1) << "seed " << seed;
  if (verdict.apart) {
    EXPECT_NEAR(norm(verdict.direction), 1.0, 1e-15) << "seed " << seed;
    EXPECT_LE(dot(verdict.direction, m.support(verdict.direction).point), m.height_error()) << "seed " << seed;
    return;
  }
  std::vector<Vec3> a, b;
  for (std::size_t i = 0; i < static_cast<std::size_t>(verdict.simplex.count); ++i) {
    a.push_back(m.a().position(verdict.simplex.a[i]));
    b.push_back(m.b().position(verdict.simplex.b[i]));
  }
  EXPECT_TRUE(tests::hulls_meet_by_oracle(a, b)) << "seed " << seed;
}

// From nothing, from where GJK ended and from any vertices, in both orders; and GJK where it is certain.
TEST(HullVerdict, IsThatOfALinearProgram) {
  int meeting = 0, parted = 0, left_by_gjk = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const tests::TouchingHulls pair = tests::touching_hulls(seed);
    const bool meet = tests::hulls_meet_by_oracle(pair.a, pair.b);
    const ClusteredMesh mesh_a = mesh_through(pair.a), mesh_b = mesh_through(pair.b);
    tests::Random random(seed);
    for (const bool swapped : {false, true}) {
      const MinkowskiDifference m(swapped ? mesh_b : mesh_a, swapped ? mesh_a : mesh_b);
      const GjkResult near = gjk(m, {}, {}, {});
      GjkSimplex any{.a = {}, .b = {}, .count = 1 + random.below(4)};
      for (std::size_t i = 0; i < static_cast<std::size_t>(any.count); ++i) {
        any.a[i] = random.below(m.a().vertex_count());
        any.b[i] = random.below(m.b().vertex_count());
      }
      for (const GjkSimplex& start : {GjkSimplex{}, near.simplex, any}) {
        std::vector<std::int32_t> scratch;
        const HullVerdict verdict = hull_verdict(m, start, scratch);
        ASSERT_EQ(verdict.apart, !meet) << pair.kind << ", seed " << seed << ", swapped " << swapped;
        expect_witness(m, verdict, seed);
      }
      if (near.status == GjkStatus::apart) {
        ASSERT_FALSE(meet) << pair.kind << ", seed " << seed;
      }
      if (near.status == GjkStatus::overlapping || holds_origin(m, near.simplex)) {
        ASSERT_TRUE(meet) << pair.kind << ", seed " << seed;
      }
      const bool is_left = near.status == GjkStatus::touching || near.status == GjkStatus::limit_reached;
      left_by_gjk += is_left ? 1 : 0;
      meeting += is_left && meet ? 1 : 0;
      parted += is_left && !meet ? 1 : 0;
    }
  }
  EXPECT_GT(left_by_gjk, 1000);
  EXPECT_GT(meeting, 300);
  EXPECT_GT(parted, 300);
}

}  // namespace
}  // namespace tact::narrowphase
