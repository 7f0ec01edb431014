// The vertices that a contact point moves, numbered as in the program's system.
#pragma once

#include <tact/report.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace tact::solver {

using Corners = Eigen::Matrix<double, 3, 4>;     ///< of a stencil, a column a vertex; unused columns are zero
using Vector12d = Eigen::Matrix<double, 12, 1>;  ///< three numbers a vertex of a stencil
using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// The features that a stencil joins, in the order of its vertices.
enum class StencilKind {
  point_point,  ///< two vertices
  point_edge,   ///< a vertex, then two of an edge
  point_facet,  ///< a vertex, then three of a facet
  edge_edge,    ///< two of an edge of a, then two of an edge of b
};

/// The vertices of a contact point and how it depends on them.
struct Stencil {
  StencilKind kind = StencilKind::point_point;  ///< the features that it joins
  bool b_first = false;                         ///< whether its first vertex is of body b, not of a
  std::array<int, 4> vertices{-1, -1, -1, -1};  ///< rows of the program's system; -1 fills up
  /// Weights of the vertices, those of body a negative: the weighted sum of positions leads from a to b.
  Eigen::Vector4d weights = Eigen::Vector4d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector from a to b
  double gap = 0.0;                                  ///< metres; negative where the surfaces have crossed
  std::uint64_t id = 0;                              ///< that of the contact point

  /// Returns the number of vertices, 2 to 4.
  int size() const { return kind == StencilKind::point_point ? 2 : kind == StencilKind::point_edge ? 3 : 4; }
};

/// Returns the stencil of a point; vertex v of body a is row `first_row_a` + v of the system. Errors: invalid_argument
/// (no contact point has such vertices).
inline Stencil stencil(const ContactPoint& point, int first_row_a, int first_row_b) {
  const auto count = [](const std::array<int, 3>& vertices) { return 3 - std::ranges::count(vertices, -1); };
  const auto count_a = count(point.a_vertices), count_b = count(point.b_vertices);
  Stencil result{.normal = point.normal, .gap = point.gap, .id = point.id};
  if (count_a == 2 && count_b == 2)
    result.kind = StencilKind::edge_edge;
  else if (count_a > 0 && count_b > 0 && std::min(count_a, count_b) == 1)
    result.kind = static_cast<StencilKind>(std::max(count_a, count_b) - 1);
  else
    throw Error(ErrorCode::invalid_argument, "a contact point joins " + std::to_string(count_a) + " vertices with " +
                                                 std::to_string(count_b) + ", which is no stencil");
  result.b_first = count_a > count_b;
  std::size_t place = 0;
  const auto add = [&](const std::array<int, 3>& vertices, const std::array<double, 3>& weights, int row, double sign) {
    for (std::size_t k = 0; k < 3 && vertices[k] >= 0; ++k, ++place) {
      result.vertices[place] = row + vertices[k];
      result.weights[static_cast<Eigen::Index>(place)] = sign * weights[k];
    }
  };
  if (result.b_first) add(point.b_vertices, point.b_weights, first_row_b, 1.0);
  add(point.a_vertices, point.a_weights, first_row_a, -1.0);
  if (!result.b_first) add(point.b_vertices, point.b_weights, first_row_b, 1.0);
  return result;
}

/// Returns the first row of a body; `first_rows` holds that of each by BodyId::index, or a negative number for one that
/// has none. Errors: wrong_size (it has none).
inline int first_row(std::span<const int> first_rows, BodyId body) {
  if (body.index >= first_rows.size() || first_rows[body.index] < 0)
    throw Error(ErrorCode::wrong_size, "body " + std::to_string(body.index) + " has no first row");
  return first_rows[body.index];
}

