
#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"
#include "scenes/library/smooth_step.h"

namespace tact::scenes {
namespace {

struct Clamp {
  int opening = 14, jaw = 2, height = 13, bridge = 2, depth = 10;  // of the clamp, in cells
  double cell = 0.03;                                              // metres
  double radius = 0.15;                                            // of the ball, metres
  double closed = 0.68;                                        // width of the closed clamp, in widths of the open one
  double close_time = 0.6, lift_start = 0.8, lift_time = 0.9;  // seconds
  double lift = 0.35;                                          // metres
  SoftMaterial ball{.surface_stiffness = 2000.0,
                    .bend_stiffness = 1000.0,
                    .inner_stiffness = 1200.0,
                    .shape_frequency = 12.0,
                    .friction = 1.5,
                    .inner_damping = 10.0,
                    .thickness = 0.002};
  RigidMaterial steel{.friction = 1.5, .thickness = 0.002};
  RigidMaterial ground{.friction = 0.5, .thickness = 0.002};
  DynamicsSettings dynamics{.time_step = 1.0 / 120.0, .substeps = 6};
};

// Upside down: the bridge is on top.
Mesh clamp_mesh(const Clamp& p) {
  std::vector<std::array<int, 3>> filled;
  const int width = p.opening + 2 * p.jaw;
  for (int i = 0; i < width; ++i) {
    const bool in_jaw = i < p.jaw || i >= width - p.jaw;
    for (int k = in_jaw ? 0 : p.height - p.bridge; k < p.height; ++k) {
      for (int j = 0; j < p.depth; ++j) filled.push_back({i, j, k});
    }
  }
  return moved(cells(filled, {p.cell, p.cell, p.cell}), {-0.5 * width * p.cell, -0.5 * p.depth * p.cell, 0.02});
}

}  // namespace

// A body held from two opposite sides by another: case 2 of the paper's figure 1.
Scene make_clamp(int /*size*/) {
  const Clamp p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.view = {.azimuth = 25.0, .elevation = 10.0};
  scene.ground = 0.0;
  scene.shown = base::Box{{-0.27, -0.15, 0.0}, {0.27, 0.12, 0.76}};
  scene.paper = "a body touched from two opposite sides is excluded; criterion 1 then drops true contacts";
  const Mesh clamp = clamp_mesh(p);
  scene.add(make_rigid("clamp", clamp, p.steel, Motion::deformable), {.shading = Shading::flat});
  scene.add(make_soft("ball", moved(sphere(3, p.radius), {0.0, 0.0, p.radius + 0.007}), p.ball));
  scene.add(make_rigid("ground", box({-1.0, -1.0, -0.2}, {1.0, 1.0, 0.0}, 0.2), p.ground, Motion::fixed),
            {.visible = false});
  scene.script = [p, rest = clamp.positions](double time, std::vector<Body>& bodies) {
    const double width = 1.0 - (1.0 - p.closed) * smooth_step(time / p.close_time);
    const double up = p.lift * smooth_step((time - p.lift_start) / p.lift_time);
    for (std::size_t v = 0; v < rest.size(); ++v) {
      bodies[0].positions[v] = {width * rest[v].x, rest[v].y, rest[v].z + up};
    }
  };
  return scene;
}

}  // namespace tact::scenes
