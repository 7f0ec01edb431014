// Random sequences of calls: after each step the world answers as a fresh one with the same bodies, and a replay of the
// calls answers with the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/oracles/minkowski_oracle.h"

namespace tact::tests {
namespace {

// A body as the test knows it.
struct ModelBody {
  BodyId id;
  Mesh mesh;
  Surface surface = Surface::closed;
  Motion motion = Motion::deformable;
  std::uint32_t layer = 1;
  std::uint32_t mask = ~0u;
};

// Plays one random sequence, a function of the seed alone.
class Player {
 public:
  explicit Player(std::uint64_t seed) : random_(seed) { settings_.threads = 1; }

  void change() {
    switch (random_.below(11)) {
      case 0:
      case 1: return add();
      case 2: return remove();
      case 3: return choose_settings();
      case 4: return move_many();
      case 5: return teleport();
      case 6: return disturb_refused();
      case 7: return change_filter();
      default: return move();
    }
  }

  const Report& detect() { return world_.detect(); }
  World& world() { return world_; }
  const std::vector<ModelBody>& bodies() const { return bodies_; }
  const Settings& settings() const { return settings_; }

 private:
  Mesh random_mesh() {
    const auto kinds = body_pair_kinds();
    const BodyPairKind& kind = kinds[random_.below(static_cast<int>(kinds.size()))];
    return kind.make(random_.bits() % 1000)[random_.below(2)];
  }

  void add() {
    if (bodies_.size() > 24) return;
    ModelBody body;
    const Vec3 at = random_.in_cube(1.5);  // first: the order of arguments is the compiler's
    body.mesh = translated(random_mesh(), at);
    body.surface = random_.chance(0.3) ? Surface::sheet : Surface::closed;
    body.motion = any_motion();
    choose_layers(body);
    body.id = world_.add_body({.positions = body.mesh.positions,
                               .facets = body.mesh.facets,
                               .surface = body.surface,
                               .motion = body.motion,
                               .layer = body.layer,
                               .mask = body.mask});
    bodies_.push_back(std::move(body));
  }

  Motion any_motion() { return random_.chance(0.2) ? Motion::fixed : Motion::deformable; }

  void choose_layers(ModelBody& body) {
    body.layer = 1u << random_.below(3);
    body.mask = random_.chance(0.7) ? ~0u : static_cast<std::uint32_t>(random_.below(8));
  }

  void change_filter() {
    if (bodies_.empty()) return;
    ModelBody& body = bodies_[random_.below(static_cast<int>(bodies_.size()))];
    if (random_.chance(0.5)) {
      choose_layers(body);
      world_.set_layers(body.id, body.layer, body.mask);
    } else {
      body.motion = any_motion();
      world_.set_motion(body.id, body.motion);
    }
  }

  void remove() {
    if (bodies_.empty()) return;
    const int i = random_.below(static_cast<int>(bodies_.size()));
    world_.remove_body(bodies_[i].id);
    bodies_.erase(bodies_.begin() + i);
  }

  // Settings that leave facet pairs as they are.
  void choose_settings() {
    settings_.direction = random_.chance(0.5) ? DirectionPolicy::carried : DirectionPolicy::smallest;
    settings_.outputs = {.zones = random_.chance(0.5), .patches = random_.chance(0.5)};
    settings_.gjk_tolerance = random_.chance(0.8) ? 1e-12 : 1e-3;
    world_.set_settings(settings_);
  }

  Mesh moved(const Mesh& mesh) {
    const Vec3 by = 0.1 * random_.in_ball();
    return random_.chance(0.5) ? translated(mesh, by) : jittered(translated(mesh, by), 0.01, random_.bits());
  }

  ModelBody* random_moving_body() {
    if (bodies_.empty()) return nullptr;
    ModelBody& body = bodies_[random_.below(static_cast<int>(bodies_.size()))];
    return body.motion == Motion::deformable ? &body : nullptr;
  }

  void move() {
    if (ModelBody* body = random_moving_body()) {
      body->mesh = moved(body->mesh);
      world_.set_positions(body->id, body->mesh.positions);
    }
  }

  void teleport() {
    if (ModelBody* body = random_moving_body()) {
      const Mesh elsewhere = translated(body->mesh, random_.in_cube(3.0));
      body->mesh = rotated(elsewhere, random_.rotation());
      world_.set_positions(body->id, body->mesh.positions);
    }
  }

  void move_many() {
    std::vector<PositionsUpdate> updates;
    for (ModelBody& body : bodies_) {
      if (body.motion == Motion::fixed || random_.chance(0.5)) continue;
      body.mesh = moved(body.mesh);
      updates.push_back({body.id, body.mesh.positions});
    }
    world_.set_positions(updates);
  }

