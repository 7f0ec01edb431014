#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"
#include "scenes/library/smooth_step.h"

namespace tact::scenes {
namespace {

struct ClothFold {
  double side = 1.6;         // of the sheet, metres
  int folds = 4;             // each of them lays what is folded so far over the next strip
  double strip = 0.32;       // metres
  double free = 0.12;        // of a strip, beside the crease, that nobody holds, metres
  double begin = 0.3;        // of the first fold, seconds
  double move_time = 2.0;    // in which a strip is turned over, seconds
  double rest_time = 0.8;    // from then to the next fold, seconds
  double clearance = 0.004;  // of the carried half over what it is laid on, metres
  ClothMaterial cloth{.density = 0.3,
                      .stretch_stiffness = 1500.0,
                      .bend_stiffness = 0.15,
                      .friction = 0.5,
                      .drag = 1.5,
                      .thickness = 0.001};
  RigidMaterial table{.friction = 0.8, .thickness = 0.001};
  DynamicsSettings dynamics{
      .time_step = 1.0 / 120.0, .substeps = 8, .most_reach = 0.004, .guarded = true, .margin = 0.0002};
};

// Takes the strip that is farthest along x with all that lies on it, turns it over, and lets go.
class Folder {
 public:
  explicit Folder(const ClothFold& p) : p_(p) {}

  void operator()(double time, std::vector<Body>& bodies) {
    Body& sheet = bodies[0];
    const double a_fold = p_.move_time + p_.rest_time;
    const int fold = static_cast<int>(std::floor((time - p_.begin) / a_fold));
    const bool carries = time >= p_.begin && fold < p_.folds && time - p_.begin - fold * a_fold < p_.move_time;
    if (!carries) {
      if (!held_.empty()) let_go(sheet);
      return;
    }
    if (held_.empty()) take(sheet, fold);
    sheet.asleep = false;
    carry(sheet, std::numbers::pi * smooth_step((time - p_.begin - fold * a_fold) / p_.move_time));
  }

 private:
  struct Held {
    std::size_t vertex;
    Vec3 from;
    double inverse_mass;
  };

  void take(Body& sheet, int fold) {
    double top = 0.0;
    for (const Vec3& p : sheet.positions) top = std::max(top, p.z);
    crease_ = 0.5 * p_.side - (fold + 1) * p_.strip;
    height_ = top + sheet.thickness + p_.clearance;
    for (std::size_t v = 0; v < sheet.positions.size(); ++v) {
      if (sheet.positions[v].x < crease_ + p_.free) continue;
      held_.push_back({v, sheet.positions[v], sheet.inverse_masses[v]});
      sheet.inverse_masses[v] = 0.0;
    }
  }

  // About an axis above the crease: what comes down lies on what is there.
  void carry(Body& sheet, double angle) {
    for (const Held& held : held_) {
      const double out = held.from.x - crease_, up = held.from.z - height_;
      sheet.positions[held.vertex] = {crease_ + out * std::cos(angle) - up * std::sin(angle), held.from.y,
                                      height_ + out * std::sin(angle) + up * std::cos(angle)};
    }
  }

  void let_go(Body& sheet) {
    for (const Held& held : held_) {
      sheet.inverse_masses[held.vertex] = held.inverse_mass;
      sheet.velocities[held.vertex] = {};
    }
    held_.clear();
  }

  ClothFold p_;
  std::vector<Held> held_;
  double crease_ = 0.0, height_ = 0.0;  // metres
};

}  // namespace

// A sheet on a table is folded over four times, into five layers.
Scene make_cloth_fold(int size) {
  const ClothFold p;
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.view = {.azimuth = 35.0, .elevation = 24.0};
  const double half = 0.5 * p.side;
  scene.shown = base::Box{{-half, -half, 0.0}, {half, half, 0.45}};
  const Mesh mesh = moved(grid_sheet(size, size, p.side, p.side), {0.0, 0.0, 2.5 * p.cloth.thickness});
  Body sheet = make_cloth("sheet", mesh, p.cloth);
  sheet.self_contact = true;
  scene.add(std::move(sheet));
  scene.add(make_rigid("table", box({-1.2 * half, -1.2 * half, -0.05}, {1.2 * half, 1.2 * half, 0.0}, 0.2), p.table,
                       Motion::fixed),
            {.marked = false, .shading = Shading::flat});
  scene.script = Folder(p);
  return scene;
}

}  // namespace tact::scenes
