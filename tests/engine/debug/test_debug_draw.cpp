#include <gtest/gtest.h>
#include <tact/debug_draw.h>
#include <tact/solver/debug_draw.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

using Eigen::Vector3d;

// Keeps what is drawn.
class Sketch : public DebugDrawer {
 public:
  struct Line {
    Vector3d from, to;
    DebugColor color;
  };
  struct Triangle {
    Vector3d p, q, r;
    DebugColor color;
  };
  void line(const Vector3d& from, const Vector3d& to, const DebugColor& color) override {
    lines.push_back({from, to, color});
  }
  void triangle(const Vector3d& p, const Vector3d& q, const Vector3d& r, const DebugColor& color) override {
    triangles.push_back({p, q, r, color});
  }
  void text(const Vector3d&, std::string_view words, const DebugColor&) override { texts.emplace_back(words); }

  std::vector<Line> lines;
  std::vector<Triangle> triangles;
  std::vector<std::string> texts;
};

constexpr DebugDrawOptions kNothing{.boxes = false,
                                    .candidate_pairs = false,
                                    .directions = false,
                                    .zones = false,
                                    .facet_pairs = false,
                                    .patches = false,
                                    .points = false,
                                    .names = false};

class DebugDraw : public ::testing::Test {
 protected:
  DebugDraw() {
    a_ = world_.add_body({.positions = ball_.positions, .facets = ball_.facets, .name = "left"});
    b_ = world_.add_body({.positions = other_.positions, .facets = other_.facets, .name = "right"});
    report_ = &world_.detect();
  }
  Sketch sketch(const DebugDrawOptions& options) const {
    Sketch sketch;
    debug_draw(world_, *report_, sketch, options);
    return sketch;
  }

  const Mesh ball_ = icosphere(2), other_ = translated(icosphere(2), {1.9, 0.1, 0.05});
  tact::World world_{{.outputs = {.zones = true, .patches = true, .points = true}}};
  BodyId a_, b_;
  const Report* report_ = nullptr;
};

TEST_F(DebugDraw, NothingAskedForDrawsNothing) {
  const Sketch drawn = sketch(kNothing);
  EXPECT_TRUE(drawn.lines.empty());
  EXPECT_TRUE(drawn.triangles.empty());
  EXPECT_TRUE(drawn.texts.empty());
}

TEST_F(DebugDraw, BoxesAreThoseOfTheBodies) {
  DebugDrawOptions options = kNothing;
  options.boxes = true;
  const Sketch drawn = sketch(options);
  ASSERT_EQ(drawn.lines.size(), 24u);
  double left = 0.0, right = 0.0;
  for (const Sketch::Line& line : drawn.lines) {
    EXPECT_EQ((line.from.array() != line.to.array()).count(), 1);
    left = std::min(left, line.from.x());
    right = std::max(right, line.to.x());
  }
  EXPECT_EQ(left, ball_.positions.row(0).minCoeff());
  EXPECT_EQ(right, other_.positions.row(0).maxCoeff());
}

TEST_F(DebugDraw, TheDirectionIsAsLongAsTheDepth) {
  DebugDrawOptions options = kNothing;
  options.directions = true;
  const Sketch drawn = sketch(options);
  const Contact& contact = report_->contacts()[0];
  ASSERT_EQ(drawn.lines.size(), 3u);
  const Vector3d way = drawn.lines[0].to - drawn.lines[0].from;
  EXPECT_LT((way - contact.depth * contact.direction).norm(), 1e-15);
  ASSERT_EQ(drawn.texts.size(), 1u);
  EXPECT_TRUE(drawn.texts[0].ends_with(" m"));
}

TEST_F(DebugDraw, PlanesAreWhereTheContactSays) {
  DebugDrawOptions options = kNothing;
  options.planes = true;
  const Sketch drawn = sketch(options);
  const Contact& contact = report_->contacts()[0];
  ASSERT_EQ(drawn.triangles.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(contact.direction.dot(drawn.triangles[i].q), i < 2 ? contact.plane_a : contact.plane_b, 1e-14);
  }
}

TEST_F(DebugDraw, ZonesAreTheirRims) {
  DebugDrawOptions options = kNothing;
  options.zones = true;
  const Sketch drawn = sketch(options);
  const Contact& contact = report_->contacts()[0];
  ASSERT_EQ(drawn.lines.size(), 48u);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_NEAR((drawn.lines[i].from - contact.zone_a.center).norm(), contact.zone_a.radius, 1e-14);
  }
}

