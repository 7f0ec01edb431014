#include "tests/support/hashes/hash_scenes.h"

#include <tact/tact.h>

#include <array>
#include <bit>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/work_hash.h"

namespace tact::tests {
namespace {

// Steps over `bodies`, all of which drift and tremble, and a few of which stand still in each step.
std::uint64_t folded(std::uint64_t fold, std::uint64_t hash) {
  return std::rotl(fold, 17) * 0x9e3779b97f4a7c15u ^ hash;
}

SceneHashes play(std::vector<Mesh> bodies, const Settings& settings, int steps, double speed) {
  World world(settings);
  std::vector<BodyId> ids;
  for (const Mesh& body : bodies) ids.push_back(world.add_body({.positions = body.positions, .facets = body.facets}));
  Random random(bodies.size());
  SceneHashes hashes;
  for (int step = 0; step < steps; ++step) {
    const Report& report = world.detect();
    hashes = {folded(hashes.answers, report.hash()), folded(hashes.work, work_hash(report))};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (random.chance(0.25)) continue;
      const Mesh drifted = translated(bodies[i], speed * random.in_ball());
      bodies[i] = jittered(drifted, 0.1 * speed, random.bits());
      world.set_positions(ids[i], bodies[i].positions);
    }
  }
  return hashes;
}

SceneHashes crowd(int threads) { return play(crowd_of_blobs(60, 1), {.threads = threads}, 6, 0.1); }

SceneHashes everything(int threads) {
  const Settings settings{
      .threads = threads, .direction = DirectionPolicy::smallest, .outputs = {.zones = true, .patches = true}};
  return play(mixed_crowd(40, 1), settings, 4, 0.05);
}

SceneHashes surgery(int threads) {
  const std::vector<Mesh> bodies = {organ(1), translated(tool(), {0.1, 0.0, 0.1}), wrinkled_sheet(20, 1.5, 0.3, 1)};
  return play(bodies, {.threads = threads, .outputs = {.zones = true}}, 12, 0.02);
}

SceneHashes as_in_the_paper(int threads) {
  return play(crowd_of_blobs(30, 2), {.threads = threads, .accuracy = Accuracy::paper}, 4, 0.1);
}

SceneHashes hulls_alone(int threads) {
  return play(crowd_of_blobs(60, 3), {.threads = threads, .accuracy = Accuracy::hulls}, 4, 0.1);
}

SceneHashes wall(int threads) { return play(brick_wall(6, 10), {.threads = threads}, 2, 0.0); }

// Bodies so large that one pair is shared out among the threads, and sheets of so many clusters that trees find their
// pairs.
SceneHashes large(int threads) {
  const std::vector<Mesh> bodies = {soup(12000, 1.0, 1), soup(10000, 1.0, 2), wrinkled_sheet(190, 2.0, 0.02, 3),
                                    wrinkled_sheet(190, 2.0, 0.02, 4)};
  return play(bodies, {.threads = threads}, 2, 0.01);
}

constexpr HashScene kScenes[] = {
    {"crowd", crowd, 0x93538d9c4ec3cc4b},
    {"everything", everything, 0x23b2383b90bc8d06},
    {"surgery", surgery, 0x77997138121fdaff},
    {"as_in_the_paper", as_in_the_paper, 0x7e43618e08008598},
    {"hulls_alone", hulls_alone, 0xc9d4f7a4a0389528},
    {"wall", wall, 0x0c6eb35572444384},
    {"large", large, 0x3590805f1b5293f3},
};

}  // namespace

std::span<const HashScene> hash_scenes() { return kScenes; }

}  // namespace tact::tests
