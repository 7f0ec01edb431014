// Derivatives of a stencil's terms, by differences in 50 digits of formulas that share nothing with tact/solver.
#pragma once

#include <tact/solver.h>

#include <cstdint>
#include <string>

namespace tact::tests {

/// A stencil at random positions: of any kind, generic, thin, nearly parallel or nearly touching, of any size and away
/// from the origin.
struct PlacedStencil {
  solver::Stencil stencil;
  solver::Corners x;
  double reach = 0.0;      // of the barrier, above the gap
  double threshold = 0.0;  // of the mollifier; 0 for none
};
PlacedStencil random_stencil(std::uint64_t seed);

/// Says what is wrong with the gap and the barrier of a stencil: a value, gradient or Hessian farther than 1e-6 of its
/// norm from differences, or a projected Hessian with an eigenvalue below -1e-12 of its norm. Empty if all is right.
std::string wrong_terms(const PlacedStencil& placed);

}  // namespace tact::tests
