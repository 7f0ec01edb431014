// Worlds that are saved and restored: into themselves, into fresh ones and into ones with a life of their own, at any
// moment, they answer as the world that went on, and bytes that are no state of a world are refused.
//   TACT_LONG_SAVED_SEEDS   sequences of calls for each tuning, 3 if not set
//   TACT_LONG_STATES        states of any content, 200 if not set
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/checks/mended_state.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/checks/varied_calls.h"
#include "tests/support/environment/environment.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using Bytes = std::vector<std::byte>;

Settings with_all_outputs(int threads) {
  Settings settings{.threads = threads};
  settings.outputs.points = settings.outputs.patches = settings.outputs.within_reach = true;
  return settings;
}

// The seed of the calls of a step.
std::uint64_t seed_of(std::uint64_t seed, int step) { return 1000 * seed + static_cast<std::uint64_t>(step); }

void play_until(tact::World& world, std::uint64_t seed, int end) {
  for (int step = 0; step < end; ++step) {
    change(world, seed_of(seed, step));
    world.detect();
  }
}

// What a world answers that goes on in the middle of a step, and the state that it ends in.
struct Rest {
  std::vector<std::vector<std::uint64_t>> answers;
  Bytes end;
  friend bool operator==(const Rest&, const Rest&) = default;
};

Rest go_on(tact::World& world, std::uint64_t seed, int begin, int steps) {
  Rest rest;
  for (int step = begin; step < begin + steps; ++step) {
    rest.answers.push_back(answers_of_step(world));
    change(world, seed_of(seed, step + 500));
  }
  rest.end = world.save();
  return rest;
}

class SavedWorlds : public ::testing::TestWithParam<NamedTuning> {};

TEST_P(SavedWorlds, GoOnAsTheWorldThatWasSaved) {
  std::size_t contacts = 0;
  const std::uint64_t seeds = from_environment("TACT_LONG_SAVED_SEEDS", 3);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const int begin = 3 + static_cast<int>(seed * 5 % 17), steps = 7;
    const auto world_of = [&](int threads) {
      World world(with_all_outputs(threads));
      world.set_tuning(GetParam().tuning);
      return world;
    };
    World world = world_of(1), fresh = world_of(2), other = world_of(3);
    play_until(world, seed, begin);
    change(world, seed_of(seed, begin));  // in the middle of a step
    const Bytes bytes = world.save();
    const Rest expected = go_on(world, seed, begin, steps);
    contacts += world.detect().contacts().size();

    world.restore(bytes);
    EXPECT_EQ(world.save(), bytes) << "seed " << seed;
    ASSERT_EQ(go_on(world, seed, begin, steps), expected) << "into itself, seed " << seed;
    fresh.restore(bytes);
    EXPECT_EQ(fresh.save(), bytes) << "seed " << seed;
    EXPECT_EQ(fresh.settings().threads, 2);
    ASSERT_EQ(go_on(fresh, seed, begin, steps), expected) << "into a fresh world, seed " << seed;
    play_until(other, seed + 70, 12);
    change(other, seed);
    other.detect_motion();
    other.restore(bytes);
    EXPECT_EQ(other.save(), bytes) << "seed " << seed;
    ASSERT_EQ(go_on(other, seed, begin, steps), expected) << "into another world, seed " << seed;
  }
  EXPECT_GT(contacts, 3 * seeds);
}

INSTANTIATE_TEST_SUITE_P(Tunings, SavedWorlds,
                         ::testing::Values(NamedTuning{"default", base::kTuning}, NamedTuning{"plain", kPlain},
                                           NamedTuning{"forced", kForced}),
                         [](const auto& instance) { return instance.param.name; });

BodyId add_cube(tact::World& world, double x, std::optional<std::uint64_t> key = {}) {
  const Mesh mesh = cube(1.0, {x, 0.0, 0.0});
  return world.add_body({.positions = mesh.positions, .facets = mesh.facets, .key = key});
}

