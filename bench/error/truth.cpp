#include "bench/error/truth.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <variant>

namespace tact::bench {
namespace {

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;
using Rational = CGAL::Exact_rational;
using Exact = CGAL::Simple_cartesian<Rational>;
using Wide3 = Eigen::Matrix<long double, 3, 1>;

struct Facet {
  Filtered::Point_3 p, q, r;
  bool has_area = false;
};

std::vector<Facet> facets_of(const TruthMesh& mesh) {
  std::vector<Facet> facets;
  for (Eigen::Index f = 0; f < mesh.facets.cols(); ++f) {
    const auto corner = [&](int row) {
      const auto p = mesh.positions.col(mesh.facets(row, f));
      return Filtered::Point_3(p.x(), p.y(), p.z());
    };
    Facet facet{corner(0), corner(1), corner(2)};
    facet.has_area = !CGAL::collinear(facet.p, facet.q, facet.r);
    facets.push_back(facet);
  }
  return facets;
}

using Figure = std::variant<Exact::Point_3, Exact::Segment_3, Exact::Triangle_3>;

// CGAL wants triangles with an area. On one line the extreme points are the least and the largest by coordinates.
Figure figure_of(const Facet& facet) {
  const auto exact = [](const Filtered::Point_3& p) {
    return Exact::Point_3(Rational(p.x()), Rational(p.y()), Rational(p.z()));
  };
  const Exact::Point_3 p = exact(facet.p), q = exact(facet.q), r = exact(facet.r);
  if (facet.has_area) return Exact::Triangle_3(p, q, r);
  const auto [low, high] = std::minmax({p, q, r});
  if (low == high) return low;
  return Exact::Segment_3(low, high);
}

bool meet(const Facet& a, const Facet& b) {
  if (a.has_area && b.has_area) {
    return CGAL::do_intersect(Filtered::Triangle_3(a.p, a.q, a.r), Filtered::Triangle_3(b.p, b.q, b.r));
  }
  return std::visit([](const auto& s, const auto& t) { return CGAL::do_intersect(s, t); }, figure_of(a), figure_of(b));
}

using FacetBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

std::vector<FacetBox> boxes_of(const std::vector<Facet>& facets) {
  std::vector<FacetBox> boxes;
  for (const Facet& f : facets) {
    boxes.emplace_back(f.p.bbox() + f.q.bbox() + f.r.bbox(), static_cast<int>(boxes.size()));
  }
  return boxes;
}

Eigen::Matrix<long double, 3, Eigen::Dynamic> used_points(const TruthMesh& mesh, const Wide3& origin) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.positions.cols()), false);
  for (const int v : mesh.facets.reshaped()) used[v] = true;
  Eigen::Matrix<long double, 3, Eigen::Dynamic> points(3, std::count(used.begin(), used.end(), true));
  Eigen::Index next = 0;
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v) {
    if (used[v]) points.col(next++) = mesh.positions.col(v).cast<long double>() - origin;
  }
  return points;
}

}  // namespace

std::vector<FacetPair> true_facet_pairs(const TruthMesh& a, const TruthMesh& b) {
  const std::vector<Facet> facets_a = facets_of(a), facets_b = facets_of(b);
  std::vector<FacetBox> boxes_a = boxes_of(facets_a), boxes_b = boxes_of(facets_b);
  std::vector<FacetPair> pairs;
  CGAL::box_intersection_d(boxes_a.begin(), boxes_a.end(), boxes_b.begin(), boxes_b.end(),
                           [&](const FacetBox& p, const FacetBox& q) {
                             const int i = p.info(), j = q.info();
                             if (meet(facets_a[i], facets_b[j])) {
                               pairs.push_back({i, j});
                             }
                           });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

SetDifference difference(const std::vector<FacetPair>& expected, const std::vector<FacetPair>& found) {
  std::vector<FacetPair> missed, wrong;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(), std::back_inserter(missed));
  std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(), std::back_inserter(wrong));
  return {static_cast<int>(missed.size()), static_cast<int>(wrong.size())};
}

