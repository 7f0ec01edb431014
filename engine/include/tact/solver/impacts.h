// Impacts as constraints: where two features are nearest when they meet, and how fast they come near.
#pragma once

#include <tact/motion.h>
#include <tact/solver/distance.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace tact::solver {

/// Returns how fast the gap of a stencil grows if its vertices have such velocities; where they are ways, by how much
/// it grows.
inline double gap_rate(const Stencil& stencil, const Corners& velocities) {
  return stencil.normal.dot(difference(stencil, velocities));
}

/// Returns the weights of the nearest places of a stencil's two features, whole facets and edges, at positions `x`.
inline Eigen::Vector4d nearest_weights(Stencil stencil, const Corners& x) {
  Eigen::Vector4d best = Eigen::Vector4d::Zero();
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Eigen::Vector4d& weights) {
    if (const double square = (x * weights).squaredNorm(); square < least) least = square, best = weights;
  };
  const auto consider_segment = [&](int point, int from, int to, double sign) {  // `sign` is that of the point's weight
    const Eigen::Vector3d along = x.col(to) - x.col(from);
    const double square = along.squaredNorm(),
                 place = square > 0.0 ? std::clamp(along.dot(x.col(point) - x.col(from)) / square, 0.0, 1.0) : 0.0;
    Eigen::Vector4d weights = Eigen::Vector4d::Zero();
    weights[point] = sign;
    weights[from] -= sign * (1.0 - place);
    weights[to] -= sign * place;
    consider(weights);
  };
  const bool edges = stencil.kind == StencilKind::edge_edge;
  const double sign = edges || !stencil.b_first ? -1.0 : 1.0;  // of the first vertex
  if (stencil.size() == 4) {
    stencil.normal.setZero();
    const Gap gap = gap_of(stencil, x);
    const auto inside = [&](int k) { return (edges && k < 2 ? sign : -sign) * gap.weights[k] >= 0.0; };
    if (!gap.normal.isZero() && inside(1) && inside(2) && inside(3) && (!edges || inside(0))) consider(gap.weights);
  }
  for (int k = 1; k < 4 && !edges; ++k)
    consider_segment(0, std::min(k, stencil.size() - 1), k % (stencil.size() - 1) + 1, sign);
  for (int k = 0; k < 2 && edges; ++k) {
    consider_segment(k, 2, 3, sign);
    consider_segment(2 + k, 0, 1, -sign);
  }
  return best;
}

/// Returns whether an impact has to be kept from happening and has a stencil: it stops, and neither body is a plane.
inline bool is_constraint(const Impact& impact) {
  return impact.stops && impact.kind != FeaturePair::vertex_plane && impact.kind != FeaturePair::plane_vertex;
}

/// Returns the stencil of an impact at its time, as its vertices go straight by `begin` to `end`; vertices of a begin
/// at row `first_row_a`. Where features share a point the normal is across both, and the gap closes along it. Errors:
/// invalid_argument (no stencil has such vertices).
inline Stencil stencil(const Impact& impact, int first_row_a, int first_row_b,
                       const Eigen::Ref<const Eigen::Matrix3Xd>& begin, const Eigen::Ref<const Eigen::Matrix3Xd>& end) {
  Stencil result = stencil(ContactPoint{.kind = impact.kind,
                                        .a_vertices = impact.a_vertices,
                                        .b_vertices = impact.b_vertices,
                                        .a_weights = {},
                                        .b_weights = {}},
                           first_row_a, first_row_b);
  const Corners first = gather(result, begin), ways = gather(result, end) - first, x = first + impact.time * ways;
  result.weights = nearest_weights(result, x);
  const Eigen::Vector3d way = difference(result, x), velocity = difference(result, ways);
  const double size = (x.colwise() - x.col(0)).leftCols(result.size()).cwiseAbs().maxCoeff();
  // Nearer than that, rounding turns the way between two places; features that meet are 1e-6 of their way apart.
  constexpr double kNear = 1e-9;
  if (const double distance = way.norm(); distance > kNear * size) {
    result.gap = distance;
    result.normal = way / distance;
    return result;
  }
  result.normal.setZero();
  if (result.size() == 4) result.normal = gap_of(result, x).normal;
  if (result.normal.isZero()) result.normal = velocity.normalized();  // no plane is across both
  if (gap_rate(result, ways) > 0.0) result.normal *= -1.0;
  return result;
}

/// Returns the stencils of all impacts that stop, but those with planes, in their order. `begin` are the
/// vertices of all bodies where the way begins, `end` where it leads; `first_rows` holds the first row of each body by
/// BodyId::index. Errors: wrong_size.
inline std::vector<Stencil> impact_stencils(std::span<const Impact> impacts, std::span<const int> first_rows,
                                            const Eigen::Ref<const Eigen::Matrix3Xd>& begin,
                                            const Eigen::Ref<const Eigen::Matrix3Xd>& end) {
  if (begin.cols() != end.cols())
    throw Error(ErrorCode::wrong_size, "a way begins with " + std::to_string(begin.cols()) +
                                           " vertices and ends with " + std::to_string(end.cols()));
  std::vector<Stencil> result;
  for (const Impact& impact : impacts) {
    if (!is_constraint(impact)) continue;
    const auto row_of = [&](BodyId body, const std::array<int, 3>& vertices) {
      const int first = first_row(first_rows, body);
      if (first + *std::ranges::max_element(vertices) >= begin.cols())
        throw Error(ErrorCode::wrong_size, "body " + std::to_string(body.index) + " has no rows");
      return first;
    };
    result.push_back(
        stencil(impact, row_of(impact.a, impact.a_vertices), row_of(impact.b, impact.b_vertices), begin, end));
  }
  return result;
}

}  // namespace tact::solver
