// Directions for soft light: the same for every run, spread evenly within a pixel and differently from pixel to pixel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "scenes/pictures/ray_scene.h"

namespace tact::scenes {

// Pixels use kTile * kTile different sets of directions, so that any kTile * kTile neighbours hold each set once: their
// mean is free of grain. Source: A. Keller and W. Heidrich, Interleaved Sampling, 2001.
inline constexpr int kTile = 5;

// Points of the unit disk, even by area.
using DiskPoints = std::array<Eigen::Vector2f, kBundle>;

class DiskPattern {
 public:
  DiskPattern() {
    constexpr std::uint32_t kSets = kTile * kTile;
    for (std::uint32_t set = 0; set < kSets; ++set) {
      // Hammersley's points; the sets fall into each other's gaps, and neighbours are far from each other.
      const float around = (static_cast<float>(set * 7 % kSets) + 0.5f) / kSets;
      const float outward = (static_cast<float>(set * 11 % kSets) + 0.5f) / kSets;
      for (std::uint32_t i = 0; i < kBundle; ++i) {
        const std::uint32_t reversed = (i & 1u) << 2 | (i & 2u) | (i & 4u) >> 2;
        const float angle = 2.0f * std::numbers::pi_v<float> * (static_cast<float>(reversed) + around) / kBundle;
        const float radius = std::sqrt((static_cast<float>(i) + outward) / kBundle);
        sets_[set][i] = {radius * std::cos(angle), radius * std::sin(angle)};
      }
    }
  }

  const DiskPoints& of_pixel(int x, int y) const { return sets_[y % kTile * kTile + x % kTile]; }

 private:
  std::array<DiskPoints, std::size_t{kTile} * kTile> sets_;
};

// Two unit vectors that stand on `normal` and on each other. Source: Duff et al., Building an Orthonormal Basis,
// Revisited, JCGT 2017.
struct Tangents {
  Eigen::Vector3f first;
  Eigen::Vector3f second;
};

inline Tangents tangents(const Eigen::Vector3f& normal) {
  const float sign = std::copysign(1.0f, normal.z());
  const float a = -1.0f / (sign + normal.z());
  const float b = normal.x() * normal.y() * a;
  return {{1.0f + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x()},
          {b, sign + normal.y() * normal.y() * a, -normal.y()}};
}

}  // namespace tact::scenes
