// Directions for soft light: the same for every run, spread evenly within a pixel and differently from pixel to pixel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "scenes/pictures/ray_scene.h"

namespace tact::scenes {

// Points of the unit disk, even by area, for one of the bundles of a pixel.
using DiskPoints = std::array<Eigen::Vector2f, kBundle>;

// How the points of a pixel differ from those of others: a turn around the centre and a shift along the radius.
struct PixelTurn {
  float cosine = 1.0f;
  float sine = 0.0f;
  float shift = 0.0f;
};

// Neighbouring pixels differ as much as they can, so that the eye blurs the grain. Source: J. Jimenez, Next Generation
// Post Processing in Call of Duty, 2014 (interleaved gradient noise).
inline PixelTurn pixel_turn(int x, int y) {
  const auto noise = [](float px, float py) {
    const float inner = 0.06711056f * px + 0.00583715f * py;
    const float outer = 52.9829189f * (inner - std::floor(inner));
    return outer - std::floor(outer);
  };
  const auto px = static_cast<float>(x);
  const auto py = static_cast<float>(y);
  const float angle = 2.0f * std::numbers::pi_v<float> * noise(px, py);
  return {.cosine = std::cos(angle), .sine = std::sin(angle), .shift = noise(px + 47.0f, py + 17.0f)};
}

// Hammersley's points on the disk, dealt out to the bundles of a pixel so that each bundle covers the disk and all
// together cover it evenly.
class DiskPattern {
 public:
  explicit DiskPattern(std::uint32_t bundles) : points_(std::size_t{bundles} * kBundle) {
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      std::uint32_t reversed = 0;
      for (int bit = 0; bit < 32; ++bit) reversed |= (i >> bit & 1u) << (31 - bit);
      const float angle = 2.0f * std::numbers::pi_v<float> * (static_cast<float>(reversed >> 8) * 0x1p-24f);
      const float area = (static_cast<float>(i) + 0.5f) / static_cast<float>(points_.size());
      points_[i % bundles * kBundle + i / bundles] = {.area = area, .cosine = std::cos(angle), .sine = std::sin(angle)};
    }
  }

  DiskPoints points(std::uint32_t bundle, const PixelTurn& turn) const {
    DiskPoints result;
    for (std::size_t i = 0; i < kBundle; ++i) {
      const Point& point = points_[bundle * kBundle + i];
      const float area = point.area + turn.shift;
      const float radius = std::sqrt(area - std::floor(area));
      result[i] = {radius * (turn.cosine * point.cosine - turn.sine * point.sine),
                   radius * (turn.sine * point.cosine + turn.cosine * point.sine)};
    }
    return result;
  }

 private:
  struct Point {
    float area = 0.0f;  // of the smaller disk whose rim it lies on
    float cosine = 1.0f;
    float sine = 0.0f;
  };
  std::vector<Point> points_;  // kBundle a bundle
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
