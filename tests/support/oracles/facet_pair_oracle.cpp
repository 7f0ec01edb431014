#include "tests/support/oracles/facet_pair_oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "tests/support/oracles/triangle_oracle.h"

namespace tact::tests {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Shape = std::variant<Triangle, Segment, Point>;

Shape shape_of(const Mesh& mesh, int facet) {
  const auto corner = [&](int row) {
    const Vec3 p = mesh.position(mesh.facets(row, facet));
    return Point(p.x, p.y, p.z);
  };
  const Point p = corner(0), q = corner(1), r = corner(2);
  if (!CGAL::collinear(p, q, r)) return Triangle(p, q, r);
  // On one line the extreme points are the least and the largest by coordinates.
  const auto [low, high] = std::minmax({p, q, r});
  if (low == high) return low;
  return Segment(low, high);
}

bool meet(const Triangle& a, const Triangle& b) { return CGAL::do_intersect(a, b); }
bool meet(const Triangle& a, const Segment& b) { return CGAL::do_intersect(a, b); }
bool meet(const Triangle& a, const Point& b) { return a.has_on(b); }
bool meet(const Segment& a, const Triangle& b) { return meet(b, a); }
bool meet(const Segment& a, const Segment& b) { return CGAL::do_intersect(a, b); }
bool meet(const Segment& a, const Point& b) { return a.has_on(b); }
bool meet(const Point& a, const Triangle& b) { return meet(b, a); }
bool meet(const Point& a, const Segment& b) { return meet(b, a); }
bool meet(const Point& a, const Point& b) { return a == b; }

bool meet(const Shape& a, const Shape& b) {
  return std::visit([](const auto& s, const auto& t) { return meet(s, t); }, a, b);
}

std::vector<Shape> shapes_of(const Mesh& mesh) {
  std::vector<Shape> shapes;
  for (int f = 0; f < mesh.facet_count(); ++f) shapes.push_back(shape_of(mesh, f));
  return shapes;
}

// A facet of one of many bodies.
struct FacetOfBody {
  int body;
  int facet;
};

using FacetBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, FacetOfBody>;

std::vector<FacetBox> boxes_of(const Mesh& mesh, int body) {
  std::vector<FacetBox> boxes;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    double low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto corner = [&](int row) { return mesh.positions(axis, mesh.facets(row, f)); };
      std::tie(low[axis], high[axis]) = std::minmax({corner(0), corner(1), corner(2)});
    }
    boxes.emplace_back(low, high, FacetOfBody{body, f});
  }
  return boxes;
}

}  // namespace

