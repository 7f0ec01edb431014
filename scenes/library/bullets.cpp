#include <cmath>
#include <string>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

struct BulletsAndSheets {
  int sheets = 3;
  double side = 1.0;       // of a sheet, metres
  double distance = 0.35;  // between two, metres
  int vertices = 24;       // along a side
  double radius = 0.03;    // of a bullet, metres
  double speed = 60.0;     // of the first bullet, metres a second: a metre in a step
  double above = 1.2;      // of the first bullet over the upper sheet, metres
  double after = 0.3;      // from one bullet to the next, metres
  ClothMaterial cloth{.density = 0.8, .stretch_stiffness = 4000.0, .bend_stiffness = 0.3, .friction = 0.3, .drag = 2.0};
  SoftMaterial soft{.density = 200.0, .surface_stiffness = 400.0, .inner_damping = 20.0};
  // Two surfaces stay a millimetre apart.
  DynamicsSettings dynamics{.time_step = 1.0 / 60.0, .substeps = 1, .stay_within_reach = false, .margin = 0.0005};
};

// Held along two opposite sides.
Body held_sheet(const BulletsAndSheets& p, int index) {
  const Mesh mesh = moved(grid_sheet(p.vertices, p.vertices, p.side, p.side), {0.0, 0.0, -index * p.distance});
  Body sheet = make_cloth("sheet " + std::to_string(index + 1), mesh, p.cloth);
  for (std::size_t v = 0; v < sheet.positions.size(); ++v) {
    if (std::abs(sheet.positions[v].x) > 0.499 * p.side) sheet.inverse_masses[v] = 0.0;
  }
  return sheet;
}

}  // namespace

Scene make_bullets(int size) {
  const BulletsAndSheets p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.view = {.azimuth = 30.0, .elevation = 12.0};
  const double half = 0.5 * p.side;
  scene.shown = base::Box{{-half, -half, -p.sheets * p.distance}, {half, half, 0.6}};
  for (int k = 0; k < p.sheets; ++k) scene.add(held_sheet(p, k));
  Random random(7);
  for (int k = 0; k < size; ++k) {
    const Vec3 place{random.between(-0.3, 0.3) * p.side, random.between(-0.3, 0.3) * p.side, p.above + k * p.after};
    Body bullet = make_soft("bullet " + std::to_string(k + 1), moved(sphere(1, p.radius), place), p.soft);
    bullet.weight = 1.0;
    for (Vec3& velocity : bullet.velocities) velocity = {random.between(-2.0, 2.0), 0.0, -p.speed};
    scene.add(std::move(bullet));
  }
  return scene;
}

}  // namespace tact::scenes
