// Springs between vertices, solved by XPBD.
#pragma once

#include <span>
#include <vector>

#include "scenes/dynamics/mesh.h"

namespace tact::scenes {

struct Spring {
  int a = 0;
  int b = 0;
  double length = 0.0;      // at rest, metres
  double compliance = 0.0;  // metres a newton
};

// Springs in groups of which no two share a vertex: the springs of a group may be solved in any order and by any number
// of threads, and give the same bits.
class Springs {
 public:
  Springs() = default;
  Springs(std::span<const Spring> springs, int vertex_count);

  // One sweep over all springs, group by group, for a substep of `h` seconds; one iteration, so that the multipliers
  // need not be stored. Source: M. Macklin et al., Small Steps in Physics Simulation, SCA 2019.
  void solve(std::vector<Vec3>& positions, const std::vector<double>& inverse_masses, double h, int threads) const;

 private:
  std::vector<Spring> springs_;
  std::vector<std::size_t> group_ends_;
};

}  // namespace tact::scenes
