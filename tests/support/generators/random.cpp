#include "tests/support/generators/random.h"

#include <numeric>
#include <utility>

#include "engine/base/hash.h"

namespace tact::tests {

std::uint64_t Random::bits() { return base::mixed(state_ += base::kGoldenStep); }

Vec3 Random::in_cube(double half_edge) {
  const double x = uniform(-half_edge, half_edge);
  const double y = uniform(-half_edge, half_edge);
  return {x, y, uniform(-half_edge, half_edge)};
}

Vec3 Random::in_ball() {
  while (true) {
    const Vec3 p = in_cube(1.0);
    if (norm_squared(p) <= 1.0) return p;
  }
}

Vec3 Random::direction() {
  while (true) {
    const Vec3 p = in_ball();
    if (norm_squared(p) > 1e-6) return normalized(p);
  }
}

Rotation Random::rotation() {
  // A point of the ball in four dimensions, by rejection: its direction is a uniform rotation.
  while (true) {
    const Vec3 v = in_cube(1.0);
    const double w = uniform(-1.0, 1.0);
    const double length = norm_squared(v) + w * w;
    if (length <= 1.0 && length > 1e-6) return tests::rotation(w, v.x, v.y, v.z);
  }
}

std::vector<int> Random::permutation(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  for (int i = count - 1; i > 0; --i) {
    std::swap(numbers[i], numbers[below(i + 1)]);
  }
  return numbers;
}

}  // namespace tact::tests
