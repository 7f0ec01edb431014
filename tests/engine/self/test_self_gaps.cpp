// Contact points of bodies that cross themselves: closed forms, brute force, memory, invariances.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/folds.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/self_crossing_oracle.h"

namespace tact::tests {
namespace {

// A world with one body that is held against itself.
class CrossingWorld {
 public:
  CrossingWorld(const Mesh& mesh, Surface surface, double margin, int threads = 2)
      : surface_(surface),
        margin_(margin),
        world_({.threads = threads, .outputs = {.points = true}}),
        id_(world_.add_body({.positions = mesh.positions,
                             .facets = mesh.facets,
                             .surface = surface,
                             .margin = margin,
                             .self_contact = true})) {}
  // Valid until the next call.
  std::span<const ContactPoint> at(const Mesh& mesh) {
    last_.assign(points_.begin(), points_.end());
    world_.set_positions(id_, mesh.positions);
    const Report& report = world_.detect();
    hash_ = report.hash();
    points_ = report.contacts().empty() ? std::span<const ContactPoint>() : report.contacts()[0].points();
    return points_;
  }
  // Holds the points of the last at() against brute force, whose memory they are, too.
  void expect_points_of_brute_force(const Mesh& mesh, const std::string& what) {
    const double band = 1e-12 * extent(mesh);
    const auto expected = self_points_with_gaps(mesh, surface_, 2 * margin_, band, last_);
    std::map<PointKey, double> seen;
    for (const ContactPoint& point : points_) {
      const PointKey key{point.kind, point.a_vertices, point.b_vertices};
      const auto known = expected.find(key);
      ASSERT_NE(known, expected.end()) << what << ": " << name(key) << ", gap " << point.gap;
      EXPECT_TRUE(seen.emplace(key, point.gap).second) << what << ": " << name(key) << " twice";
      EXPECT_NEAR(point.gap, known->second.gap, 10 * band) << what << ": " << name(key);
      crossed_ += point.gap < 0.0 ? 1 : 0;
      crossed_edges_ += point.gap < 0.0 && point.kind == FeaturePair::edge_edge ? 1 : 0;
    }
    for (const auto& [key, point] : expected) {
      ASSERT_TRUE(!point.certain || seen.contains(key)) << what << ": " << name(key) << ", gap " << point.gap;
    }
  }
  int crossed() const { return crossed_; }
  int crossed_edges() const { return crossed_edges_; }
  std::uint64_t hash() const { return hash_; }

 private:
  static std::string name(const PointKey& key) {
    std::string text = std::get<0>(key) == FeaturePair::edge_edge ? "edges" : "vertex";
    for (const auto& vertices : {std::get<1>(key), std::get<2>(key)}) {
      for (const int v : vertices) text += v < 0 ? "" : " " + std::to_string(v);
      text += ",";
    }
    return text;
  }

