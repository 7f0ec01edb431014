// Bodies whose facets change: what is still there keeps its ids and its history, all else is as in a world made anew.
#include <gtest/gtest.h>
#include <tact/recording.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/folds.h"
#include "tests/support/generators/random.h"
#include "tests/support/generators/remeshed.h"

namespace tact::tests {
namespace {

constexpr Outputs kAll{.patches = true, .points = true};

void set_facets(tact::World& world, BodyId body, const Remeshed& to) {
  world.set_facets(body, to.mesh.positions, to.mesh.facets, to.vertex_map);
}

// A point without what belongs to one step: features as sets of the names that vertices have in `names`.
using PointName = std::tuple<FeaturePair, std::set<int>, std::set<int>>;

PointName name_of(const ContactPoint& point, const std::vector<int>& names_a, const std::vector<int>& names_b,
                  bool of_itself) {
  const auto names_of = [](const std::array<int, 3>& vertices, const std::vector<int>& names) {
    std::set<int> found;
    for (const int v : vertices) {
      if (v >= 0) found.insert(names.empty() ? v : names[static_cast<std::size_t>(v)]);
    }
    return found;
  };
  auto a = names_of(point.a_vertices, names_a), b = names_of(point.b_vertices, names_b);
  if (of_itself && point.kind == FeaturePair::edge_edge && b < a) std::swap(a, b);
  return {point.kind, a, b};
}

using PointIds = std::map<std::uint64_t, PointName>;

// Of all points, each under its id. Of some body vertices have the names `names`.
PointIds point_ids(const Report& report, BodyId body = {}, const std::vector<int>& names = {}) {
  PointIds ids;
  for (const Contact& contact : report.contacts()) {
    for (const ContactPoint& point : contact.points()) {
      const auto name = name_of(point, contact.a == body ? names : std::vector<int>{},
                                contact.b == body ? names : std::vector<int>{}, contact.a == contact.b);
      EXPECT_TRUE(ids.emplace(point.id, name).second) << "an id is there twice";
    }
  }
  return ids;
}

std::vector<std::uint64_t> patch_ids(const Report& report) {
  std::vector<std::uint64_t> ids;
  for (const Contact& contact : report.contacts()) {
    for (const Patch& patch : contact.patches()) ids.push_back(patch.id);
  }
  std::ranges::sort(ids);
  return ids;
}

// A folded cloth that touches itself, on a ball, over a fixed floor.
class ChangingFacets : public ::testing::Test {
 protected:
  ChangingFacets() { fill(world_); }

  void fill(tact::World& world) { fill(world, cloth_mesh_, ball_mesh_); }
  void fill(tact::World& world, const Mesh& cloth, const Mesh& ball) {
    cloth_ = world.add_body({.positions = cloth.positions,
                             .facets = cloth.facets,
                             .surface = Surface::sheet,
                             .name = "cloth",
                             .margin = 0.04,
                             .self_contact = true});
    ball_ = world.add_body({.positions = ball.positions, .facets = ball.facets, .margin = 0.02});
    floor_ = world.add_body({.positions = floor_mesh_.positions,
                             .facets = floor_mesh_.facets,
                             .surface = Surface::sheet,
                             .motion = Motion::fixed,
                             .margin = 0.02});
  }

  static Vec3 lowest(const Mesh& mesh) {
    Eigen::Index at = 0;
    mesh.positions.row(2).minCoeff(&at);
    return mesh.position(static_cast<int>(at));
  }

