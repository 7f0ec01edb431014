// Planes against brute force in rational numbers: points, facet pairs, motion, queries. What a plane is, and what it
// refuses.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/plane_oracle.h"

namespace tact::tests {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

Eigen::Vector3d eigen(Vec3 v) { return {v.x, v.y, v.z}; }
Vec3 vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// A body near a plane: vertices on a lattice of the plane's own, so that many are exactly on it if it is aligned.
struct PlaneCase {
  ExactPlane plane;
  Eigen::Matrix3Xd before, after;  // of the vertices
  Eigen::Matrix3Xi facets{3, 0};
  Eigen::Matrix2Xi edges{2, 0};
  std::vector<int> points;
  double margin_of_body = 0.0, margin_of_plane = 0.0;
  bool plane_first = false;
};

Vec3 random_normal(Random& random) {
  switch (random.below(4)) {
    case 0: return {0.0, 0.0, random.chance(0.5) ? 1.0 : -1.0};
    case 1: return {0.6, 0.0, 0.8};
    default: return random.direction();
  }
}

PlaneCase random_case(Random& random) {
  PlaneCase one;
  one.plane.normal = random_normal(random);
  const double scale = std::ldexp(1.0, random.below(7) == 0 ? random.below(500) - 250 : random.below(8) - 4);
  const bool lattice = random.chance(0.5);
  const Vec3 far = random.chance(0.3) ? 1e6 * random.in_cube(1.0) : Vec3{};
  const int count = 3 + random.below(40);
  one.before.resize(3, count), one.after.resize(3, count);
  const auto place = [&] {
    Vec3 p = random.in_cube(1.0);
    if (lattice) p = {std::round(4.0 * p.x) / 4.0, std::round(4.0 * p.y) / 4.0, std::round(4.0 * p.z) / 4.0};
    return scale * (p + far);
  };
  for (int v = 0; v < count; ++v) {
    one.before.col(v) = eigen(place());
    one.after.col(v) = eigen(random.chance(0.2) ? vec(one.before.col(v)) : place());
  }
  one.plane.offset = exact_height({one.plane.normal, 0.0}, vec(one.after.col(random.below(count))));
  if (random.chance(0.5)) one.plane.offset += scale * random.uniform(-1.5, 1.5);
  one.facets.resize(3, random.below(30));
  one.edges.resize(2, random.below(8));
  for (int& v : one.facets.reshaped()) v = random.below(count);
  for (int& v : one.edges.reshaped()) v = random.below(count);
  for (int i = random.below(8); i > 0; --i) one.points.push_back(random.below(count));
  if (one.facets.cols() + one.edges.cols() == 0) one.points.push_back(0);
  one.margin_of_body = random.chance(0.3) ? 0.0 : scale * random.uniform(0.0, 0.3);
  one.margin_of_plane = random.chance(0.3) ? 0.0 : scale * random.uniform(0.0, 0.3);
  one.plane_first = random.chance(0.5);
  return one;
}

std::vector<bool> used_vertices(const PlaneCase& one) {
  std::vector<bool> used(static_cast<std::size_t>(one.after.cols()), false);
  for (const int v : one.facets.reshaped()) used[static_cast<std::size_t>(v)] = true;
  for (const int v : one.edges.reshaped()) used[static_cast<std::size_t>(v)] = true;
  for (const int v : one.points) used[static_cast<std::size_t>(v)] = true;
  return used;
}

struct PlaneWorld {
  World world;
  BodyId plane, body;
  explicit PlaneWorld(const PlaneCase& one, const Eigen::Matrix3Xd& positions)
      : world({.threads = 1, .outputs = {.patches = true, .points = true}}) {
    if (one.plane_first) add_plane(one);
    body = world.add_body({.positions = positions,
                           .facets = one.facets,
                           .edges = one.edges,
                           .points = one.points,
                           .surface = Surface::sheet,
                           .margin = one.margin_of_body});
    if (!one.plane_first) add_plane(one);
  }
  void add_plane(const PlaneCase& one) {
    plane =
        world.add_plane({.normal = eigen(one.plane.normal), .offset = one.plane.offset, .margin = one.margin_of_plane});
  }
};

void expect_points(const PlaneCase& one, const Contact* contact) {
  const double reach = one.margin_of_body + one.margin_of_plane;
  const std::vector<bool> used = used_vertices(one);
  std::vector<std::pair<int, double>> expected, found;
  double lowest = kUnbounded, highest = -kUnbounded;
  for (int v = 0; v < one.after.cols(); ++v) {
    if (!used[static_cast<std::size_t>(v)]) continue;
    const double height = exact_height(one.plane, vec(one.after.col(v)));
    lowest = std::min(lowest, height), highest = std::max(highest, height);
    if (height < reach || height <= 0.0) expected.emplace_back(v, height);
  }
  ASSERT_EQ(contact != nullptr, lowest <= 0.0 || lowest < reach);
  if (contact == nullptr) return;
  const Eigen::Vector3d direction = one.plane_first ? eigen(one.plane.normal) : -eigen(one.plane.normal);
  EXPECT_EQ(contact->direction, direction);
  EXPECT_EQ(contact->depth, 0.0 - lowest);
  for (const ContactPoint& point : contact->points()) {
    EXPECT_EQ(point.kind, one.plane_first ? FeaturePair::plane_vertex : FeaturePair::vertex_plane);
    EXPECT_EQ(point.normal, direction);
    found.emplace_back((one.plane_first ? point.b_vertices : point.a_vertices)[0], point.gap);
    EXPECT_EQ((one.plane_first ? point.a_vertices : point.b_vertices), (std::array{-1, -1, -1}));
  }
  EXPECT_TRUE(std::ranges::is_sorted(found));
  EXPECT_EQ(found, expected);
  const bool all_below = highest < 0.0;
  EXPECT_EQ(contact->containment, !all_below        ? Containment::none
                                  : one.plane_first ? Containment::b_in_a
                                                    : Containment::a_in_b);
}

void expect_facet_pairs(const PlaneCase& one, const Contact* contact) {
  std::vector<int> expected, found;
  for (int f = 0; f < one.facets.cols(); ++f) {
    bool above = true, below = true;
    for (int k = 0; k < 3; ++k) {
      const double height = exact_height(one.plane, vec(one.after.col(one.facets(k, f))));
      above &= height > 0.0, below &= height < 0.0;
    }
    if (!above && !below) expected.push_back(f);
  }
  if (contact != nullptr) {
    for (const FacetPair& pair : contact->facet_pairs()) {
      found.push_back(one.plane_first ? pair.b : pair.a);
      EXPECT_EQ(one.plane_first ? pair.a : pair.b, 0);
    }
  }
  EXPECT_EQ(found, expected);
}

TEST(Planes, ContactsAreThoseOfRationalNumbers) {
  int deep = 0, near = 0, apart = 0;
  for (int seed = 0; seed < 250; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const PlaneCase one = random_case(random);
    PlaneWorld scene(one, one.before);
    SCOPED_TRACE("seed " + std::to_string(seed));
    scene.world.detect();
    scene.world.set_positions(scene.body, one.after);
    const Contact* const contact = scene.world.detect().find_contact(scene.body, scene.plane);
    expect_points(one, contact);
    expect_facet_pairs(one, contact);
    if (testing::Test::HasFailure()) return;
    (contact == nullptr ? apart : contact->depth >= 0.0 ? deep : near) += 1;
    // What a step remembers changes nothing.
    PlaneWorld fresh(one, one.after);
    const Contact* const again = fresh.world.detect().find_contact(fresh.body, fresh.plane);
    ASSERT_EQ(again != nullptr, contact != nullptr);
    if (contact != nullptr) {
      EXPECT_EQ(again->points().size(), contact->points().size());
    }
  }
  EXPECT_GT(deep, 50);
  EXPECT_GT(near, 5);
  EXPECT_GT(apart, 10);
}

TEST(Planes, MotionIsThatOfRationalNumbers) {
  int impacts = 0, near = 0;
  for (int seed = 0; seed < 150; ++seed) {
    Random random(static_cast<std::uint64_t>(1000 + seed));
    const PlaneCase one = random_case(random);
    PlaneWorld scene(one, one.before);
    scene.world.detect();
    scene.world.set_positions(scene.body, one.after);
    const std::vector<bool> used = used_vertices(one);
    std::vector<std::pair<double, int>> expected, found, parting, expected_to_part;
    double first_stop = kUnbounded;
    for (int v = 0; v < one.after.cols() && one.before != one.after; ++v) {
      if (!used[static_cast<std::size_t>(v)]) continue;
      // What begins within the sum of the margins, or hardly above it, may come to a tenth of its height.
      const double sum = one.margin_of_body + one.margin_of_plane;
      const double height = std::abs(exact_height(one.plane, vec(one.before.col(v))));
      const bool begins_near = height <= sum + 0x1p-10 * sum;
      near += begins_near && height > 0.0 ? 1 : 0;
      const auto time =
          exact_time(one.plane, vec(one.before.col(v)), vec(one.after.col(v)), begins_near ? 0.1 * height : sum);
      if (!time) continue;
      expected.emplace_back(*time, v);
      // What is in the plane at the beginning and goes no lower does not stop.
      const bool stops = *time > 0.0 || exact_height(one.plane, vec(one.after.col(v))) <
                                            exact_height(one.plane, vec(one.before.col(v)));
      if (stops) first_stop = std::min(first_stop, *time);
      if (!stops) expected_to_part.emplace_back(*time, v);
    }
    std::ranges::sort(expected);
    for (const Impact& impact : scene.world.detect_motion().impacts()) {
      EXPECT_EQ(impact.kind, one.plane_first ? FeaturePair::plane_vertex : FeaturePair::vertex_plane);
      found.emplace_back(impact.time, (one.plane_first ? impact.b_vertices : impact.a_vertices)[0]);
      if (!impact.stops) parting.push_back(found.back());
    }
    ASSERT_EQ(found, expected) << "seed " << seed;
    ASSERT_EQ(parting, expected_to_part) << "seed " << seed;
    impacts += static_cast<int>(found.size());
    const MotionReport& first = scene.world.detect_motion(Impacts::first);
    ASSERT_EQ(first.first_time(), first_stop) << "seed " << seed;
  }
  EXPECT_GT(impacts, 200);
  EXPECT_GT(near, 20);
}

TEST(Planes, QueriesAreThoseOfRationalNumbers) {
  for (int seed = 0; seed < 100; ++seed) {
    Random random(static_cast<std::uint64_t>(2000 + seed));
    const PlaneCase one = random_case(random);
    const PlaneWorld scene(one, one.after);
    const World& world = scene.world;
    world.closest_point({});
    const auto vertex = [&] {
      return Eigen::Vector3d(one.before.col(random.below(static_cast<int>(one.before.cols()))));
    };
    const Eigen::Vector3d from = vertex(), to = vertex();
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto fraction = exact_fraction(one.plane, vec(from), vec(to));
    bool seen = false;
    for (const RayHit& hit : world.cast_ray_all({.from = from, .to = to})) {
      if (hit.body != scene.plane) continue;
      seen = true;
      EXPECT_EQ(hit.fraction, *fraction);
      EXPECT_EQ(hit.facet, 0);
    }
    EXPECT_EQ(seen, fraction.has_value());
    const double height = exact_height(one.plane, vec(from));
    const ClosestPoint closest = world.closest_point({.point = from});
    EXPECT_LE(closest.distance, std::abs(height));
    if (closest.body == scene.plane) {
      EXPECT_EQ(closest.distance, std::abs(height));
    }
    const std::vector<BodyId> around = world.bodies_containing({.point = from});
    EXPECT_EQ(std::ranges::find(around, scene.plane) != around.end(), height <= 0.0);
    const Eigen::Vector3d lower = from.cwiseMin(to), upper = from.cwiseMax(to);
    double least = kUnbounded, most = -kUnbounded;
    for (int corner = 0; corner < 8; ++corner) {
      const auto axis = [&](int k) { return (corner >> k & 1) != 0 ? upper[k] : lower[k]; };
      const double at = exact_height(one.plane, {axis(0), axis(1), axis(2)});
      least = std::min(least, at), most = std::max(most, at);
    }
    const std::vector<FacetOfBody> facets = world.overlap_box({.lower = lower, .upper = upper});
    EXPECT_EQ(std::ranges::find(facets, FacetOfBody{scene.plane, 0}) != facets.end(), least <= 0.0 && most >= 0.0);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Planes, ManyRaysSeeWhatOneSees) {
  World world({.threads = 2});
  const Mesh ball = icosphere(2);
  for (int i = 0; i < 3; ++i)
    world.add_body({.positions = translated(ball, {3.0 * i, 0.0, 0.5}).positions, .facets = ball.facets});
  world.add_plane({.normal = {0.0, 0.0, 1.0}, .offset = 0.2});
  world.add_plane({.normal = {-0.6, 0.0, 0.8}, .offset = -4.0, .layer = 2});
  Random random(5);
  std::vector<Ray> rays;
  for (int i = 0; i < 300; ++i)
    rays.push_back({.from = eigen(4.0 * random.in_cube(1.0)),
                    .to = eigen(4.0 * random.in_cube(1.0)),
                    .filter = {.mask = random.chance(0.5) ? 1u : 3u}});
  std::vector<RayHit> hits(rays.size());
  world.cast_rays(rays, hits);
  int of_planes = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::vector<RayHit> all = world.cast_ray_all(rays[i]);
    const RayHit any = world.cast_ray(rays[i], RayHits::any);
    ASSERT_EQ(hits[i].facet >= 0, !all.empty());
    ASSERT_EQ(any.facet >= 0, !all.empty());
    if (all.empty()) continue;
    EXPECT_EQ(hits[i].body, all[0].body);
    EXPECT_EQ(hits[i].fraction, all[0].fraction);
    of_planes += world.plane(all[0].body) ? 1 : 0;
  }
  EXPECT_GT(of_planes, 30);
}

TEST(Planes, AreWhatTheyAreSaidToBe) {
  World world({.threads = 1, .outputs = {.points = true}});
  const BodyId floor = world.add_plane(
      {.normal = {0.0, 0.6, 0.8}, .offset = 0.25, .name = "floor", .layer = 2, .external_id = 7, .margin = 0.5});
  EXPECT_EQ(world.name(floor), "floor");
  EXPECT_EQ(world.motion(floor), Motion::fixed);
  EXPECT_EQ(world.surface(floor), Surface::closed);
  EXPECT_EQ(world.layer(floor), 2u);
  EXPECT_EQ(world.external_id(floor), 7u);
  EXPECT_EQ(world.margin(floor), 0.5);
  EXPECT_EQ(world.vertex_count(floor) + world.facet_count(floor), 0u);
  EXPECT_EQ(world.bounds(floor).lower, (std::array{-kUnbounded, -kUnbounded, -kUnbounded}));
  EXPECT_EQ(world.bounds(floor).upper, (std::array{kUnbounded, kUnbounded, kUnbounded}));
  ASSERT_TRUE(world.plane(floor).has_value());
  EXPECT_EQ(world.plane(floor)->normal, Eigen::Vector3d(0.0, 0.6, 0.8));
  EXPECT_EQ(world.plane(floor)->offset, 0.25);
  const auto code_of = [&](const auto& call) -> std::optional<ErrorCode> {
    try {
      call();
    } catch (const Error& error) {
      return error.code();
    }
    return {};
  };
  const Eigen::Matrix3Xd none(3, 0);
  EXPECT_EQ(code_of([&] { world.set_positions(floor, none); }), ErrorCode::fixed_body);
  EXPECT_EQ(code_of([&] { world.set_motion(floor, Motion::deformable); }), ErrorCode::wrong_motion);
  EXPECT_EQ(code_of([&] { world.set_motion(floor, Motion::rigid); }), ErrorCode::wrong_motion);
  world.set_motion(floor, Motion::fixed);
  for (const Eigen::Vector3d& normal : {Eigen::Vector3d(0.0, 0.0, 2.0), Eigen::Vector3d(0.0, 0.0, 0.0),
                                        Eigen::Vector3d(0.0, 0.0, 1.0 + 3e-9), Eigen::Vector3d(NAN, 0.0, 1.0)})
    EXPECT_EQ(code_of([&] { world.add_plane({.normal = normal}); }), ErrorCode::invalid_argument);
  for (const double offset : {static_cast<double>(NAN), kUnbounded, 0x1.8p300})
    EXPECT_EQ(code_of([&] { world.add_plane({.offset = offset}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.add_plane({.margin = -1.0}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code_of([&] { world.add_plane({.key = 0}); }), ErrorCode::invalid_argument);
  EXPECT_EQ(world.body_count(), 1u);
}

TEST(Planes, KeepToLayersGroupsAndExclusions) {
  World world({.threads = 1, .outputs = {.points = true}});
  const BodyId floor = world.add_plane({.margin = 0.1});
  const BodyId other = world.add_plane({.normal = {0.0, 0.0, -1.0}, .margin = 0.1});
  const Mesh ball = icosphere(1);
  const BodyId body = world.add_body({.positions = ball.positions, .facets = ball.facets});
  const auto touches = [&](BodyId plane) { return world.detect().find_contact(plane, body) != nullptr; };
  EXPECT_TRUE(touches(floor));
  EXPECT_TRUE(touches(other));
  EXPECT_EQ(world.detect().find_contact(floor, other), nullptr);
  world.set_layers(floor, 1, 2);
  EXPECT_FALSE(touches(floor));
  world.set_layers(floor, 1, 3);
  EXPECT_TRUE(touches(floor));
  world.set_excluded(floor, body, true);
  EXPECT_FALSE(touches(floor));
  EXPECT_EQ(world.detect().ended().size(), 0u);
  world.set_excluded(floor, body, false);
  EXPECT_TRUE(touches(floor));
  world.set_group(floor, 3), world.set_group(body, 3);
  EXPECT_FALSE(touches(floor));
  EXPECT_TRUE(touches(other));
  world.remove_body(other);
  EXPECT_TRUE(world.detect().contacts().empty());
  world.set_motion(body, Motion::fixed);
  world.set_group(body, 0);
  EXPECT_FALSE(touches(floor));
}

TEST(Planes, FarBodiesAreNoCandidates) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh ball = icosphere(1);
  std::vector<BodyId> balls;
  for (int i = 0; i < 100; ++i)
    balls.push_back(
        world.add_body({.positions = translated(ball, {3.0 * (i % 10), 3.0 * (i / 10), 0.9 + 2.5 * (i % 3)}).positions,
                        .facets = ball.facets,
                        .margin = 0.1}));
  const BodyId floor = world.add_plane({});
  EXPECT_EQ(world.detect().candidate_pairs().size(), 34u);
  EXPECT_EQ(world.detect().contacts().size(), 34u);
  world.set_positions(balls[1], translated(ball, {3.0, 0.0, 0.5}).positions);
  EXPECT_EQ(world.detect().contacts().size(), 35u);
  EXPECT_NE(world.detect().find_contact(floor, balls[1]), nullptr);
  world.set_margin(floor, 2.5);
  EXPECT_EQ(world.detect().contacts().size(), 67u);
  for (const Contact& contact : world.detect().contacts()) EXPECT_EQ(contact.b, floor);
}

TEST(Planes, TwoPlacesOfASheetAreTwoPatches) {
  Mesh cloth = sheet(20, 4, 20.0, 4.0);
  for (int v = 0; v < cloth.vertex_count(); ++v) {
    Vec3 p = cloth.position(v);
    p.z = 0.3 + std::cos(0.6 * (p.x - 0.5));
    cloth.set_position(v, p);
  }
  for (const bool points : {true, false}) {
    World world({.threads = 1, .outputs = {.patches = true, .points = points}});
    world.add_body({.positions = cloth.positions, .facets = cloth.facets, .surface = Surface::sheet, .margin = 0.01});
    const BodyId floor = world.add_plane({});
    const Contact& contact = world.detect().contacts()[0];
    EXPECT_EQ(contact.b, floor);
    // Without points each trough has a patch on either side, where it passes the plane.
    EXPECT_EQ(contact.patches().size(), points ? 2u : 4u);
    for (const Patch& patch : contact.patches()) {
      EXPECT_EQ(patch.direction, Eigen::Vector3d(0.0, 0.0, -1.0));
      EXPECT_GT(patch.depth, points ? 0.5 : 0.2);
      EXPECT_LT(std::abs(patch.point.z()), 1.0);
    }
  }
}

TEST(Planes, AreSavedAndRecorded) {
  const Mesh ball = icosphere(1);
  const auto lowered = [&](int step) { return translated(ball, {0.0, 0.0, 1.2 - 0.2 * step}).positions; };
  std::ostringstream recorded;
  Recorder recorder(recorded);
  World world({.threads = 1, .outputs = {.patches = true, .points = true}});
  world.set_observer(&recorder);
  const BodyId body = world.add_body({.positions = lowered(0), .facets = ball.facets, .margin = 0.05});
  world.add_plane({.normal = {0.6, 0.0, 0.8}, .offset = 0.1, .name = "floor", .group = 4, .key = 99, .margin = 0.1});
  for (int step = 1; step < 4; ++step) {
    world.detect();
    world.set_positions(body, lowered(step));
  }
  world.detect();
  const std::vector<std::byte> state = world.save();
  World other({.threads = 1});
  other.restore(state);
  EXPECT_EQ(other.save(), state);
  EXPECT_EQ(other.plane(other.bodies()[1])->offset, 0.1);
  for (World* one : {&world, &other}) one->set_positions(one->bodies()[0], lowered(5));
  EXPECT_EQ(world.detect().hash(), other.detect().hash());
  EXPECT_EQ(world.detect().contacts()[0].patches()[0].id, other.detect().contacts()[0].patches()[0].id);
  const std::string bytes = recorded.str();
  RecordingPlayer player(bytes);
  int steps = 0;
  for (; const auto step = player.next(); ++steps) EXPECT_TRUE(step->same());
  EXPECT_GT(steps, 4);
  EXPECT_EQ(player.world().key(player.world().bodies()[1]), 99u);
}

TEST(Planes, AreTheSameForAnyNumberOfThreads) {
  Mesh cloth = sheet(110, 110, 10.0, 10.0);
  Random random(9);
  for (int v = 0; v < cloth.vertex_count(); ++v) {
    Vec3 p = cloth.position(v);
    p.z = random.uniform(-0.05, 0.05);
    cloth.set_position(v, p);
  }
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    for (const bool plane_first : {false, true}) {
      World world({.threads = threads, .outputs = {.patches = true, .points = true}});
      if (plane_first) world.add_plane({.key = 5, .margin = 0.01});
      world.add_body(
          {.positions = cloth.positions, .facets = cloth.facets, .surface = Surface::sheet, .key = 1, .margin = 0.01});
      if (!plane_first) world.add_plane({.key = 5, .margin = 0.01});
      hashes.push_back(world.detect().hash());
      EXPECT_GT(world.detect().contacts()[0].points().size(), 5000u);
    }
  }
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

TEST(Planes, RigidBodiesRollOnThem) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh box = centered_box({0.5, 0.5, 0.5});
  const BodyId body = world.add_body({.positions = box.positions, .facets = box.facets, .motion = Motion::rigid});
  const BodyId floor = world.add_plane({.margin = 0.05});
  world.set_pose(body, Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.52});
  EXPECT_EQ(world.detect().find_contact(body, floor)->points().size(), 4u);
  world.set_pose(body, Eigen::AngleAxisd(0.7853981633974483, Eigen::Vector3d::UnitX()).matrix(), {0.0, 0.0, 0.72});
  EXPECT_EQ(world.detect_motion().impacts().size(), 0u);  // nothing comes to a tenth of its height
  EXPECT_EQ(world.detect().find_contact(body, floor)->points().size(), 2u);
  world.set_pose(body, Eigen::AngleAxisd(0.7853981633974483, Eigen::Vector3d::UnitX()).matrix(), {0.0, 0.0, 0.78});
  EXPECT_EQ(world.detect().candidate_pairs().size(), 0u);
  EXPECT_EQ(world.detect().contacts().size(), 0u);
}

}  // namespace
}  // namespace tact::tests
