// A long life of one world: bodies come and go, step after step. Memory stays flat, and at random moments the facet
// pairs are those of a fresh world. How long is read from the environment.
//   TACT_SOAK_STEPS  steps, 20000 if not set
//   TACT_SOAK_SEED   which life, 1 if not set
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <vector>

#include "engine/base/timer.h"
#include "tests/support/checks/detection.h"
#include "tests/support/environment/environment.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

using tact::World;  // records nothing: a recording takes memory, and the seed plays the life again

constexpr std::size_t kMostBodies = 16;
constexpr double kRoom = 1.5;           // half edge of the cube that bodies are in, metres
constexpr double kChecked = 0.005;      // part of the steps that are held against a fresh world
constexpr int kParts = 10;              // of the life, a line of output each
constexpr std::int64_t kGrowth = 2048;  // kB that memory may grow by after the first part

// Memory of this process that is resident, in kB; 0 where the system does not tell.
std::int64_t resident_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::int64_t size = 0;
    if (word == "VmRSS:" && status >> size) return size;
  }
  return 0;
}

// A sanitizer keeps what was freed.
constexpr bool memory_can_be_judged() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return false;
#elif defined(__has_feature)
  return !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
  return true;
#endif
}

std::vector<Mesh> small_shapes() {
  const Mesh flat_box = stretched(centered_box({0.4, 0.4, 0.4}), {1.0, 1.0, 0.0});
  return {icosphere(0, 0.5),          icosphere(1, 0.6),
          blob(1, 0.5, 0.4, 1),       centered_box({0.5, 0.25, 0.75}),
          sheet(3, 3, 1.5, 1.5),      wrinkled_sheet(4, 2, 1, 1),
          random_hull(12, 1),         spike({0.0, 0.0, 1.5}, 0.1),
          soup(12, 0.6, 1),           lattice_soup(16, 1, 1),
          needles(6, 1e-6, 1),        flat_box,
          crumpled(icosphere(0), 1),  soup(1, 0.5, 2),
          scaled(icosphere(1), 1e-6), Mesh{}};
}

struct LiveBody {
  BodyId id;
  std::size_t shape = 0;
  Mesh mesh;
  Motion motion = Motion::deformable;
};

class Life {
 public:
  explicit Life(std::uint64_t seed) : random_(seed), shapes_(small_shapes()) {
    while (bodies_.size() < kMostBodies / 2) add();
  }

  // One to four changes, and a step.
  const Report& step() {
    for (int change = random_.below(4); change >= 0; --change) {
      const int kind = random_.below(20);
      if (kind == 0 || bodies_.empty()) {
        add();
      } else if (kind == 1) {
        remove();
      } else if (kind == 2) {
        world_.set_settings({.threads = 1,
                             .direction = random_.chance(0.5) ? DirectionPolicy::carried : DirectionPolicy::smallest,
                             .outputs = {.zones = random_.chance(0.5), .patches = random_.chance(0.5)}});
      } else {
        move();
      }
    }
    return world_.detect();
  }

  ::testing::AssertionResult answers_as_a_fresh_world(const Report& report) const {
    World fresh({.threads = 1});
    std::vector<BodyId> ids, fresh_ids;
    for (const LiveBody& body : bodies_) {
      ids.push_back(body.id);
      fresh_ids.push_back(
          fresh.add_body({.positions = body.mesh.positions, .facets = body.mesh.facets, .motion = body.motion}));
    }
    return same_meeting_bodies(meeting_bodies(fresh.detect(), fresh_ids), meeting_bodies(report, ids));
  }

 private:
  std::size_t any_body() { return static_cast<std::size_t>(random_.below(static_cast<int>(bodies_.size()))); }

  Mesh anywhere(const Mesh& shape) {
    const Vec3 at = random_.in_cube(kRoom);  // first: the order of arguments is the compiler's
    return translated(rotated(shape, random_.rotation()), at);
  }

  void add() {
    if (bodies_.size() >= kMostBodies) return remove();
    LiveBody body;
    body.shape = static_cast<std::size_t>(random_.below(static_cast<int>(shapes_.size())));
    body.mesh = anywhere(shapes_[body.shape]);
    body.motion = random_.chance(0.1) ? Motion::fixed : Motion::deformable;
    body.id = world_.add_body({.positions = body.mesh.positions, .facets = body.mesh.facets, .motion = body.motion});
    bodies_.push_back(std::move(body));
  }

  void remove() {
    const std::size_t i = any_body();
    world_.remove_body(bodies_[i].id);
    bodies_.erase(bodies_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  void move() {
    LiveBody& body = bodies_[any_body()];
    if (body.motion == Motion::fixed) return;
    if (random_.chance(0.1)) {
      body.mesh = anywhere(shapes_[body.shape]);
    } else {
      const Vec3 by = 0.1 * random_.in_ball();
      body.mesh = jittered(translated(body.mesh, by), 1e-3, random_.bits());
    }
    world_.set_positions(body.id, body.mesh.positions);
  }

  Random random_;
  std::vector<Mesh> shapes_;
  World world_{{.threads = 1}};
  std::vector<LiveBody> bodies_;
};

TEST(Soak, MemoryStaysFlatAndAnswersAreThoseOfAFreshWorld) {
  const std::uint64_t steps = from_environment("TACT_SOAK_STEPS", 20000), seed = from_environment("TACT_SOAK_SEED", 1);
  Life life(seed);
  Random random(seed + 1);
  std::uint64_t checked = 0, touching = 0, limits = 0;
  std::int64_t memory_before = 0, memory = 0;
  base::Timer timer;
  std::printf("%12s %10s %12s %12s %12s\n", "steps", "checked", "touching", "resident kB", "seconds");
  double seconds = 0.0;
  for (std::uint64_t step = 1; step <= steps; ++step) {
    const Report& report = life.step();
    touching += static_cast<std::uint64_t>(report.stats().touching_contacts);
    limits += static_cast<std::uint64_t>(report.stats().limits_reached);
    if (random.chance(kChecked) || step == steps) {
      ++checked;
      ASSERT_TRUE(life.answers_as_a_fresh_world(report)) << "seed " << seed << ", step " << step;
    }
    if (step % std::max<std::uint64_t>(1, steps / kParts) != 0) continue;
    memory = resident_memory();
    if (memory_before == 0) memory_before = memory;
    seconds += 1e-3 * timer.lap();
    std::printf("%12llu %10llu %12llu %12lld %12.1f\n", static_cast<unsigned long long>(step),
                static_cast<unsigned long long>(checked), static_cast<unsigned long long>(touching),
                static_cast<long long>(memory), seconds);
    std::fflush(stdout);
  }
  EXPECT_EQ(limits, 0u);
  EXPECT_GT(touching, steps / 2);
  if (memory_can_be_judged()) {
    EXPECT_LE(memory - memory_before, kGrowth) << "kB in all but the first part of " << steps << " steps";
  }
}

}  // namespace
}  // namespace tact::tests
