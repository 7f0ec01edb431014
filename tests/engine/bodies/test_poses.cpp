// Rigid bodies answer as bodies whose positions are set to the doubles that the pose gives each vertex.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/checks/recorded_world.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

Eigen::Matrix3d matrix_of(const Rotation& rotation) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) << rotation.row[i].x, rotation.row[i].y, rotation.row[i].z;
  return matrix;
}

// What world.h promises, operation by operation.
Eigen::Matrix3Xd placed(const Eigen::Matrix3Xd& rest, const Eigen::Matrix3d& r, const Eigen::Vector3d& t) {
  Eigen::Matrix3Xd result(3, rest.cols());
  for (Eigen::Index v = 0; v < rest.cols(); ++v) {
    for (int k = 0; k < 3; ++k)
      result(k, v) = ((r(k, 0) * rest(0, v) + r(k, 1) * rest(1, v)) + r(k, 2) * rest(2, v)) + t[k];
  }
  return result;
}

struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

// The same bodies twice: some of the first world are rigid, none of the second is.
class Twins {
 public:
  Twins(std::uint64_t seed, double size, double away, int threads, int count = 9)
      : random_(seed), size_(size), away_(away) {
    const Settings settings{.threads = threads, .outputs = {.zones = true, .patches = true, .points = true}};
    rigid_.set_settings(settings);
    plain_.set_settings(settings);
    for (int i = 0; i < count; ++i) add();
  }

  void add() {
    const Mesh mesh = random_.chance(0.3) ? centered_box({size_, 0.7 * size_, 0.4 * size_})
                                          : icosphere(random_.chance(0.1) ? 3 : 1 + random_.below(2), 0.7 * size_);
    const bool is_rigid = random_.chance(0.6);
    add(mesh, is_rigid, random_.chance(0.3) ? 0.05 * size_ : 0.0);
  }

  void add(const Mesh& mesh, bool is_rigid, double margin) {
    BodyDefinition definition{.positions = mesh.positions, .facets = mesh.facets, .margin = margin};
    plain_ids_.push_back(plain_.add_body(definition));
    if (is_rigid) definition.motion = Motion::rigid;
    rigid_ids_.push_back(rigid_.add_body(definition));
    is_rigid_.push_back(is_rigid);
    rest_.push_back(mesh);
  }

