// Bodies of edges and points, and planes.
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/hashes/hash_scene_list.h"
#include "tests/support/hashes/scene_player.h"

namespace tact::tests {
namespace {

Settings bare_settings(int threads) { return {.threads = threads, .outputs = {.patches = true, .points = true}}; }

struct BareBody {
  BodyId id;
  Eigen::Matrix3Xd positions;
};

// A rope that hangs between random places, and grains in a box.
BareBody add_rope(World& world, Random& random) {
  constexpr int kVertices = 24;
  Eigen::Matrix3Xd positions(3, kVertices);
  Eigen::Matrix2Xi edges(2, kVertices - 1);
  const Vec3 from = random.in_cube(1.0), to = random.in_cube(1.0);
  for (int k = 0; k < kVertices; ++k) {
    const double t = k / (kVertices - 1.0);
    const Vec3 p = (1.0 - t) * from + t * to;
    positions.col(k) << p.x, p.y, p.z - 0.8 * t * (1.0 - t);
    if (k > 0) edges.col(k - 1) << k - 1, k;
  }
  const BodyId id = world.add_body(
      {.positions = positions, .edges = edges, .margin = random.uniform(0.0, 0.05), .self_contact = true});
  return {id, positions};
}

BareBody add_grains(World& world, Random& random) {
  constexpr int kGrains = 150;
  Eigen::Matrix3Xd positions(3, kGrains);
  std::vector<int> points(kGrains);
  for (int k = 0; k < kGrains; ++k) {
    const Vec3 p = random.in_cube(1.0);
    positions.col(k) << p.x, p.y, p.z;
    points[static_cast<std::size_t>(k)] = k;
  }
  const BodyId id =
      world.add_body({.positions = positions, .points = points, .margin = 0.03, .self_contact = random.chance(0.5)});
  return {id, positions};
}

void tremble(World& world, BareBody& body, double amount, Random& random) {
  for (double& x : body.positions.reshaped()) x += random.uniform(-amount, amount);
  world.set_positions(body.id, body.positions);
}

}  // namespace

// Ropes and grains among each other and among surfaces, apart and crossing.
SceneHashes play_bare(int threads) {
  ScenePlayer player(bare_settings(threads));
  Random random(55);
  std::vector<BareBody> bodies;
  for (int i = 0; i < 8; ++i) bodies.push_back(add_rope(player.world(), random));
  for (int i = 0; i < 3; ++i) bodies.push_back(add_grains(player.world(), random));
  player.add({.mesh = blob(2, 0.5, 0.2, 5), .margin = 0.02});
  player.add({.mesh = wrinkled_sheet(10, 2.0, 0.3, 6), .surface = Surface::sheet, .margin = 0.03});
  for (int step = 0; step < 5; ++step) {
    player.step();
    for (BareBody& body : bodies) {
      if (random.chance(0.8)) tremble(player.world(), body, 0.03, random);
    }
    player.find_impacts(Impacts::all);
  }
  return player.hashes();
}

// Bodies of every kind that sink into three planes, near the origin and far from it.
SceneHashes play_planes(int threads) {
  ScenePlayer player(bare_settings(threads));
  Random random(56);
  World& world = player.world();
  world.add_plane({.normal = {0.0, 0.0, 1.0}, .offset = -0.9, .margin = 0.05});
  std::vector<BareBody> bodies;
  for (int i = 0; i < 4; ++i) bodies.push_back(add_rope(world, random));
  bodies.push_back(add_grains(world, random));
  world.add_plane({.normal = {0.0, -0.6, 0.8}, .offset = -0.7});
  player.add({.mesh = translated(blob(2, 0.5, 0.2, 5), {0.2, 0.1, -0.6}), .margin = 0.02});
  player.add({.mesh = translated(wrinkled_sheet(30, 2.0, 0.3, 6), {0.0, 0.0, -0.8}), .surface = Surface::sheet});
  player.add({.mesh = translated(centered_box({0.2, 0.2, 0.2}), {0.5, 0.5, -0.8}), .motion = Motion::rigid});
  const Vec3 normal = random.direction();
  world.add_plane({.normal = {normal.x, normal.y, normal.z}, .offset = 1e4, .mask = 0});
  for (int step = 0; step < 5; ++step) {
    player.step();
    for (BareBody& body : bodies) tremble(world, body, 0.02, random);
    player.shift(0, {0.0, 0.01, -0.04});
    player.shift(1, {0.0, 0.0, -0.03});
    player.find_impacts(Impacts::all);
  }
  return player.hashes();
}

}  // namespace tact::tests
