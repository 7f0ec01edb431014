#include <cmath>
#include <numbers>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

struct WheelOnGround {
  double length = 24.0, width = 12.0;  // of the ground, metres
  double depth = 0.6;                  // of the ground below its lowest point, metres
  double radius = 0.35, tube = 0.11;   // of the wheel to its middle line, and of its tyre, metres
  double speed = 2.0;                  // metres a second
  double start = -2.2;                 // metres
  SoftMaterial tyre{.density = 300.0,
                    .surface_stiffness = 3000.0,
                    .bend_stiffness = 1000.0,
                    .inner_stiffness = 2000.0,
                    .bulk_modulus = 150000.0,
                    .shape_frequency = 14.0,
                    .shape_stretch = 0.1,
                    .friction = 0.9,
                    .drag = 0.05,
                    .inner_damping = 10.0,
                    .thickness = 0.003};
  RigidMaterial soil{.friction = 0.9, .thickness = 0.003};
  DynamicsSettings dynamics{.time_step = 1.0 / 120.0, .substeps = 6};
};

double height_at(double x, double y) {
  return 0.05 * std::sin(2.1 * x) + 0.04 * std::sin(1.3 * x + 1.7 * y) +
         0.02 * std::cos(3.7 * x - 0.8) * std::cos(1.1 * y) - 0.02 * x;
}

// A slab with a hilly top.
Mesh ground(const WheelOnGround& p, int size) {
  const double edge = p.length / size;
  Mesh mesh = box({-0.5 * p.length, -0.5 * p.width, -p.depth}, {0.5 * p.length, 0.5 * p.width, 0.0}, edge);
  for (Vec3& q : mesh.positions) q.z += (1.0 + q.z / p.depth) * height_at(q.x, q.y);
  return mesh;
}

}  // namespace

// Bodies of very different size (§4.3 of the paper): the wheel meets a few of the ground's facets at a time.
Scene make_wheel_on_ground(int size) {
  const WheelOnGround p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.view = {.azimuth = 15.0, .elevation = 13.0};
  scene.shown = base::Box{{-2.7, -0.5, -0.1}, {2.7, 0.5, 1.0}};
  scene.paper = "of the larger body only the facets close to the smaller one are looked at";
  const double outer = p.radius + p.tube;
  const double z = height_at(p.start, 0.0) + outer + 0.03;
  const Mesh wheel = rotated(torus(48, 14, p.radius, p.tube), {1.0, 0.0, 0.0}, 0.5 * std::numbers::pi);
  Body tyre = make_soft("wheel", moved(wheel, {p.start, 0.0, z}), p.tyre);
  const Vec3 spin{0.0, p.speed / outer, 0.0};
  for (std::size_t v = 0; v < tyre.positions.size(); ++v) {
    tyre.velocities[v] = Vec3{p.speed, 0.0, 0.0} + cross(spin, tyre.positions[v] - Vec3{p.start, 0.0, z});
  }
  scene.add(std::move(tyre));
  scene.add(make_rigid("ground", ground(p, size), p.soil, Motion::fixed));
  return scene;
}

}  // namespace tact::scenes
