// The gap of a stencil with its first and second derivatives, and the mollifier of edges that are nearly parallel.
#pragma once

#include <tact/solver/stencil.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>

namespace tact::solver {

/// A number with its derivatives by the vertices of a stencil.
struct Term {
  double value = 0.0;
  Vector12d gradient = Vector12d::Zero();
  Matrix12d hessian = Matrix12d::Zero();
};

/// The gap of a stencil at some positions.
struct Gap {
  Term distance = {};                                 ///< metres; the sign is that of Stencil::gap
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< unit vector from a to b
  Eigen::Vector4d weights = Eigen::Vector4d::Zero();  ///< of the nearest places, as in Stencil
};

/// What the gap is made of: r(t) = x (start + first t_1 + second t_2) is the way from a place of a to one of b, and t
/// moves the places.
struct PlacesOfStencil {
  Eigen::Vector4d start = Eigen::Vector4d::Zero(), first = Eigen::Vector4d::Zero(), second = Eigen::Vector4d::Zero();
};
inline PlacesOfStencil places_of(const Stencil& stencil) {
  const double sign = stencil.b_first ? -1.0 : 1.0;
  if (stencil.kind == StencilKind::edge_edge)
    return {.start = {-1, 0, 1, 0}, .first = {1, -1, 0, 0}, .second = {0, 0, -1, 1}};
  PlacesOfStencil places{.start = {-sign, sign, 0, 0}};
  if (stencil.kind != StencilKind::point_point) places.first = {0, -sign, sign, 0};
  if (stencil.kind == StencilKind::point_facet) places.second = {0, -sign, 0, sign};
  return places;
}

/// The difference of two columns: `value` rounded, and `rest` what that left.
struct ExactDifference {
  Eigen::Vector3d value = Eigen::Vector3d::Zero(), rest = Eigen::Vector3d::Zero();
};
/// Returns the column of `x` whose sign is 1 minus that whose sign is -1, exactly; zero if there are none. (D. Knuth,
/// The Art of Computer Programming, 4.2.2.)
inline ExactDifference exact_difference(const Corners& x, const Eigen::Vector4d& signs) {
  ExactDifference result;
  int plus = 0, minus = 0;
  for (int k = 0; k < 4; ++k) {
    if (signs[k] > 0.0) plus = k;
    if (signs[k] < 0.0) minus = k;
  }
  for (int i = 0; i < 3; ++i) {
    const double a = x(i, plus), b = x(i, minus), difference = a - b, back = difference - a;
    result.value[i] = difference;
    result.rest[i] = (a - (difference - back)) - (b + back);
  }
  return result;
}

/// Returns the cross product of two exact differences, right to some roundings of itself also where they are parallel
/// to a millionth: there a plain one is right to a ten-billionth, and weights to 1e-4.
inline Eigen::Vector3d cross(const ExactDifference& p, const ExactDifference& q) {
  Eigen::Vector3d result;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double first = p.value[j] * q.value[k], second = p.value[k] * q.value[j];
    const double rest = std::fma(p.value[j], q.value[k], -first) - std::fma(p.value[k], q.value[j], -second);
    result[i] = (first - second) + (rest + ((p.rest[j] * q.value[k] + p.value[j] * q.rest[k]) -
                                            (p.rest[k] * q.value[j] + p.value[k] * q.rest[j])));
  }
  return result;
}

