#include "scenes/pictures/symbols.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace tact::scenes {
namespace {

constexpr int kSides = 20;        // of a shaft, a head and a tube
constexpr int kRimSegments = 96;  // of a disk's rim

double turn(int step, int steps) { return 2.0 * std::numbers::pi * step / steps; }

// A circle of a surface of revolution: its place along the axis and its radius.
struct Ring {
  double along = 0.0;
  double radius = 0.0;
};

// The surface of revolution through the rings, around the line through `start` along `axis`.
SymbolMesh revolve(const Eigen::Vector3d& start, const Eigen::Vector3d& axis, std::span<const Ring> rings) {
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);
  const auto count = static_cast<int>(rings.size());
  SymbolMesh mesh{Eigen::Matrix3Xd(3, kSides * count), Eigen::Matrix3Xi(3, 2 * kSides * (count - 1))};
  for (int ring = 0; ring < count; ++ring) {
    const auto [along, radius] = rings[ring];
    for (int side = 0; side < kSides; ++side) {
      const double angle = turn(side, kSides);
      mesh.positions.col(ring * kSides + side) =
          start + along * axis + radius * (std::cos(angle) * u + std::sin(angle) * v);
    }
  }
  int facet = 0;
  for (int ring = 0; ring + 1 < count; ++ring) {
    for (int side = 0; side < kSides; ++side) {
      const int a = ring * kSides + side;
      const int b = ring * kSides + (side + 1) % kSides;
      mesh.facets.col(facet++) << a, b, b + kSides;
      mesh.facets.col(facet++) << a, b + kSides, a + kSides;
    }
  }
  return mesh;
}

}  // namespace

SymbolMesh arrow_mesh(const Arrow& arrow, double thickness) {
  const double head = std::min(7.0 * thickness, arrow.length);
  const double neck = arrow.length - head;
  const Ring rings[] = {{0.0, 0.0}, {0.0, thickness}, {neck, thickness}, {neck, 2.6 * thickness}, {arrow.length, 0.0}};
  return revolve(arrow.start, arrow.direction, rings);
}

SymbolMesh ring_mesh(const Disk& disk, double thickness) {
  const Eigen::Vector3d u = disk.normal.unitOrthogonal();
  const Eigen::Vector3d v = disk.normal.cross(u);
  SymbolMesh mesh{Eigen::Matrix3Xd(3, kRimSegments * kSides), Eigen::Matrix3Xi(3, 2 * kRimSegments * kSides)};
  int facet = 0;
  for (int segment = 0; segment < kRimSegments; ++segment) {
    const double around = turn(segment, kRimSegments);
    const Eigen::Vector3d outward = std::cos(around) * u + std::sin(around) * v;
    for (int side = 0; side < kSides; ++side) {
      const double angle = turn(side, kSides);
      mesh.positions.col(segment * kSides + side) = disk.center +
                                                    (disk.radius + thickness * std::cos(angle)) * outward +
                                                    thickness * std::sin(angle) * disk.normal;
      const int a = segment * kSides + side;
      const int b = segment * kSides + (side + 1) % kSides;
      const int next = (segment + 1) % kRimSegments * kSides - segment * kSides;
      mesh.facets.col(facet++) << a, a + next, b + next;
      mesh.facets.col(facet++) << a, b + next, b;
    }
  }
  return mesh;
}

SymbolMesh disk_mesh(const Disk& disk) {
  const Eigen::Vector3d u = disk.normal.unitOrthogonal();
  const Eigen::Vector3d v = disk.normal.cross(u);
  SymbolMesh mesh{Eigen::Matrix3Xd(3, kRimSegments + 1), Eigen::Matrix3Xi(3, kRimSegments)};
  mesh.positions.col(kRimSegments) = disk.center;
  for (int segment = 0; segment < kRimSegments; ++segment) {
    const double around = turn(segment, kRimSegments);
    mesh.positions.col(segment) = disk.center + disk.radius * (std::cos(around) * u + std::sin(around) * v);
    mesh.facets.col(segment) << kRimSegments, segment, (segment + 1) % kRimSegments;
  }
  return mesh;
}

}  // namespace tact::scenes