  // Some bodies get new poses, those that are not rigid a wobble besides.
  void move() {
    std::vector<PoseUpdate> poses;
    std::vector<Eigen::Matrix3Xd> placed_at(rest_.size());
    std::vector<PositionsUpdate> rigid_updates, plain_updates;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      if (random_.chance(0.2)) continue;
      const Eigen::Matrix3d rotation = matrix_of(random_.rotation());
      const Vec3 at = random_.in_cube(1.6 * size_);
      const Eigen::Vector3d translation(at.x + away_, at.y - away_, at.z);
      placed_at[i] = placed(rest_[i].positions, rotation, translation);
      if (is_rigid_[i]) {
        poses.push_back({rigid_ids_[i], rotation, translation});
      } else {
        rigid_updates.push_back({rigid_ids_[i], placed_at[i]});
      }
      plain_updates.push_back({plain_ids_[i], placed_at[i]});
    }
    plain_.set_positions(plain_updates);
    rigid_.set_positions(rigid_updates);
    if (random_.chance(0.5)) return rigid_.set_poses(poses);
    for (const PoseUpdate& pose : poses) rigid_.set_pose(pose.body, pose.rotation, pose.translation);
  }

  void expect_same_motion() {
    const MotionReport &rigid = rigid_.detect_motion(), &plain = plain_.detect_motion();
    ASSERT_EQ(rigid.first_time(), plain.first_time());
    ASSERT_EQ(rigid.impacts().size(), plain.impacts().size());
    for (std::size_t i = 0; i < rigid.impacts().size(); ++i) {
      const Impact &x = rigid.impacts()[i], &y = plain.impacts()[i];
      ASSERT_EQ(x.a.index, y.a.index);
      ASSERT_EQ(x.b.index, y.b.index);
      ASSERT_EQ(x.time, y.time);
      ASSERT_EQ(x.a_vertices, y.a_vertices);
      ASSERT_EQ(x.b_vertices, y.b_vertices);
    }
    impacts_ += rigid.impacts().size();
  }

  void expect_same_step() {
    const Report &rigid = rigid_.detect(), &plain = plain_.detect();
    ASSERT_EQ(rigid.candidate_pairs().size(), plain.candidate_pairs().size());
    ASSERT_EQ(rigid.hash(), plain.hash());
    ASSERT_EQ(rigid.contacts().size(), plain.contacts().size());
    for (std::size_t i = 0; i < rigid.contacts().size(); ++i) {
      const Contact &x = rigid.contacts()[i], &y = plain.contacts()[i];
      ASSERT_EQ(x.points().size(), y.points().size());
      for (std::size_t k = 0; k < x.points().size(); ++k) {
        ASSERT_EQ(x.points()[k].gap, y.points()[k].gap);
        ASSERT_EQ(x.points()[k].id, y.points()[k].id);
      }
      points_ += x.points().size();
      facet_pairs_ += x.facet_pairs().size();
    }
  }

  void expect_same_queries() {
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = random_.in_cube(3.0 * size_), q = random_.in_cube(3.0 * size_);
      const Eigen::Vector3d from(p.x + away_, p.y - away_, p.z), to(q.x + away_, q.y - away_, q.z);
      const RayHit x = rigid_.cast_ray({.from = from, .to = to}), y = plain_.cast_ray({.from = from, .to = to});
      ASSERT_EQ(x.facet, y.facet);
      ASSERT_EQ(x.fraction, y.fraction);
      const ClosestPoint u = rigid_.closest_point({.point = from}), v = plain_.closest_point({.point = from});
      ASSERT_EQ(u.facet, v.facet);
      ASSERT_EQ(u.distance, v.distance);
      ASSERT_EQ(rigid_.bodies_containing({.point = from}).size(), plain_.bodies_containing({.point = from}).size());
    }
    expect_same_rays();
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      ASSERT_EQ(rigid_.bounds(rigid_ids_[i]).lower, plain_.bounds(plain_ids_[i]).lower);
      Eigen::Matrix3Xd x(3, rest_[i].positions.cols()), y = x;
      rigid_.copy_positions(rigid_ids_[i], {x.data(), static_cast<std::size_t>(x.size())});
      plain_.copy_positions(plain_ids_[i], {y.data(), static_cast<std::size_t>(y.size())});
      ASSERT_EQ(x, y);
    }
  }

  // Many at once: whichever thread comes first to a body places it.
  void expect_same_rays() {
    std::vector<Ray> rays(100);
    for (Ray& ray : rays) {
      const Vec3 p = random_.in_cube(3.0 * size_), q = random_.in_cube(size_);
      ray.from = {p.x + away_, p.y - away_, p.z};
      ray.to = {q.x + away_, q.y - away_, q.z};
    }
    std::vector<RayHit> x(rays.size()), y(rays.size());
    rigid_.cast_rays(rays, x);
    plain_.cast_rays(rays, y);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(x[i].body.index, y[i].body.index);
      ASSERT_EQ(x[i].facet, y[i].facet);
      ASSERT_EQ(x[i].fraction, y[i].fraction);
      ASSERT_EQ(x[i].barycentric, y[i].barycentric);
    }
  }

  void replace_one() {
    const auto i = static_cast<std::size_t>(random_.below(static_cast<int>(rest_.size())));
    rigid_.remove_body(rigid_ids_[i]);
    plain_.remove_body(plain_ids_[i]);
    const auto drop = [&](auto& list) { list.erase(list.begin() + static_cast<std::ptrdiff_t>(i)); };
    drop(rigid_ids_), drop(plain_ids_), drop(rest_), drop(is_rigid_);
    add();
  }

  RecordedWorld& rigid() { return rigid_; }
  std::size_t impacts() const { return impacts_; }
  std::size_t points() const { return points_; }
  std::size_t facet_pairs() const { return facet_pairs_; }

 private:
  Random random_;
  double size_, away_;
  RecordedWorld rigid_, plain_;
  std::vector<BodyId> rigid_ids_, plain_ids_;
  std::vector<Mesh> rest_;
  std::vector<bool> is_rigid_;
  std::size_t impacts_ = 0, points_ = 0, facet_pairs_ = 0;
};

struct Setting {
  const char* name;
  double size, away;
};

class RigidTwins : public ::testing::TestWithParam<Setting> {};

