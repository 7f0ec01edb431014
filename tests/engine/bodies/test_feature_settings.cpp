// Rest offsets, labels, layers and masks of single vertices and facets, against brute force over what a world without
// them finds.
#include <gtest/gtest.h>
#include <tact/recording.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <tuple>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using Three = std::array<int, 3>;

constexpr double kReach = 0.08;  // margin of every body, metres
constexpr Outputs kOutputs{.patches = true, .points = true, .curves = true, .within_reach = true};

// Settings of a body with lasting arrays.
struct Arrays {
  std::vector<double> rest_offsets;
  std::vector<std::uint32_t> vertex_labels, facet_labels, vertex_layers, vertex_masks;
  FeatureSettings view() const { return {rest_offsets, vertex_labels, facet_labels, vertex_layers, vertex_masks}; }
};

// A few values, so that sums of two are few.
constexpr std::array kOffsets{0.0, 0.01, 0.03};

Arrays random_arrays(const Mesh& mesh, Random& random) {
  Arrays arrays;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    arrays.rest_offsets.push_back(kOffsets[static_cast<std::size_t>(random.below(3))]);
    arrays.vertex_labels.push_back(static_cast<std::uint32_t>(random.bits()));
    arrays.vertex_layers.push_back(1u << random.below(3));
    arrays.vertex_masks.push_back(random.chance(0.8) ? 7u : static_cast<std::uint32_t>(random.below(8)));
  }
  for (int f = 0; f < mesh.facet_count(); ++f) arrays.facet_labels.push_back(static_cast<std::uint32_t>(random.bits()));
  return arrays;
}

// Bodies that touch, cross and near each other and themselves, over a plane.
struct Scene {
  std::vector<Mesh> meshes, ends;
  std::vector<Arrays> arrays;

  explicit Scene(std::uint64_t seed) {
    Random random(seed);
    const std::array first{blob(1, 0.4, 0.3, seed), wrinkled_sheet(6, 1.0, 0.2, seed), soup(30, 0.4, seed)};
    for (const Mesh& mesh : first) {
      meshes.push_back(translated(mesh, 0.3 * random.in_ball()));
      ends.push_back(translated(jittered(meshes.back(), 0.02, seed), 0.3 * random.in_ball()));
      arrays.push_back(random_arrays(mesh, random));
    }
  }
  std::vector<BodyId> add_to(tact::World& world) const {
    std::vector<BodyId> ids;
    for (std::size_t i = 0; i < meshes.size(); ++i)
      ids.push_back(world.add_body({.positions = meshes[i].positions,
                                    .facets = meshes[i].facets,
                                    .surface = i == 0 ? Surface::closed : Surface::sheet,
                                    .margin = kReach,
                                    .self_contact = i > 0}));
    world.add_plane({.normal = {0.0, 0.0, 1.0}, .offset = -0.35, .margin = kReach, .rest_offset = 0.02});
    return ids;
  }
  void move(tact::World& world, const std::vector<BodyId>& ids) const {
    for (std::size_t i = 0; i < ids.size(); ++i) world.set_positions(ids[i], ends[i].positions);
  }
  double rest_offset(std::uint32_t body, const Three& vertices) const {
    if (body >= arrays.size()) return 0.02;
    double most = 0.0;
    for (const int v : vertices) {
      if (v >= 0) most = std::max(most, arrays[body].rest_offsets[static_cast<std::size_t>(v)]);
    }
    return most;
  }
  // Whether each vertex of the one is tested against each of the other.
  bool are_tested(std::uint32_t a, const Three& of_a, std::uint32_t b, const Three& of_b) const {
    const auto layers = [&](std::uint32_t body, int v) {
      return body >= arrays.size() ? 1u : arrays[body].vertex_layers[static_cast<std::size_t>(v)];
    };
    const auto masks = [&](std::uint32_t body, int v) {
      return body >= arrays.size() ? ~0u : arrays[body].vertex_masks[static_cast<std::size_t>(v)];
    };
    const auto each = [](const Three& vertices, bool is_plane) {
      std::vector<int> all;
      for (const int v : vertices) {
        if (v >= 0) all.push_back(v);
      }
      if (is_plane) all = {0};
      return all;
    };
    for (const int v : each(of_a, a >= arrays.size())) {
      for (const int w : each(of_b, b >= arrays.size())) {
        if ((layers(a, v) & masks(b, w)) == 0 || (layers(b, w) & masks(a, v)) == 0) return false;
      }
    }
    return true;
  }
  Three corners(std::uint32_t body, int facet) const {
    if (body >= meshes.size()) return {-1, -1, -1};
    const Eigen::Vector3i of = meshes[body].facets.col(facet);
    return {of[0], of[1], of[2]};
  }
};

