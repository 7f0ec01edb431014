// Intersection curves hold each segment that two facets have in common once, in order, and end on borders alone; also
// where facets lie in one plane and edges on one line.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using Eigen::Vector3d;

// How many facets have an edge.
std::map<std::array<int, 2>, int> facets_of_edges(const Mesh& mesh) {
  std::map<std::array<int, 2>, int> count;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto [v, w] = std::minmax(mesh.facets(k, f), mesh.facets((k + 1) % 3, f));
      ++count[{v, w}];
    }
  }
  return count;
}

bool has_vertex(const Mesh& mesh, int facet, int vertex) { return (mesh.facets.col(facet).array() == vertex).any(); }

Vector3d corner(const Mesh& mesh, int facet, int k) { return mesh.positions.col(mesh.facets(k, facet)); }

Vector3d normal_of(const Mesh& mesh, int facet) {
  return (corner(mesh, facet, 1) - corner(mesh, facet, 0)).cross(corner(mesh, facet, 2) - corner(mesh, facet, 0));
}

// What two facets in general position have in common, by plain numbers, along the normal of the first times that of the
// second; nothing if it is next to nothing.
std::optional<std::array<Vector3d, 2>> common_segment(const Mesh& a, int facet_a, const Mesh& b, int facet_b) {
  const Vector3d n_a = normal_of(a, facet_a).normalized(), n_b = normal_of(b, facet_b).normalized();
  const Vector3d along = n_a.cross(n_b).normalized();
  double low = -1e300, high = 1e300;
  Vector3d from = Vector3d::Zero();
  for (const auto& [mesh, facet, n, plane_mesh, plane_facet] :
       {std::tuple{&a, facet_a, n_b, &b, facet_b}, std::tuple{&b, facet_b, n_a, &a, facet_a}}) {
    std::vector<Vector3d> places;
    for (int k = 0; k < 3; ++k) {
      const Vector3d p = corner(*mesh, facet, k), q = corner(*mesh, facet, (k + 1) % 3),
                     o = corner(*plane_mesh, plane_facet, 0);
      const double s = n.dot(p - o), t = n.dot(q - o);
      if (s * t < 0.0) places.push_back(p + s / (s - t) * (q - p));
    }
    if (places.size() != 2) return {};
    from = places[0];
    low = std::max(low, std::min(along.dot(places[0]), along.dot(places[1])));
    high = std::min(high, std::max(along.dot(places[0]), along.dot(places[1])));
  }
  if (high - low < 1e-9) return {};
  return {{from + (low - along.dot(from)) * along, from + (high - along.dot(from)) * along}};
}

// Whether the edge of a point, or the facet that it goes through, is of a facet without area.
bool is_beside_a_flat_facet(const Mesh& own, const Mesh& other, const CurvePoint& point) {
  if (normal_of(other, point.facet).isZero(0.0)) return true;
  for (int f = 0; f < own.facet_count(); ++f) {
    if (has_vertex(own, f, point.edge[0]) && has_vertex(own, f, point.edge[1]) && normal_of(own, f).isZero(0.0))
      return true;
  }
  return false;
}

struct Counts {
  int closed = 0, open = 0, segments = 0;
};

// What holds of the curves of two meshes, or of one given twice, wherever they lie.
Counts expect_connected(const Contact& contact, const Mesh& a, const Mesh& b, const std::string& what) {
  const bool of_itself = &a == &b;
  const auto of_a = facets_of_edges(a), of_b = facets_of_edges(b);
  std::set<int> pairs;
  Counts counts;
  for (const IntersectionCurve& curve : contact.curves()) {
    ++(curve.closed ? counts.closed : counts.open);
    EXPECT_GE(curve.points.size(), 2u) << what;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const CurvePoint& point = curve.points[i];
      const bool last = i + 1 == curve.points.size();
      EXPECT_EQ(point.facet_pair < 0, last && !curve.closed) << what;
      const Mesh &own = point.edge_of_b ? b : a, &other = point.edge_of_b ? a : b;
      if (point.facet >= 0) {
        const Vector3d p = own.positions.col(point.edge[0]), q = own.positions.col(point.edge[1]);
        EXPECT_LE((p + point.fraction * (q - p) - point.position).norm(), 1e-14 * (1.0 + p.norm() + q.norm())) << what;
        const Vector3d n = normal_of(other, point.facet);
        EXPECT_LE(std::abs(n.dot(point.position - corner(other, point.facet, 0))),
                  1e-13 * n.norm() * (1.0 + p.norm() + q.norm()))
            << what;
      }
      if (!curve.closed && (i == 0 || last) && point.facet >= 0 && !is_beside_a_flat_facet(own, other, point)) {
        EXPECT_NE((point.edge_of_b ? of_b : of_a).at(point.edge), 2) << what << ": an end that is on no border";
      }
      if (!curve.closed && point.facet < 0) {
        EXPECT_TRUE(of_itself && (i == 0 || last)) << what;
      }
      if (point.facet_pair < 0) continue;
      ++counts.segments;
      EXPECT_TRUE(pairs.insert(point.facet_pair).second) << what << ": a facet pair is in two curves";
      // Both ends of the segment are of these facets.
      const FacetPair pair = contact.facet_pairs()[static_cast<std::size_t>(point.facet_pair)];
      const CurvePoint& next = curve.points[last ? 0 : i + 1];
      for (const CurvePoint* const end : {&point, &next}) {
        const auto is_of = [&](const Mesh& mesh, int facet) {
          return has_vertex(mesh, facet, end->edge[0]) && (end->edge[1] < 0 || has_vertex(mesh, facet, end->edge[1]));
        };
        const bool by_a = is_of(a, pair.a) && (end->facet < 0 || end->facet == pair.b);
        const bool by_b = is_of(b, pair.b) && (end->facet < 0 || end->facet == pair.a);
        EXPECT_TRUE(of_itself ? by_a || by_b : end->edge_of_b ? by_b : by_a) << what;
      }
    }
  }
  return counts;
}