  Mesh cloth_mesh_ = rolled_sheet(40, 6, 1.5, 0.2, 0.05);
  Mesh ball_mesh_ = translated(icosphere(3, 0.3), lowest(cloth_mesh_) + Vec3{0.01, 0.02, -0.33});
  Mesh floor_mesh_ = translated(sheet(2, 2, 4.0, 4.0), {0.0, 0.0, lowest(ball_mesh_).z - 0.01});
  World world_{{.threads = 1, .outputs = kAll}};
  BodyId cloth_, ball_, floor_;
};

TEST_F(ChangingFacets, TheSceneHasAllKindsOfContacts) {
  const Report& report = world_.detect();
  for (const auto& [a, b] : {std::pair{cloth_, cloth_}, std::pair{cloth_, ball_}, std::pair{ball_, floor_}}) {
    const Contact* const contact = report.find_contact(a, b);
    ASSERT_NE(contact, nullptr) << a.index << " " << b.index;
    EXPECT_FALSE(contact->points().empty());
  }
}

TEST_F(ChangingFacets, ARenumberedBodyKeepsEveryIdEventAndDirection) {
  Random random(5);
  const PointIds before = point_ids(world_.detect());
  const std::vector<std::uint64_t> patches = patch_ids(world_.detect());
  std::vector<Eigen::Vector3d> directions;
  for (const Contact& contact : world_.detect().contacts()) directions.push_back(contact.direction);
  for (const BodyId body : {cloth_, ball_, floor_}) {
    const Mesh& mesh = body == cloth_ ? cloth_mesh_ : body == ball_ ? ball_mesh_ : floor_mesh_;
    std::vector<int> names = unchanged(mesh).vertex_map;
    Remeshed now = unchanged(mesh);
    for (int time = 0; time < 3; ++time) {
      now = renumbered({now.mesh, unchanged(now.mesh).vertex_map}, random, time > 0);
      std::vector<int> next;
      for (const int was : now.vertex_map) next.push_back(names[static_cast<std::size_t>(was)]);
      names = next;
      set_facets(world_, body, now);
      const Report& report = world_.detect();
      EXPECT_TRUE(report.began().empty() && report.ended().empty() && report.patch_events().empty());
      EXPECT_EQ(point_ids(report, body, names), before) << "time " << time;
      EXPECT_EQ(patch_ids(report), patches);
      ASSERT_EQ(report.contacts().size(), directions.size());
      for (std::size_t i = 0; i < directions.size(); ++i)
        EXPECT_LT((report.contacts()[i].direction - directions[i]).norm(), 1e-13);
    }
    // Back to the numbers that it had: ids are those of a body that never changed.
    Remeshed back{mesh, std::vector<int>(names.size())};
    for (std::size_t v = 0; v < names.size(); ++v)
      back.vertex_map[static_cast<std::size_t>(names[v])] = static_cast<int>(v);
    set_facets(world_, body, back);
    EXPECT_EQ(point_ids(world_.detect()), before);
  }
}

// With the numbers that it had it is set_positions(), bit for bit.
TEST_F(ChangingFacets, UnchangedFacetsAreNewPositionsAlone) {
  World other({.threads = 1, .outputs = kAll});
  fill(other);
  world_.detect(), other.detect();
  for (int step = 1; step < 4; ++step) {
    const Mesh moved = translated(cloth_mesh_, {0.01 * step, 0.0, -0.004 * step});
    other.set_positions(cloth_, moved.positions);
    set_facets(world_, BodyId{cloth_.index, cloth_.generation, world_.bodies()[0].world}, unchanged(moved));
    for (const Impacts wanted : {Impacts::all, Impacts::first}) {
      const MotionReport &expected = other.detect_motion(wanted), &found = world_.detect_motion(wanted);
      EXPECT_EQ(expected.first_time(), found.first_time());
      EXPECT_EQ(expected.impacts().size(), found.impacts().size());
    }
    EXPECT_EQ(other.detect().hash(), world_.detect().hash());
  }
}

// Whatever was changed: facet pairs are those of a world made anew; so are near points, but for their ids.
TEST_F(ChangingFacets, AnswersAreThoseOfAWorldMadeAnew) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    World world({.threads = 1, .direction = DirectionPolicy::smallest, .outputs = kAll});
    fill(world);
    const std::array bodies{cloth_, ball_};
    Mesh cloth = cloth_mesh_, ball = ball_mesh_;
    for (int time = 0; time < 3; ++time) {
      world.detect();
      Mesh& changed = random.chance(0.5) ? cloth : ball;
      const Remeshed made = remeshed(changed, random);
      changed = translated(made.mesh, 0.02 * random.in_ball());
      world.set_facets(bodies[&changed == &cloth ? 0 : 1], changed.positions, changed.facets, made.vertex_map);
      World fresh({.threads = 1, .direction = DirectionPolicy::smallest, .outputs = kAll});
      fill(fresh, cloth, ball);
      const Report &report = world.detect(), &expected = fresh.detect();
      ASSERT_EQ(report.contacts().size(), expected.contacts().size()) << "seed " << seed << ", time " << time;
      for (std::size_t i = 0; i < report.contacts().size(); ++i) {
        const Contact &one = report.contacts()[i], &other = expected.contacts()[i];
        EXPECT_TRUE(same_facet_pairs(other.facet_pairs(), one.facet_pairs())) << "seed " << seed;
        // Points of what has crossed depend on history.
        if (one.a != one.b && (!one.facet_pairs().empty() || one.containment != Containment::none)) continue;
        ASSERT_EQ(one.points().size(), other.points().size()) << "seed " << seed << ", time " << time;
        for (std::size_t p = 0; p < one.points().size(); ++p) {
          EXPECT_EQ(name_of(one.points()[p], {}, {}, false), name_of(other.points()[p], {}, {}, false));
          EXPECT_EQ(one.points()[p].gap, other.points()[p].gap);
        }
      }
    }
  }
}