using Found = std::tuple<std::uint32_t, std::uint32_t, FeaturePair, Three, Three, double>;

Found found(const Impact& one) {
  return {one.a.index, one.b.index, one.kind, one.a_vertices, one.b_vertices, one.time};
}

std::vector<Found> impacts_of(const MotionReport& report) {
  std::vector<Found> all;
  for (const Impact& one : report.impacts()) all.push_back(found(one));
  std::ranges::sort(all);
  return all;
}

TEST(RestOffsets, AreTheMarginWhereNoneIsGiven) {
  World world;
  const Mesh mesh = icosphere(0);
  const BodyId body = world.add_body({.positions = mesh.positions, .facets = mesh.facets, .margin = 0.3}),
               given = world.add_body(
                   {.positions = mesh.positions, .facets = mesh.facets, .margin = 0.3, .rest_offset = 0.1}),
               plane = world.add_plane({.margin = 0.2, .rest_offset = 0.0});
  EXPECT_EQ(world.rest_offset(body), 0.3);
  EXPECT_EQ(world.rest_offset(given), 0.1);
  EXPECT_EQ(world.rest_offset(plane), 0.0);
  for (const BodyId one : {body, given}) world.set_margin(one, 0.5);
  EXPECT_EQ(world.rest_offset(body), 0.5);
  EXPECT_EQ(world.rest_offset(given), 0.1);
  world.set_rest_offset(body, 0.4);
  world.set_margin(body, 0.45);
  EXPECT_EQ(world.rest_offset(body), 0.4);
  world.set_rest_offset(body, std::nullopt);
  EXPECT_EQ(world.rest_offset(body), 0.45);
}

TEST(RestOffsets, DecideWhatTouchesAndWhereMotionStops) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh mesh = box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  const BodyId body =
      world.add_body({.positions = translated(mesh, {0.0, 0.0, 0.15}).positions, .facets = mesh.facets, .margin = 0.1});
  const BodyId floor = world.add_plane({.margin = 0.1});
  const auto touches = [&] { return world.detect().find_contact(body, floor)->touching(); };
  EXPECT_TRUE(touches());
  world.set_rest_offset(body, 0.04);
  EXPECT_FALSE(touches());
  EXPECT_EQ(world.detect().find_contact(body, floor)->points().size(), 4u);
  ASSERT_EQ(world.detect().ended().size(), 0u);
  world.set_rest_offset(floor, 0.1);
  world.set_rest_offset(body, 0.0500001);
  EXPECT_TRUE(touches());
  EXPECT_EQ(world.detect().began().size(), 0u) << "it began one step before";
  world.set_rest_offset(body, 0.0);
  world.set_rest_offset(floor, 0.05);
  world.set_positions(body, translated(mesh, {0.0, 0.0, -0.05}).positions);
  EXPECT_NEAR(world.detect_motion().first_time(), 0.5, 1e-6);
}

TEST(RestOffsets, EventsFollowThem) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh mesh = icosphere(1);
  const BodyId a = world.add_body({.positions = mesh.positions, .facets = mesh.facets, .margin = 0.2}),
               b = world.add_body(
                   {.positions = translated(mesh, {2.2, 0.0, 0.0}).positions, .facets = mesh.facets, .margin = 0.2});
  EXPECT_EQ(world.detect().began().size(), 1u);
  world.set_rest_offset(a, 0.0);
  EXPECT_EQ(world.detect().ended().size(), 1u);
  world.set_margin(b, 0.25);
  EXPECT_EQ(world.detect().began().size(), 1u);
  const std::vector<double> none(static_cast<std::size_t>(mesh.vertex_count()), 0.0);
  world.set_feature_settings(b, {.rest_offsets = none});
  EXPECT_EQ(world.detect().ended().size(), 1u);
}