TEST(SavedIds, NameTheBodiesThatTheyNamed) {
  World world;
  const BodyId a = add_cube(world, 0.0), b = add_cube(world, 0.5);
  world.detect();
  const Bytes early = world.save();
  world.remove_body(a);
  const BodyId c = add_cube(world, 0.7);
  EXPECT_EQ(c.index, a.index);
  world.detect();
  const Bytes late = world.save();
  world.restore(early);
  EXPECT_TRUE(world.contains(a) && world.contains(b) && !world.contains(c));
  world.restore(late);
  EXPECT_TRUE(!world.contains(a) && world.contains(b) && world.contains(c));
  world.restore(early);
  world.remove_body(a);
  const BodyId d = add_cube(world, 0.1);
  EXPECT_EQ(d.index, c.index);
  EXPECT_TRUE(world.contains(d) && !world.contains(c)) << "the id of a body that is gone names no later one";
  EXPECT_TRUE(throws_error([&] { (void)world.name(c); }, ErrorCode::stale_body));
  World fresh;
  const BodyId e = add_cube(fresh, 3.0);
  fresh.restore(late);
  EXPECT_FALSE(fresh.contains(e));
  EXPECT_EQ(fresh.body_count(), 2u);
  fresh.restore(early);
  const std::vector<BodyId> first = fresh.bodies();
  fresh.restore(late);
  fresh.restore(early);
  EXPECT_EQ(fresh.bodies(), first);
}

// What a body had before it was removed is told by the step after; the bytes hold it until then.
TEST(SavedIds, AreToldWhenABodyIsRemovedInTheMiddleOfAStep) {
  World world(with_all_outputs(1));
  const BodyId a = add_cube(world, 0.0, 10), b = add_cube(world, 0.5), c = add_cube(world, 0.8, 4);
  world.detect();
  world.remove_body(a);
  const BodyId d = add_cube(world, 0.2);
  EXPECT_EQ(d.index, a.index);
  const Bytes bytes = world.save();
  const auto ended = [](const Report& report) {
    return std::vector<ContactEvent>(report.ended().begin(), report.ended().end());
  };
  const std::vector<ContactEvent> expected = ended(world.detect());
  EXPECT_EQ(expected, (std::vector<ContactEvent>{{b, a}, {c, a}}));
  world.restore(bytes);
  EXPECT_EQ(ended(world.detect()), expected);
  World other(with_all_outputs(1));
  other.restore(bytes);
  const Report& report = other.detect();
  ASSERT_EQ(report.ended().size(), 2u);
  for (const ContactEvent& event : report.ended()) {
    EXPECT_EQ(event.b.index, a.index);
    EXPECT_FALSE(other.contains(event.b));
  }
}

// The sweep of a restored world finds no pair, as in its first step: yet there was one.
TEST(SavedStates, TellOfTheLastPairThatParts) {
  World world(with_all_outputs(1));
  add_cube(world, 0.0);
  const BodyId b = add_cube(world, 0.5);
  world.detect();
  world.restore(world.save());
  world.set_positions(b, cube(1.0, {50.0, 0.0, 0.0}).positions);
  const Report& report = world.detect();
  EXPECT_EQ(report.ended().size(), 1u);
  EXPECT_EQ(report.candidate_pairs().size(), 0u);
  EXPECT_EQ(report.contacts().size(), 0u);
  EXPECT_GT(report.patch_events().size(), 0u);
}

// Its record held vertices of balls, which a cube has not.
TEST(SavedStates, OfAPlaneKnowNothingOfThePairWhoseRecordItTook) {
  World world(with_all_outputs(1));
  const Mesh ball = icosphere(2);
  const BodyId a = world.add_body({.positions = ball.positions, .facets = ball.facets});
  const Mesh other = translated(ball, {1.0, 0.3, 0.2});
  const BodyId b = world.add_body({.positions = other.positions, .facets = other.facets});
  ASSERT_EQ(world.detect().contacts().size(), 1u);
  world.remove_body(a);
  world.remove_body(b);
  world.detect();
  add_cube(world, 0.0);
  world.add_plane({.offset = 0.2});
  const std::uint64_t hash = world.detect().hash();
  ASSERT_NO_THROW(world.restore(world.save()));
  EXPECT_EQ(world.detect().hash(), hash);
}