TrueHeight::TrueHeight(const TruthMesh& a, const TruthMesh& b) {
  const Wide3 origin = a.positions.col(a.facets(0, 0)).cast<long double>();
  a_ = used_points(a, origin);
  b_ = used_points(b, origin);
  const Wide3 lower = a_.rowwise().minCoeff().cwiseMin(b_.rowwise().minCoeff());
  const Wide3 upper = a_.rowwise().maxCoeff().cwiseMax(b_.rowwise().maxCoeff());
  size_ = static_cast<double>((upper - lower).maxCoeff());
}

long double TrueHeight::height(const Wide3& n, const Eigen::Vector3d& shift) const {
  const long double low = (n.transpose() * b_).minCoeff() + n.dot(shift.cast<long double>());
  return ((n.transpose() * a_).maxCoeff() - low) / n.norm();
}

long double TrueHeight::operator()(const Eigen::Vector3d& n, const Eigen::Vector3d& shift) const {
  return height(n.cast<long double>(), shift);
}

bool TrueHeight::is_local_minimum(const Eigen::Vector3d& n, double tolerance, const Eigen::Vector3d& shift) const {
  constexpr int kTurns = 16;
  const Wide3 center = n.cast<long double>().normalized();
  const Wide3 u = center.unitOrthogonal(), v = center.cross(u);
  const long double allowed = height(center, shift) - static_cast<long double>(tolerance);
  long double radius = 1e-2L;
  for (int decade = 2; decade <= 7; ++decade, radius *= 0.1L) {
    for (int turn = 0; turn < kTurns; ++turn) {
      const long double angle = 2.0L * std::numbers::pi_v<long double> * turn / kTurns;
      if (height(center + radius * (std::cos(angle) * u + std::sin(angle) * v), shift) < allowed) return false;
    }
  }
  return true;
}

TruthMesh convex_hull(const TruthMesh& mesh) {
  std::vector<Filtered::Point_3> points;
  std::vector<bool> used(static_cast<std::size_t>(mesh.positions.cols()), false);
  for (const int v : mesh.facets.reshaped()) {
    if (used[v]) continue;
    used[v] = true;
    points.emplace_back(mesh.positions(0, v), mesh.positions(1, v), mesh.positions(2, v));
  }
  CGAL::Surface_mesh<Filtered::Point_3> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  TruthMesh result;
  result.positions.resize(3, static_cast<Eigen::Index>(hull.number_of_vertices()));
  result.facets.resize(3, static_cast<Eigen::Index>(hull.number_of_faces()));
  std::map<std::size_t, int> number;
  for (const auto v : hull.vertices()) {
    const int next = static_cast<int>(number.size());
    number[v] = next;
    result.positions.col(next) << hull.point(v).x(), hull.point(v).y(), hull.point(v).z();
  }
  Eigen::Index f = 0;
  for (const auto face : hull.faces()) {
    int row = 0;
    for (const auto v : hull.vertices_around_face(hull.halfedge(face))) result.facets(row++, f) = number[v];
    ++f;
  }
  return result;
}

