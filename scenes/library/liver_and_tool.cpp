#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

struct LiverAndTool {
  int around = 25, rings = 10;          // of the organ: 2 * 25 * 10 = 500 facets
  double tool_radius = 0.009;           // metres
  double tool_length = 0.22;            // metres
  double tilt = 0.35;                   // of the tool, radians
  double poke_time = 1.0;               // seconds
  double above = 0.035, below = 0.018;  // how far the tip goes over and into the organ, metres
  SoftMaterial organ{.density = 1060.0,
                     .surface_stiffness = 300.0,
                     .bend_stiffness = 100.0,
                     .inner_stiffness = 250.0,
                     .bulk_modulus = 60000.0,
                     .shape_frequency = 6.0,
                     .friction = 0.4,
                     .drag = 0.5,
                     .inner_damping = 12.0,
                     .thickness = 0.0008};
  RigidMaterial steel{.friction = 0.1, .thickness = 0.0008};
  RigidMaterial table{.friction = 0.8, .thickness = 0.0008};
  DynamicsSettings dynamics{.time_step = 1.0 / 120.0, .substeps = 6, .least_reach = 0.0004, .most_reach = 0.004};
};

// A large lobe that tapers to a small one, hollow below, with a notch between them.
Vec3 liver(Vec3 p) {
  const double taper = 1.0 - 0.45 * p.x;
  const double notch = 1.0 - 0.35 * std::exp(-20.0 * (p.x - 0.25) * (p.x - 0.25)) * std::max(0.0, -p.y);
  const double hollow = p.z < 0.0 ? 0.35 + 0.35 * (p.x * p.x + p.y * p.y) : 1.0;
  return {0.12 * p.x, 0.075 * taper * notch * p.y, 0.045 * taper * hollow * p.z};
}

// A rod with round ends along z, its lower tip at the origin.
Mesh rod(double radius, double length) {
  return moved(shaped_globe(16, 21,
                            [&](Vec3 p) {
                              const double square = p.z * p.z;
                              const double eighth = (square * square) * (square * square);
                              const double across = std::max(std::sqrt(p.x * p.x + p.y * p.y), 1e-9);
                              const double r = radius * std::sqrt(std::max(0.0, 1.0 - eighth)) / across;
                              return Vec3{r * p.x, r * p.y, 0.5 * length * p.z};
                            }),
               {0.0, 0.0, 0.5 * length});
}

double top_of(const Body& body, double x, double y) {
  double top = 0.0, nearest = 1e9;
  for (const Vec3& p : body.positions) {
    const double distance = (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y);
    if (p.z > 0.02 && distance < nearest) nearest = distance, top = p.z;
  }
  return top;
}

}  // namespace

Scene make_liver_and_tool(int /*size*/) {
  const LiverAndTool p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.view = {.azimuth = 20.0, .elevation = 30.0};
  scene.ground = 0.0;
  scene.shown = base::Box{{-0.14, -0.11, 0.0}, {0.14, 0.1, 0.16}};
  scene.paper = "500 facets at 12 steps a second, about 1 iteration a contact";
  const Mesh organ = moved(shaped_globe(p.around, p.rings, liver), {0.0, 0.0, 0.032});
  const Mesh tool = rotated(rod(p.tool_radius, p.tool_length), {1.0, 0.0, 0.0}, p.tilt);
  scene.add(make_soft("liver", organ, p.organ));
  scene.add(make_rigid("tool", tool, p.steel, Motion::deformable));
  scene.add(make_rigid("table", box({-0.5, -0.5, -0.1}, {0.5, 0.5, 0.0}, 0.05), p.table, Motion::fixed),
            {.visible = false});
  const double left = top_of(scene.bodies[0], -0.06, 0.0), right = top_of(scene.bodies[0], 0.06, 0.0);
  scene.script = [p, rest = tool.positions, left, right](double time, std::vector<Body>& bodies) {
    const double phase = time / p.poke_time;
    const double x = -0.06 * std::cos(0.45 * std::numbers::pi * phase);
    const double top = left + (right - left) * (0.5 + x / 0.12);
    const double z =
        top + 0.5 * (p.above - p.below) + 0.5 * (p.above + p.below) * std::cos(2.0 * std::numbers::pi * phase);
    for (std::size_t v = 0; v < rest.size(); ++v) bodies[1].positions[v] = rest[v] + Vec3{x, 0.0, z};
  };
  return scene;
}

}  // namespace tact::scenes
