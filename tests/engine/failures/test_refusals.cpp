// Every wrong call is refused by name and changes nothing.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/world_of_three.h"

namespace tact::tests {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Every call that takes an id refuses this one.
void expect_refused(World& world, BodyId id, const Eigen::Matrix3Xd& positions, ErrorCode code) {
  SCOPED_TRACE("id " + std::to_string(id.index) + ", generation " + std::to_string(id.generation));
  EXPECT_FALSE(world.contains(id));
  EXPECT_TRUE(throws_error([&] { world.remove_body(id); }, code));
  EXPECT_TRUE(throws_error([&] { world.set_positions(id, positions); }, code));
  EXPECT_TRUE(throws_error([&] { world.name(id); }, code));
  EXPECT_TRUE(throws_error([&] { world.surface(id); }, code));
  EXPECT_TRUE(throws_error([&] { world.motion(id); }, code));
  EXPECT_TRUE(throws_error([&] { world.layer(id); }, code));
  EXPECT_TRUE(throws_error([&] { world.mask(id); }, code));
  EXPECT_TRUE(throws_error([&] { world.set_layers(id, 2, 2); }, code));
  EXPECT_TRUE(throws_error([&] { world.set_motion(id, Motion::fixed); }, code));
  EXPECT_TRUE(throws_error([&] { world.vertex_count(id); }, code));
  EXPECT_TRUE(throws_error([&] { world.facet_count(id); }, code));
}

TEST_F(WorldOfThree, RefusesStaleIdInEveryCall) {
  world_.remove_body(right_);
  const BodyId next = world_.add_body(definition(right_mesh_, "next"));
  EXPECT_NE(next, right_);
  const std::uint64_t before = hash();
  const std::array updates = {PositionsUpdate{left_, left_mesh_.positions},
                              PositionsUpdate{right_, right_mesh_.positions}};
  for (const BodyId stale : {right_, BodyId{}, BodyId{99, 1, left_.world}, BodyId{left_.index, 7, left_.world}}) {
    expect_refused(world_, stale, right_mesh_.positions, ErrorCode::stale_body);
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
  expect_refused(world_, foreign, right_mesh_.positions, ErrorCode::foreign_body);
  EXPECT_TRUE(throws_error([&] { world_.set_positions(updates); }, ErrorCode::foreign_body));
  EXPECT_EQ(world_.body_count(), 3u);
  EXPECT_EQ(hash(), before);
  EXPECT_EQ(other.detect().hash(), others);
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
    updates.push_back({ids[i], wrong ? bad : left_mesh_.positions});
  }
  for (int repeat = 0; repeat < 20; ++repeat) {
    EXPECT_TRUE(throws_error([&] { world_.set_positions(updates); }, ErrorCode::non_finite_position, {"number 39."}));
  }
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
  EXPECT_TRUE(throws_error([&] { add(2, 0); }, ErrorCode::invalid_argument, {"odd", "surface", "2"}));
  EXPECT_TRUE(throws_error([&] { add(0, -1); }, ErrorCode::invalid_argument, {"odd", "motion", "-1"}));
  EXPECT_EQ(world.body_count(), 0u);
  EXPECT_NO_THROW(add(1, 1));
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

}  // namespace
}  // namespace tact::tests
