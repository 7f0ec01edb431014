// Contact points: surfaces within their margins, and ones that have crossed.
#include <array>
#include <cstddef>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/hash_scene_list.h"
#include "tests/support/hashes/scene_player.h"

namespace tact::tests {
namespace {

Settings with_points(int threads) { return {.threads = threads, .outputs = {.patches = true, .points = true}}; }

SceneHashes drift_for(ScenePlayer& player, int steps, double speed) {
  Random random(player.size());
  for (int step = 0; step < steps; ++step) {
    if (step > 0) player.drift(speed, random);
    player.step();
  }
  return player.hashes();
}

}  // namespace

// Many small bodies that lie apart, nearer than their margins.
SceneHashes play_gaps(int threads) {
  ScenePlayer player(with_points(threads));
  for (const Mesh& blob : crowd_of_blobs(40, 4))
    player.add({.mesh = scaled(blob, 0.45, centroid(blob)), .margin = 0.2});
  for (int i = 0; i < 20; ++i) {
    Random random(static_cast<std::uint64_t>(100 + i));
    const Mesh box = rotated(centered_box({0.3, 0.2, 0.4}), random.rotation());
    player.add({.mesh = translated(box, random.in_cube(2.5)), .margin = 0.1});
  }
  player.add({.mesh = translated(wrinkled_sheet(8, 6.0, 0.4, 5), {0.0, 0.0, -2.0}),
              .surface = Surface::sheet,
              .margin = 0.15});
  return drift_for(player, 5, 0.05);
}

// Many small bodies that cross each other, with and without margins.
SceneHashes play_crossings(int threads) {
  ScenePlayer player(with_points(threads));
  int i = 0;
  for (const Mesh& blob : crowd_of_blobs(30, 6)) player.add({.mesh = blob, .margin = ++i % 3 == 0 ? 0.0 : 0.05});
  const Mesh ring = torus(16, 8, 1.0, 0.3);
  player.add({.mesh = ring, .margin = 0.02});
  player.add({.mesh = translated(rotated(ring, rotation(1.0, 0.9, 0.2, 0.1)), {1.0, 0.1, 0.0})});
  player.add({.mesh = translated(organ(3), {0.5, 0.5, 0.5})});
  player.add({.mesh = translated(tool(), {0.6, 0.5, 0.6}), .margin = 0.01});
  player.add({.mesh = translated(spike({0.3, 1.5, 0.2}, 0.4), {-1.0, 0.0, 0.5})});
  return drift_for(player, 6, 0.04);
}

// Flat sheets above each other whose edges are in line exactly, then but for ever smaller amounts, and shifted.
SceneHashes play_stacked_sheets(int threads) {
  ScenePlayer player(with_points(threads));
  constexpr int kSheets = 5;
  const auto layer = [](int i) {
    const Mesh flat = i == 3 ? sheet(7, 11, 1.0, 1.0) : sheet(10, 10, 1.0, 1.0);
    return translated(flat, {0.0, 0.0, 0.03125 * i});
  };
  for (int i = 0; i < kSheets; ++i) player.add({.mesh = layer(i), .surface = Surface::sheet, .margin = 0.02});
  player.step();
  std::uint64_t seed = 0;
  for (const double amount : {1e-15, 1e-13, 1e-10, 1e-7, 1e-4, 0.01, 0.03}) {
    for (int i = 0; i < kSheets; ++i)
      player.move(static_cast<std::size_t>(i), jittered(translated(layer(i), {0.001 * i, 0.0, 0.0}), amount, ++seed));
    player.step();
  }
  return player.hashes();
}

// Rods and boxes whose edges are nearly parallel, near the origin and far from it, apart and crossing.
SceneHashes play_parallel_edges(int threads) {
  ScenePlayer player(with_points(threads));
  const Mesh bar = centered_box({0.05, 0.05, 1.0});
  const std::array angles{0.0, 1e-16, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3, 0.1};
  Random random(8);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const Vec3 at = {4.0 * static_cast<double>(k), 0.0, k % 2 == 0 ? 0.0 : 1000.0};
    const Rotation any = random.rotation();
    const Mesh turned = rotated(bar, rotation(1.0, angles[k], 0.5 * angles[k], angles[k]));
    player.add({.mesh = translated(rotated(bar, any), at), .margin = 0.05});
    player.add({.mesh = translated(rotated(translated(turned, {0.11, 0.02, 0.3}), any), at), .margin = 0.05});
    player.add({.mesh = translated(rotated(translated(turned, {0.0, -0.15, 0.2}), any), at), .margin = 0.05});
  }
  player.step();
  // The second of each three sinks into the first.
  for (int step = 0; step < 4; ++step) {
    for (std::size_t i = 1; i < player.size(); i += 3) {
      const Vec3 from = centroid(player.mesh(i)), to = centroid(player.mesh(i - 1));
      player.shift(i, 0.1 * (to - from));
    }
    player.step();
  }
  return player.hashes();
}

// A rod and a ball pressed into sheets, and through them; sheets that cross each other.
SceneHashes play_cut_sheets(int threads) {
  ScenePlayer player(with_points(threads));
  const Mesh cloth = wrinkled_sheet(14, 2.0, 0.1, 1);
  player.add({.mesh = cloth, .surface = Surface::sheet, .margin = 0.01});
  player.add({.mesh = translated(tool(), {0.3, 0.2, 1.2}), .margin = 0.01});
  player.add({.mesh = translated(icosphere(2, 0.3), {-0.5, -0.3, 0.42})});
  player.add({.mesh = translated(cloth, {0.1, 0.05, 0.02}), .surface = Surface::sheet});
  const Mesh upright = rotated(sheet(9, 9, 1.0, 1.0), rotation(1.0, 0.9, 0.0, 0.1));
  player.add({.mesh = translated(upright, {0.2, -0.6, 0.45}), .surface = Surface::sheet, .margin = 0.02});
  Random random(3);
  player.step();
  for (int step = 0; step < 8; ++step) {
    player.shift(1, {0.0, 0.002 * step, -0.06});
    player.shift(2, {0.003, 0.0, -0.05});
    player.shift(4, {0.01, 0.0, -0.03});
    player.move(0, jittered(player.mesh(0), 0.003, random.bits()));
    player.step();
  }
  return player.hashes();
}