TEST(RestOffsets, AreTheMarginsOfVerticesWhereNoneAreGiven) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh mesh = translated(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {0.0, 0.0, 0.05});
  const BodyId body = world.add_body({.positions = mesh.positions, .facets = mesh.facets, .margin = 0.1});
  const BodyId floor = world.add_plane({});
  EXPECT_TRUE(world.detect().find_contact(body, floor)->touching());
  std::vector<double> margins(8, 0.02);
  world.set_feature_settings(body, {.margins = margins});
  EXPECT_FALSE(world.detect().find_contact(body, floor)->touching());
  EXPECT_TRUE(world.detect().find_contact(body, floor)->points().empty());
  world.set_positions(body, translated(mesh, {0.0, 0.0, -0.05}).positions);
  EXPECT_NEAR(world.detect_motion().first_time(), 0.6, 1e-6);
  margins[0] = 0.06;
  world.set_positions(body, mesh.positions);
  world.set_feature_settings(body, {.margins = margins});
  const Contact* const contact = world.detect().find_contact(body, floor);
  EXPECT_EQ(contact->points().size(), mesh.positions(2, 0) < 0.5 ? 1u : 0u);
}

// A feature adds the largest of its vertices.
TEST(RestOffsets, OfVerticesDecideWhatTouches) {
  int touching = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene(seed);
    World world({.threads = 1, .outputs = kOutputs});
    const std::vector<BodyId> ids = scene.add_to(world);
    for (std::size_t i = 0; i < ids.size(); ++i)
      world.set_feature_settings(ids[i], {.rest_offsets = scene.arrays[i].rest_offsets});
    for (const Contact& contact : world.detect().contacts()) {
      const std::uint32_t a = contact.a.index, b = contact.b.index;
      const bool is_near = std::ranges::any_of(contact.points(), [&](const ContactPoint& p) {
        return p.gap < scene.rest_offset(a, p.a_vertices) + scene.rest_offset(b, p.b_vertices);
      });
      EXPECT_EQ(contact.touching(), !contact.facet_pairs().empty() || is_near) << "seed " << seed;
      if (contact.facet_pairs().empty()) ++(contact.touching() ? touching : apart);
    }
  }
  EXPECT_GT(touching, 2);
  EXPECT_GT(apart, 2);
}

// Each pair of features has the impact that it has where everything meets at the sum of its own offsets.
TEST(RestOffsets, OfVerticesDecideWhereFeaturesMeet) {
  std::size_t impacts = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Scene scene(seed);
    World world({.threads = 1}), uniform({.threads = 1});
    const std::vector<BodyId> ids = scene.add_to(world), same = scene.add_to(uniform);
    for (std::size_t i = 0; i < ids.size(); ++i)
      world.set_feature_settings(ids[i], {.rest_offsets = scene.arrays[i].rest_offsets});
    world.detect(), uniform.detect();
    scene.move(world, ids), scene.move(uniform, same);
    std::vector<Found> expected;
    std::vector<double> sums;
    for (const double x : kOffsets) {
      for (const double y : {0.0, 0.01, 0.02, 0.03}) sums.push_back(x + y);
    }
    std::ranges::sort(sums);
    sums.erase(std::unique(sums.begin(), sums.end()), sums.end());
    for (const double sum : sums) {
      for (const Impact& one : uniform.detect_motion({.distance = sum}).impacts()) {
        if (scene.rest_offset(one.a.index, one.a_vertices) + scene.rest_offset(one.b.index, one.b_vertices) == sum)
          expected.push_back(found(one));
      }
    }
    std::ranges::sort(expected);
    const std::vector<Found> all = impacts_of(world.detect_motion());
    EXPECT_EQ(all, expected) << "seed " << seed;
    impacts += all.size();
    const double first = world.detect_motion().first_time();
    EXPECT_EQ(world.detect_motion(Impacts::first).first_time(), first) << "seed " << seed;
  }
  EXPECT_GT(impacts, 50u);
}

