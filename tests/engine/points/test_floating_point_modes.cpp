// A caller's floating-point mode changes no answer: neither how SSE and x87 round, nor how many digits x87 keeps, nor
// whether subnormal numbers are zero, nor whether exceptions end in a signal.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/environment/callers_mode.h"
#include "tests/support/environment/temporary_folder.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/generators/remeshed.h"

namespace tact::tests {
namespace {

Eigen::Vector3d vector_in_cube(Random& random) {
  const base::Vec3 v = random.in_cube(1.0);
  return {v.x, v.y, v.z};
}

// Two facets above each other with edges that are turned by 1e-5 to 1e-9.
struct NearlyParallelEdges {
  Eigen::Matrix3Xd a{3, 3}, b{3, 3};
  explicit NearlyParallelEdges(Random& random) {
    const double turn = std::pow(10.0, random.uniform(-9.0, -5.0));
    const Eigen::Vector3d along = vector_in_cube(random).normalized(),
                          up = along.cross(vector_in_cube(random)).normalized(), aside = along.cross(up);
    a << -along, along * random.uniform(0.9, 1.1), -0.5 * up - 0.1 * aside;
    b << -1.05 * along + 0.05 * up - turn * aside, along + 0.05 * up + turn * random.uniform(0.7, 1.3) * aside,
        0.6 * up + 0.2 * aside;
  }
};

TEST(FloatingPointModes, OfTheCallerChangeNoPointsOfNearlyParallelEdges) {
  Random random(1);
  const Eigen::Matrix3Xi facet = Eigen::Vector3i(0, 1, 2);
  int edge_points = 0;
  for (int i = 0; i < 200; ++i) {
    const NearlyParallelEdges edges(random);
    std::vector<std::uint64_t> hashes;
    for (const FloatingPointSettings& mode : callers_modes()) {
      World world({.threads = 1, .outputs = {.points = true}});
      for (const Eigen::Matrix3Xd* positions : {&edges.a, &edges.b})
        world.add_body({.positions = *positions, .facets = facet, .surface = Surface::sheet, .margin = 0.1});
      hashes.push_back(in_mode(mode, [&] { return world.detect().hash(); }));
      if (hashes.size() > 1) continue;
      for (const Contact& contact : world.detect().contacts()) {
        for (const ContactPoint& point : contact.points()) edge_points += point.kind == FeaturePair::edge_edge;
      }
    }
    for (const std::uint64_t hash : hashes) ASSERT_EQ(hash, hashes.front()) << "pair " << i;
  }
  EXPECT_GT(edge_points, 50);
}

// The box of a body that touches another one's only as rounding has it.
TEST(FloatingPointModes, OfTheCallerChangeNoMargin) {
  const Eigen::Matrix3Xi facet = Eigen::Vector3i(0, 1, 2);
  Eigen::Matrix3Xd x(3, 3);
  x << 0, 0, 0, 0, 1, 0, 0, 0, 1;
  x.row(0).array() += 1.0 / 3.0;
  for (int k = 1; k < 200; ++k) {
    const double margin = 0.1 + k * 1e-3;
    std::vector<Bounds> bounds;
    for (const FloatingPointSettings& mode : callers_modes()) {
      World world({.threads = 1});
      const BodyId body = world.add_body({.positions = x, .facets = facet, .surface = Surface::sheet});
      in_mode(mode, [&] { world.set_margin(body, margin); });
      bounds.push_back(world.bounds(body));
    }
    for (const Bounds& one : bounds) {
      EXPECT_EQ(one.lower, bounds.front().lower) << k;
      EXPECT_EQ(one.upper, bounds.front().upper) << k;
    }
  }
}

// Everything that a program is told, in one list.
class AllThatIsTold final : public DebugDrawer {
 public:
  std::vector<std::uint64_t> words;
  std::vector<std::pair<std::size_t, std::string>> parts;  // where they begin

