// Stencils of pairs within reach: what a barrier is summed over, so that it changes smoothly as bodies slide.
#pragma once

#include <tact/solver/potential.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

namespace tact::solver {

/// A pair within reach, and how it depends on its vertices.
struct ReachStencil {
  Stencil whole;    ///< all vertices of both features: what edge_mollifier() depends on
  Stencil closest;  ///< those of the closest features alone: what gap and friction depend on
};

/// Returns the stencil of a pair; vertex v of body a is row `first_row_a` + v of the system. Errors: invalid_argument
/// (no pair has such vertices).
inline ReachStencil stencil(const ReachPair& pair, int first_row_a, int first_row_b) {
  ContactPoint whole{.kind = pair.kind,
                     .a_vertices = pair.a_vertices,
                     .b_vertices = pair.b_vertices,
                     .a_weights = pair.a_weights,
                     .b_weights = pair.b_weights,
                     .normal = {pair.normal[0], pair.normal[1], pair.normal[2]},
                     .gap = pair.distance},
      closest = whole;
  const auto keep_closest = [](std::array<int, 3>& vertices, std::array<double, 3>& weights) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(weights[k] > 0.0)) continue;
      vertices[count] = vertices[k];
      weights[count++] = weights[k];
    }
    std::fill(vertices.begin() + static_cast<std::ptrdiff_t>(count), vertices.end(), -1);
    std::fill(weights.begin() + static_cast<std::ptrdiff_t>(count), weights.end(), 0.0);
  };
  keep_closest(closest.a_vertices, closest.a_weights);
  keep_closest(closest.b_vertices, closest.b_weights);
  return {stencil(whole, first_row_a, first_row_b), stencil(closest, first_row_a, first_row_b)};
}

/// Returns the stencils of all pairs within reach of a report, in its order; see first_row(). Errors:
/// wrong_size (a body has no first row).
inline std::vector<ReachStencil> stencils_within_reach(const Report& report, std::span<const int> first_rows) {
  std::vector<ReachStencil> result;
  for (const Contact& contact : report.contacts()) {
    for (const ReachPair& pair : contact.within_reach())
      result.push_back(stencil(pair, first_row(first_rows, contact.a), first_row(first_rows, contact.b)));
  }
  return result;
}

/// Returns a term of the closest features as one of all vertices of both.
inline Term widened(const ReachStencil& pair, const Term& term) {
  const auto place = [&](int k) {
    const auto found = std::ranges::find(pair.whole.vertices, pair.closest.vertices[static_cast<std::size_t>(k)]);
    return static_cast<Eigen::Index>(found - pair.whole.vertices.begin());
  };
  Term result{.value = term.value};
  for (int k = 0; k < pair.closest.size(); ++k) {
    result.gradient.segment<3>(3 * place(k)) = term.gradient.segment<3>(3 * k);
    for (int l = 0; l < pair.closest.size(); ++l)
      result.hessian.block<3, 3>(3 * place(k), 3 * place(l)) = term.hessian.block<3, 3>(3 * k, 3 * l);
  }
  return result;
}

/// Returns the barrier of a pair's distance at positions `x` (3 x V), a term of its `whole` stencil; with a `threshold`
/// of mollifier_threshold() times edge_mollifier() where it is finite. It is that of the closest features the pair had.
inline Term barrier_term(const ReachStencil& pair, const Eigen::Ref<const Eigen::Matrix3Xd>& x, double reach,
                         double threshold = 0.0) {
  const Term term = widened(pair, barrier_term(pair.closest, gather(pair.closest, x), reach));
  const bool has_factor = threshold > 0.0 && term.value > 0.0 && std::isfinite(term.value);
  return has_factor ? product(edge_mollifier(pair.whole, gather(pair.whole, x), threshold), term) : term;
}

}  // namespace tact::solver
