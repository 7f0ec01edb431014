#include <algorithm>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

struct ClothOverSphere {
  double cloth_side = 1.8;  // metres
  double radius = 0.45;     // of the sphere, metres
  double height = 0.75;     // of the sphere's centre above the ground, metres
  double drop = 0.2;        // from the cloth down to the sphere, metres
  double turn = 0.3;        // of the cloth about z, radians
  ClothMaterial cloth;
  RigidMaterial ball{.friction = 0.4, .thickness = 0.004};
  DynamicsSettings dynamics{
      .time_step = 1.0 / 120.0, .substeps = 8, .most_reach = 0.004, .guarded = true, .margin = 0.0005};
  int vertices_a_substep = 16;  // along a side, at most: a finer cloth needs finer steps, or it stretches and is passed
};

}  // namespace

Scene make_cloth_over_sphere(int size) {
  const ClothOverSphere p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.dynamics.substeps = std::max(p.dynamics.substeps, size / p.vertices_a_substep);
  scene.view = {.azimuth = 30.0, .elevation = 18.0};
  scene.ground = 0.0;
  scene.add(make_rigid("sphere", moved(sphere(4, p.radius), {0.0, 0.0, p.height}), p.ball, Motion::fixed));
  const Mesh cloth = rotated(grid_sheet(size, size, p.cloth_side, p.cloth_side), {0.0, 0.0, 1.0}, p.turn);
  Body body = make_cloth("cloth", moved(cloth, {0.05, 0.0, p.height + p.radius + p.drop}), p.cloth);
  body.self_contact = true;
  scene.add(std::move(body));
  return scene;
}

}  // namespace tact::scenes