TEST_P(RigidTwins, AnswerAsPlacedBodies) {
  std::size_t impacts = 0, points = 0, facet_pairs = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Twins twins(seed, GetParam().size, GetParam().away, 1 + static_cast<int>(seed % 4));
    for (int step = 0; step < 6; ++step) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
      if (step % 3 == 2) twins.replace_one();
      if (step != 4) twins.move();
      if (step % 2 == 1) twins.expect_same_queries();
      if (step > 0 && step % 2 == 0) twins.expect_same_motion();
      if (HasFatalFailure()) return;
      twins.expect_same_step();
      if (HasFatalFailure()) return;
    }
    impacts += twins.impacts(), points += twins.points(), facet_pairs += twins.facet_pairs();
  }
  EXPECT_GT(impacts, 50u);
  EXPECT_GT(points, 100u);
  EXPECT_GT(facet_pairs, 100u);
}

INSTANTIATE_TEST_SUITE_P(Sizes, RigidTwins,
                         ::testing::Values(Setting{"of_a_metre", 1.0, 0.0}, Setting{"far_away", 1.0, 1e9},
                                           Setting{"tiny", 0x1p-300, 0.0}, Setting{"huge", 0x1p280, 0.0}),
                         [](const auto& setting) { return std::string(setting.param.name); });

