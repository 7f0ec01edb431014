#include "tests/support/hash_scenes.h"

#include <span>
#include <vector>

#include "tests/support/body_pairs.h"
#include "tests/support/generators.h"
#include "tests/support/scene_player.h"

namespace tact::tests {
namespace {

// Steps over `bodies`, all of which drift and tremble, and a few of which stand still in each step.
SceneHashes play(std::span<const Mesh> bodies, const Settings& settings, int steps, double speed) {
  ScenePlayer player(settings);
  for (const Mesh& body : bodies) player.add({.mesh = body});
  Random random(bodies.size());
  for (int step = 0; step < steps; ++step) {
    player.step();
    player.drift(speed, random);
  }
  return player.hashes();
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
    {"crowd", crowd, {0x93538d9c4ec3cc4b, 0x271d56502165e527, 0x34a12a61384a9bd5}},
    {"everything", everything, {0x23b2383b90bc8d06, 0x20bd806eade2e0fc, 0x5c425457e9dd823b}},
    {"surgery", surgery, {0x77997138121fdaff, 0xe7488da143c14c84, 0x940e0e4a8141c8f5}},
    {"as_in_the_paper", as_in_the_paper, {0x7e43618e08008598, 0x3700745f7c7ebc4b, 0xfc3e8592dac366cb}},
    {"hulls_alone", hulls_alone, {0xc9d4f7a4a0389528, 0x41f80414c23f4714, 0xa6c0dc80fab03bc2}},
    {"wall", wall, {0x0c6eb35572444384, 0x9e6d15c0a91a0336, 0x37cf5f49c603ea96}},
    {"large", large, {0x3590805f1b5293f3, 0x25b10be5e2ffb539, 0xe5c0571f6aa85dca}},
};

}  // namespace

std::span<const HashScene> hash_scenes() { return kScenes; }

}  // namespace tact::tests
