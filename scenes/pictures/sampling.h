// Directions for soft light: the same for every run, spread evenly within a pixel and differently from pixel to pixel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace tact::scenes {

// A point of the unit square.
struct SquarePoint {
  float u = 0.0f;
  float v = 0.0f;
};

// Point i of Hammersley's set of `count` points.
inline SquarePoint hammersley(std::uint32_t i, std::uint32_t count) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= (i >> bit & 1u) << (31 - bit);
  return {(static_cast<float>(i) + 0.5f) / static_cast<float>(count), static_cast<float>(reversed >> 8) * 0x1p-24f};
}

// How far the points of a pixel are shifted, around the ends of the square. Neighbouring pixels differ as much as they
// can, so that the eye blurs the grain. Source: J. Jimenez, Next Generation Post Processing in Call of Duty, 2014
// (interleaved gradient noise).
inline SquarePoint pixel_shift(int x, int y) {
  const auto noise = [](float px, float py) {
    const float inner = 0.06711056f * px + 0.00583715f * py;
    const float outer = 52.9829189f * (inner - std::floor(inner));
    return outer - std::floor(outer);
  };
  const auto px = static_cast<float>(x);
  const auto py = static_cast<float>(y);
  return {noise(px, py), noise(px + 47.0f, py + 17.0f)};
}

inline SquarePoint shifted(SquarePoint point, SquarePoint shift) {
  const float u = point.u + shift.u;
  const float v = point.v + shift.v;
  return {u - std::floor(u), v - std::floor(v)};
}

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

// A point of the unit disk, even by area.
inline Eigen::Vector2f disk_point(SquarePoint point) {
  const float radius = std::sqrt(point.u);
  const float angle = 2.0f * std::numbers::pi_v<float> * point.v;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace tact::scenes