  void begin(const std::string& part) { parts.emplace_back(words.size(), part); }
  // The part that holds a word.
  std::string part_of(std::size_t word) const {
    std::string name;
    for (const auto& [first, part] : parts) {
      if (first <= word) name = part;
    }
    return name;
  }
  void add(std::uint64_t word) { words.push_back(word); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::span<const double> values) {
    std::ranges::for_each(values, [this](double value) { add(value); });
  }
  void add(const Eigen::Vector3d& v) { add(std::span(v.data(), 3)); }
  void add(BodyId body) { add(std::uint64_t{body.index}); }
  void add(const RayHit& hit) {
    add(static_cast<std::uint64_t>(hit.facet));
    add(hit.fraction);
    add(hit.barycentric);
  }
  void add(const ClosestPoint& closest) {
    add(static_cast<std::uint64_t>(closest.facet));
    add(closest.distance);
    add(closest.barycentric);
  }
  void add(const Report& report) {
    add(report.hash());
    for (const Contact& contact : report.contacts()) {
      for (const Patch& patch : contact.patches()) {
        add(patch.point);
        add(patch.direction);
        add(patch.depth);
        add(patch.area);
      }
      for (const IntersectionCurve& curve : contact.curves()) {
        for (const CurvePoint& point : curve.points) add(point.position);
      }
      for (const ContactPoint& point : contact.points()) add(std::uint64_t{point.minimum});
    }
  }
  void add(const MotionReport& report) {
    for (const Impact& impact : report.impacts()) add(impact.time);
  }
  void line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const DebugColor&) override {
    add(from);
    add(to);
  }
  void triangle(const Eigen::Vector3d& p, const Eigen::Vector3d&, const Eigen::Vector3d&, const DebugColor&) override {
    add(p);
  }
  void text(const Eigen::Vector3d& at, std::string_view words_of_it, const DebugColor&) override {
    add(at);
    add(std::hash<std::string_view>()(words_of_it));
  }
};

// Calls every function of the interface for C++ in a caller's mode; what is handed over is made before.
class EveryCall {
  template <class Call>
  decltype(auto) call(const Call& one) {
    return in_mode(mode_, one);
  }
  template <class Call>
  void tell(const Call& one) {
    told_.add(call(one));
  }

 public:
  EveryCall(const FloatingPointSettings& mode, int threads) : mode_(mode), settings_(all_outputs(threads)) {
    for (int k = 0; k < 100; ++k) {
      rays_.push_back({.from = 3.0 * vector_in_cube(random_), .to = 3.0 * vector_in_cube(random_)});
      points_.push_back({.point = 2.0 * vector_in_cube(random_)});
      boxes_.push_back({.lower = points_.back().point, .upper = points_.back().point + Eigen::Vector3d(0.3, 0.2, 0.4)});
    }
  }

  const AllThatIsTold& run() {
    std::ostringstream recording;
    Recorder recorder = call([&] { return Recorder(recording); });
    World world = call([&] { return World(settings_); });
    call([&] { world.set_observer(&recorder); });
    add_bodies(world);
    step(world);
    set(world);
    step(world);
    ask(world);
    look(world);
    for (const std::byte byte : call([&] { return world.save(); })) told_.add(static_cast<std::uint64_t>(byte));
    const std::vector<std::byte> bytes = world.save();
    call([&] { world.restore(bytes); });
    refuse(world);
    call([&] { world.remove_body(bodies_[1]); });
    step(world);
    play(recording.str());
    return told_;
  }

 private:
  static Settings all_outputs(int threads) {
    Settings settings;
    settings.threads = threads;
    settings.outputs = {
        .zones = true, .patches = true, .points = true, .curves = true, .trace = true, .within_reach = true};
    settings.on_message = [](const Message&) {};
    return settings;
  }