// Between a change of facets and the next step no facet has the number that it had.
TEST(SavedStates, OfOtherFacetsHoldNoCurvesOfTheLast) {
  Settings settings = with_all_outputs(1);
  settings.outputs.curves = true;
  World world(settings);
  const BodyId a = add_cube(world, 0.0);
  add_cube(world, 0.5);
  ASSERT_EQ(world.detect().contacts()[0].curves().size(), 1u);
  const Mesh mesh = cube(1.0, {0.0, 0.0, 0.0});
  const Eigen::Matrix3Xi half = mesh.facets.leftCols(6);
  const std::vector<int> same{0, 1, 2, 3, 4, 5, 6, 7};
  world.set_facets(a, mesh.positions, half, same);
  World other(settings);
  ASSERT_NO_THROW(other.restore(world.save()));
  EXPECT_EQ(other.detect().hash(), world.detect().hash());
}

// The pair of the last step is there until the next one, with a body that no facet is of.
TEST(SavedStates, OfABodyThatLostAllItsFacetsAreRestored) {
  World world(with_all_outputs(1));
  const BodyId a = add_cube(world, 0.0);
  add_cube(world, 0.5);
  world.detect();
  const std::vector<int> same{0, 1, 2, 3, 4, 5, 6, 7};
  world.set_facets(a, cube(1.0, {0.0, 0.0, 0.0}).positions, Eigen::Matrix3Xi(3, 0), same);
  World other(with_all_outputs(1));
  ASSERT_NO_THROW(other.restore(world.save()));
  EXPECT_EQ(other.detect().hash(), world.detect().hash());
  EXPECT_EQ(other.save(), world.save());
}

// Surfaces of the search for the smallest separation that came to no end hold vertices, which then have other numbers.
TEST(SavedStates, OfTheSmallestDirectionAreRestoredAfterFacetsChanged) {
  Random random(31);
  for (int i = 0; i < 400; ++i) {
    Settings settings = with_all_outputs(1);
    settings.direction = DirectionPolicy::smallest;
    World world(settings), other(settings);
    std::array<BodyId, 2> ids;
    std::array<Mesh, 2> meshes;
    for (std::size_t k = 0; k < 2; ++k) {
      meshes[k].facets.resize(3, 4);
      meshes[k].facets << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
      meshes[k].positions.resize(3, 4);
      for (double& x : meshes[k].positions.reshaped()) x = random.uniform(-8.0, 8.0);
      ids[k] =
          world.add_body({.positions = meshes[k].positions, .facets = meshes[k].facets, .surface = Surface::sheet});
    }
    world.detect();
    world.set_positions(ids[0], meshes[0].positions.array() + 0.5);
    world.detect();
    Eigen::Matrix3Xd corners(3, 3);
    for (double& x : corners.reshaped()) x = random.uniform(-8.0, 8.0);
    const std::vector<int> all_new{-1, -1, -1};
    world.set_facets(ids[1], corners, Eigen::Vector3i(0, 1, 2), all_new);
    ASSERT_NO_THROW(other.restore(world.save())) << i;
    EXPECT_EQ(other.detect().hash(), world.detect().hash()) << i;
    EXPECT_EQ(other.save(), world.save()) << i;
  }
}

TEST(SavedStates, OfAPlaneHaveTheSameBytesWhateverRecordItsPairTook) {
  World world(with_all_outputs(1)), other(with_all_outputs(1));
  add_cube(world, 0.0);
  const BodyId b = add_cube(world, 0.5);
  world.detect();
  world.remove_body(b);
  world.add_plane({.offset = 0.2});
  other.restore(world.save());
  EXPECT_EQ(other.detect().hash(), world.detect().hash());
  EXPECT_EQ(other.save(), world.save());
}

TEST(SavedStates, AreOfTheStateAlone) {
  World one(with_all_outputs(1)), two(with_all_outputs(2));
  for (World* const world : {&one, &two}) {
    if (world == &two) {  // a life before
      add_cube(*world, 7.0);
      world->restore(World(with_all_outputs(1)).save());
    }
    add_cube(*world, 0.0), add_cube(*world, 0.4);
    world->detect();
  }
  EXPECT_EQ(one.save(), two.save());
  for (const RayHit& hit : one.cast_ray_all({.from = {-2, 0, 0}, .to = {2, 0, 0}})) EXPECT_GE(hit.facet, 0);
  EXPECT_EQ(one.save(), two.save()) << "a query changes nothing";
}

