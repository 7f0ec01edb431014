// Random numbers that are the same on every platform, unlike the standard library's distributions.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/vec3.h"
#include "tests/support/mesh.h"

namespace tact::tests {

// SplitMix64 (Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits();
  // 0 <= the number < 1, a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // 0 <= the number < count, for a small positive count.
  int below(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }
  bool chance(double probability) { return uniform() < probability; }

  // Uniform in the cube of the given half edge about the origin, in the unit ball, on the unit sphere.
  Vec3 in_cube(double half_edge);
  Vec3 in_ball();
  Vec3 direction();
  Rotation rotation();

  // 0 .. count - 1 in a random order.
  std::vector<int> permutation(int count);

 private:
  std::uint64_t state_;
};

}  // namespace tact::tests