  void add_bodies(World& world) {
    const auto add = [&](const Mesh& mesh, Surface surface, Motion motion, bool self) {
      BodyDefinition definition{.positions = mesh.positions, .facets = mesh.facets, .surface = surface};
      definition.motion = motion;
      definition.margin = 0.03;
      definition.self_contact = self;
      bodies_.push_back(call([&] { return world.add_body(definition); }));
    };
    add(ball_, Surface::closed, Motion::deformable, false);
    add(translated(ball_, {1.4, 0.3, 0.1}), Surface::closed, Motion::deformable, false);
    add(cloth_, Surface::sheet, Motion::deformable, true);
    add(box({-0.4, -0.3, -0.2}, {0.4, 0.3, 0.2}), Surface::closed, Motion::rigid, false);
    add(scaled(ball_, 1e-310), Surface::closed, Motion::deformable, false);
    add(translated(scaled(ball_, 1e-310), {1e-310, 0.0, 0.0}), Surface::closed, Motion::deformable, false);
    const Eigen::Matrix2Xi edges = ball_.facets.topRows<2>();
    const std::vector<int> points{0, 1, 2};
    const Mesh lifted = translated(ball_, {0.3, -0.4, 1.1 / 3.0});
    bodies_.push_back(call([&] {
      return world.add_body({.positions = lifted.positions, .edges = edges, .points = points, .margin = 0.03});
    }));
    const Eigen::Vector3d normal = Eigen::Vector3d(1.0, 2.0, 7.0).normalized();
    bodies_.push_back(call([&] { return world.add_plane({.normal = normal, .offset = -1.0 / 3.0, .margin = 0.1}); }));
  }

  void step(World& world) {
    told_.begin("detect");
    const Report& report = call([&]() -> const Report& { return world.detect(); });
    told_.add(report);
    tell([&] { return report.hash(); });
    tell([&] { return std::uint64_t{report.find_contact(bodies_[0], bodies_[1]) != nullptr}; });
    KeptReport kept;
    call([&] { kept.keep(report); });
    tell([&] { return kept.report().hash(); });
    told_.begin("debug_draw");
    call([&] { debug_draw(world, report, told_, {.surfaces = true, .planes = true, .kept_facets = true}); });
    call([&] { debug_draw_sums(world, sum_contacts(world, report), told_); });
    std::vector<std::uint32_t> labels(point_count(report));
    call([&] { copy_point_labels(world, report, {.a_facets = labels}); });
    for (const std::uint8_t minimum : call([&] { return joined_minima(world, report); }))
      told_.add(std::uint64_t{minimum});
  }

  void set(World& world) {
    const Mesh moved = translated(ball_, {0.1, 0.05, -0.02}), other = translated(ball_, {1.1, 0.3, 0.1}),
               sunk = translated(cloth_, {0.0, 0.0, -0.1});
    const std::vector<PositionsUpdate> updates{{bodies_[1], other.positions}, {bodies_[2], sunk.positions}};
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const PoseUpdate pose{bodies_[3], turn, {0.9, 0.4, 0.2}};
    const Remeshed halves = cut(unchanged(sunk), {1.0, 0.0, 0.0}, 0.1);
    const std::vector<double> offsets(world.vertex_count(bodies_[1]), world.margin(bodies_[1]) / 3.0);
    call([&] {
      world.set_positions(bodies_[0], moved.positions);
      world.set_positions(updates);
      world.set_pose(bodies_[3], turn, pose.translation);
      world.set_poses(std::span(&pose, 1));
      world.set_facets(bodies_[2], halves.mesh.positions, halves.mesh.facets, halves.vertex_map);
      world.set_facets(bodies_[2], {.positions = halves.mesh.positions,
                                    .facets = halves.mesh.facets,
                                    .vertex_map = unchanged(halves.mesh).vertex_map});
      world.set_feature_settings(bodies_[1], {.rest_offsets = offsets, .margins = offsets});
      world.set_self_contact_filter(bodies_[2], {.rings = 1, .rest_distance = 0.1 / 3.0});
      world.set_excluded_labels({bodies_[0], 1, bodies_[1], 2}, true);
    });
    told_.begin("detect_motion");
    for (const Impacts wanted : {Impacts::all, Impacts::first_of_pair, Impacts::first})
      told_.add(call([&]() -> const MotionReport& { return world.detect_motion(wanted); }));
    const MotionOptions options{.distance = 0.01, .bounds = true};
    const MotionReport& motion = call([&]() -> const MotionReport& { return world.detect_motion(options); });
    told_.add(motion);
    for (const double bound : call([&] { return motion.bounds(bodies_[0]); })) told_.add(bound);
    call([&] {
      world.set_settings(settings_);
      world.set_layers(bodies_[0], 3, 0xffu);
      world.set_group(bodies_[3], 2);
      world.set_excluded(bodies_[1], bodies_[3], true);
      world.set_motion(bodies_[3], Motion::fixed);
      world.set_margin(bodies_[0], 0.013);
      world.set_rest_offset(bodies_[0], 0.013 / 3.0);
      world.set_self_contact(bodies_[2], false);
    });
  }

