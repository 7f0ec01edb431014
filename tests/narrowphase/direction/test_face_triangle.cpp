#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "narrowphase/direction/face_triangle.h"
#include "tests/support/inside/mesh_through.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::narrowphase {
namespace {

// Points less a point at the origin: vertices of M are those of A. The first three are a triangle at height 1, two more
// are higher, and the last stands where the first does.
class FaceTriangles : public ::testing::TestWithParam<std::array<int, 3>> {
 protected:
  FaceTriangles()
      : a_(tests::mesh_through(points())), b_(tests::mesh_through(std::vector<Vec3>{{0, 0, 0}})), m_(a_, b_) {}

  static std::vector<Vec3> points() {
    return {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}, {0.5, 0.5, 2}, {-4, 0, 2}, {-1, -1, 1}};
  }

  // The vertex of the mesh at one of the points.
  MinkowskiVertex vertex(int point) const {
    for (int v = 0; v < a_.vertex_count(); ++v) {
      if (a_.source_vertex(v) == point) return m_.vertex(v, 0);
    }
    return {};
  }
  GjkSimplex simplex(std::array<int, 3> corner) const {
    GjkSimplex s{.a = {}, .b = {}, .count = 3};
    for (std::size_t i = 0; i < 3; ++i) s.a[i] = vertex(corner[i]).a;
    return s;
  }
  double in_metres(double scaled) const { return scaled / m_.scale(); }

  ClusteredMesh a_, b_;
  MinkowskiDifference m_;
};

TEST_P(FaceTriangles, KnowsTheSideThatTheFootIsNearest) {
  const FaceTriangle triangle(m_, simplex(GetParam()), {0, 0, 1});
  const FaceTriangle::Side side = triangle.side_of_projection();
  // The sides x = -1 and y = -1 are a metre away, x + y = 2 is farther.
  EXPECT_NEAR(in_metres(side.distance), 1.0, 1e-15);
  const Vec3 outward = triangle.outward(side.index);
  EXPECT_NEAR(std::min(outward.x, outward.y), -1.0, 1e-15);
  EXPECT_NEAR(std::max(outward.x, outward.y), 0.0, 1e-15);
}

TEST_P(FaceTriangles, GoesToAVertexAboveIt) {
  const FaceTriangle triangle(m_, simplex(GetParam()), {0, 0, 1});
  const auto next = triangle.toward_projection(vertex(3));  // above (0.5, 0.5): the foot lies between it and (-1, -1)
  ASSERT_TRUE(next);
  EXPECT_EQ(next->a[2], vertex(3).a);
  const auto holds = [&](int point) { return next->a[0] == vertex(point).a || next->a[1] == vertex(point).a; };
  EXPECT_TRUE(holds(0));
  EXPECT_TRUE(holds(1) || holds(2));
}

INSTANTIATE_TEST_SUITE_P(EitherWayAround, FaceTriangles,
                         ::testing::Values(std::array{0, 1, 2}, std::array{2, 1, 0}, std::array{1, 2, 0}));

class FootOutside : public FaceTriangles {};

TEST_P(FootOutside, IsBeyondASide) {
  const ClusteredMesh far =
      tests::mesh_through(std::vector<Vec3>{{-2, 0, 0}});  // M moves by +2: the foot is at x = -2 of A
  const MinkowskiDifference m(a_, far);
  const FaceTriangle triangle(m, simplex(GetParam()), {0, 0, 1});
  const FaceTriangle::Side side = triangle.side_of_projection();
  EXPECT_NEAR(side.distance / m.scale(), -1.0, 1e-15);
  EXPECT_NEAR(triangle.outward(side.index).x, -1.0, 1e-15);
  EXPECT_TRUE(triangle.is_end_of(side.index, vertex(0)));
  EXPECT_FALSE(triangle.is_end_of(side.index, vertex(1)));
  const auto next = triangle.toward_projection(m.vertex(vertex(4).a, 0));  // beyond that side and beyond the foot
  ASSERT_TRUE(next);
  EXPECT_EQ(next->a[2], vertex(4).a);
  const auto corner = [&](std::size_t i) { return m.vertex(next->a[i], next->b[i]).point; };
  const auto turn = [&](std::size_t i, std::size_t j) { return cross(corner(i), corner(j)).z; };
  EXPECT_EQ(turn(0, 1) > 0.0, turn(1, 2) > 0.0);  // the foot is inside
  EXPECT_EQ(turn(0, 1) > 0.0, turn(2, 0) > 0.0);
}

INSTANTIATE_TEST_SUITE_P(EitherWayAround, FootOutside,
                         ::testing::Values(std::array{0, 1, 2}, std::array{2, 1, 0}, std::array{1, 2, 0}));

TEST_F(FaceTriangles, OfASideWithoutLengthNothingIsNotANumber) {
  const FaceTriangle triangle(m_, simplex({0, 5, 1}), {0, 0, 1});
  EXPECT_LE(triangle.side_of_projection().distance, 0.0);
  EXPECT_FALSE(face_normal(m_, simplex({0, 5, 1}), {0, 0, 1}));
}

TEST_F(FaceTriangles, ItsNormalIsOnTheSideAskedFor) {
  for (const double side : {1.0, -1.0}) {
    const auto n = face_normal(m_, simplex({0, 1, 2}), {0.3, 0.1, side});
    ASSERT_TRUE(n);
    EXPECT_EQ(*n, (Vec3{0.0, 0.0, side}));
  }
}

}  // namespace
}  // namespace tact::narrowphase
