// What tact/solver.h makes of the points of a world: rows, weights, gaps, masses, areas, tangents, friction, sums and
// colours.
#include <gtest/gtest.h>
#include <tact/solver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using solver::Corners;
using solver::Stencil;
using solver::Term;

// A wrinkled cloth that lies on a ball and touches itself, after one step.
struct Draped {
  explicit Draped(int threads = 1) : world({.threads = threads, .outputs = {.points = true}}) {
    add(folded(), Surface::sheet, 0.03, true);
    add(icosphere(2), Surface::closed, 0.02, false);
    report = &world.detect();
    stencils = solver::stencils(*report, first_rows);
  }
  static Mesh folded() {
    return mapped(wrinkled_sheet(16, 2.0, 0.05, 3), [](Vec3 p) {
      return p.x > 0.5 ? Vec3{1.0 - p.x, p.y, 1.08} : Vec3{p.x, p.y, 1.04};
    });
  }
  void add(const Mesh& mesh, Surface surface, double margin, bool self) {
    first_rows.push_back(static_cast<int>(x.cols()));
    x.conservativeResize(3, x.cols() + mesh.positions.cols());
    x.rightCols(mesh.positions.cols()) = mesh.positions;
    world.add_body({.positions = mesh.positions,
                    .facets = mesh.facets,
                    .surface = surface,
                    .margin = margin,
                    .self_contact = self});
  }
  World world;
  Eigen::Matrix3Xd x{3, 0};
  std::vector<int> first_rows;
  const Report* report = nullptr;
  std::vector<Stencil> stencils;
};

TEST(Solver, StencilsHaveTheGapsNormalsAndWeightsOfTheirPoints) {
  const Draped draped;
  ASSERT_GT(draped.stencils.size(), 100u);
  std::size_t at = 0;
  std::set<solver::StencilKind> kinds;
  for (const Contact& contact : draped.report->contacts())
    for (const ContactPoint& point : contact.points()) {
      const Stencil& stencil = draped.stencils[at++];
      const solver::Gap gap = solver::gap_of(stencil, solver::gather(stencil, draped.x));
      kinds.insert(stencil.kind);
      EXPECT_EQ(stencil.id, point.id);
      EXPECT_NEAR(gap.distance.value, point.gap, 1e-12);
      EXPECT_LT((gap.normal - point.normal).norm(), 1e-9);
      EXPECT_LT((gap.weights - stencil.weights).norm(), 1e-9);
      Eigen::Vector3d way = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        if (point.a_vertices[k] >= 0)
          way -= point.a_weights[k] * draped.x.col(draped.first_rows[contact.a.index] + point.a_vertices[k]);
        if (point.b_vertices[k] >= 0)
          way += point.b_weights[k] * draped.x.col(draped.first_rows[contact.b.index] + point.b_vertices[k]);
      }
      EXPECT_LT((solver::difference(stencil, solver::gather(stencil, draped.x)) - way).norm(), 1e-14);
    }
  EXPECT_EQ(at, draped.stencils.size());
  EXPECT_EQ(kinds.size(), 3u) << "all but two vertices";
}

TEST(Solver, GapsOfCrossedSurfacesAreNegative) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh ball = icosphere(2), other = translated(ball, {1.7, 0.1, 0.2});
  world.add_body({.positions = ball.positions, .facets = ball.facets});
  world.add_body({.positions = other.positions, .facets = other.facets});
  Eigen::Matrix3Xd x(3, 2 * ball.positions.cols());
  x << ball.positions, other.positions;
  const std::vector<int> first_rows{0, ball.vertex_count()};
  int crossed = 0;
  for (const Stencil& stencil : solver::stencils(world.detect(), first_rows)) {
    const solver::Gap gap = solver::gap_of(stencil, solver::gather(stencil, x));
    EXPECT_NEAR(gap.distance.value, stencil.gap, 1e-12);
    EXPECT_NEAR(solver::penalty_term(stencil, solver::gather(stencil, x), 0.0).value, 0.5 * stencil.gap * stencil.gap,
                1e-12);
    crossed += stencil.gap < 0.0;
  }
  EXPECT_GT(crossed, 5);
}

TEST(Solver, WhatIsNoStencilIsRefused) {
  ContactPoint point;
  point.a_vertices = {0, 1, -1};
  point.b_vertices = {0, 1, 2};
  EXPECT_THROW(solver::stencil(point, 0, 0), Error);
  const Draped draped;
  EXPECT_THROW(solver::stencils(*draped.report, std::vector<int>{0}), Error);
}