TEST(SavedStates, KeepTheSettingsOfTheProgram) {
  World one({.threads = 1, .accuracy = Accuracy::paper, .gjk_tolerance = 1e-9});
  int messages = 0;
  World two({.threads = 3, .on_message = [&](const Message&) { ++messages; }});
  two.restore(one.save());
  EXPECT_EQ(two.settings().threads, 3);
  EXPECT_TRUE(two.settings().on_message);
  EXPECT_EQ(two.settings().accuracy, Accuracy::paper);
  EXPECT_EQ(two.settings().gjk_tolerance, 1e-9);
}

struct Seen : WorldObserver {
  Bytes restored;
  void state_restored(std::span<const std::byte> bytes) noexcept override {
    restored.assign(bytes.begin(), bytes.end());
  }
};

TEST(SavedStates, AreToldToTheObserver) {
  Seen seen;
  tact::World world;
  world.set_observer(&seen);
  add_cube(world, 0.0);
  const Bytes bytes = world.save();
  world.restore(bytes);
  EXPECT_EQ(seen.restored, bytes);
  Bytes damaged = bytes;
  damaged.back() ^= std::byte{1};
  seen.restored.clear();
  EXPECT_TRUE(throws_error([&] { world.restore(damaged); }, ErrorCode::bad_state, {"checksum"}));
  EXPECT_TRUE(seen.restored.empty());
  world.set_observer(nullptr);
}

// A world with a history of every kind.
Bytes rich_state() {
  tact::World world(with_all_outputs(1));
  play_until(world, 3, 14);
  change(world, 77);
  return world.save();
}

TEST(SavedStates, AreRefusedWithAnyBitWrong) {
  const Bytes good = rich_state();
  tact::World world;
  add_cube(world, 0.0);
  const Bytes before = world.save();
  for (std::size_t at = 0; at < good.size(); at += at < 64 ? 1 : 61) {
    Bytes bad = good;
    bad[at] ^= std::byte{static_cast<unsigned char>(1u << (at % 8))};
    EXPECT_TRUE(throws_error([&] { world.restore(bad); }, ErrorCode::bad_state)) << "byte " << at;
    EXPECT_TRUE(throws_error([&] { world.restore(std::span(good).first(at)); }, ErrorCode::bad_state))
        << "cut at " << at;
  }
  EXPECT_EQ(world.save(), before);
}

// With a checksum that is right whatever the bytes say is refused, or a world that can be used.
TEST(SavedStates, AreHarmlessWhateverTheyHold) {
  const Bytes good = rich_state();
  Random random(5);
  const int states = static_cast<int>(from_environment("TACT_LONG_STATES", 200));
  int refused = 0, taken = 0;
  for (int i = 0; i < states; ++i) {
    Bytes bytes = good;
    for (int k = random.below(3); k >= 0; --k) {
      const std::size_t at = kStateHead + random.bits() % (bytes.size() - kStateHead);
      const std::byte values[] = {std::byte{0}, std::byte{1}, std::byte{0x7f}, std::byte{0xff},
                                  bytes[at] ^ std::byte{static_cast<unsigned char>(1 << random.below(8))}};
      for (std::size_t byte = at; byte < std::min(bytes.size(), at + (random.chance(0.3) ? 8 : 1)); ++byte)
        bytes[byte] = values[random.below(5)];
    }
    if (random.chance(0.1)) bytes.resize(kStateHead + random.bits() % (bytes.size() - kStateHead));
    mend(bytes);
    tact::World world({.threads = 1});
    try {
      world.restore(bytes);
      ++taken;
    } catch (const Error& error) {
      ++refused;
      EXPECT_TRUE(error.code() == ErrorCode::bad_state || error.code() == ErrorCode::too_large) << error.what();
      continue;
    }
    for (int step = 0; step < 2; ++step) {
      answers_of_step(world);
      change(world, static_cast<std::uint64_t>(i + step));
    }
    world.restore(world.save());
  }
  EXPECT_GT(refused, states / 5);
  EXPECT_GT(taken, states / 5);
}

}  // namespace
}  // namespace tact::tests