namespace {

// An edge of a hull: its ends, and the normals of the facets beside it.
struct HullEdge {
  Wide3 from, to;
  Eigen::Vector3d left, right;
};

struct Hull {
  std::vector<Wide3> normals;  // of each facet, unit and outward
  std::vector<HullEdge> edges;
};

// The convex hull of the mesh, or of its mirror image in the origin.
Hull hull_of(const TruthMesh& mesh, long double sign) {
  const TruthMesh shape = convex_hull(mesh);
  Hull hull;
  std::map<std::pair<int, int>, std::size_t> facet_of;
  const auto point = [&](int v) -> Wide3 { return sign * shape.positions.col(v).cast<long double>(); };
  for (Eigen::Index f = 0; f < shape.facets.cols(); ++f) {
    const Eigen::Vector3i corner = shape.facets.col(f);
    const Wide3 p = point(corner[0]);
    hull.normals.push_back(sign * (point(corner[1]) - p).cross(point(corner[2]) - p).normalized());
    for (int k = 0; k < 3; ++k) facet_of[{corner[k], corner[(k + 1) % 3]}] = hull.normals.size() - 1;
  }
  for (const auto& [ends, facet] : facet_of) {
    if (ends.first > ends.second) continue;
    const Wide3 left = hull.normals[facet], right = hull.normals[facet_of.at({ends.second, ends.first})];
    hull.edges.push_back({point(ends.first), point(ends.second), left.cast<double>(), right.cast<double>()});
  }
  return hull;
}

// Can two edges span a face of the sum of their hulls, that is, do their arcs of normals cross on the sphere? Says yes
// when in doubt: a candidate too many only costs time.
bool arcs_may_cross(const HullEdge& a, const HullEdge& b) {
  constexpr double kDoubt = 1e-12;
  const auto apart = [](double s, double t) { return (s > kDoubt && t > kDoubt) || (s < -kDoubt && t < -kDoubt); };
  const Eigen::Vector3d across_a = a.left.cross(a.right);
  if (apart(across_a.dot(b.left), across_a.dot(b.right))) return false;
  const Eigen::Vector3d across_b = b.left.cross(b.right);
  if (apart(across_b.dot(a.left), across_b.dot(a.right))) return false;
  return (a.left + a.right).dot(b.left + b.right) > -kDoubt;
}

}  // namespace

MinkowskiFaces::MinkowskiFaces(const TruthMesh& a, const TruthMesh& b) {
  const TrueHeight w(a, b);
  const Hull hull_a = hull_of(a, 1.0L), hull_b = hull_of(b, -1.0L);
  const auto add = [&](const Wide3& n) { faces_.push_back({n.cast<double>(), w(n.cast<double>())}); };
  for (const Wide3& n : hull_a.normals) add(n);
  for (const Wide3& n : hull_b.normals) add(n);
  for (const HullEdge& e : hull_a.edges) {
    for (const HullEdge& f : hull_b.edges) {
      if (!arcs_may_cross(e, f)) continue;
      Wide3 n = (e.to - e.from).cross(f.to - f.from);
      if (n.norm() <= 1e-15L * (e.to - e.from).norm() * (f.to - f.from).norm()) continue;
      n.normalize();
      if (n.dot((e.left + e.right + f.left + f.right).cast<long double>()) < 0.0L) n = -n;
      // The edges span a face only if the supporting plane goes through them.
      if (w(n.cast<double>()) <= n.dot(e.from + f.from) + 1e-12L * static_cast<long double>(w.size())) add(n);
    }
  }
}

MinkowskiFaces::Smallest MinkowskiFaces::smallest(const Eigen::Vector3d& shift, double tie) const {
  const auto height = [&](const Face& f) {
    return f.height - (f.normal.cast<long double>()).dot(shift.cast<long double>());
  };
  long double least = std::numeric_limits<long double>::infinity();
  for (const Face& f : faces_) least = std::min(least, height(f));
  Smallest smallest{static_cast<double>(least), {}};
  for (const Face& f : faces_) {
    if (height(f) <= least + static_cast<long double>(tie)) smallest.directions.push_back(f.normal);
  }
  return smallest;
}

MinkowskiFaces::Nearest MinkowskiFaces::nearest(const Eigen::Vector3d& n, const Eigen::Vector3d& shift) const {
  const auto face = std::ranges::min_element(faces_, {}, [&](const Face& f) { return (f.normal - n).squaredNorm(); });
  const long double height = face->height - face->normal.cast<long double>().dot(shift.cast<long double>());
  return {face->normal, static_cast<double>(height)};
}

}  // namespace tact::bench