/// Returns the gap between the lines and planes of a stencil's features at positions `x`. The sign of a facet's or two
/// edges' gap is that of the side of Stencil::normal; that of other gaps stays. Features without length, area or an
/// angle between them keep normal and weights. Lengths are 1e-70 to 1e70 metres.
//
// With n the normal, w the weights at the nearest places, J = x (first, second), and D its dual basis (D^T J = I, in
// the span of J):
//   d gap / d x_k = w_k n                                                   (the nearest places are stationary)
//   d2 gap / d x_k d x_l = w_k w_l P / gap - w_k v_l n^T - w_l n v_k^T - gap (v_k . v_l) n n^T,
//   v = D (first, second)^T,
// P the projection onto what is perpendicular to n and J: the Schur complement of t in the Hessian of r^2 / 2, divided
// by the gap. No term of it cancels, so it is right to the angle between the columns of J, also where features touch.
// Matrices are written out in loops: a matrix expression costs each source that includes this a tenth of a second.
inline Gap gap_of(const Stencil& stencil, const Corners& x) {
  const PlacesOfStencil places = places_of(stencil);
  const ExactDifference exact_first = exact_difference(x, places.first),
                        exact_second = exact_difference(x, places.second);
  const Eigen::Vector3d &first = exact_first.value, &second = exact_second.value, start = x * places.start,
                        across = cross(exact_first, exact_second);
  Eigen::Vector3d of_first = Eigen::Vector3d::Zero(), of_second = Eigen::Vector3d::Zero();  // D
  Gap result{.normal = stencil.normal, .weights = stencil.weights};
  Eigen::Vector3d way = x * stencil.weights;
  if (const double square = across.squaredNorm(); stencil.size() == 4 && square > 0.0) {
    of_first = second.cross(across) / square;
    of_second = across.cross(first) / square;
    result.weights = places.start - of_first.dot(start) * places.first - of_second.dot(start) * places.second;
    result.normal = (across.dot(stencil.normal) < 0.0 ? -1.0 : 1.0) / std::sqrt(square) * across;
    way = start;
  } else if (stencil.size() < 4) {
    const double length_squared = first.squaredNorm();
    if (length_squared > 0.0) of_first = first / length_squared;
    if (length_squared > 0.0 || stencil.size() == 2) result.weights = places.start - of_first.dot(start) * places.first;
    way = x * result.weights;
    if (const double length = way.norm(); length > 0.0) result.normal = (stencil.gap < 0.0 ? -1.0 : 1.0) / length * way;
  }
  const Eigen::Vector3d n = result.normal;
  const Eigen::Vector4d w = result.weights;
  const double gap = n.dot(way), curvature = stencil.size() < 4 && gap != 0.0 ? 1.0 / gap : 0.0;
  result.distance.value = gap;
  for (int k = 0; k < stencil.size(); ++k) {
    const Eigen::Vector3d v_k = places.first[k] * of_first + places.second[k] * of_second;
    for (int i = 0; i < 3; ++i) result.distance.gradient[3 * k + i] = w[k] * n[i];
    for (int l = 0; l < stencil.size(); ++l) {
      const Eigen::Vector3d v_l = places.first[l] * of_first + places.second[l] * of_second;
      const double both = curvature * w[k] * w[l], along = gap * v_k.dot(v_l);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          result.distance.hessian(3 * k + i, 3 * l + j) =
              both * ((i == j ? 1.0 : 0.0) - n[i] * n[j] - first[i] * of_first[j]) - w[k] * v_l[i] * n[j] -
              w[l] * n[i] * v_k[j] - along * n[i] * n[j];
    }
  }
  return result;
}

/// Returns the squared sine below which edges count as nearly parallel, times their squared lengths at rest: the
/// `threshold` of edge_mollifier(), after Li et al., Incremental Potential Contact, 2020, section 6.
inline double mollifier_threshold(const Corners& rest) {
  return 1e-3 * (rest.col(1) - rest.col(0)).squaredNorm() * (rest.col(3) - rest.col(2)).squaredNorm();
}

/// Returns the factor of two edges' potential that falls smoothly to 0 where they are parallel: 1 where |u x v|^2 is at
/// least `threshold`, and for all other kinds. (Li et al. 2020, equation 24.)
inline Term edge_mollifier(const Stencil& stencil, const Corners& x, double threshold) {
  Term result{.value = 1.0};
  if (stencil.kind != StencilKind::edge_edge) return result;
  const Eigen::Vector3d u = x.col(1) - x.col(0), v = x.col(3) - x.col(2), c = u.cross(v);
  const double sine = c.squaredNorm();
  if (!(sine < threshold)) return result;
  const double part = sine / threshold, first = 2.0 * (1.0 - part) / threshold, second = 2.0 / (threshold * threshold);
  const std::array<Eigen::Vector3d, 2> edge{u, v}, by_edge{2.0 * v.cross(c), 2.0 * c.cross(u)};
  // Of |u x v|^2 by edges e and f.
  const auto by_edges = [&](std::size_t e, std::size_t f, int i, int j) {
    const Eigen::Vector3d &p = edge[e], &q = edge[f];
    if (e != f) return 2.0 * (2.0 * p[i] * q[j] - q[i] * p[j] - (i == j ? u.dot(v) : 0.0));
    const Eigen::Vector3d& other = edge[1 - e];
    return 2.0 * ((i == j ? other.squaredNorm() : 0.0) - other[i] * other[j]);
  };
  result.value = part * (2.0 - part);
  for (int row = 0; row < 12; ++row) {
    const int k = row / 3, i = row % 3;
    const auto e = static_cast<std::size_t>(k / 2);
    const double sign = k % 2 == 0 ? -1.0 : 1.0, slope = sign * by_edge[e][i];
    result.gradient[row] = first * slope;
    for (int column = 0; column < 12; ++column) {
      const int l = column / 3, j = column % 3;
      const auto f = static_cast<std::size_t>(l / 2);
      const double other = l % 2 == 0 ? -1.0 : 1.0;
      result.hessian(row, column) =
          sign * other * first * by_edges(e, f, i, j) - second * slope * other * by_edge[f][j];
    }
  }
  return result;
}

}  // namespace tact::solver