// Vertices that are new stand; the others come from where they were that they were, whatever their number.
TEST_F(ChangingFacets, MotionGoesAcrossAChange) {
  const Mesh high = translated(sheet(4, 4, 1.0, 1.0), {0.0, 0.0, 1.0});
  const Mesh low = translated(high, {0.0, 0.0, -2.0});
  Random random(3);
  World world({.threads = 1});
  const Mesh ground = sheet(3, 3, 3.0, 3.0);
  const BodyId moving = world.add_body({.positions = high.positions, .facets = high.facets, .surface = Surface::sheet});
  world.add_body(
      {.positions = ground.positions, .facets = ground.facets, .surface = Surface::sheet, .motion = Motion::fixed});
  world.detect();
  Remeshed fallen = renumbered(unchanged(low), random, true);
  set_facets(world, moving, fallen);
  EXPECT_NEAR(world.detect_motion(Impacts::first).first_time(), 0.5, 1e-9);
  // Again before the next step, in two parts: the way is still that from the last step on.
  fallen = renumbered(cut(unchanged(fallen.mesh), {1.0, 0.0, 0.0}, 0.01), random, false);
  set_facets(world, moving, fallen);
  EXPECT_NEAR(world.detect_motion(Impacts::first).first_time(), 0.5, 1e-9);
  fallen.vertex_map.assign(fallen.vertex_map.size(), -1);
  set_facets(world, moving, fallen);
  EXPECT_TRUE(world.detect_motion(Impacts::all).impacts().empty());
  world.detect();
  world.set_positions(moving, translated(fallen.mesh, {0.0, 0.0, 4.0}).positions);
  EXPECT_NEAR(world.detect_motion(Impacts::first).first_time(), 0.25, 1e-9);
}

TEST_F(ChangingFacets, WhatIsSavedBeforeTheNextStepGoesOnTheSame) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    World world({.threads = 1, .outputs = kAll}), other({.threads = 1, .outputs = kAll});
    fill(world);
    world.detect();
    const BodyId body = seed % 2 == 0 ? ball_ : cloth_;
    const Remeshed first = remeshed(body == ball_ ? ball_mesh_ : cloth_mesh_, random);
    set_facets(world, body, first);
    const Remeshed second = remeshed(first.mesh, random);
    if (random.chance(0.5)) set_facets(world, body, second);
    other.restore(world.save());
    EXPECT_EQ(other.save(), world.save()) << "seed " << seed;
    for (int step = 0; step < 2; ++step) {
      EXPECT_EQ(other.detect().hash(), world.detect().hash()) << "seed " << seed;
      EXPECT_EQ(point_ids(other.detect()), point_ids(world.detect()));
      EXPECT_EQ(other.save(), world.save()) << "seed " << seed << ", step " << step;
    }
  }
}

