// Bodies come, move and go; every wrong call is refused by name and changes nothing.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tests/support/detection.h"
#include "tests/support/generators.h"

namespace tact::tests {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

BodyDefinition definition(const Mesh& mesh, std::string name = {}) {
  return {.positions = mesh.positions, .facets = mesh.facets, .name = std::move(name)};
}

// A world with two spheres that meet and a fixed box that both rest on.
class WorldOfThree : public ::testing::Test {
 protected:
  WorldOfThree() {
    left_ = world_.add_body(definition(left_mesh_, "left"));
    right_ = world_.add_body(definition(right_mesh_, "right"));
    BodyDefinition floor = definition(floor_mesh_, "floor");
    floor.motion = Motion::fixed;
    floor_ = world_.add_body(floor);
  }

  // The hash of a new look at every pair, so that a body whose copy was spoiled would show. The look before it settles
  // how the directions are found.
  std::uint64_t hash() {
    world_.detect();
    world_.set_settings(world_.settings());
    return world_.detect().hash();
  }

  Mesh left_mesh_ = icosphere(2);
  Mesh right_mesh_ = translated(icosphere(2), {1.5, 0.1, 0.2});
  Mesh floor_mesh_ = box({-3.0, -3.0, -2.0}, {3.0, 3.0, -0.7});
  World world_;
  BodyId left_;
  BodyId right_;
  BodyId floor_;
};

TEST_F(WorldOfThree, KnowsItsBodies) {
  EXPECT_EQ(world_.body_count(), 3u);
  EXPECT_EQ(world_.bodies(), (std::vector<BodyId>{left_, right_, floor_}));
  EXPECT_EQ(world_.name(left_), "left");
  EXPECT_EQ(world_.motion(floor_), Motion::fixed);
  EXPECT_EQ(world_.motion(left_), Motion::moving);
  EXPECT_EQ(world_.surface(left_), Surface::closed);
  EXPECT_EQ(world_.vertex_count(left_), 162u);
  EXPECT_EQ(world_.facet_count(left_), 320u);
  EXPECT_TRUE(world_.contains(left_));
  EXPECT_FALSE(world_.contains(BodyId{}));
}

TEST_F(WorldOfThree, ReportsContactsInOrder) {
  const Report& report = world_.detect();
  ASSERT_EQ(report.contacts().size(), 3u);
  const std::array<std::array<BodyId, 2>, 3> expected = {{{left_, right_}, {left_, floor_}, {right_, floor_}}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(report.contacts()[i].a, expected[i][0]);
    EXPECT_EQ(report.contacts()[i].b, expected[i][1]);
    EXPECT_EQ(report.candidate_pairs()[i].a, expected[i][0]);
    EXPECT_TRUE(report.candidate_pairs()[i].hulls_overlap);
  }
  EXPECT_EQ(report.stats().bodies, 3);
  EXPECT_EQ(report.stats().moved_bodies, 3);
  EXPECT_EQ(report.stats().contacts, 3);
}

TEST_F(WorldOfThree, FindsTheContactOfTwoBodies) {
  world_.set_positions(right_, translated(right_mesh_, {0.0, 0.0, 9.0}).positions);
  const BodyId third = world_.add_body(definition(translated(left_mesh_, {0.0, 0.1, 0.0})));
  const Report& report = world_.detect();
  ASSERT_EQ(report.contacts().size(), 3u);
  for (const Contact& contact : report.contacts()) {
    EXPECT_EQ(report.find_contact(contact.a, contact.b), &contact);
    EXPECT_EQ(report.find_contact(contact.b, contact.a), &contact);
  }
  EXPECT_EQ(report.find_contact(left_, third)->b, third);
  EXPECT_EQ(report.find_contact(left_, right_), nullptr);
  EXPECT_EQ(report.find_contact(third, third), nullptr);
  EXPECT_EQ(report.find_contact(third, BodyId{}), nullptr);
  world_.remove_body(third);
  const BodyId next = world_.add_body(definition(left_mesh_));
  world_.detect();
  EXPECT_EQ(next.index, third.index);
  EXPECT_EQ(report.find_contact(left_, third), nullptr);
  EXPECT_NE(report.find_contact(next, left_), nullptr);
}

TEST_F(WorldOfThree, ForgetsRemovedBody) {
  world_.detect();
  world_.remove_body(right_);
  EXPECT_EQ(world_.body_count(), 2u);
  EXPECT_FALSE(world_.contains(right_));
  const Report& report = world_.detect();
  ASSERT_EQ(report.contacts().size(), 1u);
  EXPECT_EQ(report.contacts()[0].a, left_);
  EXPECT_EQ(report.contacts()[0].b, floor_);
}

TEST_F(WorldOfThree, RefusesStaleIdInEveryCall) {
  world_.remove_body(right_);
  const BodyId next = world_.add_body(definition(right_mesh_, "next"));
  EXPECT_NE(next, right_);
  const std::uint64_t before = hash();
  const std::array updates = {PositionsUpdate{left_, left_mesh_.positions},
                              PositionsUpdate{right_, right_mesh_.positions}};
  for (const BodyId stale : {right_, BodyId{}, BodyId{99, 1, left_.world}, BodyId{left_.index, 7, left_.world}}) {
    EXPECT_FALSE(world_.contains(stale));
    EXPECT_TRUE(throws_error([&] { world_.remove_body(stale); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.set_positions(stale, right_mesh_.positions); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.name(stale); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.surface(stale); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.motion(stale); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.layer(stale); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.mask(stale); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.set_layers(stale, 2, 2); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.set_motion(stale, Motion::fixed); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.vertex_count(stale); }, ErrorCode::stale_body));
    EXPECT_TRUE(throws_error([&] { world_.facet_count(stale); }, ErrorCode::stale_body));
  }
  EXPECT_TRUE(throws_error([&] { world_.set_positions(updates); }, ErrorCode::stale_body, {"update 1", "removed"}));
  EXPECT_TRUE(throws_error(
      [&] {
        world_.name({left_.index, 7, left_.world});
      },
      ErrorCode::stale_body, {"never given"}));
  EXPECT_EQ(hash(), before);
}

TEST_F(WorldOfThree, RefusesForeignIdInEveryCall) {
  World other;
  const BodyId foreign = other.add_body(definition(left_mesh_));
  ASSERT_EQ(foreign.index, left_.index);
  const std::uint64_t before = hash(), others = other.detect().hash();
  const std::array updates = {PositionsUpdate{left_, right_mesh_.positions},
                              PositionsUpdate{foreign, right_mesh_.positions}};
  EXPECT_FALSE(world_.contains(foreign));
  EXPECT_TRUE(throws_error([&] { world_.remove_body(foreign); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.set_positions(foreign, right_mesh_.positions); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.set_positions(updates); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.name(foreign); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.surface(foreign); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.motion(foreign); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.layer(foreign); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.mask(foreign); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.set_layers(foreign, 2, 2); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.set_motion(foreign, Motion::fixed); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.vertex_count(foreign); }, ErrorCode::foreign_body));
  EXPECT_TRUE(throws_error([&] { world_.facet_count(foreign); }, ErrorCode::foreign_body));
  EXPECT_EQ(world_.body_count(), 3u);
  EXPECT_EQ(hash(), before);
  EXPECT_EQ(other.detect().hash(), others);
}

TEST(World, KeepsIdsAndAnswersWhenMoved) {
  const Mesh left = icosphere(1), right = translated(left, {1.5, 0.1, 0.2});
  tact::World world;
  const BodyId a = world.add_body(definition(left)), b = world.add_body(definition(right));
  const std::uint64_t before = world.detect().hash();
  tact::World moved = std::move(world);
  EXPECT_TRUE(moved.contains(a) && moved.contains(b));
  EXPECT_EQ(moved.detect().hash(), before);

  EXPECT_FALSE(world.contains(a));
  EXPECT_EQ(world.body_count(), 0u);
  EXPECT_TRUE(throws_error([&] { world.settings(); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.set_settings({}); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.add_body(definition(left)); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.remove_body(a); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.set_positions(a, left.positions); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.set_positions({}); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.detect(); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.set_layers(a, 1, 1); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.set_motion(a, Motion::fixed); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.bodies(); }, ErrorCode::wrong_order));
  EXPECT_TRUE(throws_error([&] { world.name(a); }, ErrorCode::wrong_order));

  world = std::move(moved);
  EXPECT_EQ(world.detect().hash(), before);
}

TEST_F(WorldOfThree, RefusesBadPositionsAndNamesThem) {
  const std::uint64_t before = hash();
  const struct {
    double value;
    ErrorCode code;
  } cases[] = {{kNan, ErrorCode::non_finite_position},
               {kInfinity, ErrorCode::non_finite_position},
               {-kInfinity, ErrorCode::non_finite_position},
               {0x1.0000000000001p300, ErrorCode::position_out_of_range},
               {-1e300, ErrorCode::position_out_of_range}};
  for (const auto& [value, code] : cases) {
    Eigen::Matrix3Xd bad = left_mesh_.positions;
    bad(1, 77) = value;
    EXPECT_TRUE(throws_error([&] { world_.set_positions(left_, bad); }, code, {"left", "77"})) << value;
    EXPECT_TRUE(throws_error([&] { world_.add_body({.positions = bad, .facets = left_mesh_.facets, .name = "new"}); },
                             code, {"new", "77"}))
        << value;
  }
  EXPECT_EQ(world_.body_count(), 3u);
  EXPECT_EQ(hash(), before);
}

TEST_F(WorldOfThree, TakesTheLargestCoordinate) {
  Mesh far = left_mesh_;
  far.positions(0, 3) = kLargestCoordinate;
  EXPECT_NO_THROW(world_.set_positions(left_, far.positions));
  EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(std::array{far, right_mesh_, floor_mesh_}),
                                  meeting_bodies(world_.detect(), world_.bodies())));
}

