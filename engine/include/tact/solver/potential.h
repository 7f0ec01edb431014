// Potentials of a gap: barrier and penalty, with their derivatives.
#pragma once

#include <tact/solver/distance.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace tact::solver {

/// A function of the gap with its derivatives.
struct Potential {
  double value = 0.0;   ///< square metres
  double first = 0.0;   ///< metres
  double second = 0.0;  ///< a number
};

/// Returns -(gap - reach)^2 ln(gap / reach), the clamped logarithm of Li et al., Incremental Potential Contact, 2020,
/// equation 6; 0 from `reach` metres on, infinity where the gap is not positive.
inline Potential barrier(double gap, double reach) {
  if (!(gap < reach)) return {};
  if (!(gap > 0.0)) return {.value = std::numeric_limits<double>::infinity()};
  const double t = gap - reach, logarithm = std::log(gap / reach);
  return {.value = -t * t * logarithm,
          .first = -t * (2.0 * logarithm + t / gap),
          .second = -2.0 * logarithm - 4.0 * t / gap + t * t / (gap * gap)};
}

/// Returns (reach - gap)^2 / 2, or 0 from `reach` metres on; gaps may be negative.
inline Potential penalty(double gap, double reach) {
  if (!(gap < reach)) return {};
  return {.value = 0.5 * (reach - gap) * (reach - gap), .first = gap - reach, .second = 1.0};
}

/// Returns a potential of the gap as a function of the vertices.
inline Term chain(const Potential& potential, const Term& gap) {
  return {.value = potential.value,
          .gradient = potential.first * gap.gradient,
          .hessian = potential.second * gap.gradient * gap.gradient.transpose() + potential.first * gap.hessian};
}

/// Returns the product of two terms of one stencil.
inline Term product(const Term& f, const Term& g) {
  const Matrix12d mixed = f.gradient * g.gradient.transpose();
  return {.value = f.value * g.value,
          .gradient = f.value * g.gradient + g.value * f.gradient,
          .hessian = f.value * g.hessian + g.value * f.hessian + mixed + mixed.transpose()};
}

/// Returns the barrier of a stencil's gap at positions `x`; with a `threshold` of mollifier_threshold() times
/// edge_mollifier() where it is finite. Multiply it by a stiffness, and by area_weight() where meshes differ in size.
inline Term barrier_term(const Stencil& stencil, const Corners& x, double reach, double threshold = 0.0) {
  const Gap gap = gap_of(stencil, x);
  const Term term = chain(barrier(gap.distance.value, reach), gap.distance);
  const bool has_factor = threshold > 0.0 && term.value > 0.0 && std::isfinite(term.value);
  return has_factor ? product(edge_mollifier(stencil, x, threshold), term) : term;
}

/// Returns the penalty of a stencil's gap at positions `x`. Multiply it by a stiffness in N/m.
inline Term penalty_term(const Stencil& stencil, const Corners& x, double reach) {
  const Gap gap = gap_of(stencil, x);
  return chain(penalty(gap.distance.value, reach), gap.distance);
}

}  // namespace tact::solver
