// What moves past, into or through what else.
#pragma once

#include <tact/tact.h>

#include <Eigen/Geometry>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/mesh.h"
#include "tests/support/oracles/motion_by_brute_force.h"

namespace tact::tests {

// A motion that no rigid body makes.
inline Eigen::Matrix3Xd moved(const Mesh& mesh, Vec3 way, double wildness, Random& random) {
  Eigen::Matrix3Xd end = mesh.positions;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = way + wildness * random.in_ball();
    end.col(v) += Eigen::Vector3d(p.x, p.y, p.z);
  }
  return end;
}

struct Couple {
  const char* name;
  MovingMesh a, b;
};

// Both about one axis that passes far from them.
inline Couple turned(const char* name, const Mesh& a, const Mesh& b) {
  const auto turn = [](const Mesh& mesh) {
    const Eigen::Vector3d pivot(3, 0, 0);
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    return Eigen::Matrix3Xd(((rotation * (mesh.positions.colwise() - pivot)).colwise() + pivot));
  };
  Couple couple{name, {a, turn(a)}, {b, turn(b)}};
  couple.b.end.row(0).array() -= 0.05;
  return couple;
}

inline std::vector<Couple> couples() {
  Random random(11);
  std::vector<Couple> all;
  const auto add = [&](const char* name, const Mesh& a, Vec3 way_a, const Mesh& b, Vec3 way_b, double wildness) {
    all.push_back({name, {a, moved(a, way_a, wildness, random)}, {b, moved(b, way_b, wildness, random)}});
  };
  const Mesh ball = blob(3, 1.0, 0.2, 1), other = translated(blob(3, 1.0, 0.2, 2), {3.0, 0.2, 0.1});
  add("balls that pass through each other", ball, {4, 0, 0}, other, {-4, 0, 0}, 0.0);
  add("balls that graze", ball, {0.6, 0, 0}, other, {-0.6, 0, 0}, 0.05);
  add("balls that overlap", ball, {0.1, 0, 0}, translated(other, {-1.8, 0, 0}), {-0.1, 0, 0}, 0.01);
  add("a sheet that a ball falls through", translated(icosphere(2), {0, 0, 3}), {0.1, 0.2, -7}, sheet(24, 24, 6, 6),
      {0, 0, 0.5}, 0.02);
  add("boxes on a grid, face to face", gridded_box({0, 0, 0}, {1, 1, 1}, 4), {0.5, 0, 0},
      gridded_box({1, 0, 0}, {2, 1, 1}, 4), {0, 0.25, 0}, 0.0);
  add("boxes on a grid that meet", gridded_box({0, 0, 0}, {1, 1, 1}, 4), {2, 0, 0},
      gridded_box({1.5, 0.25, 0}, {2.5, 1.25, 1}, 4), {0, 0, 0}, 0.0);
  add("soups", soup(120, 1.0, 3), {0.5, 0, 0}, soup(120, 1.0, 4), {-0.5, 0, 0}, 0.3);
  add("soups with facets without area", lattice_soup(150, 3, 5), {1, 1, 0}, lattice_soup(150, 3, 6), {0, 0, 1}, 0.0);
  add("needles", needles(100, 1e4, 7), {0.3, 0, 0}, needles(100, 1e4, 8), {-0.3, 0.1, 0}, 0.1);
  add("balls that graze, carried along", ball, {30.6, -7, 4}, other, {29.4, -7, 4}, 0.05);
  add("soups, carried along", soup(120, 1.0, 3), {0.5, 9, 0}, soup(120, 1.0, 4), {-0.5, 9, 0}, 0.3);
  all.push_back(turned("soups, turned by half a radian", soup(120, 1.0, 3), soup(120, 1.0, 4)));
  return all;
}

struct BallAndWall {
  tact::World world;
  Mesh ball = translated(icosphere(1, 0.1), {0, 0, 1}), wall = sheet(4, 4, 4, 4);
  BodyId flying = world.add_body({.positions = ball.positions, .facets = ball.facets});
  BodyId standing = world.add_body(
      {.positions = wall.positions, .facets = wall.facets, .surface = Surface::sheet, .motion = Motion::fixed});

  void put(double z) { world.set_positions(flying, translated(ball, {0, 0, z - 1.0}).positions); }
};

}  // namespace tact::tests