TEST(RestOffsets, AreNotLargerThanTheMargin) {
  World world;
  const Mesh mesh = icosphere(0);
  const BodyDefinition definition{.positions = mesh.positions, .facets = mesh.facets, .margin = 0.1};
  const BodyId body = world.add_body(definition);
  std::vector<double> offsets(static_cast<std::size_t>(mesh.vertex_count()), 0.1);
  world.set_feature_settings(body, {.rest_offsets = offsets});
  const std::vector<std::byte> bytes = world.save();
  const auto refuses = [&](auto call, ErrorCode code, const char* word) {
    EXPECT_TRUE(throws_error(call, code, {word}));
    EXPECT_EQ(world.save(), bytes) << word;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.2, -0.1, nan}) {
    refuses([&] { world.set_rest_offset(body, bad); }, ErrorCode::invalid_argument, "rest offset is");
    BodyDefinition worse = definition;
    worse.rest_offset = bad;
    refuses([&] { world.add_body(worse); }, ErrorCode::invalid_argument, "rest offset is");
    refuses([&] { world.add_plane({.margin = 0.1, .rest_offset = bad}); }, ErrorCode::invalid_argument, "rest offset");
    offsets[3] = bad;
    refuses([&] { world.set_feature_settings(body, {.rest_offsets = offsets}); }, ErrorCode::invalid_argument,
            "vertex 3");
  }
  refuses([&] { world.set_margin(body, 0.05); }, ErrorCode::invalid_argument, "less than a rest offset of 0.1");
  offsets.pop_back();
  refuses([&] { world.set_feature_settings(body, {.rest_offsets = offsets}); }, ErrorCode::wrong_size, "rest offsets");
  const std::vector<std::uint32_t> two{1, 2};
  refuses([&] { world.set_feature_settings(body, {.vertex_labels = two}); }, ErrorCode::wrong_size, "vertices");
  refuses([&] { world.set_feature_settings(body, {.facet_labels = two}); }, ErrorCode::wrong_size, "facets");
  refuses([&] { world.set_feature_settings(body, {.vertex_layers = two}); }, ErrorCode::wrong_size, "layers");
  refuses([&] { world.set_feature_settings(body, {.vertex_masks = two}); }, ErrorCode::wrong_size, "masks");
  refuses([&] { world.labels(body, {12, -1, -1}); }, ErrorCode::invalid_argument, "vertex 12");
  world.set_feature_settings(body, {});
  world.set_margin(body, 0.05);
}

TEST(Labels, AreThoseOfFeaturesThatAreFound) {
  std::size_t looked_at = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Scene scene(seed);
    for (const bool has_points : {true, false}) {
      World world({.threads = 1, .outputs = {.points = has_points}}), other({.threads = 1, .outputs = kOutputs});
      const std::vector<BodyId> ids = scene.add_to(world);
      for (std::size_t i = 0; i < ids.size(); ++i) world.set_feature_settings(ids[i], scene.arrays[i].view());
      scene.add_to(other);
      world.detect();
      const auto expect_labels = [&](std::uint32_t body, const Three& vertices) {
        if (body >= ids.size()) return;
        const Arrays& arrays = scene.arrays[body];
        FeatureLabels expected;
        for (std::size_t k = 0; k < 3; ++k) {
          if (vertices[k] >= 0) expected.vertices[k] = arrays.vertex_labels[static_cast<std::size_t>(vertices[k])];
        }
        for (int f = scene.meshes[body].facet_count(); f-- > 0;) {
          const Three corners = scene.corners(body, f);
          const bool has_all =
              std::ranges::all_of(vertices, [&](int v) { return v < 0 || std::ranges::count(corners, v) > 0; });
          if (has_all) expected.facet = arrays.facet_labels[static_cast<std::size_t>(f)];
        }
        EXPECT_EQ(world.labels(ids[body], vertices), expected) << "seed " << seed;
        ++looked_at;
      };
      for (const Contact& contact : other.detect().contacts()) {
        for (const ContactPoint& point : contact.points()) {
          expect_labels(contact.a.index, point.a_vertices);
          expect_labels(contact.b.index, point.b_vertices);
        }
      }
    }
  }
  EXPECT_GT(looked_at, 300u);
}