  Surface surface_;
  double margin_;
  World world_;
  BodyId id_;
  std::span<const ContactPoint> points_;
  std::vector<ContactPoint> last_;
  int crossed_ = 0, crossed_edges_ = 0;
  std::uint64_t hash_ = 0;
};

constexpr int kStrip = 41;  // vertices along the strip

// A strip that lies folded over itself: its second half 5 cm above its first one, with a dent so deep.
Mesh dented_strip(double depth) {
  Mesh strip = sheet(kStrip - 1, 9, 4.0, 0.9);
  for (int v = 0; v < strip.vertex_count(); ++v) {
    const double x = strip.positions(0, v) + 2.0, y = strip.positions(1, v);
    const double turn = std::clamp(x - 1.5, 0.0, 1.0) * std::numbers::pi, back = std::max(0.0, x - 2.5);
    strip.positions.col(v) << std::min(x, 1.5) + 0.3 * std::sin(turn) - 1.0173 * back, 1.001 * y + 0.013 * back,
        0.025 * (1.0 - std::cos(turn));
    const double from_dent = std::hypot(strip.positions(0, v) - 0.713, strip.positions(1, v) - 0.027);
    if (v % kStrip > 26) strip.positions(2, v) -= depth * std::exp(-20.0 * from_dent * from_dent);
  }
  return strip;
}

// What holds of any point: its gap is the distance of its two places along its normal.
void expect_places_to_agree(std::span<const ContactPoint> points, const Mesh& mesh) {
  for (const ContactPoint& point : points) {
    const Vec3 way =
        weighted(mesh, point.b_vertices, point.b_weights) - weighted(mesh, point.a_vertices, point.a_weights);
    EXPECT_NEAR(point.normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR(point.normal.dot(Eigen::Vector3d(way.x, way.y, way.z)), point.gap, 1e-12);
    EXPECT_NEAR(norm(way), std::abs(point.gap), 1e-12);
  }
}

// The dent goes through the lower layer, which is level: every vertex below it has its height as its gap, until the
// dent comes up again.
TEST(SelfGaps, OfADentThroughALevelLayerAreItsDepth) {
  CrossingWorld world(dented_strip(0.0), Surface::sheet, 0.0);
  world.at(dented_strip(0.02));
  std::map<int, std::uint64_t> ids;
  for (const double depth : {0.04, 0.06, 0.08, 0.11, 0.13, 0.12, 0.08, 0.06}) {
    const Mesh strip = dented_strip(depth);
    const auto points = world.at(strip);
    expect_places_to_agree(points, strip);
    std::map<int, double> gaps;
    for (const ContactPoint& point : points) {
      if (point.kind != FeaturePair::vertex_facet || point.gap >= 0.0) continue;
      const int v = point.a_vertices[0];
      EXPECT_TRUE(gaps.emplace(v, point.gap).second) << depth;
      const bool is_upper = v % kStrip > 26;
      EXPECT_GT(is_upper ? -point.normal.z() : point.normal.z(), 0.5) << depth;
      if (is_upper) {
        EXPECT_EQ(ids.try_emplace(v, point.id).first->second, point.id) << depth;
      }
    }
    int below = 0;
    for (int v = 0; v < strip.vertex_count(); ++v) {
      if (v % kStrip <= 26) continue;
      const double height = strip.positions(2, v);
      ASSERT_EQ(gaps.contains(v), height < 0.0) << depth << ", vertex " << v << " at " << height;
      if (height >= 0.0) continue;
      EXPECT_NEAR(gaps.at(v), height, 1e-12) << depth;
      ++below;
    }
    EXPECT_EQ(below > 0, depth > 0.05) << depth;
  }
}

// The same without a step before: most of what crosses is above.
TEST(SelfGaps, OfACrossingThatIsNewLeadToTheLongerSide) {
  const Mesh strip = dented_strip(0.07);
  CrossingWorld world(strip, Surface::sheet, 0.0);
  int crossed = 0;
  for (const ContactPoint& point : world.at(strip)) {
    if (point.kind != FeaturePair::vertex_facet || point.gap >= 0.0) continue;
    const int v = point.a_vertices[0];
    EXPECT_GT(v % kStrip > 26 ? -point.normal.z() : point.normal.z(), 0.5);
    ++crossed;
  }
  EXPECT_GT(crossed, 3);
}

TEST(SelfGaps, OfASheetWithAMarginAreNone) {
  CrossingWorld world(dented_strip(0.0), Surface::sheet, 0.02);
  for (const double depth : {0.02, 0.04, 0.06, 0.08}) {
    const auto points = world.at(dented_strip(depth));
    EXPECT_GT(points.size(), 30u);
    for (const ContactPoint& point : points) EXPECT_GE(point.gap, 0.0);
  }
}

// How deep a vertex is in a convex part of a mesh, of facets `from` to `to`: the least distance to its planes; negative
// outside.
double depth_in_part(const Mesh& mesh, int from, int to, Vec3 v) {
  double least = 1e300;
  for (int f = from; f < to; ++f) {
    const Vec3 p = mesh.position(mesh.facets(0, f)), q = mesh.position(mesh.facets(1, f)),
               r = mesh.position(mesh.facets(2, f));
    least = std::min(least, dot(normalized(cross(q - p, r - p)), p - v));
  }
  return least;
}

// A closed body of two balls: those vertices that are inside the other ball have their distance to it, no others.
TEST(SelfGaps, OfAClosedBodyAreThoseOfVerticesInsideItsOtherParts) {
  const Mesh ball = icosphere(3);
  for (const double margin : {0.0, 0.01}) {
    for (const double apart : {1.9, 1.5, 1.0}) {
      const Mesh balls[] = {ball, translated(rotated(ball, rotation(0.3, 0.4, -0.5, 0.7)), {apart, 0.03, 0.02})};
      const Mesh both = merged(balls);
      CrossingWorld world(both, Surface::closed, margin);
      std::map<int, double> gaps;
      for (const ContactPoint& point : world.at(both)) {
        if (point.gap >= 0.0) continue;
        for (const auto& vertices : {point.a_vertices, point.b_vertices}) {
          if (vertices[1] < 0) {
            EXPECT_TRUE(gaps.emplace(vertices[0], point.gap).second);
          }
        }
      }
      int inside = 0;
      for (int v = 0; v < both.vertex_count(); ++v) {
        const bool of_first = v < ball.vertex_count();
        const int first = of_first ? ball.facet_count() : 0;
        const double depth = depth_in_part(both, first, first + ball.facet_count(), both.position(v));
        ASSERT_EQ(gaps.contains(v), depth > 0.0) << "vertex " << v << ", depth " << depth << ", " << apart;
        if (depth <= 0.0) continue;
        EXPECT_NEAR(gaps.at(v), -depth, 1e-9) << "vertex " << v << ", " << apart;
        ++inside;
      }
      EXPECT_GT(inside, 10) << apart;
    }
  }
}

// Two boxes of one body, end in end, their sides in the same planes: the vertices of both ends are inside, those too
// that lie on the other's sides.
TEST(SelfGaps, OfPartsWithFacesInOnePlaneAreThoseOfAllVerticesInside) {
  const Mesh boxes[] = {gridded_box({-1, -0.5, -0.5}, {0.25, 0.5, 0.5}, 4),
                        gridded_box({0, -0.5, -0.5}, {1.25, 0.5, 0.5}, 4)};
  const Mesh both = merged(boxes);
  for (const double margin : {0.0, 0.01}) {
    CrossingWorld world(both, Surface::closed, margin);
    std::map<int, double> gaps;
    for (const ContactPoint& point : world.at(both)) {
      if (point.gap >= 0.0) continue;
      for (const auto& vertices : {point.a_vertices, point.b_vertices}) {
        if (vertices[1] < 0) gaps.emplace(vertices[0], point.gap);
      }
    }
    for (int v = 0; v < both.vertex_count(); ++v) {
      const double end = v < boxes[0].vertex_count() ? 0.25 : 0.0;
      const bool inside = both.positions(0, v) == end;
      ASSERT_EQ(gaps.contains(v), inside) << both.positions.col(v).transpose();
      if (inside) {
        EXPECT_NEAR(gaps.at(v), -0.25, 1e-12);
      }
    }
  }
}

// Around a curve from 0 to 1, closed by its ends' middles; its cross sections do not turn about the curve.
template <class Curve>
Mesh tube_around(const Curve& curve, int rings, int sides, double radius) {
  MeshBuilder builder;
  Vec3 across{0.3, 0.5, 0.8};
  for (int i = 0; i < rings; ++i) {
    const double step = 1.0 / (rings - 1), at = step * i;
    const Vec3 along = normalized(curve(std::min(1.0, at + step)) - curve(std::max(0.0, at - step)));
    across = normalized(across - dot(across, along) * along);
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      builder.vertex(curve(at) + radius * (std::cos(angle) * across + std::sin(angle) * cross(along, across)));
    }
  }
  const int first = rings * sides, last = first + 1;
  builder.vertex(curve(0.0)), builder.vertex(curve(1.0));
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides, end = first - sides;
    for (int ring = 0; ring < end; ring += sides)
      builder.quad(ring + k, ring + next, ring + sides + next, ring + sides + k);
    builder.facet(first, next, k), builder.facet(last, end + k, end + next);
  }
  return builder.mesh();
}

// By solid angles (van Oosterom and Strackee, 1983).
double winding_around(const Mesh& mesh, Vec3 place) {
  double sum = 0.0;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    Vec3 t[3];
    double length[3];
    for (int k = 0; k < 3; ++k) t[k] = mesh.position(mesh.facets(k, f)) - place, length[k] = norm(t[k]);
    sum += std::atan2(dot(t[0], cross(t[1], t[2])), length[0] * length[1] * length[2] + dot(t[0], t[1]) * length[2] +
                                                        dot(t[1], t[2]) * length[0] + dot(t[2], t[0]) * length[1]);
  }
  return sum / (2.0 * std::numbers::pi);
}