// Every facet that meets, once, where the body is.
TEST_F(DebugDraw, FacetsThatMeet) {
  DebugDrawOptions options = kNothing;
  options.facet_pairs = true;
  const Sketch drawn = sketch(options);
  std::vector<int> a, b;
  for (const FacetPair pair : report_->contacts()[0].facet_pairs()) a.push_back(pair.a), b.push_back(pair.b);
  for (std::vector<int>* facets : {&a, &b}) {
    std::ranges::sort(*facets);
    facets->erase(std::unique(facets->begin(), facets->end()), facets->end());
  }
  ASSERT_GT(a.size(), 0u);
  ASSERT_EQ(drawn.triangles.size(), a.size() + b.size());
  EXPECT_EQ(drawn.triangles[0].p, ball_.positions.col(ball_.facets(0, a[0])));
  EXPECT_EQ(drawn.triangles.back().r, other_.positions.col(other_.facets(2, b.back())));
}

// As many as the contact tells, those that meet among them; each colour its own.
TEST_F(DebugDraw, FacetsThatWereKept) {
  DebugDrawOptions options = kNothing;
  options.kept_facets = true;
  const Contact& contact = report_->contacts()[0];
  const auto kept = static_cast<std::size_t>(contact.kept_facets_a + contact.kept_facets_b);
  EXPECT_EQ(sketch(options).triangles.size(), kept);
  options.facet_pairs = true;
  const Sketch both = sketch(options);
  EXPECT_EQ(both.triangles.size(), kept);
  const auto of_color = [&](const DebugColor& color) {
    return std::ranges::count_if(both.triangles, [&](const Sketch::Triangle& one) {
      return one.color.green == color.green && one.color.alpha == color.alpha;
    });
  };
  EXPECT_GT(of_color(options.kept), 0);
  EXPECT_GT(of_color(options.meeting), 0);
  EXPECT_EQ(of_color(options.kept) + of_color(options.meeting), static_cast<std::ptrdiff_t>(kept));
}

