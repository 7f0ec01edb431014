// Bodies against themselves: facet pairs and points, before and after they cross themselves.
#include <array>
#include <cstddef>

#include "tests/support/generators/bodies.h"
#include "tests/support/hashes/hash_scene_list.h"
#include "tests/support/hashes/scene_player.h"

namespace tact::tests {
namespace {

// Overhangs of two waves: none, apart, near, touching, crossing, and back.
constexpr std::array kOverhangs{0.0, 0.06, 0.17, 0.183, 0.1875, 0.21, 0.185, 0.1};

// Two sheets and a border between them: a thin closed body.
Mesh plate(int cells_x, int cells_y, double thickness) {
  const Mesh flat = sheet(cells_x, cells_y, 1.0, 0.3);
  MeshBuilder builder;
  for (const double z : {0.0, thickness}) {
    for (int v = 0; v < flat.vertex_count(); ++v) builder.vertex(flat.position(v) + Vec3{0.0, 0.0, z});
  }
  const int top = flat.vertex_count(), row = cells_x + 1;
  for (int f = 0; f < flat.facet_count(); ++f) {
    const int i = flat.facets(0, f), j = flat.facets(1, f), k = flat.facets(2, f);
    builder.facet(i, k, j);
    builder.facet(top + i, top + j, top + k);
  }
  const auto border = [&](int i, int j) { builder.quad(i, j, top + j, top + i); };
  for (int i = 0; i < cells_x; ++i) {
    border(i, i + 1);
    border(cells_y * row + i + 1, cells_y * row + i);
  }
  for (int j = 0; j < cells_y; ++j) {
    border((j + 1) * row, j * row);
    border(j * row + cells_x, (j + 1) * row + cells_x);
  }
  return builder.mesh();
}

}  // namespace

// Sheets with and without margins, smooth, crumpled and flat; one that others lie on.
SceneHashes play_self_sheets(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.patches = true, .points = true}});
  const Mesh flat = sheet(48, 8, 1.0, 0.3);
  for (const double margin : {0.0, 0.005, 0.02}) {
    player.add({.mesh = translated(flat, {0.0, static_cast<double>(player.size()), 0.0}),
                .surface = Surface::sheet,
                .margin = margin,
                .self_contact = true});
  }
  player.add({.mesh = translated(crumpled(sheet(8, 8, 1.0, 1.0), 5), {0.0, 5.0, 0.0}),
              .surface = Surface::sheet,
              .self_contact = true});
  player.add({.mesh = lattice_soup(40, 4, 7), .surface = Surface::sheet, .margin = 0.1, .self_contact = true});
  player.add({.mesh = translated(icosphere(1, 0.3), {0.0, 1.0, 0.4}), .margin = 0.01, .self_contact = true});
  Random random(6);
  for (const double overhang : kOverhangs) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Mesh folded = translated(pleated(flat, 2, 0.3, overhang), {0.0, static_cast<double>(i), 0.0});
      player.move(i, jittered(folded, i == 0 ? 0.0 : 0.0005, random.bits()));
    }
    player.move(3, jittered(player.mesh(3), 0.02, random.bits()));
    player.shift(5, {0.0, 0.0, -0.03});
    player.step();
  }
  return player.hashes();
}

// Closed bodies: a plate that is folded, a torus that grows through its middle, noise.
SceneHashes play_self_closed(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.patches = true, .points = true}});
  const Mesh flat = plate(44, 5, 0.01);
  for (const double y : {0.0, 5.0})
    player.add({.mesh = translated(flat, {0.0, y, 0.0}), .margin = 0.001 * y, .self_contact = true});
  for (const double x : {10.0, 15.0})
    player.add({.mesh = translated(torus(16, 8, 1.0, 0.5), {x, 0.0, 0.0}),
                .margin = 0.002 * (x - 10.0),
                .self_contact = true});
  player.add({.mesh = translated(jittered(icosphere(2), 0.2, 3), {20.0, 0.0, 0.0}), .self_contact = true});
  Random random(9);
  int step = 0;
  for (const double overhang : kOverhangs) {
    for (std::size_t i = 0; i < 2; ++i)
      player.move(i, translated(pleated(flat, 2, 0.3, overhang), {0.0, i == 0 ? 0.0 : 5.0, 0.0}));
    const double minor = 0.8 + 0.06 * step;
    for (std::size_t i = 0; i < 2; ++i)
      player.move(2 + i, translated(torus(16, 8, 1.0, minor), {i == 0 ? 10.0 : 15.0, 0.0, 0.0}));
    player.move(4, jittered(player.mesh(4), 0.02, random.bits()));
    player.step();
    ++step;
  }
  return player.hashes();
}

// Facet pairs and patches without points, beside contacts of bodies with each other.
SceneHashes play_self_facets(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.patches = true}});
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    player.add({.mesh = soup(60, 1.0, seed), .surface = Surface::sheet, .self_contact = true});
    player.add({.mesh = lattice_soup(50, 5, seed), .margin = 0.1, .self_contact = true});
    player.add({.mesh = crumpled(icosphere(1), seed), .self_contact = true});
  }
  Random random(2);
  for (int step = 0; step < 4; ++step) {
    if (step > 0) player.drift(0.1, random);
    player.step();
  }
  return player.hashes();
}

// So many clusters that trees find their pairs, shared by threads.
SceneHashes play_self_large(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.points = true}});
  const Mesh flat = sheet(420, 84, 1.0, 0.2);
  player.add({.mesh = flat, .surface = Surface::sheet, .margin = 0.0008, .self_contact = true});
  for (const double overhang : {0.187, 0.2}) {
    player.move(0, pleated(flat, 2, 0.3, overhang));
    player.step();
  }
  player.world().set_margin(player.id(0), 0.0);
  player.step();
  return player.hashes();
}

}  // namespace tact::tests