/// Returns the stencils of all points of a report but those with planes, in its order; see first_row(). Errors:
/// wrong_size (a body has no first row).
inline std::vector<Stencil> stencils(const Report& report, std::span<const int> first_rows) {
  std::vector<Stencil> result;
  for (const Contact& contact : report.contacts()) {
    for (const ContactPoint& point : contact.points()) {
      if (point.kind == FeaturePair::vertex_plane || point.kind == FeaturePair::plane_vertex) continue;
      result.push_back(stencil(point, first_row(first_rows, contact.a), first_row(first_rows, contact.b)));
    }
  }
  return result;
}

/// Returns the columns of `values` (3 x V: positions, velocities) that belong to the vertices of a stencil.
inline Corners gather(const Stencil& stencil, const Eigen::Ref<const Eigen::Matrix3Xd>& values) {
  Corners corners = Corners::Zero();
  for (int k = 0; k < stencil.size(); ++k) corners.col(k) = values.col(stencil.vertices[static_cast<std::size_t>(k)]);
  return corners;
}

/// Returns the value at the point of b minus that at the point of a: the way between them, or their relative velocity.
inline Eigen::Vector3d difference(const Stencil& stencil, const Corners& values) { return values * stencil.weights; }

/// Returns the mass that resists a push along any direction at the point, kg; infinity if no vertex moves. Vertices
/// from `inverse_masses.size()` on do not move.
inline double effective_mass(const Stencil& stencil, std::span<const double> inverse_masses) {
  double inverse = 0.0;
  for (int k = 0; k < stencil.size(); ++k) {
    const auto vertex = static_cast<std::size_t>(stencil.vertices[static_cast<std::size_t>(k)]);
    if (vertex < inverse_masses.size()) inverse += stencil.weights[k] * stencil.weights[k] * inverse_masses[vertex];
  }
  return inverse > 0.0 ? 1.0 / inverse : std::numeric_limits<double>::infinity();
}

/// Adds what an impulse on b, and the opposite on a, does to the vertices: each moves by its weight over its mass.
/// `values` are velocities, or positions in position-based dynamics.
inline void push(const Stencil& stencil, const Eigen::Vector3d& impulse, std::span<const double> inverse_masses,
                 Eigen::Ref<Eigen::Matrix3Xd> values) {
  for (int k = 0; k < stencil.size(); ++k) {
    const auto vertex = static_cast<std::size_t>(stencil.vertices[static_cast<std::size_t>(k)]);
    if (vertex < inverse_masses.size())
      values.col(static_cast<Eigen::Index>(vertex)) += stencil.weights[k] * inverse_masses[vertex] * impulse;
  }
}

/// Returns the area of each vertex, a third of that of its facets; square metres.
inline Eigen::VectorXd vertex_areas(const Eigen::Ref<const Eigen::Matrix3Xd>& positions,
                                    const Eigen::Ref<const Eigen::Matrix3Xi>& facets) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(positions.cols());
  for (Eigen::Index f = 0; f < facets.cols(); ++f) {
    const Eigen::Vector3d p = positions.col(facets(0, f)), q = positions.col(facets(1, f));
    const double third = (q - p).cross(positions.col(facets(2, f)) - p).norm() / 6.0;
    for (Eigen::Index k = 0; k < 3; ++k) areas[facets(k, f)] += third;
  }
  return areas;
}

/// Returns the area that a stencil stands for: that of its first vertex, or, of two edges, the geometric mean of the
/// areas at their places; square metres. Crossings of two meshes are as dense as the product of their edge lengths an
/// area.
inline double area_weight(const Stencil& stencil, const Eigen::Ref<const Eigen::VectorXd>& areas) {
  if (stencil.kind != StencilKind::edge_edge) return areas[stencil.vertices[0]];
  const auto side = [&](Eigen::Index k) {
    const auto first = static_cast<std::size_t>(k);
    return std::abs(stencil.weights[k] * areas[stencil.vertices[first]] +
                    stencil.weights[k + 1] * areas[stencil.vertices[first + 1]]);
  };
  return std::sqrt(side(0) * side(2));
}

}  // namespace tact::solver