// Of 80 clusters each, in three groups.
TEST(Rigid, LargeBodiesAnswerAsPlacedOnesOnAnyThreads) {
  const Mesh ball = icosphere(4, 0.7), rough = blob(4, 0.7, 0.3, 1);
  for (const int threads : {1, 3}) {
    Twins twins(5, 1.0, 0.0, threads, 0);
    for (int i = 0; i < 4; ++i) twins.add(i % 2 == 0 ? ball : rough, i != 1, i == 2 ? 0.01 : 0.0);
    for (int step = 0; step < 3; ++step) {
      SCOPED_TRACE(std::to_string(threads) + " threads, step " + std::to_string(step));
      twins.move();
      if (step == 1) twins.expect_same_queries();
      if (step == 2) twins.expect_same_motion();
      if (HasFatalFailure()) return;
      twins.expect_same_step();
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(twins.facet_pairs(), 100u);
    EXPECT_GT(twins.points(), 100u);
  }
}

TEST(Rigid, OnlyBodiesThatOthersComeNearArePlaced) {
  const Mesh ball = icosphere(2);
  RecordedWorld world;
  std::vector<BodyId> ids;
  for (int i = 0; i < 20; ++i)
    ids.push_back(world.add_body({.positions = ball.positions, .facets = ball.facets, .motion = Motion::rigid}));
  std::vector<PoseUpdate> poses;
  for (int i = 0; i < 20; ++i) poses.push_back({ids[i], Eigen::Matrix3d::Identity(), {5.0 * i + 1.0, 0.0, 0.0}});
  poses[1].translation.x() = 2.5;
  world.set_poses(poses);
  const Report& report = world.detect();
  EXPECT_EQ(report.candidate_pairs().size(), 1u);
  EXPECT_EQ(report.stats().placed_bodies, 2);
  EXPECT_EQ(world.detect().stats().placed_bodies, 0);
  world.set_poses(poses);  // where they are
  EXPECT_EQ(world.detect().stats().moved_bodies, 0);
}

// Two tilted rings whose turned boxes and balls overlap, and whose boxes do not; then nearer.
TEST(Rigid, BodiesWhoseBoxesAreApartAreNoCandidates) {
  const Mesh ring = torus(64, 32, 1.0, 0.4);
  RecordedWorld world;
  const BodyDefinition definition{.positions = ring.positions, .facets = ring.facets, .motion = Motion::rigid};
  const BodyId a = world.add_body(definition), b = world.add_body(definition);
  const Eigen::Matrix3d tilt = matrix_of(rotation(1.0, std::tan(0.125 * 3.14159265358979), 0.0, 0.0));
  for (const double x : {0.3, 0.2, 0.1}) {
    world.set_poses(std::vector<PoseUpdate>{{a, tilt, {x, 0.0, 0.0}}, {b, tilt, {0.0, 2.25, 0.0}}});
    EXPECT_TRUE(world.detect().candidate_pairs().empty());
  }
  world.set_pose(a, tilt, {0.0, 1.0, 0.0});
  const Report& report = world.detect();
  EXPECT_EQ(report.candidate_pairs().size(), 1u);
  EXPECT_EQ(report.stats().placed_bodies, 1);  // the other stands as it stood
}

TEST(Rigid, ARecordingPlaysThePoses) {
  Twins twins(3, 1.0, 0.0, 2);
  for (int step = 0; step < 4; ++step) {
    twins.move();
    twins.rigid().detect();
  }
  const std::string recording = twins.rigid().recording();
  RecordingPlayer player(recording, {});
  int steps = 0;
  while (const auto step = player.next()) {
    ++steps;
    EXPECT_EQ(step->recorded, step->now);
  }
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(player.cut_at(), std::nullopt);
}

class RigidRefusal : public ::testing::Test {
 protected:
  template <class Call>
  void expect(ErrorCode code, const std::string& words, const Call& call) {
    const std::uint64_t before = world_.detect().hash();
    try {
      call();
      FAIL() << "nothing was refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    EXPECT_EQ(world_.detect().hash(), before);
    EXPECT_EQ(world_.detect().stats().moved_bodies, 0);
  }

  const Mesh ball_ = icosphere(1);
  RecordedWorld world_;
  const BodyId rigid_ =
      world_.add_body({.positions = ball_.positions, .facets = ball_.facets, .motion = Motion::rigid, .name = "stone"});
  const BodyId soft_ = world_.add_body({.positions = ball_.positions, .facets = ball_.facets, .name = "jelly"});
  const Eigen::Matrix3d identity_ = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d here_ = Eigen::Vector3d::Zero();
};

TEST_F(RigidRefusal, WhatIsNoRotation) {
  Eigen::Matrix3d stretched = identity_, mirror = identity_, skew = identity_, broken = identity_;
  stretched(1, 1) = 1.0 + 1e-8;
  mirror(2, 2) = -1.0;
  skew(0, 1) = 1e-8;
  broken(2, 0) = std::numeric_limits<double>::quiet_NaN();
  for (const Eigen::Matrix3d& matrix : {stretched, mirror, skew, broken})
    expect(ErrorCode::not_a_rotation, "stone", [&] { world_.set_pose(rigid_, matrix, here_); });
  Eigen::Matrix3d nearly = identity_;
  nearly(0, 1) = 5e-10;
  EXPECT_NO_THROW(world_.set_pose(rigid_, nearly, here_));
}

TEST_F(RigidRefusal, PlacesThatAreTooFar) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect(ErrorCode::non_finite_position, "stone", [&] { world_.set_pose(rigid_, identity_, {0.0, nan, 0.0}); });
  expect(ErrorCode::position_out_of_range, "stone", [&] { world_.set_pose(rigid_, identity_, {0x1p301, 0.0, 0.0}); });
  // A translation that is allowed, and vertices that are not.
  const BodyId planet = world_.add_body(
      {.positions = 0x1p299 * ball_.positions, .facets = ball_.facets, .motion = Motion::rigid, .name = "planet"});
  const std::vector<PoseUpdate> far{{rigid_, identity_, {1.0, 0.0, 0.0}}, {planet, identity_, {0x1.9p299, 0.0, 0.0}}};
  world_.detect();
  expect(ErrorCode::position_out_of_range, "planet", [&] { world_.set_pose(planet, identity_, far[1].translation); });
  expect(ErrorCode::position_out_of_range, "vertex", [&] { world_.set_poses(far); });
  EXPECT_NO_THROW(world_.set_pose(planet, identity_, {0x1p298, 0.0, 0.0}));
}

TEST_F(RigidRefusal, WhatDoesNotFitTheMotion) {
  expect(ErrorCode::wrong_motion, "jelly", [&] { world_.set_pose(soft_, identity_, here_); });
  expect(ErrorCode::wrong_motion, "stone", [&] { world_.set_positions(rigid_, ball_.positions); });
  expect(ErrorCode::wrong_motion, "stone", [&] { world_.set_motion(rigid_, Motion::deformable); });
  expect(ErrorCode::wrong_motion, "jelly", [&] { world_.set_motion(soft_, Motion::rigid); });
  world_.set_motion(rigid_, Motion::fixed);
  world_.detect();
  expect(ErrorCode::fixed_body, "stone", [&] { world_.set_pose(rigid_, identity_, here_); });
  world_.set_motion(rigid_, Motion::rigid);
  EXPECT_NO_THROW(world_.set_pose(rigid_, identity_, {1.0, 0.0, 0.0}));
}

TEST_F(RigidRefusal, ABatchIsAllOrNothing) {
  const std::vector<PoseUpdate> twice{{rigid_, identity_, {1.0, 0.0, 0.0}}, {rigid_, identity_, {2.0, 0.0, 0.0}}};
  expect(ErrorCode::wrong_order, "twice", [&] { world_.set_poses(twice); });
  const std::vector<PoseUpdate> mixed{{rigid_, identity_, {1.0, 0.0, 0.0}}, {soft_, identity_, here_}};
  expect(ErrorCode::wrong_motion, "update 1", [&] { world_.set_poses(mixed); });
}

}  // namespace
}  // namespace tact::tests