TEST_F(ChangingFacets, ARecordingPlaysIt) {
  std::ostringstream stream;
  Recorder recorder(stream);
  tact::World world({.threads = 1, .outputs = kAll});
  world.set_observer(&recorder);
  fill(world);
  Random random(2);
  Mesh cloth = cloth_mesh_;
  std::vector<PointIds> recorded;
  for (int step = 0; step < 3; ++step) {
    world.detect();
    const Remeshed made = remeshed(cloth, random);
    cloth = made.mesh;
    set_facets(world, cloth_, made);
    recorded.push_back(point_ids(world.detect()));
  }
  const std::string bytes = stream.str();
  RecordingPlayer player(bytes);
  int steps = 0;
  for (; const auto played = player.next(); ++steps) {
    EXPECT_TRUE(played->same());
    if (steps % 2 == 0) continue;
    EXPECT_EQ(point_ids(player.report()), recorded[static_cast<std::size_t>(steps / 2)]);
  }
  EXPECT_EQ(steps, 6);
}

TEST_F(ChangingFacets, WhatIsRefusedChangesNothing) {
  const std::uint64_t hash = world_.detect().hash();
  const std::vector<std::byte> bytes = world_.save();
  const Remeshed good = unchanged(cloth_mesh_);
  const auto expect_refused = [&](BodyId body, const Remeshed& made, ErrorCode code, const char* word) {
    EXPECT_TRUE(throws_error([&] { set_facets(world_, body, made); }, code, {word}));
    EXPECT_EQ(world_.save(), bytes) << word;
  };
  Remeshed bad = good;
  bad.vertex_map.pop_back();
  expect_refused(cloth_, bad, ErrorCode::wrong_size, "vertex map has");
  bad = good;
  bad.vertex_map[3] = cloth_mesh_.vertex_count();
  expect_refused(cloth_, bad, ErrorCode::invalid_argument, "for vertex 3");
  bad.vertex_map[3] = -2;
  expect_refused(cloth_, bad, ErrorCode::invalid_argument, "names vertex -2");
  bad = good;
  bad.mesh.facets(1, 4) = cloth_mesh_.vertex_count();
  expect_refused(cloth_, bad, ErrorCode::facet_out_of_range, "facet 4");
  bad = good;
  bad.mesh.positions(2, 7) = HUGE_VAL;
  expect_refused(cloth_, bad, ErrorCode::non_finite_position, "vertex 7");
  bad.mesh.positions(2, 7) = 0x1p301;
  expect_refused(cloth_, bad, ErrorCode::position_out_of_range, "vertex 7");
  expect_refused({}, good, ErrorCode::stale_body, "names no body");
  expect_refused({cloth_.index, cloth_.generation, cloth_.world + 1}, good, ErrorCode::foreign_body, "another world");
  const Eigen::MatrixXd flat = Eigen::MatrixXd::Zero(2, 5);
  const Eigen::MatrixXi quads = Eigen::MatrixXi::Zero(4, 5);
  EXPECT_TRUE(throws_error([&] { world_.set_facets(cloth_, flat, good.mesh.facets, good.vertex_map); },
                           ErrorCode::wrong_size, {"positions is 2 x 5"}));
  EXPECT_TRUE(throws_error([&] { world_.set_facets(cloth_, good.mesh.positions, quads, good.vertex_map); },
                           ErrorCode::wrong_size, {"facets is 4 x 5"}));
  EXPECT_EQ(world_.detect().hash(), hash);
  const BodyId rigid =
      world_.add_body({.positions = ball_mesh_.positions, .facets = ball_mesh_.facets, .motion = Motion::rigid});
  EXPECT_TRUE(throws_error([&] { set_facets(world_, rigid, unchanged(ball_mesh_)); }, ErrorCode::wrong_motion,
                           {"added as rigid"}));
}