// What is left is what a world without layers finds, but for what they exclude.
TEST(VertexLayers, LeaveOutWhatTheyExclude) {
  std::size_t kept = 0, left_out = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Scene scene(seed);
    World world({.threads = 1, .outputs = kOutputs}), all({.threads = 1, .outputs = kOutputs});
    const std::vector<BodyId> ids = scene.add_to(world), same = scene.add_to(all);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const Arrays& arrays = scene.arrays[i];
      world.set_feature_settings(ids[i], {.vertex_layers = arrays.vertex_layers, .vertex_masks = arrays.vertex_masks});
    }
    const Report& report = world.detect();
    for (const Contact& whole : all.detect().contacts()) {
      const std::uint32_t a = whole.a.index, b = whole.b.index;
      const Contact* const contact = report.find_contact(ids.size() > a ? ids[a] : BodyId{a, 1, ids[0].world},
                                                         ids.size() > b ? ids[b] : BodyId{b, 1, ids[0].world});
      const auto expect_same = [&](const auto& before, const auto& after, const auto& features_of,
                                   const auto& are_same) {
        std::size_t next = 0;
        for (const auto& one : before) {
          const auto [of_a, of_b] = features_of(one);
          if (!scene.are_tested(a, of_a, b, of_b)) {
            ++left_out;
            continue;
          }
          ++kept;
          ASSERT_LT(next, after.size()) << "seed " << seed;
          EXPECT_TRUE(are_same(one, after[next++])) << "seed " << seed;
        }
        EXPECT_EQ(next, after.size()) << "seed " << seed;
      };
      const auto named = [](const auto& one) { return std::pair(one.a_vertices, one.b_vertices); };
      static const Contact kNothing;
      const Contact& now = contact == nullptr ? kNothing : *contact;
      expect_same(
          whole.facet_pairs(), now.facet_pairs(),
          [&](const FacetPair& pair) { return std::pair(scene.corners(a, pair.a), scene.corners(b, pair.b)); },
          [](const FacetPair& x, const FacetPair& y) { return x == y; });
      expect_same(whole.points(), now.points(), named,
                  [](const ContactPoint& x, const ContactPoint& y) { return x.id == y.id && x.gap == y.gap; });
      expect_same(whole.within_reach(), now.within_reach(), named, [](const ReachPair& x, const ReachPair& y) {
        return x.distance == y.distance && x.a_vertices == y.a_vertices && x.b_vertices == y.b_vertices;
      });
      for (const IntersectionCurve& curve : now.curves()) {
        for (const CurvePoint& point : curve.points)
          EXPECT_LT(point.facet_pair, static_cast<int>(now.facet_pairs().size()));
      }
    }
    scene.move(world, ids), scene.move(all, same);
    std::vector<Found> expected;
    for (const Impact& one : all.detect_motion().impacts()) {
      if (scene.are_tested(one.a.index, one.a_vertices, one.b.index, one.b_vertices)) expected.push_back(found(one));
    }
    std::ranges::sort(expected);
    EXPECT_EQ(impacts_of(world.detect_motion()), expected) << "seed " << seed;
  }
  EXPECT_GT(kept, 300u);
  EXPECT_GT(left_out, 300u);
}

// A collar sewn to a body: its seam is not tested against the body, all else is.
TEST(VertexLayers, DefaultToThoseOfTheBody) {
  World world({.threads = 1, .outputs = {.points = true}});
  const Mesh body = box({-1.0, -1.0, -1.0}, {1.0, 1.0, 0.0}), collar = translated(sheet(4, 1, 0.8, 0.2), {0, 0, 0.01});
  const BodyId under =
      world.add_body({.positions = body.positions, .facets = body.facets, .layer = 2, .margin = kReach});
  const BodyId over = world.add_body({.positions = collar.positions,
                                      .facets = collar.facets,
                                      .surface = Surface::sheet,
                                      .layer = 1,
                                      .margin = kReach});
  // Vertices of the collar that have a point.
  const auto vertices = [&] {
    std::vector<int> found;
    for (const ContactPoint& point : world.detect().find_contact(under, over)->points()) {
      if (point.b_vertices[1] < 0) found.push_back(point.b_vertices[0]);
    }
    return found;
  };
  EXPECT_EQ(vertices().size(), 10u);
  std::vector<std::uint32_t> masks(10, ~0u);
  for (int v = 0; v < 10; ++v) {
    if (collar.positions(1, v) < 0.0) masks[static_cast<std::size_t>(v)] = ~2u;
  }
  world.set_feature_settings(over, {.vertex_masks = masks});
  EXPECT_EQ(vertices().size(), 5u);
  for (const int v : vertices()) EXPECT_GT(collar.positions(1, v), 0.0);
  std::ranges::fill(masks, 0u);
  world.set_feature_settings(over, {.vertex_masks = masks});
  EXPECT_FALSE(world.detect().find_contact(under, over)->touching());
  EXPECT_EQ(world.detect().ended().size(), 0u);
  world.set_feature_settings(over, {});
  EXPECT_EQ(world.detect().began().size(), 1u);
}