TEST_F(DebugDraw, NamesAndSurfaces) {
  DebugDrawOptions options = kNothing;
  options.names = options.surfaces = true;
  const Sketch drawn = sketch(options);
  EXPECT_EQ(drawn.texts, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(drawn.lines.size(), 3u * static_cast<std::size_t>(ball_.facets.cols() + other_.facets.cols()));
}

TEST_F(DebugDraw, BodyThatIsGoneIsAnError) {
  world_.remove_body(b_);
  Sketch drawn;
  try {
    debug_draw(world_, *report_, drawn, {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::stale_body);
  }
}

TEST(DebugDrawPoints, LinesGoFromSurfaceToSurface) {
  tact::World world({.outputs = {.points = true}});
  const Mesh ball = icosphere(2), other = translated(ball, {2.05, 0.0, 0.0});
  world.add_body({.positions = ball.positions, .facets = ball.facets, .margin = 0.05});
  world.add_body({.positions = other.positions, .facets = other.facets, .margin = 0.05});
  const Report& report = world.detect();
  ASSERT_EQ(report.contacts().size(), 1u);
  const auto points = report.contacts()[0].points();
  ASSERT_GT(points.size(), 0u);
  DebugDrawOptions options = kNothing;
  options.points = true;
  Sketch drawn;
  debug_draw(world, report, drawn, options);
  ASSERT_EQ(drawn.lines.size(), 4 * points.size());
  EXPECT_NEAR((drawn.lines[0].to - drawn.lines[0].from).norm(), points[0].gap, 1e-14);
}

// Nothing that a drawing asks of a world of hostile bodies fails.
TEST(DebugDrawBodies, WithoutFacets) {
  tact::World world;
  const Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, 2);
  world.add_body({.positions = positions, .facets = Eigen::Matrix3Xi(3, 0)});
  Sketch drawn;
  debug_draw(world, world.detect(), drawn, {.surfaces = true, .planes = true});
  EXPECT_TRUE(drawn.lines.empty());
}

// From place to place, also to a plane, with the length; what is too far is left out.
TEST(DebugDrawAnswers, DistancesGoFromPlaceToPlace) {
  tact::World world;
  const Mesh ball = icosphere(2), other = translated(ball, {3.0, 0.0, 0.0});
  const BodyId a = world.add_body({.positions = ball.positions, .facets = ball.facets}),
               b = world.add_body({.positions = other.positions, .facets = other.facets}),
               floor = world.add_plane({.offset = -1.5});
  const std::vector<BodyDistance> found{world.distance({a, b}), world.distance({floor, a}),
                                        world.distance({a, b, 0.1})};
  Sketch drawn;
  debug_draw_distances(world, found, drawn);
  ASSERT_EQ(drawn.lines.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR((drawn.lines[i].to - drawn.lines[i].from).norm(), found[i].distance, 1e-14);
  EXPECT_EQ(drawn.lines[1].from.z(), -1.5);
  EXPECT_EQ(drawn.texts.size(), 2u);
  world.remove_body(a);
  EXPECT_THROW(debug_draw_distances(world, found, drawn), Error);
}

TEST_F(DebugDraw, SumsAreCirclesAndForces) {
  const Contact& contact = report_->contacts()[0];
  ASSERT_FALSE(contact.patches().empty());
  std::vector<PointImpulse> impulses;
  for (const ContactPoint& point : contact.points()) impulses.push_back({point.id, point.normal});
  const auto circles = 24 * contact.patches().size(), arrows = 3 * contact.patches().size();
  Sketch bare, pushed;
  debug_draw_sums(world_, sum_contacts(world_, *report_), bare);
  EXPECT_EQ(bare.lines.size(), circles + arrows);
  const ContactSums sums = sum_contacts(world_, *report_, impulses);
  debug_draw_sums(world_, sums, pushed);
  EXPECT_EQ(pushed.lines.size(), circles + 2 * arrows + 6);  // and the forces on both bodies
  double longest = 0.0;
  const DebugDrawOptions options;
  for (const Sketch::Line& line : pushed.lines) {
    if (line.color.green == options.force.green) longest = std::max(longest, (line.to - line.from).norm());
  }
  const Vector3d size = Vector3d(other_.positions.rowwise().maxCoeff()) - ball_.positions.rowwise().minCoeff();
  EXPECT_NEAR(longest, 0.5 * size.norm(), 1e-6);
}

// Impacts as constraints, and points.
TEST(DebugDrawStencils, AreTheirFeaturesAndNormals) {
  Eigen::Matrix3Xd x(3, 4);
  x << 0.2, 0, 1, 0,  //
      0.2, 0, 0, 1,   //
      0.5, 0, 0, 0;
  const solver::Stencil one{.kind = solver::StencilKind::point_facet,
                            .b_first = true,
                            .vertices = {0, 1, 2, 3},
                            .weights = {1.0, -0.6, -0.2, -0.2},
                            .normal = {0, 0, 1},
                            .gap = 0.5};
  Sketch drawn;
  solver::debug_draw(std::span(&one, 1), x, drawn);
  ASSERT_EQ(drawn.lines.size(), 5u);
  EXPECT_LT((drawn.lines[3].from - Vector3d(0.2, 0.2, 0.0)).norm(), 1e-15);
  EXPECT_LT((drawn.lines[3].to - x.col(0)).norm(), 1e-15);
  EXPECT_GT(drawn.lines[4].to.z(), 0.3);
  EXPECT_THROW(solver::debug_draw(std::span(&one, 1), x.leftCols(3), drawn), Error);
}

TEST(WorldMesh, IsReadBackAsItWasGiven) {
  tact::World world;
  Mesh mesh = icosphere(3);
  mesh.positions.conservativeResize(3, mesh.positions.cols() + 1);  // a vertex that no facet uses
  mesh.positions.col(mesh.positions.cols() - 1) << 7, 7, 7;
  const BodyId body = world.add_body({.positions = mesh.positions, .facets = mesh.facets, .margin = 0.5});
  Eigen::Matrix3Xd positions(3, mesh.positions.cols());
  Eigen::Matrix3Xi facets(3, mesh.facets.cols());
  world.copy_positions(body, {positions.data(), static_cast<std::size_t>(positions.size())});
  world.copy_facets(body, {facets.data(), static_cast<std::size_t>(facets.size())});
  EXPECT_EQ(facets, mesh.facets);
  EXPECT_EQ(positions.leftCols(positions.cols() - 1), mesh.positions.leftCols(positions.cols() - 1));
  EXPECT_TRUE(positions.col(positions.cols() - 1).array().isNaN().all());
  EXPECT_NEAR(world.bounds(body).upper[2], 1.5, 1e-15);  // rounded outward
  EXPECT_THROW(world.copy_positions(body, {positions.data(), 3}), Error);
  EXPECT_THROW(world.copy_facets(body, {facets.data(), 4}), Error);
}

}  // namespace
}  // namespace tact::tests
