#include <algorithm>
#include <cmath>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"
#include "scenes/library/smooth_step.h"

namespace tact::scenes {
namespace {

struct SphereIntoCloth {
  double cloth_side = 1.6;  // metres
  double hang = 0.92;       // distance of the four fixed corners, in cloth sides
  double height = 0.9;      // of the corners above the ground, metres
  double radius = 0.28;     // of the sphere, metres
  double rest_time = 0.6;   // in which the cloth finds its hang, seconds
  double rise_time = 1.2;   // seconds
  double lowest = 0.3;      // of the sphere's centre, metres
  double highest = 1.05;    // metres
  ClothMaterial cloth{.density = 0.25, .stretch_stiffness = 1500.0, .bend_stiffness = 0.3, .friction = 0.3};
  RigidMaterial ball{.friction = 0.3, .thickness = 0.004};
  DynamicsSettings dynamics{.time_step = 1.0 / 120.0, .substeps = 8};
  int vertices_a_substep = 16;  // along a side, at most: a finer cloth needs finer steps, or it stretches and is passed
};

// Flat, with the four corners drawn together and held.
Body hung_cloth(const SphereIntoCloth& p, int size) {
  Body cloth = make_cloth("cloth", grid_sheet(size, size, p.cloth_side, p.cloth_side), p.cloth);
  const double half = 0.5 * p.cloth_side;
  for (std::size_t v = 0; v < cloth.positions.size(); ++v) {
    Vec3& q = cloth.positions[v];
    const double x = q.x / half, y = q.y / half;
    if (std::abs(x) > 0.9999 && std::abs(y) > 0.9999) cloth.inverse_masses[v] = 0.0;
    q = {p.hang * q.x, p.hang * q.y, p.height - 0.25 * p.cloth_side * (1.0 - 0.5 * (x * x + y * y)) * (1.0 - p.hang)};
  }
  return cloth;
}

}  // namespace

Scene make_sphere_into_cloth(int size) {
  const SphereIntoCloth p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.dynamics.substeps = std::max(p.dynamics.substeps, size / p.vertices_a_substep);
  scene.view = {.azimuth = 30.0, .elevation = 12.0};
  scene.ground = 0.0;
  const double half = 0.5 * p.cloth_side;
  scene.shown = base::Box{{-half, -half, 0.0}, {half, half, p.highest + p.radius}};
  const std::vector<Vec3> ball = sphere(4, p.radius).positions;
  scene.add(make_rigid("sphere", sphere(4, p.radius), p.ball, Motion::deformable));
  scene.add(hung_cloth(p, size));
  scene.script = [p, ball](double time, std::vector<Body>& bodies) {
    const double z = p.lowest + (p.highest - p.lowest) * smooth_step((time - p.rest_time) / p.rise_time);
    for (std::size_t v = 0; v < ball.size(); ++v) bodies[0].positions[v] = ball[v] + Vec3{0.06, 0.04, z};
  };
  return scene;
}

}  // namespace tact::scenes