// The vertices just inside of which the surface winds twice.
std::set<int> vertices_wound_twice(const Mesh& mesh) {
  std::vector<Vec3> normals(static_cast<std::size_t>(mesh.vertex_count()));
  for (int f = 0; f < mesh.facet_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 v = mesh.position(mesh.facets(k, f)), p = mesh.position(mesh.facets((k + 1) % 3, f)) - v,
                 q = mesh.position(mesh.facets((k + 2) % 3, f)) - v, normal = cross(p, q);
      Vec3& sum = normals[static_cast<std::size_t>(mesh.facets(k, f))];
      sum = sum + std::atan2(norm(normal), dot(p, q)) * normalized(normal);
    }
  }
  std::set<int> inside;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 normal = normals[static_cast<std::size_t>(v)];
    if (winding_around(mesh, mesh.position(v) - 1e-7 * normalized(normal)) > 1.5) inside.insert(v);
  }
  return inside;
}

// A ring that overlaps its own end, a coil whose turns are too near, and a knot that is too thick.
TEST(SelfGaps, AreOfTheVerticesThatAreWoundTwice) {
  Random random(3);
  const double turn = 2.0 * std::numbers::pi;
  std::size_t found = 0;
  for (int k = 0; k < 6; ++k) {
    const double radius = random.uniform(0.08, 0.16), over = random.uniform(0.1, 0.5);
    const auto ring = [&](double s) {
      const double angle = (turn + over) * s;
      return Vec3{std::cos(angle), std::sin(angle), 0.3 * radius * s};
    };
    const auto coil = [&](double s) {
      return Vec3{std::cos(2 * turn * s), std::sin(2 * turn * s), (3.0 + over) * radius * s};
    };
    const auto knot = [&](double s) {
      return Vec3{std::sin(turn * s) + 2 * std::sin(2 * turn * s), std::cos(turn * s) - 2 * std::cos(2 * turn * s),
                  -std::sin(3 * turn * s)};
    };
    Mesh tube = k % 3 == 0   ? tube_around(ring, 40, 9, radius)
                : k % 3 == 1 ? tube_around(coil, 60, 9, radius)
                             : tube_around(knot, 80, 9, 5.0 * radius + 0.2);
    tube = jittered(tube, 1e-3, static_cast<std::uint64_t>(k));
    CrossingWorld world(tube, Surface::closed, 0.0);
    std::set<int> named;
    for (const ContactPoint& point : world.at(tube)) {
      if (point.gap < 0.0 && point.kind == FeaturePair::vertex_facet) named.insert(point.a_vertices[0]);
    }
    EXPECT_EQ(named, vertices_wound_twice(tube)) << k;
    found += named.size();
  }
  EXPECT_GT(found, 200u);
}

