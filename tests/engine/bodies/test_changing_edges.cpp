// Bodies whose edges and points change: what is still there keeps its ids, all else is as in a world made anew.
#include <gtest/gtest.h>
#include <tact/recording.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

// What set_facets() takes, with arrays of its own.
struct Changed {
  Eigen::Matrix3Xd positions{3, 0};
  Eigen::Matrix3Xi facets{3, 0};
  Eigen::Matrix2Xi edges{2, 0};
  std::vector<int> points{}, vertex_map{};

  MeshUpdate update() const {
    return {.positions = positions, .facets = facets, .edges = edges, .points = points, .vertex_map = vertex_map};
  }
  BodyDefinition definition(double margin, bool self_contact) const {
    return {.positions = positions,
            .facets = facets,
            .edges = edges,
            .points = points,
            .surface = Surface::sheet,
            .margin = margin,
            .self_contact = self_contact};
  }
};

// Some facets, a rope that hangs from them, and grains.
Changed tasselled_sheet(Random& random) {
  const Mesh mesh = jittered(sheet(3, 3, 0.6, 0.6), 0.05, random.bits());
  constexpr int kRope = 8, kGrains = 6;
  const int first = mesh.vertex_count();
  Changed made{.positions = Eigen::Matrix3Xd(3, first + kRope + kGrains), .facets = mesh.facets};
  made.positions.leftCols(first) = mesh.positions;
  made.edges.resize(2, kRope);
  for (int k = 0; k < kRope; ++k) {
    made.positions.col(first + k) << 0.4 + 0.08 * k, 0.1 * random.uniform(), 0.05 * random.uniform();
    made.edges.col(k) << (k == 0 ? 3 : first + k - 1), first + k;
  }
  for (int k = 0; k < kGrains; ++k) {
    const Vec3 p = random.in_cube(0.5);
    made.positions.col(first + kRope + k) << p.x, p.y, p.z;
    made.points.push_back(first + kRope + k);
  }
  return made;
}

// Vertices in another order, some edges, points and facets left out, some new, an edge or a facet turned.
Changed changed(const Changed& from, Random& random) {
  const auto count = static_cast<int>(from.positions.cols());
  const std::vector<int> order = random.permutation(count);  // of each new vertex the old one
  std::vector<int> now(order.size());
  Changed to{.positions = Eigen::Matrix3Xd(3, count)};
  for (int v = 0; v < count; ++v) {
    to.positions.col(v) = from.positions.col(order[static_cast<std::size_t>(v)]);
    now[static_cast<std::size_t>(order[static_cast<std::size_t>(v)])] = v;
  }
  to.vertex_map = order;
  if (random.chance(0.3)) to.vertex_map[static_cast<std::size_t>(random.below(count))] = -1;
  const auto renumber = [&](const auto& columns) {
    auto kept = columns;
    Eigen::Index next = 0;
    for (const int i : random.permutation(static_cast<int>(columns.cols()))) {
      if (random.chance(0.15)) continue;
      const int turn = random.below(static_cast<int>(columns.rows()));
      for (Eigen::Index k = 0; k < columns.rows(); ++k)
        kept((k + turn) % columns.rows(), next) = now[static_cast<std::size_t>(columns(k, i))];
      ++next;
    }
    kept.conservativeResize(Eigen::NoChange, next);
    return kept;
  };
  to.facets = renumber(from.facets);
  to.edges = renumber(from.edges);
  for (const int v : from.points) {
    if (random.chance(0.8)) to.points.push_back(now[static_cast<std::size_t>(v)]);
  }
  if (random.chance(0.5)) to.points.push_back(random.below(count));
  return to;
}

using NamedFeatures = std::tuple<FeaturePair, std::set<int>, std::set<int>>;

NamedFeatures features_of(const ContactPoint& point, const std::vector<int>& names, bool of_itself, bool of_a) {
  const auto named = [&](const std::array<int, 3>& vertices, bool renames) {
    std::set<int> all;
    for (const int v : vertices) {
      if (v >= 0) all.insert(renames ? names[static_cast<std::size_t>(v)] : v);
    }
    return all;
  };
  auto a = named(point.a_vertices, of_itself || of_a), b = named(point.b_vertices, of_itself || !of_a);
  const bool is_symmetric = point.kind == FeaturePair::edge_edge || point.kind == FeaturePair::vertex_vertex;
  if (of_itself && is_symmetric && b < a) std::swap(a, b);
  return {point.kind, a, b};
}

// Over a fixed floor of facets.
struct Tassels {
  World world{{.threads = 1, .direction = DirectionPolicy::smallest, .outputs = {.patches = true, .points = true}}};
  BodyId body, floor;
  explicit Tassels(const Changed& mesh) {
    body = world.add_body(mesh.definition(0.06, true));
    const Mesh ground = translated(sheet(2, 2, 4.0, 4.0), {0.0, 0.0, -0.6});
    floor = world.add_body({.positions = ground.positions,
                            .facets = ground.facets,
                            .surface = Surface::sheet,
                            .motion = Motion::fixed,
                            .margin = 0.1});
  }
};

