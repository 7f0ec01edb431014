// Random numbers that are the same on every platform, unlike the standard library's distributions.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace tact::bench {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  // low <= the number < high.
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }

  // 0 .. count - 1 in a random order.
  std::vector<int> permutation(int count) {
    std::vector<int> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[bits_() % k]);
    return order;
  }

  // Uniform on the unit sphere.
  Eigen::Vector3d direction() {
    for (;;) {
      const double x = uniform(-1.0, 1.0), y = uniform(-1.0, 1.0), z = uniform(-1.0, 1.0);
      const Eigen::Vector3d p(x, y, z);
      const double square = p.squaredNorm();
      if (square > 0.01 && square <= 1.0) return p / std::sqrt(square);
    }
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace tact::bench