std::vector<FacetPair> facet_pairs_by_oracle(const Mesh& a, const Mesh& b) {
  const std::vector<Shape> shapes_a = shapes_of(a), shapes_b = shapes_of(b);
  std::vector<FacetBox> boxes_a = boxes_of(a, 0), boxes_b = boxes_of(b, 1);
  std::vector<FacetPair> pairs;
  const auto test = [&](const FacetBox& box_a, const FacetBox& box_b) {
    const int f = box_a.info().facet, g = box_b.info().facet;
    if (meet(shapes_a[f], shapes_b[g])) pairs.push_back({f, g});
  };
  CGAL::box_intersection_d(boxes_a.begin(), boxes_a.end(), boxes_b.begin(), boxes_b.end(), test);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

namespace {

// A facet's vertices, those first that another one names, too.
struct WithCommonFirst {
  std::vector<int> vertices;
  int common = 0;

  WithCommonFirst(const Mesh& mesh, int facet, int other) {
    const auto f = mesh.facets.col(facet), g = mesh.facets.col(other);
    std::vector<int> rest(f.begin(), f.end());
    std::vector<int> shared(g.begin(), g.end());
    std::ranges::sort(shared);
    shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
    for (const int v : shared) {
      const auto same = std::ranges::find(rest, v);
      if (same == rest.end()) continue;
      vertices.push_back(v);
      rest.erase(same);
      ++common;
    }
    vertices.insert(vertices.end(), rest.begin(), rest.end());
  }
};

Point point_of(const Mesh& mesh, int vertex) {
  const Vec3 p = mesh.position(vertex);
  return {p.x, p.y, p.z};
}

// Of facets that name common vertices.
bool meet_beyond_common(const Mesh& mesh, const WithCommonFirst& f, const WithCommonFirst& g) {
  const auto points = [&](const WithCommonFirst& one) {
    return std::array{point_of(mesh, one.vertices[0]), point_of(mesh, one.vertices[1]),
                      point_of(mesh, one.vertices[2])};
  };
  const auto p = points(f), q = points(g);
  if (CGAL::collinear(p[0], p[1], p[2]) || CGAL::collinear(q[0], q[1], q[2])) {
    const auto triangle = [&](const WithCommonFirst& one) {
      return narrowphase::Triangle{mesh.position(one.vertices[0]), mesh.position(one.vertices[1]),
                                   mesh.position(one.vertices[2])};
    };
    return rational_meet_beyond(triangle(f), triangle(g), f.common);
  }
  if (f.common == 1)
    return CGAL::do_intersect(Segment(p[1], p[2]), Triangle(q[0], q[1], q[2])) ||
           CGAL::do_intersect(Segment(q[1], q[2]), Triangle(p[0], p[1], p[2]));
  if (f.common == 2)
    return CGAL::coplanar(p[0], p[1], p[2], q[2]) &&
           CGAL::coplanar_orientation(p[0], p[1], p[2], q[2]) == CGAL::POSITIVE;
  return true;
}

}  // namespace

std::vector<FacetPair> self_facet_pairs_by_oracle(const Mesh& mesh) {
  std::vector<FacetPair> pairs = facet_pairs_by_oracle(mesh, mesh);
  std::erase_if(pairs, [&](const FacetPair& pair) {
    if (pair.b <= pair.a) return true;
    const WithCommonFirst f(mesh, pair.a, pair.b), g(mesh, pair.b, pair.a);
    return f.common > 0 && !meet_beyond_common(mesh, f, g);
  });
  return pairs;
}

std::optional<std::vector<FacetPair>> self_facet_pairs_by_cgal(const Mesh& mesh) {
  CGAL::Surface_mesh<Point> surface;
  std::vector<CGAL::SM_Vertex_index> vertices;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.position(v);
    vertices.push_back(surface.add_vertex(Point(p.x, p.y, p.z)));
  }
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const auto vertex = [&](int row) { return vertices[mesh.facets(row, f)]; };
    if (shape_of(mesh, f).index() != 0) return {};
    if (surface.add_face(vertex(0), vertex(1), vertex(2)) == surface.null_face()) return {};
  }
  std::vector<std::pair<CGAL::SM_Face_index, CGAL::SM_Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
  std::vector<FacetPair> pairs;
  for (const auto& [f, g] : found) {
    const auto [low, high] = std::minmax({static_cast<int>(f), static_cast<int>(g)});
    pairs.push_back({low, high});
  }
  std::ranges::sort(pairs);
  return pairs;
}

std::vector<FacetPair> facet_pairs_by_brute_force(const Mesh& a, const Mesh& b) {
  const auto triangle = [](const Mesh& mesh, int f) {
    return narrowphase::Triangle{mesh.position(mesh.facets(0, f)), mesh.position(mesh.facets(1, f)),
                                 mesh.position(mesh.facets(2, f))};
  };
  std::vector<FacetPair> pairs;
  for (int f = 0; f < a.facet_count(); ++f) {
    for (int g = 0; g < b.facet_count(); ++g) {
      if (cgal_meet(triangle(a, f), triangle(b, g))) pairs.push_back({f, g});
    }
  }
  return pairs;
}

std::vector<MeetingBodies> meeting_bodies_by_oracle(std::span<const Mesh> bodies) {
  std::vector<std::vector<Shape>> shapes;
  std::vector<FacetBox> boxes;
  for (const Mesh& body : bodies) {
    const std::vector<FacetBox> more = boxes_of(body, static_cast<int>(shapes.size()));
    boxes.insert(boxes.end(), more.begin(), more.end());
    shapes.push_back(shapes_of(body));
  }
  const auto shape = [&](FacetOfBody f) -> const Shape& { return shapes[f.body][f.facet]; };
  std::map<std::pair<int, int>, std::vector<FacetPair>> found;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const FacetBox& one, const FacetBox& other) {
    const bool ordered = one.info().body < other.info().body;
    const FacetOfBody f = ordered ? one.info() : other.info(), g = ordered ? other.info() : one.info();
    if (f.body != g.body && meet(shape(f), shape(g))) found[{f.body, g.body}].push_back({f.facet, g.facet});
  });
  std::vector<MeetingBodies> result;
  for (auto& [pair, facet_pairs] : found) {
    std::sort(facet_pairs.begin(), facet_pairs.end());
    result.push_back({pair.first, pair.second, std::move(facet_pairs)});
  }
  return result;
}

}  // namespace tact::tests
