// Draws stencils: of contact points, of pairs within reach, or of impacts.
#pragma once

#include <tact/debug_draw.h>
#include <tact/solver/distance.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <string>

namespace tact::solver {

/// Draws stencils where `positions` (3 x V) has their vertices: the edges of both features, a line from a to b, and the
/// normal, half as long as the features are wide. Errors: wrong_size (a vertex has no position).
inline void debug_draw(std::span<const Stencil> stencils, const Eigen::Ref<const Eigen::Matrix3Xd>& positions,
                       DebugDrawer& drawer, const DebugColor& color = DebugDrawOptions{}.point) {
  const auto has_position = [&](int vertex) { return vertex < positions.cols(); };
  for (const Stencil& one : stencils) {
    if (!std::ranges::all_of(one.vertices, has_position))
      throw Error(ErrorCode::wrong_size,
                  "a stencil has a vertex beyond the " + std::to_string(positions.cols()) + " positions");
    const Corners x = gather(one, positions);
    const auto edge = [&](int from, int to) { drawer.line(x.col(from), x.col(to), color); };
    if (one.kind == StencilKind::edge_edge) edge(0, 1), edge(2, 3);
    if (one.kind == StencilKind::point_edge) edge(1, 2);
    if (one.kind == StencilKind::point_facet) edge(1, 2), edge(2, 3), edge(3, 1);
    Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
    for (int k = 0; k < one.size(); ++k) {
      const bool of_a = one.kind == StencilKind::edge_edge ? k < 2 : (k == 0) != one.b_first;
      if (of_a) on_a -= one.weights[k] * x.col(k);
    }
    drawer.line(on_a, on_a + difference(one, x), color);
    double width = 0.0;
    for (int k = 1; k < one.size(); ++k) width = std::max(width, (x.col(k) - x.col(0)).norm());
    drawer.line(on_a, on_a + 0.5 * width * one.normal, color);
  }
}

}  // namespace tact::solver