// Bodies wholly inside others, that come out of them.
SceneHashes play_nested(int threads) {
  ScenePlayer player(with_points(threads));
  player.add({.mesh = blob(3, 2.0, 0.2, 1), .margin = 0.05});
  player.add({.mesh = translated(cube(0.5, {0.2, 0.1, 0.0}), {0.3, 0.0, 0.0}), .margin = 0.05});
  player.add(
      {.mesh = translated(wrinkled_sheet(6, 0.8, 0.1, 2), {0.0, 0.0, 0.8}), .surface = Surface::sheet, .margin = 0.1});
  player.add({.mesh = translated(icosphere(1, 0.3), {-0.5, -0.5, -0.5})});
  player.add({.mesh = translated(icosphere(0, 0.1), {-0.5, -0.5, -0.5})});
  player.step();
  for (int step = 0; step < 6; ++step) {
    player.shift(1, {0.25, 0.01, 0.0});
    player.shift(2, {0.0, 0.02, 0.2});
    player.shift(3, {-0.2, -0.2, 0.0});
    player.step();
  }
  return player.hashes();
}

// Facets without area, coplanar, touching and repeated ones; needles; noise.
SceneHashes play_degenerate(int threads) {
  ScenePlayer player(with_points(threads));
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Surface surface = seed % 2 == 0 ? Surface::closed : Surface::sheet;
    const double margin = seed <= 2 ? 0.0 : 0.25;
    player.add({.mesh = lattice_soup(24, 3, seed), .surface = surface, .margin = margin});
    player.add({.mesh = soup(12, 3.0, seed), .surface = surface, .margin = margin});
    player.add({.mesh = scaled(needles(6, 1e-6, seed), 3.0), .surface = surface, .margin = margin});
  }
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const Mesh& body : kissing_bodies(seed)) player.add({.mesh = body, .margin = seed % 2 == 0 ? 0.0 : 0.01});
  }
  player.step();
  for (std::size_t i = 0; i < 12; ++i) player.shift(i, i % 2 == 0 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 0.5, 0.25});
  player.step();
  for (std::size_t i = 0; i < 12; ++i) player.move(i, jittered(player.mesh(i), 1e-9, i));
  player.step();
  return player.hashes();
}

// Bodies of some hundred clusters: threads share each pair.
SceneHashes play_many_clusters(int threads) {
  ScenePlayer player(with_points(threads));
  player.add({.mesh = wrinkled_sheet(56, 3.0, 0.05, 1), .surface = Surface::sheet, .margin = 0.01});
  player.add({.mesh = translated(wrinkled_sheet(60, 3.0, 0.05, 1), {0.0, 0.0, 0.015}),
              .surface = Surface::sheet,
              .margin = 0.01});
  player.add({.mesh = translated(icosphere(4, 1.0), {0.1, 0.1, 1.05}), .margin = 0.02});
  player.add({.mesh = translated(blob(4, 1.0, 0.2, 2), {0.3, 0.2, -0.95})});
  Random random(4);
  player.step();
  for (int step = 0; step < 3; ++step) {
    player.shift(2, {0.01, 0.0, -0.03});
    player.move(1, jittered(player.mesh(1), 0.001, random.bits()));
    player.step();
  }
  return player.hashes();
}

// Sheets of so many clusters that trees find their pairs.
SceneHashes play_cluster_trees(int threads) {
  ScenePlayer player(with_points(threads));
  player.add({.mesh = wrinkled_sheet(190, 4.0, 0.05, 3), .surface = Surface::sheet, .margin = 0.001});
  player.add({.mesh = translated(wrinkled_sheet(191, 4.0, 0.05, 3), {0.0, 0.0, 0.0015}),
              .surface = Surface::sheet,
              .margin = 0.001});
  player.step();
  player.shift(1, {0.003, 0.001, -0.0004});
  player.step();
  return player.hashes();
}

// Intersection curves, and which points are minima: bodies in general position, boxes that have planes, lines and
// places in common, and what crosses itself.
SceneHashes play_curves(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.points = true, .curves = true}});
  for (const Mesh& blob : crowd_of_blobs(12, 8)) player.add({.mesh = blob, .margin = 0.05});
  player.add({.mesh = translated(wrinkled_sheet(12, 4.0, 0.3, 2), {0.0, 0.0, 0.2}),
              .surface = Surface::sheet,
              .margin = 0.02});
  const Mesh grid = gridded_box({0.0, 0.0, 5.0}, {1.0, 1.0, 6.0}, 2);
  for (int i = 0; i < 4; ++i)
    player.add({.mesh = translated(grid, {0.25 * i, 0.5 * (i % 2), 0.25 * (i / 2)}), .margin = 0.01});
  player.add({.mesh = translated(crumpled(icosphere(2), 9), {0.0, 5.0, 0.0}), .self_contact = true});
  player.add(
      {.mesh = translated(lattice_soup(40, 3, 5), {0.0, -8.0, 0.0}), .surface = Surface::sheet, .self_contact = true});
  return drift_for(player, 3, 0.05);
}

}  // namespace tact::tests