  void ask(const World& world) {
    told_.begin("queries");
    std::vector<RayHit> hits(rays_.size());
    std::vector<ClosestPoint> nearest(points_.size());
    std::vector<std::vector<FacetOfBody>> inside(boxes_.size());
    std::vector<std::vector<BodyId>> around(points_.size());
    call([&] {
      world.cast_rays(rays_, hits);
      world.closest_points(points_, nearest);
      world.overlap_boxes(boxes_, inside);
      world.bodies_containing_each(points_, around);
    });
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      told_.add(hits[i]);
      told_.add(nearest[i]);
      told_.add(inside[i].size());
      told_.add(around[i].size());
      if (i >= 20) continue;
      tell([&] { return world.cast_ray(rays_[i]); });
      tell([&] { return world.cast_ray(rays_[i], RayHits::any); });
      for (const RayHit& hit : call([&] { return world.cast_ray_all(rays_[i]); })) told_.add(hit);
      tell([&] { return world.closest_point(points_[i]); });
      tell([&] { return world.overlap_box(boxes_[i]).size(); });
      tell([&] { return world.bodies_containing(points_[i]).size(); });
      tell([&] { return world.signed_distance(points_[i]); });
    }
    call([&] { world.signed_distances(points_, nearest); });
    for (const ClosestPoint& one : nearest) told_.add(one);
    ask_of_bodies(world);
  }

  void ask_of_bodies(const World& world) {
    told_.begin("queries of bodies");
    const Eigen::Vector3d way(0.3, -1.0 / 3.0, 0.2), axis(1.0, 2.0, 7.0);
    const std::vector<Sweep> ways{{bodies_[0], way, axis, way, 0.7, {}},
                                  {bodies_[1], -way, axis, Eigen::Vector3d::Zero(), -2.1, {}}};
    const std::vector<DistanceQuery> pairs{
        {bodies_[0], bodies_[2]}, {bodies_[1], bodies_[4]}, {bodies_[0], bodies_[3]}};
    std::vector<SweepHit> hits(ways.size());
    std::vector<BodyDistance> apart(pairs.size());
    call([&] {
      world.sweeps(ways, hits);
      world.distances(pairs, apart);
    });
    hits.push_back(call([&] { return world.sweep(ways[1]); }));
    apart.push_back(call([&] { return world.distance(pairs[0]); }));
    for (const BodyDistance& one : call([&] { return world.nearest_bodies({.body = bodies_[0], .count = 3}); }))
      apart.push_back(one);
    for (const SweepHit& hit : hits) {
      told_.add(hit.fraction);
      told_.add(hit.normal);
      told_.add(hit.barycentric);
    }
    for (const BodyDistance& one : apart) {
      told_.add(one.distance);
      told_.add(one.a_barycentric);
      told_.add(one.b_barycentric);
    }
    const Overlap both = call([&] { return world.overlap(bodies_[0], bodies_[1]); });
    told_.add(both.volume);
    told_.add(both.area);
  }