TEST(FeatureSettings, GoWithVerticesAndFacetsThatChange) {
  World world({.threads = 1, .outputs = kOutputs});
  const Mesh mesh = icosphere(0);
  const BodyId body = world.add_body({.positions = mesh.positions,
                                      .facets = mesh.facets,
                                      .layer = 4,
                                      .mask = 6,
                                      .margin = kReach,
                                      .rest_offset = 0.05});
  Random random(3);
  const Arrays arrays = random_arrays(mesh, random);
  world.set_feature_settings(body, arrays.view());
  const std::vector<int> vertex_map{3, -1, 5, 3, 0}, facet_map{7, -1};
  Eigen::Matrix3Xd x(3, 5);
  for (Eigen::Index v = 0; v < 5; ++v) x.col(v) << 0.3 * static_cast<double>(v), static_cast<double>(v % 2), 0.0;
  Eigen::Matrix3Xi facets(3, 2);
  facets << 0, 2, 1, 3, 2, 4;
  world.set_facets(body, {.positions = x, .facets = facets, .vertex_map = vertex_map, .facet_map = facet_map});
  const FeatureSettings now = world.feature_settings(body);
  ASSERT_EQ(now.rest_offsets.size(), 5u);
  ASSERT_EQ(now.facet_labels.size(), 2u);
  for (std::size_t v = 0; v < 5; ++v) {
    const int was = vertex_map[v];
    const auto expected = [&](const auto& list, auto of_new) {
      return was < 0 ? of_new : list[static_cast<std::size_t>(was)];
    };
    EXPECT_EQ(now.rest_offsets[v], expected(arrays.rest_offsets, 0.05));
    EXPECT_EQ(now.vertex_labels[v], expected(arrays.vertex_labels, 0u));
    EXPECT_EQ(now.vertex_layers[v], expected(arrays.vertex_layers, 4u));
    EXPECT_EQ(now.vertex_masks[v], expected(arrays.vertex_masks, 6u));
  }
  EXPECT_EQ(now.facet_labels[0], arrays.facet_labels[7]);
  EXPECT_EQ(now.facet_labels[1], 0u);
  const std::vector<int> short_map{0}, wrong_map{2, 0};
  EXPECT_TRUE(throws_error(
      [&] { world.set_facets(body, {.positions = x, .facets = facets, .vertex_map = {}, .facet_map = {}}); },
      ErrorCode::wrong_size, {"vertex map has 0"}));
  const std::vector<int> same{0, 1, 2, 3, 4};
  const auto set = [&](const std::vector<int>& map) {
    world.set_facets(body, {.positions = x, .facets = facets, .vertex_map = same, .facet_map = map});
  };
  EXPECT_TRUE(throws_error([&] { set(short_map); }, ErrorCode::wrong_size, {"facet map has 1"}));
  EXPECT_TRUE(throws_error([&] { set(wrong_map); }, ErrorCode::invalid_argument, {"facet map names facet 2"}));
  world.set_facets(body, x, facets, same);
  EXPECT_TRUE(world.feature_settings(body).facet_labels.empty());
  EXPECT_EQ(world.feature_settings(body).vertex_labels.size(), 5u);
}

TEST(FeatureSettings, AreSavedAndRecorded) {
  const Scene scene(4);
  std::ostringstream stream;
  Recorder recorder(stream);
  tact::World world({.threads = 1, .outputs = kOutputs});
  world.set_observer(&recorder);
  const std::vector<BodyId> ids = scene.add_to(world);
  for (std::size_t i = 0; i < ids.size(); ++i) world.set_feature_settings(ids[i], scene.arrays[i].view());
  world.set_rest_offset(ids[1], 0.01);
  world.detect();
  tact::World other({.threads = 1, .outputs = kOutputs});
  other.restore(world.save());
  EXPECT_EQ(other.save(), world.save());
  scene.move(world, ids);
  const std::vector<BodyId> others = other.bodies();
  scene.move(other, {others.begin(), others.begin() + 3});
  EXPECT_EQ(other.detect_motion().impacts().size(), world.detect_motion().impacts().size());
  EXPECT_EQ(other.detect().hash(), world.detect().hash());
  EXPECT_EQ(other.rest_offset(others[1]), 0.01);
  EXPECT_TRUE(std::ranges::equal(other.feature_settings(others[2]).facet_labels, scene.arrays[2].facet_labels));
  const std::vector<int> map = [&] {
    std::vector<int> all(static_cast<std::size_t>(scene.meshes[2].facet_count()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    return all;
  }();
  std::vector<int> vertices(static_cast<std::size_t>(scene.meshes[2].vertex_count()));
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = static_cast<int>(i);
  world.set_facets(
      ids[2],
      {.positions = scene.ends[2].positions, .facets = scene.ends[2].facets, .vertex_map = vertices, .facet_map = map});
  world.set_rest_offset(ids[1], std::nullopt);
  world.detect();
  const std::string bytes = stream.str();
  RecordingPlayer player(bytes);
  while (const auto played = player.next()) EXPECT_TRUE(played->same());
  EXPECT_EQ(player.world().save(), world.save());
}

}  // namespace
}  // namespace tact::tests