// The same, and that all segments are there, of meshes in general position.
Counts expect_all_segments(const Contact& contact, const Mesh& a, const Mesh& b, const std::string& what) {
  std::map<int, std::array<Vector3d, 2>> found;
  for (const IntersectionCurve& curve : contact.curves()) {
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const CurvePoint &point = curve.points[i], &next = curve.points[(i + 1) % curve.points.size()];
      if (point.facet_pair >= 0) found[point.facet_pair] = {point.position, next.position};
    }
  }
  for (std::size_t i = 0; i < contact.facet_pairs().size(); ++i) {
    const auto [facet_a, facet_b] = contact.facet_pairs()[i];
    const auto expected = common_segment(a, facet_a, b, facet_b);
    const auto at = found.find(static_cast<int>(i));
    if (!expected) continue;
    if (at == found.end()) {
      ADD_FAILURE() << what << ": the segment of facets " << facet_a << " and " << facet_b << " is in no curve";
      continue;
    }
    for (std::size_t end = 0; end < 2; ++end)
      EXPECT_LE((at->second[end] - (*expected)[end]).norm(), 1e-9) << what << ", end " << end;
  }
  return expect_connected(contact, a, b, what);
}

// The contact of two bodies, or of one with itself.
class CurvesOf {
 public:
  CurvesOf(const Mesh& a, const Mesh& b) {
    for (const Mesh* mesh : {&a, &b})
      bodies_.push_back(
          world_.add_body({.positions = mesh->positions, .facets = mesh->facets, .surface = Surface::sheet}));
  }
  explicit CurvesOf(const Mesh& mesh) {
    bodies_.push_back(world_.add_body(
        {.positions = mesh.positions, .facets = mesh.facets, .surface = Surface::sheet, .self_contact = true}));
  }
  const Contact& contact() {
    const Contact* const found = world_.detect().find_contact(bodies_.front(), bodies_.back());
    return found == nullptr ? none_ : *found;
  }

 private:
  World world_{{.threads = 1, .outputs = {.curves = true}}};
  std::vector<BodyId> bodies_;
  Contact none_;
};

// Two meshes as one, without a common vertex.
Mesh both(const Mesh& a, const Mesh& b) {
  Mesh mesh;
  mesh.positions.resize(3, a.positions.cols() + b.positions.cols());
  mesh.positions << a.positions, b.positions;
  mesh.facets.resize(3, a.facets.cols() + b.facets.cols());
  mesh.facets << a.facets, (b.facets.array() + a.vertex_count()).matrix();
  return mesh;
}

TEST(Curves, OfClosedBodiesAreClosedAndHoldEachSegmentOnce) {
  int closed = 0, segments = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    const Mesh a = blob(2, 1.0, 0.3, seed), b = translated(blob(2, 0.8, 0.4, seed + 100), random.in_cube(0.9));
    const Counts counts = expect_all_segments(CurvesOf(a, b).contact(), a, b, "seed " + std::to_string(seed));
    EXPECT_EQ(counts.open, 0);
    closed += counts.closed;
    segments += counts.segments;
  }
  EXPECT_GE(closed, 12);
  EXPECT_GT(segments, 900);
}

TEST(Curves, OfSheetsAndSoupsEndOnBorders) {
  int open = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const std::string what = "seed " + std::to_string(seed);
    const Mesh cloth = wrinkled_sheet(12, 2.0, 0.3, seed), ball = translated(icosphere(2, 0.8), {0.3, 0.7, 0.1});
    open += expect_all_segments(CurvesOf(cloth, ball).contact(), cloth, ball, what).open;
    const Mesh a = soup(40, 1.0, seed), b = soup(40, 1.0, seed + 50);
    open += expect_all_segments(CurvesOf(a, b).contact(), a, b, what + ", soup").open;
    const Mesh one = soup(60, 1.0, seed + 90);
    expect_all_segments(CurvesOf(one).contact(), one, one, what + ", one soup");
  }
  EXPECT_GT(open, 30);
}

