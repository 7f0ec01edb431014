#include <algorithm>
#include <cmath>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

struct SphereInCloth {
  double cloth_side = 2.0;       // metres
  double frame = 0.5;            // side of the frame that holds the rim of the cloth, in cloth sides
  double height = 1.15;          // of the frame above the ground, metres
  double sag = 0.6;              // of the cloth at the start, metres
  double radius = 0.2;           // of the sphere, metres
  double start = 0.9;            // of the sphere's centre, metres
  double push_time = 1.2;        // from when the sphere has no weight and is pushed out, seconds
  double hull_stiffness = 60.0;  // of that push, newtons a metre
  double push_drag = 5.0;        // of the sphere while it is pushed out, 1 / seconds
  ClothMaterial cloth{
      .density = 0.15, .stretch_stiffness = 400.0, .bend_stiffness = 0.02, .friction = 0.1, .drag = 1.5};
  SoftMaterial ball{.density = 120.0,
                    .surface_stiffness = 3000.0,
                    .bend_stiffness = 1000.0,
                    .inner_stiffness = 2000.0,
                    .bulk_modulus = 200000.0,
                    .shape_frequency = 20.0,
                    .shape_stretch = 0.0,
                    .friction = 0.1,
                    .drag = 0.8,
                    .skin = 0.008};
  DynamicsSettings dynamics{.time_step = 1.0 / 120.0, .substeps = 8, .settle_sweeps = 3, .slop = 0.002};
};

// A bag: the rim is held by a square frame that is smaller than the cloth.
Body bag(const SphereInCloth& p, int size) {
  Body cloth = make_cloth("cloth", grid_sheet(size, size, p.cloth_side, p.cloth_side), p.cloth);
  const double half = 0.5 * p.cloth_side;
  for (std::size_t v = 0; v < cloth.positions.size(); ++v) {
    Vec3& q = cloth.positions[v];
    const double rim = std::max(std::abs(q.x), std::abs(q.y)) / half;
    if (rim > 0.9999) cloth.inverse_masses[v] = 0.0;
    q = {p.frame * q.x, p.frame * q.y, p.height - p.sag * (1.0 - rim * rim)};
  }
  return cloth;
}

}  // namespace

// The paper's second demonstration: the direction is carried from step to step, so that the sphere is pushed out the
// way it came in, though the shortest way out is through the cloth.
Scene make_sphere_in_cloth(int size) {
  const SphereInCloth p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.view = {.azimuth = 30.0, .elevation = 14.0};
  scene.marks = {.hulls = true};
  scene.ground = 0.0;
  scene.shown = base::Box{{-0.55, -0.55, 0.0}, {0.55, 0.55, p.height + 2.5 * p.radius}};
  scene.paper = "a sphere wholly inside a very flexible cloth: the direction stays and pushes it out of the cloth";
  scene.add(make_soft("sphere", moved(sphere(3, p.radius), {0.02, 0.01, p.height + p.start - 0.6}), p.ball));
  scene.add(bag(p, size), {.opacity = 0.75});
  scene.script = [p](double time, std::vector<Body>& bodies) {
    const bool push = time > p.push_time;
    bodies[0].weight = push ? 0.0 : 1.0;
    bodies[0].hull_stiffness = push ? p.hull_stiffness : 0.0;
    bodies[0].drag = push ? p.push_drag : p.ball.drag;
  };
  return scene;
}

}  // namespace tact::scenes
