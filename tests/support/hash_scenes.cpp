#include "tests/support/hash_scenes.h"

#include <tact/tact.h>

#include <array>
#include <bit>
#include <vector>

#include "tests/support/body_pairs.h"
#include "tests/support/generators.h"

namespace tact::tests {
namespace {

// Steps over `bodies`, all of which drift and tremble, and a few of which stand still in each step.
std::uint64_t play(std::vector<Mesh> bodies, const Settings& settings, int steps, double speed) {
  World world(settings);
  std::vector<BodyId> ids;
  for (const Mesh& body : bodies) ids.push_back(world.add_body({.positions = body.positions, .facets = body.facets}));
  Random random(bodies.size());
  std::uint64_t fold = 0;
  for (int step = 0; step < steps; ++step) {
    fold = std::rotl(fold, 17) * 0x9e3779b97f4a7c15u ^ world.detect().hash();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (random.chance(0.25)) continue;
      const Mesh drifted = translated(bodies[i], speed * random.in_ball());
      bodies[i] = jittered(drifted, 0.1 * speed, random.bits());
      world.set_positions(ids[i], bodies[i].positions);
    }
  }
  return fold;
}

std::uint64_t crowd(int threads) { return play(crowd_of_blobs(60, 1), {.threads = threads}, 6, 0.1); }

std::uint64_t everything(int threads) {
  const Settings settings{
      .threads = threads, .direction = DirectionPolicy::smallest, .outputs = {.zones = true, .patches = true}};
  return play(mixed_crowd(40, 1), settings, 4, 0.05);
}

std::uint64_t surgery(int threads) {
  const std::vector<Mesh> bodies = {organ(1), translated(tool(), {0.1, 0.0, 0.1}), wrinkled_sheet(20, 1.5, 0.3, 1)};
  return play(bodies, {.threads = threads, .outputs = {.zones = true}}, 12, 0.02);
}

std::uint64_t as_in_the_paper(int threads) {
  return play(crowd_of_blobs(30, 2), {.threads = threads, .accuracy = Accuracy::paper}, 4, 0.1);
}

std::uint64_t hulls_alone(int threads) {
  return play(crowd_of_blobs(60, 3), {.threads = threads, .accuracy = Accuracy::hulls}, 4, 0.1);
}

std::uint64_t wall(int threads) { return play(brick_wall(6, 10), {.threads = threads}, 2, 0.0); }

// Bodies so large that one pair is shared out among the threads, and sheets of so many clusters that trees find their
// pairs.
std::uint64_t large(int threads) {
  const std::vector<Mesh> bodies = {soup(12000, 1.0, 1), soup(10000, 1.0, 2), wrinkled_sheet(190, 2.0, 0.02, 3),
                                    wrinkled_sheet(190, 2.0, 0.02, 4)};
  return play(bodies, {.threads = threads}, 2, 0.01);
}

constexpr HashScene kScenes[] = {
    {"crowd", crowd, 0xd988a832a325bc2c},
    {"everything", everything, 0x03c58efb8b3a976d},
    {"surgery", surgery, 0x18802ba7935e1dda},
    {"as_in_the_paper", as_in_the_paper, 0x2a817ee8bb8196f2},
    {"hulls_alone", hulls_alone, 0xbbfdee593a8b34f6},
    {"wall", wall, 0x572e99e0490e2ec3},
    {"large", large, 0x67c61c331868f97c},
};

}  // namespace

std::span<const HashScene> hash_scenes() { return kScenes; }

}  // namespace tact::tests
