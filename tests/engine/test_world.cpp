// Bodies come, move and go.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/world_of_three.h"

namespace tact::tests {
namespace {

TEST_F(WorldOfThree, KnowsItsBodies) {
  EXPECT_EQ(world_.body_count(), 3u);
  EXPECT_EQ(world_.bodies(), (std::vector<BodyId>{left_, right_, floor_}));
  EXPECT_EQ(world_.name(left_), "left");
  EXPECT_EQ(world_.motion(floor_), Motion::fixed);
  EXPECT_EQ(world_.motion(left_), Motion::deformable);
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

  world_.set_motion(floor_, Motion::deformable);
  world_.set_positions(floor_, translated(floor_mesh_, {0.0, 0.0, 0.01}).positions);
  EXPECT_TRUE(std::ranges::equal(world_.detect().began(), std::vector<ContactEvent>{{left_, floor_}}));
  EXPECT_EQ(report.contacts().size(), 3u);
  EXPECT_TRUE(throws_error([&] { world_.set_motion(left_, static_cast<Motion>(3)); }, ErrorCode::invalid_argument,
                           {"left", "motion", "3"}));
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

// A report shows what is the world's: it cannot be copied by mistake.
static_assert(!std::is_copy_constructible_v<Report> && !std::is_copy_assignable_v<Report> &&
              !std::is_move_constructible_v<Report>);

}  // namespace
}  // namespace tact::tests