TEST(Solver, FeaturesWithoutLengthAreaOrAngleHaveFiniteDerivatives) {
  const Eigen::Vector3d up{0.0, 0.0, 1.0};
  for (const auto kind : {solver::StencilKind::point_point, solver::StencilKind::point_edge,
                          solver::StencilKind::point_facet, solver::StencilKind::edge_edge}) {
    Stencil stencil{.kind = kind, .weights = {-1.0, 1.0, 0.0, 0.0}, .normal = up, .gap = 0.0};
    if (kind == solver::StencilKind::edge_edge) stencil.weights = {-1.0, 0.0, 1.0, 0.0};
    for (const double height : {0.0, 1.0}) {
      Corners x = Corners::Zero();
      if (kind == solver::StencilKind::edge_edge)
        x << 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, height, height;
      else
        x(2, 0) = -height;
      const solver::Gap gap = solver::gap_of(stencil, x);
      EXPECT_EQ(gap.distance.value, height);
      EXPECT_EQ(gap.normal, up);
      EXPECT_TRUE(gap.distance.hessian.allFinite() && gap.distance.gradient.allFinite());
      EXPECT_EQ(solver::edge_mollifier(stencil, x, 1.0).value, kind == solver::StencilKind::edge_edge ? 0.0 : 1.0);
    }
  }
}

// An impulse along the normal changes the speed at the point by the impulse over the effective mass.
TEST(Solver, EffectiveMassIsWhatAnImpulseMeets) {
  const Draped draped;
  const std::size_t moving = static_cast<std::size_t>(draped.first_rows[1]);
  std::vector<double> inverse_masses(moving);
  for (std::size_t v = 0; v < moving; ++v) inverse_masses[v] = 1.0 + 0.1 * static_cast<double>(v % 7);
  for (const Stencil& stencil : draped.stencils) {
    Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, draped.x.cols());
    solver::push(stencil, stencil.normal, inverse_masses, all);
    const Corners velocity = solver::gather(stencil, all);
    EXPECT_EQ(all.rightCols(draped.x.cols() - draped.first_rows[1]).norm(), 0.0) << "what has no mass stays";
    const double speed = stencil.normal.dot(solver::difference(stencil, velocity));
    EXPECT_NEAR(speed * solver::effective_mass(stencil, inverse_masses), 1.0, 1e-12);
  }
  EXPECT_EQ(solver::effective_mass(draped.stencils[0], {}), std::numeric_limits<double>::infinity());
}

TEST(Solver, AreasOfVerticesAddUpToThatOfTheFacets) {
  const Mesh cloth = sheet(10, 4, 2.0, 1.5);
  const Eigen::VectorXd areas = solver::vertex_areas(cloth.positions, cloth.facets);
  EXPECT_NEAR(areas.sum(), 3.0, 1e-12);
  Stencil stencil{
      .kind = solver::StencilKind::edge_edge, .vertices = {0, 1, 2, 3}, .weights = {-0.5, -0.5, 0.25, 0.75}};
  EXPECT_NEAR(solver::area_weight(stencil, areas),
              std::sqrt(0.5 * (areas[0] + areas[1]) * (0.25 * areas[2] + 0.75 * areas[3])), 1e-15);
  stencil.kind = solver::StencilKind::point_facet;
  EXPECT_EQ(solver::area_weight(stencil, areas), areas[0]);
}

TEST(Solver, TangentsAreARightHandedFrame) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = random.direction();
    const Eigen::Vector3d n = i == 0 ? Eigen::Vector3d(0, 0, -1) : Eigen::Vector3d(d.x, d.y, d.z);
    const solver::Tangents tangents = solver::tangents(n);
    Eigen::Matrix3d frame;
    frame << tangents, n;
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(frame.determinant(), 1.0, 1e-14);
  }
}

Corners moved_by(const Corners& x, int i, double by) {
  Corners moved = x;
  moved.data()[i] += by;
  return moved;
}

TEST(Solver, FrictionIsAForceBelowItsLimit) {
  Random random(7);
  const Stencil stencil{
      .kind = solver::StencilKind::point_facet, .vertices = {0, 1, 2, 3}, .weights = {-1.0, 0.2, 0.3, 0.5}};
  const solver::Tangents tangents = solver::tangents({0.6, 0.0, 0.8});
  for (const double length : {0.0, 1e-4, 5e-4, 2e-3, 1.0}) {
    Corners moved = Corners::Zero();
    const Vec3 d = random.direction();
    moved.col(0) = length * Eigen::Vector3d(d.x, d.y, d.z);
    const auto term = [&](const Corners& at) { return solver::friction_term(stencil, tangents, at, 3.0, 1e-3); };
    const Term here = term(moved);
    const double step = 1e-9;
    for (int i = 0; i < 12; ++i) {
      const Term above = term(moved_by(moved, i, step)), below = term(moved_by(moved, i, -step));
      EXPECT_NEAR((above.value - below.value) / (2.0 * step), here.gradient[i], 1e-5) << length;
      EXPECT_LT(((above.gradient - below.gradient) / (2.0 * step) - here.hessian.col(i)).norm(), 1e-2) << length;
    }
    EXPECT_LE(here.gradient.head<3>().norm(), 3.0 + 1e-12);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<solver::Matrix12d>(here.hessian).eigenvalues()[0],
              -1e-12 * here.hessian.norm());
  }
}

