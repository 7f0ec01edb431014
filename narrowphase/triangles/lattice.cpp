#include "narrowphase/triangles/lattice.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace tact::narrowphase {

namespace {

// The sides of a box, and the power of two that is next above the longest; 0 if there is none or it is too far from 1.
struct Sides {
  double length[3];
  double unit = 0.0;

  explicit Sides(const BoxBounds& box) {
    double longest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      length[axis] = box.upper[axis] - box.lower[axis];
      longest = std::max(longest, length[axis]);
    }
    if (!(longest > 0x1p-150 && longest < 0x1p150)) return;
    constexpr int kFractionBits = std::numeric_limits<double>::digits - 1;
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(longest) >> kFractionBits;
    unit = std::bit_cast<double>((exponent + 1) << kFractionBits);
  }
};

// No lattice if some coordinate is 2^51 steps and more: whether it is a whole number of them could not be told.
Lattice lattice_over(const BoxBounds& box, double step) {
  Lattice lattice;
  const double whole = 0x1.8p52 * step;  // added and taken away again leaves whole numbers of steps
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::max(-box.lower[axis], box.upper[axis]) < 0x1p51 * step)) return {};
    lattice.grid.origin[axis] = (box.lower[axis] + whole) - whole;
    lattice.grid.scale[axis] = 1.0 / step;
  }
  lattice.step = step;
  return lattice;
}

}  // namespace

Lattice finest_lattice_in_doubles(const BoxBounds& box) {
  const Sides sides(box);
  return sides.unit > 0.0 ? lattice_over(box, 0x1p-16 * sides.unit) : Lattice{};
}

Lattice finest_lattice_in_floats(const BoxBounds& box) {
  const Sides sides(box);
  if (sides.unit == 0.0) return {};
  constexpr double kMost = 0.999 * 0x1p24;  // the sides may have been rounded down
  double steps = 0x1p10;                    // in a unit
  const auto largest = [&] {
    double product = 6.0;
    for (const double length : sides.length) product *= std::max(length / sides.unit * steps, 1.0);
    return product;
  };
  while (largest() > kMost) steps *= 0.5;
  return lattice_over(box, sides.unit / steps);
}

}  // namespace tact::narrowphase