  // Calls that must be refused and change nothing.
  void disturb_refused() {
    if (ModelBody* body = random_moving_body(); body != nullptr && body->mesh.vertex_count() > 0) {
      Eigen::Matrix3Xd bad = 2.0 * body->mesh.positions;
      bad(2, random_.below(body->mesh.vertex_count())) = HUGE_VAL;
      EXPECT_TRUE(throws_error([&] { world_.set_positions(body->id, bad); }, ErrorCode::non_finite_position));
    }
    EXPECT_TRUE(throws_error([&] { world_.remove_body({}); }, ErrorCode::stale_body));
  }

  Random random_;
  Settings settings_;
  World world_{{.threads = 1}};
  std::vector<ModelBody> bodies_;
};

// The bodies of `player` in a world that has seen nothing else, in the order of their indices.
struct FreshWorld {
  explicit FreshWorld(const Player& player) : world(player.settings()) {
    std::vector<ModelBody> bodies = player.bodies();
    std::ranges::sort(bodies, {}, [](const ModelBody& body) { return body.id.index; });
    for (const ModelBody& body : bodies) {
      old_ids.push_back(body.id);
      ids.push_back(world.add_body({.positions = body.mesh.positions,
                                    .facets = body.mesh.facets,
                                    .surface = body.surface,
                                    .motion = body.motion,
                                    .layer = body.layer,
                                    .mask = body.mask}));
    }
  }
  World world;
  std::vector<BodyId> old_ids;
  std::vector<BodyId> ids;
};

const Mesh& mesh_of(const Player& player, BodyId id) {
  return std::ranges::find(player.bodies(), id, &ModelBody::id)->mesh;
}

constexpr int kSteps = 80;

class RandomSequence : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomSequence, AnswersAsFreshWorld) {
  Player player(GetParam());
  int touching = 0;
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < 4; ++i) player.change();
    FreshWorld fresh(player);
    const Report& report = player.detect();
    const Report& expected = fresh.world.detect();
    ASSERT_TRUE(same_meeting_bodies(meeting_bodies(expected, fresh.ids), meeting_bodies(report, fresh.old_ids)))
        << "step " << step;
    ASSERT_EQ(report.candidate_pairs().size(), expected.candidate_pairs().size()) << "step " << step;
    ASSERT_EQ(report.contacts().size(), expected.contacts().size()) << "step " << step;
    for (std::size_t i = 0; i < report.contacts().size(); ++i) {
      const Contact &found = report.contacts()[i], &other = expected.contacts()[i];
      touching += found.touching() ? 1 : 0;
      if (player.settings().direction != DirectionPolicy::smallest) continue;
      ASSERT_NEAR(found.depth, other.depth, 1e-9) << "step " << step;
    }
  }
  EXPECT_GT(touching, 100);
}

TEST_P(RandomSequence, DirectionsAreLocalMinima) {
  Player player(GetParam());
  int checked = 0;
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < 4; ++i) player.change();
    for (const Contact& contact : player.detect().contacts()) {
      if (step % 8 != 7) continue;  // brute force is slow
      ++checked;
      const Mesh &a = mesh_of(player, contact.a), &b = mesh_of(player, contact.b);
      const Vec3 n{contact.direction.x(), contact.direction.y(), contact.direction.z()};
      ASSERT_FALSE(contact.limit_reached) << "step " << step;
      ASSERT_TRUE(is_local_minimum(used_points(a), used_points(b), n, 1e-11 * (extent(a) + extent(b))))
          << "step " << step << ", depth " << contact.depth;
    }
  }
  EXPECT_GT(checked, 20);
}

TEST_P(RandomSequence, ReplayHasTheSameBits) {
  Player first(GetParam()), second(GetParam());
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < 4; ++i) first.change();
    for (int i = 0; i < 4; ++i) second.change();
    ASSERT_EQ(first.detect().hash(), second.detect().hash()) << "step " << step;
  }
}

// Events tell exactly what changed between one step and the next.
TEST_P(RandomSequence, EventsTellWhatChanged) {
  Player player(GetParam());
  std::vector<ContactEvent> before;
  const auto less = [](const ContactEvent& x, const ContactEvent& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  };
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < 4; ++i) player.change();
    const Report& report = player.detect();
    std::vector<ContactEvent> now, began, ended;
    for (const Contact& contact : report.contacts()) {
      if (contact.touching()) now.push_back({contact.a, contact.b});
    }
    std::ranges::set_difference(now, before, std::back_inserter(began), less);
    std::ranges::set_difference(before, now, std::back_inserter(ended), less);
    ASSERT_TRUE(std::ranges::equal(report.began(), began)) << "step " << step;
    ASSERT_TRUE(std::ranges::equal(report.ended(), ended)) << "step " << step;
    before = std::move(now);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSequence, ::testing::Range<std::uint64_t>(1, 9));

}  // namespace
}  // namespace tact::tests