TEST_F(WorldOfThree, RefusesWrongNumberOfPositions) {
  const std::uint64_t before = hash();
  for (const Eigen::Index count : {0, 161, 163}) {
    const Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, count);
    EXPECT_TRUE(throws_error([&] { world_.set_positions(left_, positions); }, ErrorCode::wrong_size, {"left", "162"}));
  }
  EXPECT_EQ(hash(), before);
}

TEST_F(WorldOfThree, RefusesFacetsOutOfRangeAndNamesThem) {
  const std::uint64_t before = hash();
  for (const int index : {-1, 162, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
    Mesh bad = left_mesh_;
    bad.facets(2, 41) = index;
    EXPECT_TRUE(throws_error([&] { world_.add_body(definition(bad, "bad")); }, ErrorCode::facet_out_of_range,
                             {"bad", "41", std::to_string(index).c_str()}));
  }
  EXPECT_EQ(world_.body_count(), 3u);
  EXPECT_EQ(hash(), before);
}

// So many that their numbers would not fit: refused before any of them is read.
TEST_F(WorldOfThree, RefusesMoreThanIndicesCanNumber) {
  const std::uint64_t before = hash();
  constexpr Eigen::Index kTooMany = std::numeric_limits<int>::max() / 4 + Eigen::Index{1};
  const Eigen::Map<const Eigen::Matrix3Xd> positions(left_mesh_.positions.data(), 3, kTooMany);
  const Eigen::Map<const Eigen::Matrix3Xi> facets(left_mesh_.facets.data(), 3, kTooMany);
  const auto add = [&](const BodyDefinition& body) { world_.add_body(body); };
  EXPECT_TRUE(throws_error([&] { add({.positions = positions, .facets = left_mesh_.facets, .name = "huge"}); },
                           ErrorCode::too_large, {"huge"}));
  EXPECT_TRUE(throws_error([&] { add({.positions = left_mesh_.positions, .facets = facets, .name = "huge"}); },
                           ErrorCode::too_large, {"huge"}));
  EXPECT_TRUE(throws_error([&] { world_.set_positions(left_, positions); }, ErrorCode::wrong_size, {"left"}));
  EXPECT_EQ(world_.body_count(), 3u);
  EXPECT_EQ(hash(), before);
}

TEST_F(WorldOfThree, RefusesToMoveFixedBody) {
  const std::uint64_t before = hash();
  const Eigen::Matrix3Xd lower = floor_mesh_.positions.array() - 1.0;
  EXPECT_TRUE(throws_error([&] { world_.set_positions(floor_, lower); }, ErrorCode::fixed_body, {"floor"}));
  EXPECT_EQ(hash(), before);
}

TEST_F(WorldOfThree, MovesAllBodiesOfABatchOrNone) {
  const std::uint64_t before = hash();
  const Eigen::Matrix3Xd up = left_mesh_.positions.array() + 0.25;
  Eigen::Matrix3Xd bad = right_mesh_.positions;
  bad(2, 5) = kNan;
  const std::array broken = {PositionsUpdate{left_, up}, PositionsUpdate{right_, bad}};
  EXPECT_TRUE(throws_error([&] { world_.set_positions(broken); }, ErrorCode::non_finite_position, {"right", "5"}));
  const std::array twice = {PositionsUpdate{left_, up}, PositionsUpdate{left_, up}};
  EXPECT_TRUE(throws_error([&] { world_.set_positions(twice); }, ErrorCode::wrong_order, {"left"}));
  const std::array fixed = {PositionsUpdate{left_, up}, PositionsUpdate{floor_, floor_mesh_.positions}};
  EXPECT_TRUE(throws_error([&] { world_.set_positions(fixed); }, ErrorCode::fixed_body, {"floor"}));
  EXPECT_EQ(hash(), before);
  const std::array good = {PositionsUpdate{right_, right_mesh_.positions}, PositionsUpdate{left_, up}};
  world_.set_positions(good);
  const std::uint64_t after = hash();
  EXPECT_NE(after, before);
  world_.set_positions(left_, left_mesh_.positions);
  world_.set_positions(left_, up);
  EXPECT_TRUE(
      same_meeting_bodies(meeting_bodies_by_oracle(std::array{Mesh{up, left_mesh_.facets}, right_mesh_, floor_mesh_}),
                          meeting_bodies(world_.detect(), world_.bodies())));
}

// Of several wrong bodies in a batch the first is named, however many threads look at them.
TEST_F(WorldOfThree, NamesTheFirstWrongBodyOfABatch) {
  std::vector<BodyId> ids;
  std::vector<PositionsUpdate> updates;
  Eigen::Matrix3Xd bad = left_mesh_.positions;
  bad(0, 0) = kNan;
  for (int i = 0; i < 200; ++i)
    ids.push_back(world_.add_body(definition(left_mesh_, "number " + std::to_string(i) + ".")));
  for (int i = 0; i < 200; ++i) {
    const bool wrong = i >= 37 && i % 3 == 0;  // the first is 39
    updates.push_back({ids[static_cast<std::size_t>(i)], wrong ? bad : left_mesh_.positions});
  }
  for (int repeat = 0; repeat < 20; ++repeat) {
    EXPECT_TRUE(throws_error([&] { world_.set_positions(updates); }, ErrorCode::non_finite_position, {"number 39."}));
  }
}

TEST_F(WorldOfThree, HasNotMovedWhenPositionsAreEqual) {
  world_.detect();
  world_.set_positions(left_, left_mesh_.positions);
  const StepStats still = world_.detect().stats();
  EXPECT_EQ(still.moved_bodies, 0);
  EXPECT_EQ(still.kept_pairs, still.candidate_pairs);
  Eigen::Matrix3Xd up = left_mesh_.positions;
  up(0, 0) += 1e-12;
  world_.set_positions(left_, up);
  const StepStats moved = world_.detect().stats();
  EXPECT_EQ(moved.moved_bodies, 1);
  EXPECT_EQ(moved.kept_pairs, 1);
}

TEST_F(WorldOfThree, TellsWhenFacetsBeginAndCeaseToMeet) {
  const Report& report = world_.detect();
  EXPECT_EQ(report.began().size(), 3u);
  EXPECT_TRUE(report.ended().empty());
  world_.set_positions(left_, translated(left_mesh_, {-0.6, 0.0, 0.4}).positions);
  const Report& second = world_.detect();
  EXPECT_TRUE(second.began().empty());
  EXPECT_EQ(std::vector(second.ended().begin(), second.ended().end()),
            (std::vector<ContactEvent>{{left_, right_}, {left_, floor_}}));
  world_.remove_body(right_);
  const Report& third = world_.detect();
  EXPECT_EQ(std::vector(third.ended().begin(), third.ended().end()), (std::vector<ContactEvent>{{right_, floor_}}));
  EXPECT_TRUE(world_.detect().ended().empty());
}

TEST_F(WorldOfThree, RefusesSettingsWithoutMeaning) {
  world_.set_settings({.threads = 1, .gjk_tolerance = 1e-9});
  const std::uint64_t before = hash();
  const struct {
    Settings settings;
    const char* name;
  } bad[] = {{{.threads = -1}, "threads"},
             {{.threads = 1025}, "threads"},
             {{.gjk_tolerance = 0.0}, "gjk_tolerance"},
             {{.gjk_tolerance = -1e-12}, "gjk_tolerance"},
             {{.gjk_tolerance = kNan}, "gjk_tolerance"},
             {{.gjk_tolerance = 1.0}, "gjk_tolerance"},
             {{.iteration_limit = 0}, "iteration_limit"},
             {{.accuracy = static_cast<Accuracy>(17)}, "accuracy"},
             {{.direction = static_cast<DirectionPolicy>(-3)}, "direction"}};
  for (const auto& one : bad) {
    EXPECT_TRUE(throws_error([&] { world_.set_settings(one.settings); }, ErrorCode::bad_settings, {one.name}));
    EXPECT_TRUE(throws_error([&] { World another(one.settings); }, ErrorCode::bad_settings, {one.name}));
    EXPECT_EQ(world_.settings().gjk_tolerance, 1e-9);
    EXPECT_EQ(world_.settings().threads, 1);
  }
  EXPECT_EQ(world_.detect().stats().kept_pairs, 3);  // not even a new look at the pairs
  EXPECT_EQ(hash(), before);
}

TEST(World, IsEmptyAtFirst) {
  World world;
  EXPECT_EQ(world.body_count(), 0u);
  const Report& report = world.detect();
  EXPECT_TRUE(report.contacts().empty());
  EXPECT_TRUE(report.candidate_pairs().empty());
  EXPECT_EQ(report.stats().bodies, 0);
}

// With a slot used again, an old id must not reach the new body, and pairs must not inherit a history.
TEST(World, GivesNoIdTwice) {
  World world;
  const Mesh mesh = icosphere(0);
  std::vector<BodyId> seen;
  for (int i = 0; i < 100; ++i) {
    const BodyId id = world.add_body(definition(mesh));
    EXPECT_EQ(std::count(seen.begin(), seen.end(), id), 0);
    seen.push_back(id);
    world.remove_body(id);
  }
  for (const BodyId id : seen) EXPECT_FALSE(world.contains(id));
}

TEST(World, IdsAreKeysOfUnorderedContainers) {
  World world, other;
  const Mesh mesh = icosphere(0);
  std::unordered_set<BodyId> ids;
  for (int k = 0; k < 10; ++k) {
    const BodyId id = add_bodies(world, std::array{mesh})[0];
    ids.insert(id);
    ids.insert(add_bodies(other, std::array{mesh})[0]);
    if (k % 2 == 0) world.remove_body(id);  // the slot is used again
  }
  EXPECT_EQ(ids.size(), 20u);
  for (const BodyId id : world.bodies()) EXPECT_TRUE(ids.contains(id));
}

TEST(World, RefusesASurfaceOrMotionThatIsNone) {
  World world;
  const Mesh mesh = icosphere(0);
  const auto add = [&](int surface, int motion) {
    world.add_body({.positions = mesh.positions,
                    .facets = mesh.facets,
                    .surface = static_cast<Surface>(surface),
                    .motion = static_cast<Motion>(motion),
                    .name = "odd"});
  };
  EXPECT_TRUE(throws_error([&] { add(2, 0); }, ErrorCode::bad_settings, {"odd", "surface", "2"}));
  EXPECT_TRUE(throws_error([&] { add(0, -1); }, ErrorCode::bad_settings, {"odd", "motion", "-1"}));
  EXPECT_EQ(world.body_count(), 0u);
  EXPECT_NO_THROW(add(1, 1));
}

TEST(World, NamesBodiesByIndexIfNotNamed) {
  World world;
  const Mesh mesh = icosphere(0);
  const BodyId first = world.add_body(definition(mesh));
  const BodyId second = world.add_body(definition(mesh));
  EXPECT_EQ(world.name(first), "body " + std::to_string(first.index));
  EXPECT_EQ(world.name(second), "body " + std::to_string(second.index));
}

TEST(World, TakesBodiesWithoutFacetsOrVertices) {
  World world;
  const Mesh sphere = icosphere(1);
  const BodyId empty = world.add_body(definition(Mesh{}));
  const BodyId points = world.add_body({.positions = sphere.positions, .facets = Eigen::Matrix3Xi(3, 0)});
  world.add_body(definition(sphere));
  EXPECT_TRUE(world.detect().candidate_pairs().empty());
  world.set_positions(points, 2.0 * sphere.positions);
  world.set_positions(empty, Eigen::Matrix3Xd(3, 0));
  EXPECT_TRUE(world.detect().candidate_pairs().empty());
}

struct LayerCase {
  std::uint32_t layer_a, mask_a, layer_b, mask_b;
  bool tested;
};

TEST(World, TestsAPairIfEachMaskHoldsTheOthersLayer) {
  const LayerCase cases[] = {{1, ~0u, 1, ~0u, true}, {1, 2, 2, 1, true},
                             {1, 2, 2, 2, false},    {1, 1, 2, 1, false},
                             {3, 4, 6, 1, true},     {0, ~0u, 1, ~0u, false},
                             {1, 0, 1, ~0u, false},  {0x80000000u, 0x80000000u, 0x80000000u, 0x80000000u, true}};
  const Mesh mesh = icosphere(0);
  for (const LayerCase& c : cases) {
    World world;
    BodyDefinition a = definition(mesh), b = definition(mesh);
    a.layer = c.layer_a, a.mask = c.mask_a, b.layer = c.layer_b, b.mask = c.mask_b;
    world.add_body(a);
    world.add_body(b);
    EXPECT_EQ(world.detect().candidate_pairs().size(), c.tested ? 1u : 0u)
        << c.layer_a << " " << c.mask_a << " " << c.layer_b << " " << c.mask_b;

    World later;
    const BodyId first = later.add_body(definition(mesh)), second = later.add_body(definition(mesh));
    later.detect();
    later.set_layers(first, c.layer_a, c.mask_a);
    later.set_layers(second, c.layer_b, c.mask_b);
    EXPECT_EQ(later.detect().candidate_pairs().size(), c.tested ? 1u : 0u)
        << c.layer_a << " " << c.mask_a << " " << c.layer_b << " " << c.mask_b << ", set afterwards";
  }
}

TEST_F(WorldOfThree, ChangesLayers) {
  world_.detect();
  world_.set_layers(right_, 2, 4);
  EXPECT_EQ(world_.layer(right_), 2u);
  EXPECT_EQ(world_.mask(right_), 4u);
  const Report& report = world_.detect();
  ASSERT_EQ(report.candidate_pairs().size(), 1u);
  EXPECT_EQ(report.candidate_pairs()[0].b, floor_);
  const std::vector<ContactEvent> with_right = {{left_, right_}, {right_, floor_}};
  EXPECT_TRUE(std::ranges::equal(report.ended(), with_right));
  EXPECT_EQ(report.stats().moved_bodies, 1);
  EXPECT_EQ(report.stats().excluded_pairs, 2);

  world_.set_layers(right_, 1, ~0u);
  EXPECT_TRUE(std::ranges::equal(world_.detect().began(), with_right));
  EXPECT_EQ(report.contacts().size(), 3u);
  world_.set_layers(right_, 1, ~0u);
  EXPECT_EQ(world_.detect().stats().moved_bodies, 0);
}

TEST_F(WorldOfThree, ChangesMotion) {
  world_.detect();
  world_.set_motion(left_, Motion::fixed);
  EXPECT_EQ(world_.motion(left_), Motion::fixed);
  EXPECT_TRUE(throws_error([&] { world_.set_positions(left_, left_mesh_.positions); }, ErrorCode::fixed_body));
  const Report& report = world_.detect();
  EXPECT_EQ(report.candidate_pairs().size(), 2u);
  EXPECT_TRUE(std::ranges::equal(report.ended(), std::vector<ContactEvent>{{left_, floor_}}));

  world_.set_motion(floor_, Motion::moving);
  world_.set_positions(floor_, translated(floor_mesh_, {0.0, 0.0, 0.01}).positions);
  EXPECT_TRUE(std::ranges::equal(world_.detect().began(), std::vector<ContactEvent>{{left_, floor_}}));
  EXPECT_EQ(report.contacts().size(), 3u);
  EXPECT_TRUE(throws_error([&] { world_.set_motion(left_, static_cast<Motion>(2)); }, ErrorCode::bad_settings,
                           {"left", "motion", "2"}));
}

TEST(World, NeverTestsTwoFixedBodies) {
  World world;
  const Mesh mesh = icosphere(0);
  BodyDefinition fixed = definition(mesh);
  fixed.motion = Motion::fixed;
  world.add_body(fixed);
  world.add_body(fixed);
  EXPECT_TRUE(world.detect().candidate_pairs().empty());
  world.add_body(definition(mesh));
  EXPECT_EQ(world.detect().candidate_pairs().size(), 2u);
}

// A row-major matrix is copied, and a block of a larger one is read where it is.
TEST(World, TakesRowMajorMatricesAndBlocks) {
  World world;
  const Mesh mesh = icosphere(1), other = translated(mesh, {1.2, 0.0, 0.0});
  const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> rows = mesh.positions;
  Eigen::MatrixXd wide(3, 2 * other.vertex_count());
  wide.rightCols(other.vertex_count()) = other.positions;
  const BodyId a = world.add_body({.positions = rows, .facets = mesh.facets});
  const BodyId b = world.add_body({.positions = wide.rightCols(other.vertex_count()), .facets = mesh.facets});
  const std::array ids = {a, b};
  EXPECT_TRUE(
      same_meeting_bodies(meeting_bodies_by_oracle(std::array{mesh, other}), meeting_bodies(world.detect(), ids)));
}

// A matrix that is part of a taller one has gaps between its columns.
TEST(World, TakesPositionsWithGapsBetweenColumns) {
  World world;
  const Mesh mesh = icosphere(1), other = translated(mesh, {1.2, 0.0, 0.0});
  Eigen::MatrixXd tall = Eigen::MatrixXd::Constant(5, mesh.vertex_count(), kNan);
  tall.topRows(3) = mesh.positions;
  Eigen::MatrixXi tall_facets = Eigen::MatrixXi::Constant(4, mesh.facet_count(), -7);
  tall_facets.bottomRows(3) = mesh.facets;
  const BodyId a = world.add_body({.positions = tall.topRows(3), .facets = tall_facets.bottomRows(3)});
  const std::array ids = {a, world.add_body(definition(other))};
  EXPECT_TRUE(
      same_meeting_bodies(meeting_bodies_by_oracle(std::array{mesh, other}), meeting_bodies(world.detect(), ids)));
}

// What is no matrix of whole columns in the caller's memory is held by the update and its copies.
TEST(World, UpdatesOutliveWhatTheyWereMadeFrom) {
  World world;
  const Mesh mesh = icosphere(1);
  const std::array ids = {world.add_body(definition(mesh)), world.add_body(definition(mesh)),
                          world.add_body(definition(mesh)), world.add_body(definition(mesh)),
                          world.add_body(definition(mesh))};
  std::vector<PositionsUpdate> updates;
  std::vector<Mesh> expected;
  const auto at = [&](double x) { return translated(mesh, {x, 0.0, 0.0}); };
  {
    const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> rows = at(1.0).positions;
    const Eigen::Matrix3Xf narrow = at(2.0).positions.cast<float>();
    const Eigen::Matrix3Xd half = 0.5 * at(3.0).positions;
    updates.push_back({ids[0], rows});
    updates.push_back({ids[1], narrow});
    updates.push_back({ids[2], 2.0 * half});
    updates.push_back({ids[3], at(4.0).positions});
    updates.push_back({ids[4], Eigen::Ref<const Eigen::Matrix3Xd>(2.0 * at(2.5).positions.array() - 5.0)});
    expected = {at(1.0), at(2.0), at(3.0), at(4.0), at(2.5)};
    expected[4].positions = 2.0 * expected[4].positions.array() - 5.0;
    expected[1].positions = narrow.cast<double>();
  }
  const std::vector<PositionsUpdate> copies = updates;
  updates.clear();
  world.set_positions(copies);
  EXPECT_TRUE(same_meeting_bodies(meeting_bodies_by_oracle(expected), meeting_bodies(world.detect(), ids)));
}

// Classes derived from a matrix, whole numbers, vectors and nothing at all.
TEST(World, TakesWhateverIsAMatrix) {
  struct Points : Eigen::Matrix3Xd {
    using Eigen::Matrix3Xd::Matrix3Xd;
  };
  Points points(3, 4);
  points << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(Positions(points).data(), points.data());
  const Eigen::Matrix<int, 3, 4> whole = points.cast<int>();
  const Positions positions = whole;
  EXPECT_TRUE((Eigen::Map<const Eigen::Matrix3Xd>(positions.data(), 3, 4) == points));
  EXPECT_EQ(Positions(Eigen::Vector3d(1, 2, 3)).cols(), 1);
  EXPECT_EQ(Positions(Eigen::Matrix3Xd()).cols(), 0);
}

// What is looked at is not copied.
TEST(World, LooksAtMatricesWhereTheyAre) {
  Eigen::Matrix3Xd matrix = icosphere(1).positions;
  Eigen::MatrixXd tall(5, 7);
  EXPECT_EQ(Positions(matrix).data(), matrix.data());
  const Eigen::Ref<const Eigen::Matrix3Xd> ref = matrix;
  EXPECT_EQ(Positions(ref).data(), matrix.data());
  EXPECT_EQ(Positions(Eigen::Map<Eigen::Matrix3Xd>(matrix.data(), 3, 4)).data(), matrix.data());
  EXPECT_EQ(Positions(tall.middleRows(1, 3)).data(), tall.data() + 1);
  EXPECT_EQ(Positions(tall.middleRows(1, 3)).stride(), 5);
  const double* const data = matrix.data();
  EXPECT_EQ(Positions(std::move(matrix)).data(), data);  // taken over
}

TEST_F(WorldOfThree, RefusesMatricesThatHaveVerticesAsRows) {
  const Eigen::MatrixXd rows = left_mesh_.positions.transpose();
  const Eigen::MatrixXi facet_rows = left_mesh_.facets.transpose();
  const std::uint64_t before = hash();
  const auto refuses = [](const auto& call, const char* who, const char* what) {
    return throws_error(call, ErrorCode::wrong_size, {who, what});
  };
  EXPECT_TRUE(refuses([&] { world_.set_positions(left_, rows); }, "left", "positions is 162 x 3, not 3 x N"));
  EXPECT_TRUE(refuses([&] { world_.add_body({.positions = rows, .facets = left_mesh_.facets, .name = "new"}); }, "new",
                      "positions is 162 x 3, not 3 x N"));
  EXPECT_TRUE(
      refuses([&] { world_.add_body({.positions = left_mesh_.positions, .facets = facet_rows, .name = "new"}); }, "new",
              "facets is 320 x 3, not 3 x N"));
  EXPECT_EQ(hash(), before);
}

TEST_F(WorldOfThree, WritesNumbersThatCanBeRead) {
  Mesh far = left_mesh_;
  far.positions(1, 7) = -1e300;
  EXPECT_TRUE(throws_error([&] { world_.set_positions(left_, far.positions); }, ErrorCode::position_out_of_range,
                           {"vertex 7 has y = -1e+300, which"}));
  EXPECT_TRUE(throws_error([&] { world_.set_settings({.gjk_tolerance = 1e-16}); }, ErrorCode::bad_settings,
                           {"gjk_tolerance is 1e-16, not"}));
}

// A report shows what is the world's: it cannot be copied by mistake.
static_assert(!std::is_copy_constructible_v<Report> && !std::is_copy_assignable_v<Report> &&
              !std::is_move_constructible_v<Report>);

}  // namespace
}  // namespace tact::tests
