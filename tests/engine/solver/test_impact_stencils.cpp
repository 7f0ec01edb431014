// Impacts as constraints: features meet at the places of their stencils, and what keeps the gaps stops all of them.
#include <gtest/gtest.h>
#include <tact/solver.h>

#include <vector>

#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

// A crumpled ball that falls through a crumpled sheet, which keeps still.
struct FallingBall {
  explicit FallingBall(double margin) {
    const Mesh ball = translated(blob(2, 0.5, 0.2, 1), {0.05, 0.02, 0.9}), low = wrinkled_sheet(8, 2.0, 0.1, 3);
    for (const Mesh* mesh : {&ball, &low})
      bodies.push_back(world.add_body({.positions = mesh->positions,
                                       .facets = mesh->facets,
                                       .surface = mesh == &low ? Surface::sheet : Surface::closed,
                                       .margin = margin}));
    rows = {0, ball.vertex_count()};
    begin.resize(3, ball.vertex_count() + low.vertex_count());
    begin << ball.positions, low.positions;
    end = begin;
    end.leftCols(rows[1]).colwise() += Eigen::Vector3d(0.1, -0.05, -1.5);
    world.detect();
    world.set_positions(bodies[0], end.leftCols(rows[1]));
  }
  World world{{.threads = 1}};
  std::vector<BodyId> bodies;
  std::vector<int> rows;
  Eigen::Matrix3Xd begin, end;
};

TEST(ImpactStencils, HaveThePlacesWhereFeaturesMeet) {
  for (const double margin : {0.0, 0.01}) {
    FallingBall scene(margin);
    const auto impacts = scene.world.detect_motion().impacts();
    const std::vector<solver::Stencil> stencils = solver::impact_stencils(impacts, scene.rows, scene.begin, scene.end);
    ASSERT_GT(stencils.size(), 30u);
    std::size_t i = 0, edges = 0;
    for (const Impact& impact : impacts) {
      if (!solver::is_constraint(impact)) continue;
      const solver::Stencil& stencil = stencils[i++];
      edges += stencil.kind == solver::StencilKind::edge_edge;
      const solver::Corners first = solver::gather(stencil, scene.begin),
                            ways = solver::gather(stencil, scene.end) - first;
      // Times are early by less than 1e-6 of a way of 1.5 m; the gap is measured along the normal.
      const Eigen::Vector3d way = solver::difference(stencil, first + impact.time * ways);
      EXPECT_LT((way - stencil.gap * stencil.normal).norm(), 2e-6);
      EXPECT_NEAR(stencil.gap, 2.0 * margin, 2e-6);
      EXPECT_NEAR(stencil.normal.norm(), 1.0, 1e-12);
      EXPECT_NEAR(stencil.weights.sum(), 0.0, 1e-12);
      EXPECT_LE(solver::gap_rate(stencil, ways), 1e-12);
    }
    EXPECT_GT(edges, 10u);
  }
}

// Of each kind, nearest at a corner: the distance of vertices, along the way between them.
TEST(ImpactStencils, AreNearestAtCornersToo) {
  Eigen::Matrix3Xd x(3, 5);
  x.transpose() << 0, 0, 0, 1, 1, 0, 2, 1, 0, 1, 2, 0, 3, 3, 3;
  const auto expect_corner = [&](const Impact& impact, int row_b) {
    const solver::Stencil stencil = solver::stencil(impact, 0, row_b, x, x);
    EXPECT_NEAR(stencil.gap, std::sqrt(2.0), 1e-15);
    EXPECT_LT((stencil.normal - Eigen::Vector3d(1, 1, 0) / std::sqrt(2.0)).norm(), 1e-15);
    EXPECT_LT((solver::difference(stencil, solver::gather(stencil, x)) - Eigen::Vector3d(1, 1, 0)).norm(), 1e-15);
  };
  expect_corner(
      {.a = {}, .b = {}, .kind = FeaturePair::vertex_facet, .a_vertices = {0, -1, -1}, .b_vertices = {0, 1, 2}}, 1);
  expect_corner(
      {.a = {}, .b = {}, .kind = FeaturePair::vertex_edge, .a_vertices = {0, -1, -1}, .b_vertices = {0, 1, -1}}, 1);
  expect_corner(
      {.a = {}, .b = {}, .kind = FeaturePair::vertex_vertex, .a_vertices = {0, -1, -1}, .b_vertices = {0, -1, -1}}, 1);
  x.col(4) << -1, -1, 0;
  expect_corner({.a = {}, .b = {}, .kind = FeaturePair::edge_edge, .a_vertices = {4, 0, -1}, .b_vertices = {1, 2, -1}},
                0);
}

TEST(ImpactStencils, OfWaysThatFitNoRowsAreRefused) {
  FallingBall scene(0.0);
  const auto impacts = scene.world.detect_motion().impacts();
  EXPECT_THROW(solver::impact_stencils(impacts, std::vector<int>{0}, scene.begin, scene.end), Error);
  EXPECT_THROW(solver::impact_stencils(impacts, scene.rows, scene.begin, scene.end.leftCols(5)), Error);
  EXPECT_THROW(solver::impact_stencils(impacts, scene.rows, scene.begin.leftCols(5), scene.end.leftCols(5)), Error);
}

}  // namespace
}  // namespace tact::tests
