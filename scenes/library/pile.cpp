#include "scenes/library/pile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "scenes/library/catalog.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

struct Pile {
  std::uint64_t seed = 1;
  double body_size = 0.3;  // about the diameter of a body, metres
  double spacing = 1.2;    // of the bodies before they fall, in body sizes
  double widest = 1.15;    // of a body, in body sizes
  double room = 0.04;      // between the outermost bodies and the wall, metres
  double wall = 0.15;      // thickness of the bin, metres
  double bin_edges = 0.3;  // length of the edges of the bin's facets, metres
  SoftMaterial soft{.drag = 0.5, .thickness = 0.003};
  RigidMaterial bin{.friction = 0.5, .thickness = 0.003};
};
constexpr int kRigid = 3;  // each so manieth body of the scene is rigid

// Shapes of radius about 1. All are spheres pulled into form, so that facets stay of one size.
Vec3 ball(Vec3 p) { return p; }
Vec3 rounded_cube(Vec3 p) {
  const auto fourth = [](double x) { return (x * x) * (x * x); };
  return (0.9 / std::sqrt(std::sqrt(fourth(p.x) + fourth(p.y) + fourth(p.z)))) * p;
}
Vec3 star(Vec3 p) {
  const double flat = p.x * p.x + p.y * p.y;
  const double wave = 0.35 * flat * std::cos(5.0 * std::atan2(p.y, p.x));
  return {1.1 * (0.9 + wave) * p.x, 1.1 * (0.9 + wave) * p.y, 0.55 * p.z};
}
Vec3 bone(Vec3 p) {
  const double thick = 0.45 + 0.5 * p.z * p.z;
  return {thick * p.x, thick * p.y, 1.25 * p.z};
}
Vec3 bean(Vec3 p) { return {0.6 * p.x + 0.6 * (p.z * p.z - 0.4), 0.55 * p.y, 1.15 * p.z}; }
// The upper half of the sphere becomes the inside.
Vec3 bowl(Vec3 p) {
  const double inner = 1.0 - 0.45 * std::min(1.0, 2.5 * std::max(p.z, 0.0));
  return {inner * p.x, inner * p.y, p.z > 0.0 ? -0.5 * p.z : 0.95 * p.z};
}

struct Shape {
  const char* name;
  Vec3 (*shape)(Vec3);  // of a sphere; null: a ring
};

constexpr std::array kShapes = {Shape{"ball", ball},   Shape{"star", star}, Shape{"cube", rounded_cube},
                                Shape{"bone", bone},   Shape{"bean", bean}, Shape{"bowl", bowl},
                                Shape{"ring", nullptr}};

// No part of it is farther than `most` from the origin: neighbours of the grid do not begin in each other, however they
// are turned.
Mesh mesh_of(const Shape& shape, double most) {
  const Mesh mesh = shape.shape != nullptr ? shaped_sphere(2, shape.shape) : torus(20, 8, 0.7, 0.37);
  double radius = 0.0;
  for (const Vec3& p : mesh.positions) radius = std::max(radius, norm(p));
  return scaled(mesh, std::min(1.0, most / radius));
}

// The numbers from 0 to count - 1 in random order.
std::vector<int> shuffled(int count, Random& random) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  for (std::size_t i = numbers.size(); i > 1; --i) std::swap(numbers[i - 1], numbers[random.bits() % i]);
  return numbers;
}

double step_of(const Pile& p) { return p.spacing * p.body_size; }

}  // namespace

PileGrid pile_grid(int size, double most_layers) {
  const int side = static_cast<int>(std::ceil(std::max(std::cbrt(2.0 * size), std::sqrt(size / most_layers))));
  return {.side = side, .layers = (size + side * side - 1) / (side * side), .half = 0.5 * step_of(Pile{}) * side};
}

std::vector<Body> pile_bin(const PileGrid& grid) {
  const Pile p;
  const double half = grid.half + p.room, out = half + p.wall, height = step_of(p) * grid.layers + 0.2 * p.body_size;
  std::vector<Body> walls;
  const auto add = [&](const char* name, Vec3 lower, Vec3 upper) {
    walls.push_back(make_rigid(name, box(lower, upper, p.bin_edges), p.bin, Motion::fixed));
  };
  add("floor", {-out, -out, -p.wall}, {out, out, 0.0});
  add("left wall", {-out, -out, 0.0}, {-half, out, height});
  add("right wall", {half, -out, 0.0}, {out, out, height});
  add("front wall", {-half, -out, 0.0}, {half, -half, height});
  add("back wall", {-half, half, 0.0}, {half, out, height});
  return walls;
}

Body pile_body(int number, int place, const PileGrid& grid, PileBody kind, Random& random) {
  const Pile p;
  const int side = grid.side;
  const Vec3 cell{static_cast<double>(place % side), static_cast<double>(place / side % side),
                  static_cast<double>(place / (side * side))};
  const double loose = 0.5 * (p.spacing - p.widest) * p.body_size - p.soft.thickness;
  const Vec3 jitter{random.between(-loose, loose), random.between(-loose, loose), random.between(-loose, loose)};
  const Vec3 center = step_of(p) * (cell + Vec3{0.5, 0.5, 0.6}) - Vec3{grid.half, grid.half, 0.0} + jitter;
  const Shape& shape = kShapes[random.bits() % kShapes.size()];
  const Mesh mesh = moved(rotated(scaled(mesh_of(shape, p.widest), 0.5 * p.body_size), random), center);
  const std::string name = shape.name + (" " + std::to_string(number));
  return kind == PileBody::rigid ? make_hard(name, mesh, p.soft) : make_soft(name, mesh, p.soft);
}

DynamicsSettings pile_dynamics() {
  return {.time_step = 1.0 / 240.0, .substeps = 4, .most_reach = 0.006, .sleep = {.speed = 0.05, .room = 0.01}};
}

Scene make_pile(int size) {
  // So low that no body falls faster than contacts follow.
  constexpr double kMostLayers = 5.0;
  Random random(Pile{}.seed);
  const PileGrid grid = pile_grid(size, kMostLayers);
  Scene scene;
  scene.dynamics = pile_dynamics();
  scene.view = {.azimuth = 25.0, .elevation = 28.0};
  scene.ground = -0.01 * Pile{}.body_size;  // below the walls, so that they do not blend
  for (Body& wall : pile_bin(grid)) {
    const Look floor{.visible = false}, glass{.marked = false, .opacity = 0.07, .shading = Shading::flat};
    const bool is_floor = scene.bodies.empty();
    scene.add(std::move(wall), is_floor ? floor : glass);
  }
  const std::vector<int> places = shuffled(size, random);
  for (int i = 0; i < size; ++i) {
    const PileBody kind = i % kRigid == kRigid - 1 ? PileBody::rigid : PileBody::soft;
    scene.add(pile_body(i, places[i], grid, kind, random));
  }
  return scene;
}

}  // namespace tact::scenes
