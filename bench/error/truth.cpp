#include "bench/error/truth.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/eigen_vectors.h"

namespace tact::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Wide3 = Eigen::Matrix<long double, 3, 1>;

}  // namespace

SetDifference difference(const std::vector<FacetPair>& expected, const std::vector<FacetPair>& found) {
  std::vector<FacetPair> missed, wrong;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(), std::back_inserter(missed));
  std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(), std::back_inserter(wrong));
  return {static_cast<int>(missed.size()), static_cast<int>(wrong.size())};
}

MinkowskiHeight height_of(const Mesh& a, const Mesh& b) { return {tests::used_points(a), tests::used_points(b)}; }

Mesh convex_hull(const Mesh& mesh) {
  std::vector<Kernel::Point_3> points;
  std::vector<bool> used(static_cast<std::size_t>(mesh.positions.cols()), false);
  for (const int v : mesh.facets.reshaped()) {
    if (used[v]) continue;
    used[v] = true;
    points.emplace_back(mesh.positions(0, v), mesh.positions(1, v), mesh.positions(2, v));
  }
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  Mesh result;
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
Hull hull_of(const Mesh& mesh, long double sign) {
  const Mesh shape = convex_hull(mesh);
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

MinkowskiFaces::MinkowskiFaces(const Mesh& a, const Mesh& b) {
  const MinkowskiHeight w = height_of(a, b);
  const auto size = static_cast<long double>(w.size());
  const Hull hull_a = hull_of(a, 1.0L), hull_b = hull_of(b, -1.0L);
  const auto add = [&](const Wide3& n) { faces_.push_back({n.cast<double>(), w(from_eigen(n.cast<double>()))}); };
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
      if (w(from_eigen(n.cast<double>())) <= n.dot(e.from + f.from) + 1e-12L * size) add(n);
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
