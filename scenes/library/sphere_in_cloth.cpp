#include <algorithm>
#include <cmath>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

struct SphereInCloth {
  double cloth_side = 2.0;    // metres
  double frame = 0.5;         // side of the frame that holds the rim of the cloth, in cloth sides
  double height = 1.15;       // of the frame above the ground, metres
  double sag = 0.6;           // of the cloth at the start, metres
  double radius = 0.2;        // of the sphere, metres
  double start = 0.9;         // of the sphere's centre, metres
  double lift_time = 1.2;     // from when the sphere is lifted, seconds
  double lift_weight = -0.4;  // of the sphere then, weights: as if it were filled with helium
  ClothMaterial cloth{
      .density = 0.15, .stretch_stiffness = 400.0, .bend_stiffness = 0.02, .friction = 0.1, .drag = 6.0};
  SoftMaterial ball{.density = 120.0,
                    .surface_stiffness = 3000.0,
                    .bend_stiffness = 1000.0,
                    .inner_stiffness = 2000.0,
                    .bulk_modulus = 200000.0,
                    .shape_frequency = 20.0,
                    .shape_stretch = 0.0,
                    .friction = 0.1,
                    .drag = 3.0,
                    .thickness = 0.004};
  DynamicsSettings dynamics{.time_step = 1.0 / 120.0, .substeps = 8};
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

// The paper's second demonstration: the direction is carried from step to step, so that it tells the way that the
// sphere came in, and goes out again, though the shortest way out is through the cloth.
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
    if (time < p.lift_time) return;
    Body& ball = bodies[0];
    const bool is_out = ball.positions.front().z > p.height + 2.0 * p.radius;
    const double weight = is_out ? 0.0 : p.lift_weight;
    if (weight == ball.weight) return;
    ball.weight = weight;
    for (Body& body : bodies) body.asleep = false;
  };
  return scene;
}

}  // namespace tact::scenes
