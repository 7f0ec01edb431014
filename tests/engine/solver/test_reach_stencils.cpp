// Stencils of pairs within reach: the closest features inside all, and derivatives of their barriers.
#include <gtest/gtest.h>
#include <tact/solver.h>

#include <vector>

#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

TEST(ReachStencils, HaveTheClosestFeaturesAmongAllVertices) {
  World world({.threads = 1, .outputs = {.within_reach = true}});
  const Mesh low = wrinkled_sheet(6, 1.0, 0.05, 1),
             high = translated(wrinkled_sheet(6, 1.0, 0.05, 2), {0.02, 0.01, 0.05});
  for (const Mesh* mesh : {&low, &high})
    world.add_body({.positions = mesh->positions, .facets = mesh->facets, .surface = Surface::sheet, .margin = 0.04});
  const std::vector<int> rows{0, low.vertex_count()};
  Eigen::Matrix3Xd x(3, low.vertex_count() + high.vertex_count());
  x << low.positions, high.positions;
  const auto stencils = solver::stencils_within_reach(world.detect(), rows);
  ASSERT_GT(stencils.size(), 100u);
  int smaller = 0;
  for (const solver::ReachStencil& pair : stencils) {
    EXPECT_EQ(pair.whole.size(), 4);
    smaller += pair.closest.size() < 4;
    for (int k = 0; k < pair.closest.size(); ++k)
      EXPECT_NE(std::ranges::find(pair.whole.vertices, pair.closest.vertices[static_cast<std::size_t>(k)]),
                pair.whole.vertices.end());
    EXPECT_NEAR(solver::gap_of(pair.closest, solver::gather(pair.closest, x)).distance.value, pair.closest.gap, 1e-12);
  }
  EXPECT_GT(smaller, 50);
  EXPECT_THROW(solver::stencils_within_reach(world.detect(), std::vector<int>{0}), Error);
}

// Central differences by each coordinate of all four vertices, where the mollifier is at work and where it is not.
TEST(ReachStencils, HaveBarriersWithTheirDerivatives) {
  constexpr double kReach = 0.3, kStep = 1e-6;
  Eigen::Matrix3Xd x(3, 4);
  x.transpose() << 0, 0, 0, 1, 0.05, 0, 0.2, 0.1, 0.11, 1.1, 0.12, 0.12;
  ReachPair edges{
      .kind = FeaturePair::edge_edge, .a_vertices = {0, 1, -1}, .b_vertices = {0, 1, -1}, .normal = {0, 0, 1}};
  edges.a_weights = {0.79, 0.21, 0.0};  // nearest at the first end of b
  edges.b_weights = {1.0, 0.0, 0.0};
  edges.distance = 0.14;
  const solver::ReachStencil pair = solver::stencil(edges, 0, 2);
  EXPECT_EQ(pair.whole.kind, solver::StencilKind::edge_edge);
  EXPECT_EQ(pair.closest.kind, solver::StencilKind::point_edge);
  for (const double threshold : {0.0, 0.5}) {
    const solver::Term term = solver::barrier_term(pair, x, kReach, threshold);
    EXPECT_GT(term.value, 0.0);
    for (int i = 0; i < 12; ++i) {
      Eigen::Matrix3Xd more = x, less = x;
      more(i % 3, i / 3) += kStep;
      less(i % 3, i / 3) -= kStep;
      const solver::Term up = solver::barrier_term(pair, more, kReach, threshold),
                         down = solver::barrier_term(pair, less, kReach, threshold);
      EXPECT_NEAR(term.gradient[i], (up.value - down.value) / (2 * kStep), 1e-7) << threshold << ", " << i;
      EXPECT_LT((term.hessian.col(i) - (up.gradient - down.gradient) / (2 * kStep)).norm(), 1e-6)
          << threshold << ", " << i;
    }
  }
}

}  // namespace
}  // namespace tact::tests