TEST(ChangingEdges, KeepIdsOfWhatIsStillThere) {
  std::size_t kept = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Changed first = tasselled_sheet(random);
    Tassels scene(first);
    std::vector<int> names(static_cast<std::size_t>(first.positions.cols()));
    for (std::size_t v = 0; v < names.size(); ++v) names[v] = static_cast<int>(v);
    int next_name = 1000;
    std::map<std::uint64_t, NamedFeatures> known;
    Changed mesh = first;
    for (int step = 0; step < 4; ++step) {
      for (const Contact& contact : scene.world.detect().contacts()) {
        for (const ContactPoint& point : contact.points()) {
          const NamedFeatures features = features_of(point, names, contact.a == contact.b, contact.a == scene.body);
          const auto [at, is_new] = known.emplace(point.id, features);
          EXPECT_EQ(at->second, features) << "seed " << seed << ", step " << step;
          kept += is_new ? 0 : 1;
        }
      }
      mesh = changed(mesh, random);
      std::vector<int> next;
      for (const int was : mesh.vertex_map)
        next.push_back(was < 0 ? next_name++ : names[static_cast<std::size_t>(was)]);
      names = next;
      scene.world.set_facets(scene.body, mesh.update());
    }
    // No feature has two ids.
    std::set<NamedFeatures> features;
    for (const auto& [id, one] : known) EXPECT_TRUE(features.insert(one).second) << "seed " << seed;
  }
  EXPECT_GT(kept, 100u);
}

TEST(ChangingEdges, AnswersAreThoseOfAWorldMadeAnew) {
  std::size_t points = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    Changed mesh = tasselled_sheet(random);
    Tassels scene(mesh);
    for (int step = 0; step < 3; ++step) {
      scene.world.detect();
      mesh = changed(mesh, random);
      scene.world.set_facets(scene.body, mesh.update());
      EXPECT_EQ(scene.world.edge_count(scene.body), static_cast<std::size_t>(mesh.edges.cols()));
      EXPECT_EQ(scene.world.point_count(scene.body), mesh.points.size());
      Tassels fresh(mesh);
      const Report &report = scene.world.detect(), &expected = fresh.world.detect();
      ASSERT_EQ(report.contacts().size(), expected.contacts().size()) << "seed " << seed << ", step " << step;
      for (std::size_t i = 0; i < report.contacts().size(); ++i) {
        const Contact &one = report.contacts()[i], &other = expected.contacts()[i];
        EXPECT_TRUE(same_facet_pairs(other.facet_pairs(), one.facet_pairs())) << "seed " << seed;
        const auto crosses = [](const ContactPoint& point) { return point.gap <= 0.0; };
        if (!one.facet_pairs().empty() || std::ranges::any_of(other.points(), crosses)) continue;
        ASSERT_EQ(one.points().size(), other.points().size()) << "seed " << seed << ", step " << step;
        for (std::size_t p = 0; p < one.points().size(); ++p, ++points) {
          EXPECT_EQ(one.points()[p].kind, other.points()[p].kind);
          EXPECT_EQ(one.points()[p].a_vertices, other.points()[p].a_vertices);
          EXPECT_EQ(one.points()[p].b_vertices, other.points()[p].b_vertices);
          EXPECT_EQ(one.points()[p].gap, other.points()[p].gap);
        }
      }
    }
  }
  EXPECT_GT(points, 300u);
}

TEST(ChangingEdges, AreSavedAndRecorded) {
  Random random(7);
  std::ostringstream stream;
  Recorder recorder(stream);
  Changed mesh = tasselled_sheet(random);
  tact::World world({.threads = 1, .outputs = {.patches = true, .points = true}});
  world.set_observer(&recorder);
  const BodyId body = world.add_body(mesh.definition(0.06, true));
  const BodyId floor = world.add_plane({.offset = -0.1, .margin = 0.1});
  for (int step = 0; step < 4; ++step) {
    world.detect();
    mesh = changed(mesh, random);
    world.set_facets(body, mesh.update());
    tact::World other({.threads = 1});
    other.restore(world.save());
    EXPECT_EQ(other.detect().hash(), world.detect().hash()) << step;
  }
  // The other way to set facets leaves neither edges nor points.
  const std::vector<int> none(static_cast<std::size_t>(mesh.positions.cols()), -1);
  world.set_facets(body, mesh.positions, mesh.facets, none);
  EXPECT_EQ(world.edge_count(body) + world.point_count(body), 0u);
  world.detect();
  EXPECT_TRUE(throws_error([&] { world.set_facets(floor, mesh.update()); }, ErrorCode::invalid_argument, {"plane"}));
  const std::vector<std::byte> bytes = world.save();
  mesh.edges(1, 0) = 99;
  EXPECT_TRUE(throws_error([&] { world.set_facets(body, mesh.update()); }, ErrorCode::facet_out_of_range, {"edge 0"}));
  EXPECT_EQ(world.save(), bytes);
  const std::string recording = stream.str();
  RecordingPlayer player(recording);
  while (const auto played = player.next()) EXPECT_TRUE(played->same());
  EXPECT_EQ(player.world().save(), bytes);
}

// A rope without facets becomes a body with facets, which is a sheet as the rope was, and back.
TEST(ChangingEdges, TurnIntoFacetsAndBack) {
  World world({.threads = 1, .outputs = {.points = true}});
  Changed rope;
  rope.positions.resize(3, 3);
  rope.positions << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.05, 0.05, 0.05;
  rope.edges.resize(2, 2);
  rope.edges << 0, 1, 1, 2;
  rope.vertex_map = {0, 1, 2};
  const BodyId body = world.add_body({.positions = rope.positions, .edges = rope.edges, .margin = 0.1});
  const BodyId floor = world.add_plane({});
  EXPECT_EQ(world.detect().find_contact(body, floor)->points().size(), 3u);
  Changed facet = rope;
  facet.edges.resize(2, 0);
  facet.facets = Eigen::Vector3i(0, 1, 2);
  for (const Changed* const next : {&facet, &rope, &facet}) {
    world.set_facets(body, next->update());
    EXPECT_EQ(world.surface(body), Surface::sheet);
    const Report& report = world.detect();
    EXPECT_TRUE(report.began().empty() && report.ended().empty());
    EXPECT_EQ(report.find_contact(body, floor)->points().size(), 3u);
  }
}

}  // namespace
}  // namespace tact::tests
