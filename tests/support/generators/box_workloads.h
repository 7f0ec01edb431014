// Sets of boxes that move, step by step, for tests and benchmarks of the broad phase. Every workload is fixed by its
// kind, the number of boxes and a seed. Boxes have a size of about 1, and the density does not depend on their number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "broadphase/index_pair.h"
#include "engine/base/box.h"

namespace tact::tests {

enum class BoxWorkloadKind {
  small_motion,  // cubes scattered in a cube, about one pair a box; each moves by up to 2 % of its size a step
  all_far,       // the same, each put at a new random place in every step
  few_moving,    // the same, ten of them put at a new place in every step
  churn,         // the same, of which a tenth is missing; in every step a tenth is removed and a tenth added
  tall_pile,     // a column three boxes wide: all overlap along x and y; motion as in small_motion
  thin_layer,    // a layer one box high: all overlap along z; motion as in small_motion
  one_huge,      // small_motion, and one box around all
  size_spread,   // cubes whose edges spread over 1 : 1000, evenly in their logarithm; motion in proportion
  rods,          // small_motion with every hundredth box a rod of 1 x 1 x 20, along any axis
  lattice,       // bricks on a grid that touch in exactly equal coordinates; one layer in ten slides by a brick a step
};

std::span<const BoxWorkloadKind> all_box_workloads();
std::string name_of(BoxWorkloadKind kind);

class BoxWorkload {
 public:
  BoxWorkload(BoxWorkloadKind kind, std::size_t count, std::uint64_t seed);

  // Moves the boxes. changed() then lists those that differ; before the first step it lists all.
  void step();

  // Lists all boxes as changed.
  void mark_all();

  std::span<const base::Box> boxes() const { return boxes_; }
  std::span<const broadphase::Filter> filters() const { return filters_; }
  std::span<const std::uint32_t> changed() const { return changed_; }

 private:
  double uniform(double lower, double upper);
  base::Vec3 random_point();
  base::Vec3 random_size(std::size_t index);
  void place(std::size_t index);
  void place_lattice();
  void drift();
  void slide_layers();
  void exchange();

  BoxWorkloadKind kind_;
  std::mt19937_64 random_;
  base::Vec3 domain_;  // places lie between 0 and this
  std::vector<base::Box> boxes_;
  std::vector<base::Vec3> velocities_;
  std::vector<broadphase::Filter> filters_;
  std::vector<std::uint32_t> changed_;
  int steps_ = 0;
};

}  // namespace tact::tests