TEST(Curves, OfABodyWithItself) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Mesh two = both(blob(2, 1.0, 0.3, seed), translated(blob(2, 0.8, 0.4, seed + 7), {0.9, 0.2, 0.1}));
    const Counts counts = expect_all_segments(CurvesOf(two).contact(), two, two, "seed " + std::to_string(seed));
    EXPECT_EQ(counts.open, 0);
    EXPECT_GT(counts.closed, 0);
    // Crumpled, facets with a common vertex cross: curves may end there.
    const Mesh crumple = crumpled(wrinkled_sheet(10, 1.0, 0.2, seed), seed);
    expect_connected(CurvesOf(crumple).contact(), crumple, crumple, "crumpled " + std::to_string(seed));
  }
}

// Boxes on a grid: facets in one plane, edges on one line, vertices in one place.
TEST(Curves, OfWhatLiesInOnePlaneAreClosedToo) {
  const Mesh still = gridded_box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 2);
  int curves = 0, of_itself = 0;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; y += 2) {
      for (int z = -4; z <= 4; z += 4) {
        const Mesh moved = translated(still, {0.25 * x, 0.25 * y, 0.25 * z});
        const std::string what = std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z);
        const Counts counts = expect_connected(CurvesOf(still, moved).contact(), still, moved, what);
        EXPECT_EQ(counts.open, 0) << what;
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 4) {
          EXPECT_EQ(counts.closed, 0) << what << ": boxes that only touch";
        }
        curves += counts.closed;
        const Mesh one = both(still, moved);
        const Counts own = expect_connected(CurvesOf(one).contact(), one, one, what + " as one");
        EXPECT_EQ(own.open, 0) << what;
        of_itself += own.closed;
      }
    }
  }
  EXPECT_GT(curves, 10);
  EXPECT_GT(of_itself, 10);
}

TEST(Curves, OfLatticesAreConnected) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Mesh a = lattice_soup(30, 2, seed), b = lattice_soup(30, 2, seed + 1000);
    const std::string what = "seed " + std::to_string(seed);
    expect_connected(CurvesOf(a, b).contact(), a, b, what);
    expect_connected(CurvesOf(a).contact(), a, a, what + ", of one");
  }
}

// A box through the middle of a plate: the hole is a square of known corners.
TEST(Curves, OfABoxThroughASheetAreTheBoxesOutline) {
  const Mesh plate = sheet(2, 2, 4.0, 4.0),
             post = translated(box({0.5, 0.5, -1.0}, {1.25, 1.25, 1.0}), {0.0, 0.0, 0.0});
  CurvesOf both_bodies(plate, post);
  const Contact& contact = both_bodies.contact();
  ASSERT_EQ(contact.curves().size(), 1u);
  const IntersectionCurve& curve = contact.curves()[0];
  EXPECT_TRUE(curve.closed);
  Vector3d low = Vector3d::Constant(9.0), high = -low;
  for (const CurvePoint& point : curve.points) {
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
    EXPECT_EQ(point.position.z(), plate.positions(2, 0));
  }
  EXPECT_EQ(low.x(), 0.5);
  EXPECT_EQ(high.y(), 1.25);
}

TEST(Curves, AreThereOnlyWhereRequestedAndStay) {
  const Mesh a = icosphere(1), b = translated(a, {0.7, 0.1, 0.2});
  World world({.threads = 1});
  const BodyId one = world.add_body({.positions = a.positions, .facets = a.facets});
  const BodyId other = world.add_body({.positions = b.positions, .facets = b.facets});
  EXPECT_TRUE(world.detect().find_contact(one, other)->curves().empty());
  Settings settings = world.settings();
  settings.outputs.curves = true;
  world.set_settings(settings);
  const std::size_t points = world.detect().find_contact(one, other)->curves()[0].points.size();
  EXPECT_GT(points, 4u);
  EXPECT_EQ(world.detect().find_contact(one, other)->curves()[0].points.size(), points);  // nothing moved
  World restored;
  restored.restore(world.save());
  EXPECT_EQ(restored.save(), world.save());
  EXPECT_EQ(restored.detect().contacts()[0].curves()[0].points.size(), points);
  world.set_positions(other, translated(b, {0.5, 0.0, 0.0}).positions);
  EXPECT_FALSE(world.detect().find_contact(one, other)->curves().empty());
  world.set_positions(other, translated(b, {1.27, 0.0, 0.0}).positions);
  const Contact* const near = world.detect().find_contact(one, other);
  if (near != nullptr) {
    EXPECT_TRUE(near->curves().empty());
  }
  settings.outputs.curves = false;
  world.set_settings(settings);
  world.set_positions(other, b.positions);
  EXPECT_TRUE(world.detect().find_contact(one, other)->curves().empty());
}

}  // namespace
}  // namespace tact::tests