  void look(const World& world) {
    told_.begin("what a world tells of bodies");
    for (const BodyId body : call([&] { return world.bodies(); })) {
      std::vector<double> coordinates(3 * world.vertex_count(body));
      std::vector<int> corners(3 * world.facet_count(body)), ends(2 * world.edge_count(body)),
          vertices(world.point_count(body));
      call([&] {
        world.copy_positions(body, coordinates);
        world.copy_facets(body, corners);
        world.copy_edges(body, ends);
        world.copy_points(body, vertices);
      });
      tell([&] { return world.plane(body) ? world.plane(body)->offset : 0.0; });
      told_.add(coordinates);
      const Bounds bounds = call([&] { return world.bounds(body); });
      told_.add(bounds.lower);
      told_.add(bounds.upper);
      tell([&] { return world.margin(body); });
      tell([&] { return world.rest_offset(body); });
      tell([&] { return world.feature_settings(body).rest_offsets.size(); });
      if (world.vertex_count(body) > 0) tell([&] { return std::uint64_t{world.labels(body, {0, -1, -1}).facet}; });
      tell([&] { return world.check_surface(body).crossings.size(); });
      tell([&] {
        return std::uint64_t{world.contains(body)} + world.name(body).size() + world.vertex_count(body) +
               world.facet_count(body) + world.layer(body) + world.mask(body) + world.group(body) +
               world.external_id(body) + world.key(body) + static_cast<std::uint64_t>(world.surface(body)) +
               static_cast<std::uint64_t>(world.motion(body)) + std::uint64_t{world.self_contact(body)};
      });
    }
    tell([&] { return world.body_count() + static_cast<std::size_t>(world.settings().iteration_limit); });
    tell([&] { return std::uint64_t{world.excluded(bodies_[1], bodies_[3])}; });
    tell([&] { return std::uint64_t{world.excluded_labels({bodies_[0], 1, bodies_[1], 2})}; });
    tell([&] { return world.self_contact_filter(bodies_[2]).rest_distance; });
  }

  // What is refused is told by its code. Comparisons with what is no number raise an exception, too.
  template <class Call>
  void expect_refused(const Call& one) {
    tell([&] {
      try {
        one();
      } catch (const Error& error) {
        return static_cast<std::uint64_t>(error.code());
      }
      return std::uint64_t{999};
    });
  }
  void refuse(World& world) {
    told_.begin("what is refused");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Mesh bad = ball_;
    bad.positions(0, 0) = nan;
    Settings no_settings;
    no_settings.gjk_tolerance = nan;
    const Eigen::Vector3d nowhere(nan, 0.0, 0.0), zero(0.0, 0.0, 0.0);
    const Eigen::Matrix3d no_rotation = Eigen::Matrix3d::Constant(nan);
    const Ray no_ray{.from = nowhere, .to = zero};
    const PointQuery no_point{.point = nowhere}, no_distance{.point = zero, .within = nan};
    const BoxQuery no_box{.lower = nowhere, .upper = zero};
    RayHit hit;
    expect_refused([&] { world.set_positions(bodies_[0], bad.positions); });
    expect_refused([&] { world.set_facets(bodies_[0], bad.positions, bad.facets, unchanged(bad).vertex_map); });
    expect_refused([&] { world.add_body({.positions = bad.positions, .facets = bad.facets}); });
    expect_refused([&] { world.set_settings(no_settings); });
    expect_refused([&] { World refused(no_settings); });
    expect_refused([&] { world.set_margin(bodies_[0], nan); });
    expect_refused([&] { world.set_rest_offset(bodies_[0], nan); });
    const std::vector<double> no_offsets(world.vertex_count(bodies_[0]), nan);
    expect_refused([&] { world.set_feature_settings(bodies_[0], {.rest_offsets = no_offsets}); });
    expect_refused([&] { world.set_pose(bodies_[3], no_rotation, zero); });
    expect_refused([&] { world.cast_ray(no_ray); });
    expect_refused([&] { world.cast_rays(std::span(&no_ray, 1), std::span(&hit, 1)); });
    expect_refused([&] { world.cast_ray_all(no_ray); });
    expect_refused([&] { world.closest_point(no_point); });
    expect_refused([&] { world.closest_point(no_distance); });
    expect_refused([&] { world.bodies_containing(no_point); });
    expect_refused([&] { world.overlap_box(no_box); });
    expect_refused([&] { world.signed_distance(no_point); });
    expect_refused([&] { world.distance({bodies_[0], bodies_[1], nan}); });
    expect_refused([&] { world.nearest_bodies({.body = bodies_[0], .within = nan}); });
    expect_refused([&] { world.sweep({.body = bodies_[0], .angle = nan}); });
    expect_refused([&] { world.overlap(bodies_[0], bodies_[0]); });
  }

