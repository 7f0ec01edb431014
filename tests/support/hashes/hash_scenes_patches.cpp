// Patches, their ids and events, and what calls between steps do to them.
#include <array>
#include <cstddef>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/hash_scene_list.h"
#include "tests/support/hashes/scene_player.h"

namespace tact::tests {
namespace {

// A table on four legs that sinks into a bumpy ground and is lifted again, a sheet that is lowered onto bumps, so that
// patches begin, merge, split and end.
SceneHashes sink_and_rise(const Settings& settings, double margin) {
  ScenePlayer player(settings);
  player.add({.mesh = wrinkled_sheet(24, 3.0, 0.3, 4), .surface = Surface::sheet, .margin = margin});
  std::vector<Mesh> parts{translated(box({-0.8, -0.6, 0.5}, {0.8, 0.6, 0.6}), {})};
  for (const double x : {-0.7, 0.6}) {
    for (const double y : {-0.5, 0.4}) parts.push_back(gridded_box({x, y, 0.0}, {x + 0.1, y + 0.1, 0.55}, 3));
  }
  player.add({.mesh = translated(merged(parts), {0.0, 0.0, 0.2}), .margin = margin});
  player.add({.mesh = translated(wrinkled_sheet(20, 2.5, 0.25, 8), {0.1, 0.0, 0.28}),
              .surface = Surface::sheet,
              .margin = margin});
  player.add({.mesh = translated(torus(32, 8, 0.5, 0.1), {1.0, 1.0, 0.2}), .margin = margin});
  player.step();
  for (const double rise : {-0.06, -0.06, -0.06, -0.06, 0.05, 0.05, 0.06, 0.08}) {
    player.shift(1, {0.004, 0.0, rise});
    player.shift(2, {0.0, 0.006, 0.8 * rise});
    player.move(3, rotated(translated(player.mesh(3), {0.0, 0.0, rise}), rotation(1.0, 0.01, 0.005, 0.0)));
    player.step();
  }
  return player.hashes();
}

}  // namespace

SceneHashes play_patches(int threads) {
  return sink_and_rise({.threads = threads, .outputs = {.zones = true, .patches = true, .points = true}}, 0.02);
}

SceneHashes play_patches_of_facets(int threads) {
  return sink_and_rise({.threads = threads, .outputs = {.patches = true}}, 0.0);
}

// A plate between jaws that close: two patches a pair of bodies, and one body between two.
SceneHashes play_clamp(int threads) {
  ScenePlayer player({.threads = threads, .outputs = {.patches = true, .points = true}});
  const std::vector<Mesh> jaws{gridded_box({-1.0, -0.5, 0.1}, {0.5, 0.5, 0.5}, 6),
                               gridded_box({-1.0, -0.5, -0.5}, {0.5, 0.5, -0.1}, 6),
                               box({-1.2, -0.5, -0.5}, {-1.0, 0.5, 0.5})};
  const Mesh clamp = merged(jaws);
  player.add({.mesh = clamp, .margin = 0.02});
  player.add({.mesh = gridded_box({-0.3, -0.4, -0.07}, {1.0, 0.4, 0.07}, 5), .margin = 0.02});
  player.add({.mesh = translated(sheet(6, 6, 0.6, 0.6), {0.1, 0.0, 0.09}), .surface = Surface::sheet, .margin = 0.01});
  player.step();
  const std::array closings{0.01, 0.02, 0.03, 0.05, 0.02, -0.02};
  for (const double closing : closings) {
    player.move(0, mapped(clamp, [&](Vec3 p) {
                  if (p.x > -1.1) p.z += p.z > 0.0 ? -closing : closing;
                  return p;
                }));
    player.step();
  }
  return player.hashes();
}

// Calls between steps: margins, self-contact, layers, groups, exclusions, motions, settings, removal, new bodies.
SceneHashes play_calls(int threads) {
  const Settings settings{.threads = threads, .outputs = {.patches = true, .points = true}};
  ScenePlayer player(settings);
  for (const Mesh& blob : crowd_of_blobs(16, 3)) player.add({.mesh = blob, .margin = 0.02});
  player.add({.mesh = pleated(sheet(24, 4, 3.0, 1.0), 1, 0.5, 0.2), .surface = Surface::sheet});
  Random random(13);
  World& world = player.world();
  const auto next = [&] {
    player.drift(0.03, random);
    player.step();
  };
  player.step();
  world.set_margin(player.id(1), 0.2);
  world.set_self_contact(player.id(16), true);
  next();
  world.set_layers(player.id(2), 2, 2);
  world.set_group(player.id(3), 1);
  world.set_group(player.id(4), 1);
  for (std::size_t i = 6; i < 12; ++i) world.set_excluded(player.id(5), player.id(i), true);
  next();
  player.step();  // nothing moved
  player.remove(15);
  player.add({.mesh = blob(1, 0.9, 0.2, 77), .margin = 0.1});
  world.set_motion(player.id(0), Motion::fixed);
  player.step();
  world.set_motion(player.id(0), Motion::deformable);
  world.set_layers(player.id(2), 1, 0xffffffffu);
  for (std::size_t i = 6; i < 12; ++i) world.set_excluded(player.id(5), player.id(i), false);
  player.step();
  Settings other = settings;
  other.direction = DirectionPolicy::smallest;
  other.outputs.zones = true;
  world.set_settings(other);
  player.step();
  other.accuracy = Accuracy::paper;
  world.set_settings(other);
  player.shift(6, {0.05, 0.0, 0.0});
  player.step();
  other.accuracy = Accuracy::hulls;
  world.set_settings(other);
  player.shift(7, {0.05, 0.0, 0.0});
  player.step();
  world.set_settings(settings);
  world.set_self_contact(player.id(16), false);
  player.shift(8, {0.05, 0.0, 0.0});
  player.step();
  return player.hashes();
}

}  // namespace tact::tests