// Sums over stencils: by triplets, into a matrix that is there, and entry by entry in a dense one.
TEST(Solver, ScattersTheSameIntoSparseAndPlainArrays) {
  const Draped draped;
  const int moving = draped.first_rows[1], rows = 3 * moving;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(rows), of_all = Eigen::VectorXd::Zero(3 * draped.x.cols());
  std::vector<double> plain(static_cast<std::size_t>(rows), 0.0);
  std::vector<Eigen::Triplet<double>> triplets;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(rows, rows);
  Eigen::SparseMatrix<double> sparse(rows, rows), direct(rows, rows);
  for (const Stencil& stencil : draped.stencils) {
    const Term term = solver::barrier_term(stencil, solver::gather(stencil, draped.x), 0.06);
    solver::add_gradient(stencil, term.gradient, gradient);
    solver::add_gradient(stencil, term.gradient, of_all);
    solver::add_gradient(stencil, term.gradient, Eigen::Map<Eigen::VectorXd>(plain.data(), rows));
    solver::append_triplets(stencil, term.hessian, moving, triplets);
    solver::add_hessian(stencil, term.hessian, direct);
    solver::for_each_entry(stencil, term.hessian, moving,
                           [&](int row, int column, double v) { dense(row, column) += v; });
  }
  sparse.setFromTriplets(triplets.begin(), triplets.end());
  EXPECT_GT(dense.norm(), 0.0);
  EXPECT_LT((Eigen::MatrixXd(sparse) - dense).norm(), 1e-12 * dense.norm());
  EXPECT_LT((Eigen::MatrixXd(direct) - dense).norm(), 1e-12 * dense.norm());
  EXPECT_EQ(of_all.head(rows), gradient);
  EXPECT_EQ(Eigen::Map<Eigen::VectorXd>(plain.data(), rows), gradient);
  // Forces of contact are in balance.
  for (int i = 0; i < 3; ++i) {
    double sum = 0.0;
    for (Eigen::Index row = i; row < of_all.size(); row += 3) sum += of_all[row];
    EXPECT_LT(std::abs(sum), 1e-12 * of_all.norm());
  }
}

TEST(Solver, ColorsShareNoMovingVertexAndDependOnNoThreads) {
  const Draped draped;
  const int moving = draped.first_rows[1];
  const solver::Coloring coloring = solver::color(draped.stencils, moving);
  std::vector<int> seen = coloring.order;
  for (int c = 0; c < coloring.count(); ++c) {
    std::set<int> used;
    EXPECT_FALSE(coloring.of(c).empty());
    EXPECT_TRUE(std::ranges::is_sorted(coloring.of(c)));
    for (const int s : coloring.of(c)) {
      for (const int v : draped.stencils[static_cast<std::size_t>(s)].vertices) {
        if (v >= 0 && v < moving) {
          EXPECT_TRUE(used.insert(v).second) << "colour " << c;
        }
      }
    }
  }
  std::ranges::sort(seen);
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<int>(i));
  EXPECT_EQ(seen.size(), draped.stencils.size());
  EXPECT_EQ(solver::color(Draped(2).stencils, moving).order, coloring.order);
}

// More colours than a machine word has bits: 200 stencils of one vertex.
TEST(Solver, ColorsOfOneVertexAreAllDifferent) {
  std::vector<Stencil> star;
  for (int i = 0; i < 200; ++i) star.push_back({.vertices = {0, 1 + i, -1, -1}});
  const solver::Coloring coloring = solver::color(star, 500);
  EXPECT_EQ(coloring.count(), 200);
  for (int c = 0; c < 200; ++c) EXPECT_EQ(coloring.of(c)[0], c);
  EXPECT_EQ(solver::color(star, 0).count(), 1) << "nothing moves";
  EXPECT_EQ(solver::color({}, 5).count(), 0);
}

}  // namespace
}  // namespace tact::tests
