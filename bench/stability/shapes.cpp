#include "bench/stability/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace tact::bench {

int StabilityRandom::below(int count) { return static_cast<int>(random_.bits() % static_cast<std::uint64_t>(count)); }

Eigen::Vector3d StabilityRandom::in_cube(double half_edge) {
  const double x = uniform(-half_edge, half_edge), y = uniform(-half_edge, half_edge);
  return {x, y, uniform(-half_edge, half_edge)};
}

Eigen::Vector3d StabilityRandom::direction() {
  for (;;) {
    const Eigen::Vector3d p = in_cube(1.0);
    if (p.squaredNorm() <= 1.0 && p.squaredNorm() > 1e-3) return p.normalized();
  }
}

Eigen::Matrix3d StabilityRandom::rotation() {
  const Eigen::Vector3d axis = direction();
  return Eigen::AngleAxisd(uniform(0.0, 2.0 * std::numbers::pi), axis).toRotationMatrix();
}

Mesh box_shape(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  Mesh mesh;
  mesh.positions.resize(3, 8);
  for (int v = 0; v < 8; ++v) {
    mesh.positions.col(v) << (v & 1 ? upper.x() : lower.x()), (v & 2 ? upper.y() : lower.y()),
        (v & 4 ? upper.z() : lower.z());
  }
  mesh.facets.resize(3, 12);
  mesh.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,             //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return mesh;
}

Mesh ball_shape(int subdivisions) {
  const double g = std::numbers::phi;
  std::vector<Eigen::Vector3d> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Eigen::Vector3d& p : points) p.normalize();
  std::vector<Eigen::Vector3i> facets{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int s = 0; s < subdivisions; ++s) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(i, j), static_cast<int>(points.size()));
      if (is_new) points.push_back((points[i] + points[j]).normalized());
      return place->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& f : facets) {
      const int p = middle(f[0], f[1]), q = middle(f[1], f[2]), r = middle(f[2], f[0]);
      for (const Eigen::Vector3i& part : {Eigen::Vector3i{f[0], p, r}, {f[1], q, p}, {f[2], r, q}, {p, q, r}})
        finer.push_back(part);
    }
    facets = std::move(finer);
  }
  Mesh mesh;
  mesh.positions =
      Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, static_cast<Eigen::Index>(points.size()));
  mesh.facets = Eigen::Map<const Eigen::Matrix3Xi>(facets.front().data(), 3, static_cast<Eigen::Index>(facets.size()));
  return mesh;
}

Mesh lumpy_shape(int subdivisions, double roughness, StabilityRandom& random) {
  Mesh mesh = ball_shape(subdivisions);
  for (int bump = 0; bump < 6; ++bump) {
    const Eigen::Vector3d at = random.direction();
    const double height = random.uniform(-roughness, roughness);
    for (auto p : mesh.positions.colwise()) {
      const double near = std::max(0.0, p.normalized().dot(at) - 0.5) * 2.0;
      p *= 1.0 + height * near * near * (3.0 - 2.0 * near);
    }
  }
  return mesh;
}

Mesh sheet_shape(int cells) {
  Mesh mesh;
  const int row = cells + 1;
  mesh.positions.resize(3, row * row);
  mesh.facets.resize(3, 2 * cells * cells);
  for (int j = 0; j < row; ++j) {
    for (int i = 0; i < row; ++i) {
      mesh.positions.col(j * row + i) << static_cast<double>(i) / cells - 0.5, static_cast<double>(j) / cells - 0.5,
          0.0;
    }
  }
  int f = 0;
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int v = j * row + i;
      mesh.facets.col(f++) << v, v + 1, v + row + 1;
      mesh.facets.col(f++) << v, v + row + 1, v + row;
    }
  }
  return mesh;
}

namespace {

// One triangle after another, nothing shared.
template <class Triangle>
Mesh triangles(int facets, const Triangle& triangle) {
  Mesh mesh;
  mesh.positions.resize(3, 3 * facets);
  mesh.facets.resize(3, facets);
  for (int f = 0; f < facets; ++f) {
    mesh.positions.middleCols(3 * f, 3) = triangle();
    mesh.facets.col(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  }
  return mesh;
}

Mesh thin_shape(int facets, double aspect, double third_corner_at, StabilityRandom& random) {
  return triangles(facets, [&] {
    const Eigen::Vector3d along = random.direction(), middle = random.in_cube(0.3);
    const Eigen::Vector3d from = middle - 0.5 * along, across = random.direction() / aspect;
    Eigen::Matrix3d corners;
    corners << from, from + along, from + third_corner_at * along + across;
    return corners;
  });
}

}  // namespace

Mesh soup_shape(int facets, StabilityRandom& random) {
  return triangles(facets, [&] {
    const Eigen::Vector3d at = random.in_cube(0.7);
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = at + random.in_cube(0.3);
    return corners;
  });
}

Mesh needle_shape(int facets, double aspect, StabilityRandom& random) {
  return thin_shape(facets, aspect, 1.0, random);
}
Mesh sliver_shape(int facets, double aspect, StabilityRandom& random) {
  return thin_shape(facets, aspect, 0.5, random);
}

Mesh hull_shape(int points, StabilityRandom& random) {
  Mesh cloud;
  cloud.positions.resize(3, points);
  cloud.facets.resize(3, points);
  for (int v = 0; v < points; ++v) {
    cloud.positions.col(v) = random.direction();
    cloud.facets.col(v).setConstant(v);
  }
  return convex_hull(cloud);
}

Mesh triangle_shape(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
  Mesh mesh;
  mesh.positions.resize(3, 3);
  mesh.positions << p, q, r;
  mesh.facets.resize(3, 1);
  mesh.facets << 0, 1, 2;
  return mesh;
}

Mesh moved(Mesh mesh, const Eigen::Vector3d& by) {
  mesh.positions.colwise() += by;
  return mesh;
}

Mesh rotated(Mesh mesh, const Eigen::Matrix3d& rotation) {
  mesh.positions = rotation * mesh.positions;
  return mesh;
}

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh;
  mesh.positions.resize(3, a.positions.cols() + b.positions.cols());
  mesh.facets.resize(3, a.facets.cols() + b.facets.cols());
  if (a.positions.cols() > 0) mesh.positions.leftCols(a.positions.cols()) = a.positions;
  if (a.facets.cols() > 0) mesh.facets.leftCols(a.facets.cols()) = a.facets;
  mesh.positions.rightCols(b.positions.cols()) = b.positions;
  mesh.facets.rightCols(b.facets.cols()) = b.facets.array() + static_cast<int>(a.positions.cols());
  return mesh;
}

}  // namespace tact::bench