TEST(SelfGaps, EqualBruteForceWithoutMemory) {
  int crossed = 0, edges = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    for (const auto& [name, mesh] : folded_meshes(8, seed)) {
      const Mesh uneven = jittered(mesh, 0.02, seed);
      CrossingWorld world(uneven, Surface::sheet, 0.0);
      world.at(uneven);
      world.expect_points_of_brute_force(uneven, name);
      if (HasFatalFailure()) return;
      crossed += world.crossed(), edges += world.crossed_edges();
    }
  }
  EXPECT_GT(crossed, 200);
  EXPECT_GT(edges, 20);
}

// A fan that closes, with layers that sink into each other, and come out.
TEST(SelfGaps, EqualBruteForceFromStepToStep) {
  int crossed = 0, edges = 0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const auto fan_at = [&](double angle, double noise) { return jittered(fan_fold(12, 8, 3, angle), noise, seed); };
    CrossingWorld one(fan_at(1.4, 0.0), Surface::sheet, 0.0, 1), two(fan_at(1.4, 0.0), Surface::sheet, 0.0, 2);
    for (const double noise : {0.002, 0.01, 0.02, 0.04, 0.06, 0.04, 0.02, 0.005}) {
      const Mesh mesh = fan_at(1.54, noise);
      one.at(mesh);
      two.at(mesh);
      EXPECT_EQ(one.hash(), two.hash());
      one.expect_points_of_brute_force(mesh, "noise " + std::to_string(noise));
      if (HasFatalFailure()) return;
    }
    crossed += one.crossed(), edges += one.crossed_edges();
  }
  EXPECT_GT(crossed, 200);
  EXPECT_GT(edges, 20);
}

}  // namespace
}  // namespace tact::tests