  void play(const std::string& bytes) {
    told_.begin("a recording");
    RecordingPlayer player = call([&] { return RecordingPlayer(bytes); });
    while (const auto step = call([&] { return player.next(); })) {
      told_.add(step->now);
      told_.add(std::uint64_t{call([&] { return step->same(); })});
      told_.add(call([&]() -> const Report& { return player.report(); }));
    }
    tell([&] { return player.world().body_count() + player.recorded_by().size() + std::uint64_t{!player.cut_at()}; });
  }

  const FloatingPointSettings mode_;
  const Settings settings_;
  Random random_{7};
  Mesh ball_ = blob(1, 0.8, 0.2, 3), cloth_ = wrinkled_sheet(8, 2.0, 0.3, 1);
  std::vector<Ray> rays_;
  std::vector<PointQuery> points_;
  std::vector<BoxQuery> boxes_;
  std::vector<BodyId> bodies_;
  AllThatIsTold told_;
};

TEST(FloatingPointModes, OfTheCallerChangeNoAnswerOfAnyFunction) {
  EveryCall plain({}, 1);
  const AllThatIsTold& expected = plain.run();
  EXPECT_GT(expected.words.size(), 10000u);
  for (const FloatingPointSettings& mode : callers_modes()) {
    for (int threads = 1; threads <= (mode.traps || mode.rounding == FE_UPWARD ? 2 : 1); ++threads) {
      EveryCall calls(mode, threads);
      const AllThatIsTold& told = calls.run();
      const auto [one, other] = std::ranges::mismatch(told.words, expected.words);
      const auto word = static_cast<std::size_t>(other - expected.words.begin());
      EXPECT_TRUE(one == told.words.end() && other == expected.words.end())
          << mode.name << ", " << threads << " threads: " << expected.part_of(word) << ", word " << word;
    }
  }
}

// Names of functions in a header, and whether this file calls them.
TEST(FloatingPointModes, AreTriedWithEachFunctionOfAWorld) {
  const std::string own = contents(__FILE__),
                    header = contents(std::string(TACT_SOURCE_DIR) + "/engine/include/tact/world.h");
  std::istringstream lines(header.substr(header.find("class TACT_API World")));
  std::set<std::string> names;
  for (std::string line; std::getline(lines, line) && line != " private:";) {
    const std::size_t end = line.find('('), begin = line.rfind(' ', end);
    if (line.find("//") < end || end == std::string::npos || line.substr(0, 2) != "  ") continue;
    names.insert(line.substr(begin + 1, end - begin - 1));
  }
  EXPECT_GT(names.size(), 35u);
  for (const std::string& name : names) {
    if (name.find("World") != std::string::npos || name.find("operator") != std::string::npos) continue;
    EXPECT_NE(own.find("." + name + "("), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace tact::tests