// Doubles come first or last, in a numbering forwards or backwards: the first that names a vertex keeps its ids.
TEST_F(ChangingFacets, OneOfTheDoublesKeepsTheIds) {
  constexpr int kSide = 11;
  Mesh flat = translated(sheet(kSide - 1, kSide - 1, 0.1, 0.1), {0.0, 0.0, 0.003});
  MeshBuilder one_facet;
  one_facet.triangle({-5.0, -5.0, 0.0}, {5.0, -5.0, 0.0}, {0.0, 8.0, 0.0});
  const Mesh ground = one_facet.mesh();
  for (const bool backwards : {false, true}) {
    World world({.threads = 1, .outputs = {.points = true}});
    const BodyId body = world.add_body({.positions = flat.positions,
                                        .facets = flat.facets,
                                        .surface = Surface::sheet,
                                        .margin = 0.002,
                                        .self_contact = true});
    const BodyId under = world.add_body({.positions = ground.positions,
                                         .facets = ground.facets,
                                         .surface = Surface::sheet,
                                         .motion = Motion::fixed,
                                         .margin = 0.002});
    const PointIds before = point_ids(world.detect());
    Remeshed halves = cut(unchanged(flat), {1.0, 0.0, 0.0}, 0.0);
    ASSERT_EQ(halves.mesh.vertex_count(), kSide * kSide + kSide);
    if (backwards) {
      std::vector<int> vertices = unchanged(halves.mesh).vertex_map,
                       facets(static_cast<std::size_t>(flat.facet_count()));
      std::ranges::reverse(vertices);
      for (std::size_t f = 0; f < facets.size(); ++f) facets[f] = static_cast<int>(f);
      std::vector<int> map;
      for (const int v : vertices) map.push_back(halves.vertex_map[static_cast<std::size_t>(v)]);
      halves = {permuted(halves.mesh, vertices, facets), map};
    }
    set_facets(world, body, halves);
    const Report& report = world.detect();
    EXPECT_TRUE(report.ended().empty());
    ASSERT_EQ(report.began().size(), 1u);
    EXPECT_EQ(report.began()[0].a, report.began()[0].b);
    const Contact* const walls = report.find_contact(body, body);
    ASSERT_NE(walls, nullptr);
    for (const ContactPoint& point : walls->points()) EXPECT_GE(point.gap, 0.0);
    std::size_t kept = 0;
    for (const ContactPoint& point : report.find_contact(body, under)->points()) {
      const auto was = before.find(point.id);
      if (was == before.end()) continue;
      ++kept;
      EXPECT_EQ(name_of(point, halves.vertex_map, {}, false), was->second);
    }
    EXPECT_EQ(kept, before.size());
    EXPECT_EQ(report.find_contact(body, under)->points().size(), before.size() + kSide);
    // The halves move apart: nothing is left between them, and they lie where they lay.
    Mesh apart = halves.mesh;
    std::vector<char> is_right(halves.vertex_map.size(), 0);
    for (int f = 0; f < apart.facet_count(); ++f) {
      const Eigen::Vector3i corners = apart.facets.col(f);
      const bool right = halves.mesh.positions(0, corners).sum() > 0.0;
      for (const int v : corners) is_right[static_cast<std::size_t>(v)] |= right ? 1 : 0;
    }
    for (int v = 0; v < apart.vertex_count(); ++v) {
      if (is_right[static_cast<std::size_t>(v)] != 0) apart.positions(0, v) += 0.005;
    }
    std::set<std::uint64_t> ids;
    for (const ContactPoint& point : report.find_contact(body, under)->points()) ids.insert(point.id);
    world.set_positions(body, apart.positions);
    const Report& later = world.detect();
    EXPECT_EQ(later.find_contact(body, body), nullptr);
    for (const ContactPoint& point : later.find_contact(body, under)->points()) EXPECT_EQ(ids.count(point.id), 1u);
    EXPECT_EQ(later.find_contact(body, under)->points().size(), ids.size());
  }
}

}  // namespace
}  // namespace tact::tests
