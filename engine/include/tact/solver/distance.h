// The gap of a stencil with its first and second derivatives, and the mollifier of edges that are nearly parallel.
#pragma once

#include <tact/solver/stencil.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

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

/// What the gap is made of: r(t) = x (start + slope t) is the way from a place of a to one of b, and t moves the
/// places.
struct PlacesOfStencil {
  Eigen::Vector4d start = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, 2> slope = Eigen::Matrix<double, 4, 2>::Zero();
};
inline PlacesOfStencil places_of(const Stencil& stencil) {
  PlacesOfStencil places;
  if (stencil.kind == StencilKind::edge_edge) {
    places.start << -1, 0, 1, 0;
    places.slope << 1, 0, -1, 0, 0, -1, 0, 1;
  } else {
    places.start << -1, 1, 0, 0;
    if (stencil.kind != StencilKind::point_point) places.slope.col(0) << 0, -1, 1, 0;
    if (stencil.kind == StencilKind::point_facet) places.slope.col(1) << 0, -1, 0, 1;
  }
  if (stencil.b_first) places.start *= -1.0, places.slope *= -1.0;
  return places;
}

/// Returns the gap between the lines and planes of a stencil's features at positions `x`. The sign of a facet's or two
/// edges' gap is that of the side of Stencil::normal; that of other gaps stays. Features without length, area or an
/// angle between them keep normal and weights. Lengths are 1e-70 to 1e70 metres.
//
// With n the normal, w the weights at the nearest places, J = x * slope, and D its dual basis (D^T J = I, in the span
// of J):
//   d gap / d x_k = w_k n                                                   (the nearest places are stationary)
//   d2 gap / d x_k d x_l = w_k w_l P / gap - w_k v_l n^T - w_l n v_k^T - gap (v_k . v_l) n n^T,   v = D slope^T,
// P the projection onto what is perpendicular to n and J: the Schur complement of t in the Hessian of r^2 / 2, divided
// by the gap. No term of it cancels, so it is right to the angle between the columns of J, also where features touch.
inline Gap gap_of(const Stencil& stencil, const Corners& x) {
  const PlacesOfStencil places = places_of(stencil);
  const Eigen::Matrix<double, 3, 2> J = x * places.slope;
  const Eigen::Vector3d start = x * places.start, across = Eigen::Vector3d(J.col(0)).cross(Eigen::Vector3d(J.col(1)));
  Eigen::Matrix<double, 3, 2> D = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  Gap result{.normal = stencil.normal, .weights = stencil.weights};
  Eigen::Vector3d way = x * stencil.weights;
  if (stencil.size() == 4 && across.squaredNorm() > 0.0) {
    const double square = across.squaredNorm();
    D.col(0) = Eigen::Vector3d(J.col(1)).cross(across) / square;
    D.col(1) = across.cross(Eigen::Vector3d(J.col(0))) / square;
    result.weights = places.start - places.slope * (D.transpose() * start);
    result.normal = (across.dot(stencil.normal) < 0.0 ? -1.0 : 1.0) / std::sqrt(square) * across;
    way = start;
  } else if (stencil.size() < 4) {
    const double square = J.col(0).squaredNorm();
    if (square > 0.0) D.col(0) = J.col(0) / square;
    if (square > 0.0 || stencil.size() == 2) result.weights = places.start - places.slope * (D.transpose() * start);
    way = x * result.weights;
    if (way.squaredNorm() > 0.0) result.normal = (stencil.gap < 0.0 ? -1.0 : 1.0) * way.normalized();
    P = Eigen::Matrix3d::Identity() - result.normal * result.normal.transpose();
    if (square > 0.0) P -= J.col(0) * D.col(0).transpose();
  }
  const Eigen::Vector3d n = result.normal;
  const Eigen::Vector4d w = result.weights;
  const double gap = n.dot(way);
  const Corners v = D * places.slope.transpose();
  result.distance.value = gap;
  for (int k = 0; k < stencil.size(); ++k) {
    result.distance.gradient.segment<3>(3 * k) = w[k] * n;
    for (int l = 0; l < stencil.size(); ++l)
      result.distance.hessian.block<3, 3>(3 * k, 3 * l) =
          (gap != 0.0 ? w[k] * w[l] / gap : 0.0) * P - w[k] * v.col(l) * n.transpose() -
          w[l] * n * v.col(k).transpose() - gap * v.col(k).dot(v.col(l)) * n * n.transpose();
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
  Eigen::Matrix<double, 6, 1> gradient;
  gradient << 2.0 * v.cross(c), 2.0 * c.cross(u);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 6, 6> hessian;
  hessian.topLeftCorner<3, 3>() = 2.0 * (v.squaredNorm() * one - v * v.transpose());
  hessian.bottomRightCorner<3, 3>() = 2.0 * (u.squaredNorm() * one - u * u.transpose());
  hessian.topRightCorner<3, 3>() = 2.0 * (2.0 * u * v.transpose() - v * u.transpose() - u.dot(v) * one);
  hessian.bottomLeftCorner<3, 3>() = hessian.topRightCorner<3, 3>().transpose();
  const double part = sine / threshold, first = 2.0 * (1.0 - part) / threshold;
  hessian = (first * hessian - 2.0 / (threshold * threshold) * gradient * gradient.transpose()).eval();
  gradient *= first;
  Eigen::Matrix<double, 6, 12> edges = Eigen::Matrix<double, 6, 12>::Zero();
  edges.block<3, 3>(0, 0) = edges.block<3, 3>(3, 6) = -one;
  edges.block<3, 3>(0, 3) = edges.block<3, 3>(3, 9) = one;
  result.value = part * (2.0 - part);
  result.gradient = edges.transpose() * gradient;
  result.hessian = edges.transpose() * hessian * edges;
  return result;
}

}  // namespace tact::solver
