#include "engine/debug/pen.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

namespace tact {

namespace {

using Eigen::Vector3d;

constexpr int kCircleSides = 24;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kArrowHead = 0.15;  // of the arrow's length

}  // namespace

Bounds bounds_of_all(const World& world) {
  Bounds all{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const BodyId body : world.bodies()) {
    if (world.plane(body)) continue;
    const Bounds bounds = world.bounds(body);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.lower[axis] = std::min(all.lower[axis], bounds.lower[axis]);
      all.upper[axis] = std::max(all.upper[axis], bounds.upper[axis]);
    }
  }
  return all;
}

Vector3d foot(const Plane& plane, const Vector3d& point) {
  return point - (plane.normal.dot(point) - plane.offset) * plane.normal;
}

// Not by printf, which rounds as the caller's x87 does.
std::string metres(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr;
  return std::string(text.data(), end) + " m";
}

void Pen::arrow(const Vector3d& from, const Vector3d& way, const DebugColor& color) {
  const Vector3d tip = from + way;
  drawer_.line(from, tip, color);
  const Vector3d across = kArrowHead * way.norm() * way.unitOrthogonal();
  if (!across.allFinite()) return;  // no way at all
  drawer_.line(tip, tip - kArrowHead * way + across, color);
  drawer_.line(tip, tip - kArrowHead * way - across, color);
}

void Pen::circle(const Vector3d& center, double radius, const Vector3d& n, const DebugColor& color) {
  const Vector3d u = radius * n.unitOrthogonal(), v = n.cross(u);
  // Drawn alone: no answer depends on the last digits of cosines, which differ between C libraries.
  const auto rim = [&](int side) -> Vector3d {
    const double angle = 2.0 * std::numbers::pi * side / kCircleSides;
    return center + std::cos(angle) * u + std::sin(angle) * v;
  };
  for (int side = 0; side < kCircleSides; ++side) drawer_.line(rim(side), rim(side + 1), color);
}

}  // namespace tact
