// What is left out below the body: layers and masks of facets, excluded labels, neighbours on one surface, margins of
// vertices. Against brute force over what a world without them finds.
#include <gtest/gtest.h>
#include <tact/recording.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

using Corner3 = std::array<int, 3>;
using LabelsOfTwo = std::pair<std::uint32_t, std::uint32_t>;

constexpr double kWide = 0.08;  // the margin of every body, metres
constexpr Outputs kAllFound{.patches = true, .points = true, .curves = true, .within_reach = true};
constexpr std::array kMargins{0.01, 0.03, kWide};

// A body with all that it is filtered by.
struct FilteredBody {
  Mesh mesh, end;
  Eigen::Matrix2Xi edges = Eigen::Matrix2Xi(2, 0);
  std::vector<int> points;
  std::vector<std::uint32_t> facet_layers, facet_masks, facet_labels, vertex_labels;
  std::vector<double> margins;
  int rings = 0;
  double rest_distance = 0.0;
  Eigen::Matrix3Xd rest;
  std::vector<std::vector<int>> steps;  // edges between any two vertices

  std::size_t vertex_count() const { return static_cast<std::size_t>(mesh.vertex_count()); }
  std::size_t facet_count() const { return static_cast<std::size_t>(mesh.facet_count()); }
  // The vertices of all facets, edges and points.
  std::vector<std::vector<int>> elements() const {
    std::vector<std::vector<int>> all;
    for (const auto& f : mesh.facets.colwise()) all.push_back({f[0], f[1], f[2]});
    for (const auto& e : edges.colwise()) all.push_back({e[0], e[1]});
    for (const int v : points) all.push_back({v});
    return all;
  }
  FeatureSettings settings() const {
    return {.vertex_labels = vertex_labels,
            .facet_labels = facet_labels,
            .facet_layers = facet_layers,
            .facet_masks = facet_masks,
            .margins = margins};
  }
};

// How many edges lie between vertices: by Floyd and Warshall.
std::vector<std::vector<int>> steps_between(const FilteredBody& body) {
  constexpr int kFar = 1000;
  const std::size_t count = body.vertex_count();
  std::vector<std::vector<int>> steps(count, std::vector<int>(count, kFar));
  for (const std::vector<int>& element : body.elements()) {
    for (const int v : element) {
      for (const int w : element) steps[static_cast<std::size_t>(v)][static_cast<std::size_t>(w)] = v == w ? 0 : 1;
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) steps[i][j] = std::min(steps[i][j], steps[i][k] + steps[k][j]);
    }
  }
  return steps;
}

FilteredBody filtered_body(const Mesh& mesh, Random& random, std::uint64_t seed) {
  FilteredBody body;
  body.mesh = translated(mesh, 0.3 * random.in_ball());
  body.end = translated(jittered(body.mesh, 0.02, seed), 0.3 * random.in_ball());
  for (int f = 0; f < mesh.facet_count(); ++f) {
    body.facet_layers.push_back(1u << random.below(3));
    body.facet_masks.push_back(random.chance(0.7) ? 7u : static_cast<std::uint32_t>(random.below(8)));
    body.facet_labels.push_back(static_cast<std::uint32_t>(random.below(4)));
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    body.vertex_labels.push_back(static_cast<std::uint32_t>(random.below(6)));
    body.margins.push_back(kMargins[static_cast<std::size_t>(random.below(3))]);
  }
  body.rings = random.below(4);
  body.rest_distance = random.chance(0.5) ? 0.2 * random.uniform() : 0.0;
  body.rest = body.end.positions;
  return body;
}

// A chain with a few points beside it.
FilteredBody rope_body(Random& random, std::uint64_t seed) {
  constexpr int kVertices = 16, kOfRope = 13;
  Mesh mesh{Eigen::Matrix3Xd(3, kVertices), Eigen::Matrix3Xi(3, 0)};
  Vec3 at{-0.4, 0.0, 0.0};
  for (int v = 0; v < kVertices; ++v) {
    at = at + Vec3{0.04, 0.0, 0.0} + 0.05 * random.in_ball();
    mesh.set_position(v, at);
  }
  FilteredBody body = filtered_body(mesh, random, seed);
  body.edges.resize(2, kOfRope - 1);
  for (int e = 0; e + 1 < kOfRope; ++e) body.edges.col(e) << e, e + 1;
  body.points = {13, 14, 15};
  return body;
}

// Bodies that touch, cross and near each other and themselves, over a plane; those of even seeds are turned.
struct FilteredScene {
  std::vector<FilteredBody> bodies;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<std::set<LabelsOfTwo>, 2>> excluded;  // by kind
  double scale;

  explicit FilteredScene(std::uint64_t seed, double size = 1.0) : scale(size) {
    Random random(seed);
    const Rotation turn = seed % 2 == 0 ? random.rotation() : Rotation{};
    const std::array first{blob(1, 0.4, 0.3, seed), wrinkled_sheet(6, 1.0, 0.2, seed), soup(30, 0.4, seed)};
    for (const Mesh& mesh : first) bodies.push_back(filtered_body(rotated(mesh, turn), random, seed));
    bodies.push_back(rope_body(random, seed));
    for (FilteredBody& body : bodies) {
      body.steps = steps_between(body);
      body.mesh.positions *= scale, body.end.positions *= scale, body.rest *= scale, body.rest_distance *= scale;
      for (double& margin : body.margins) margin *= scale;
    }
    for (std::uint32_t a = 0; a < bodies.size(); ++a) {
      for (std::uint32_t b = a; b < bodies.size(); ++b) {
        for (std::uint32_t i = 0; i < 4; ++i) {
          const auto label_a = 1u + static_cast<std::uint32_t>(random.below(3)),
                     label_b = 1u + static_cast<std::uint32_t>(random.below(3));
          if (!random.chance(0.5)) continue;
          excluded[{a, b}][i % 2].insert({label_a, label_b});
          if (a == b) excluded[{a, b}][i % 2].insert({label_b, label_a});
        }
      }
    }
  }
  std::vector<BodyId> add_to(tact::World& world, double margin = 0.0) const {
    if (margin == 0.0) margin = scale * kWide;
    std::vector<BodyId> ids;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      ids.push_back(world.add_body({.positions = bodies[i].mesh.positions,
                                    .facets = bodies[i].mesh.facets,
                                    .edges = bodies[i].edges,
                                    .points = bodies[i].points,
                                    .surface = i == 0 ? Surface::closed : Surface::sheet,
                                    .margin = margin,
                                    .self_contact = i > 0,
                                    .rest_offset = 0.0}));
    world.add_plane({.normal = {0.0, 0.0, 1.0}, .offset = -0.35 * scale, .margin = margin, .rest_offset = 0.0});
    return ids;
  }
  void filter(tact::World& world, const std::vector<BodyId>& ids) const {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      world.set_feature_settings(ids[i], bodies[i].settings());
      const FilteredBody& body = bodies[i];
      world.set_self_contact_filter(
          ids[i], {.rings = body.rings, .rest_distance = body.rest_distance, .rest_positions = body.rest});
    }
    for (const auto& [pair, kinds] : excluded) {
      for (const LabelKind kind : {LabelKind::facet, LabelKind::vertex}) {
        for (const auto& [label_a, label_b] : kinds[static_cast<std::size_t>(kind)])
          world.set_excluded_labels({ids[pair.second], label_b, ids[pair.first], label_a, kind}, true);
      }
    }
  }
  void move(tact::World& world, const std::vector<BodyId>& ids) const {
    for (std::size_t i = 0; i < ids.size(); ++i) world.set_positions(ids[i], bodies[i].end.positions);
  }

  bool are_excluded(std::uint32_t a, std::uint32_t label_a, std::uint32_t b, std::uint32_t label_b, int kind) const {
    if (a > b) std::swap(a, b), std::swap(label_a, label_b);
    const auto found = excluded.find({a, b});
    return found != excluded.end() && found->second[static_cast<std::size_t>(kind)].contains({label_a, label_b});
  }
  struct Tested {
    std::uint32_t layer = 1, mask = ~0u, label = 0;
  };
  // Facets, edges and points that have the vertices; a plane has one.
  std::vector<Tested> elements_with(std::uint32_t body, const Corner3& vertices) const {
    if (body >= bodies.size()) return {{}};
    const FilteredBody& of = bodies[body];
    std::vector<Tested> found;
    const auto all = of.elements();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!std::ranges::all_of(vertices, [&](int v) { return v < 0 || std::ranges::count(all[i], v) > 0; })) continue;
      found.push_back(i < of.facet_count() ? Tested{of.facet_layers[i], of.facet_masks[i], of.facet_labels[i]}
                                           : Tested{});
    }
    return found;
  }
  bool elements_are_tested(std::uint32_t a, const Tested& x, std::uint32_t b, const Tested& y) const {
    return (x.layer & y.mask) != 0 && (y.layer & x.mask) != 0 && !are_excluded(a, x.label, b, y.label, 0);
  }
  bool vertices_are_tested(std::uint32_t a, const Corner3& of_a, std::uint32_t b, const Corner3& of_b) const {
    for (const int v : of_a) {
      for (const int w : of_b) {
        if (v < 0 || w < 0) continue;
        const auto i = static_cast<std::size_t>(v), k = static_cast<std::size_t>(w);
        if (are_excluded(a, bodies[a].vertex_labels[i], b, bodies[b].vertex_labels[k], 1)) return false;
        if (a != b) continue;
        if (bodies[a].rings > 0 && bodies[a].steps[i][k] <= bodies[a].rings) return false;
        const double apart = (bodies[a].rest.col(v) - bodies[a].rest.col(w)).norm();
        if (bodies[a].rest_distance > 0.0 && apart <= bodies[a].rest_distance) return false;
      }
    }
    return true;
  }
  bool are_tested(std::uint32_t a, const Corner3& of_a, std::uint32_t b, const Corner3& of_b) const {
    if (!vertices_are_tested(a, of_a, b, of_b)) return false;
    const auto others = elements_with(b, of_b);
    return std::ranges::any_of(elements_with(a, of_a), [&](const Tested& x) {
      return std::ranges::any_of(others, [&](const Tested& y) { return elements_are_tested(a, x, b, y); });
    });
  }
  double margin(std::uint32_t body, const Corner3& vertices) const {
    if (body >= bodies.size()) return scale * kWide;
    double most = 0.0;
    for (const int v : vertices) {
      if (v >= 0) most = std::max(most, bodies[body].margins[static_cast<std::size_t>(v)]);
    }
    return most;
  }
  Corner3 facet(std::uint32_t body, int f) const {
    const Eigen::Vector3i of = bodies[body].mesh.facets.col(f);
    return {of[0], of[1], of[2]};
  }
};

template <class One>
auto named_features(const One& one) {
  return std::tuple(one.a.index, one.b.index, one.kind, one.a_vertices, one.b_vertices, one.time);
}

std::vector<int> first_numbers(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

auto contacts_by_bodies(const Report& report) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, const Contact*> found;
  for (const Contact& contact : report.contacts()) found[{contact.a.index, contact.b.index}] = &contact;
  return found;
}

// Those of `all` that `is_kept` are `left`, in their order; returns how many are not.
template <class One, class IsKept, class AreSame>
std::size_t expect_left(std::span<const One> all, std::span<const One> left, const IsKept& is_kept,
                        const AreSame& are_same, std::uint64_t seed) {
  std::size_t next = 0;
  for (const One& one : all) {
    if (!is_kept(one)) continue;
    EXPECT_TRUE(next < left.size() && are_same(one, left[next])) << "seed " << seed << ", " << next;
    ++next;
  }
  EXPECT_EQ(next, left.size()) << "seed " << seed;
  return all.size() - next;
}

std::size_t expect_filtered(const FilteredScene& scene, const Contact& whole, const Contact& now, std::uint64_t seed) {
  const std::uint32_t a = whole.a.index, b = whole.b.index;
  const auto is_seen = [&](const auto& one, double gap) {
    return scene.are_tested(a, one.a_vertices, b, one.b_vertices) &&
           (gap <= 0.0 || gap < scene.margin(a, one.a_vertices) + scene.margin(b, one.b_vertices));
  };
  const auto facet_pair_is_tested = [&](const FacetPair& pair) {
    const FilteredBody &of_a = scene.bodies[a], &of_b = scene.bodies[b];
    const auto tested = [](const FilteredBody& body, int facet) {
      const auto f = static_cast<std::size_t>(facet);
      return FilteredScene::Tested{body.facet_layers[f], body.facet_masks[f], body.facet_labels[f]};
    };
    return scene.vertices_are_tested(a, scene.facet(a, pair.a), b, scene.facet(b, pair.b)) &&
           scene.elements_are_tested(a, tested(of_a, pair.a), b, tested(of_b, pair.b));
  };
  const std::size_t planes = std::max(a, b) >= scene.bodies.size() ? 1 : 0;
  std::size_t left_out = 0;
  if (planes == 0)
    left_out += expect_left<FacetPair>(
        whole.facet_pairs(), now.facet_pairs(), facet_pair_is_tested,
        [](const FacetPair& x, const FacetPair& y) { return x == y; }, seed);
  left_out += expect_left<ContactPoint>(
      whole.points(), now.points(), [&](const ContactPoint& point) { return is_seen(point, point.gap); },
      [](const ContactPoint& x, const ContactPoint& y) { return x.id == y.id && x.gap == y.gap; }, seed);
  left_out += expect_left<ReachPair>(
      whole.within_reach(), now.within_reach(),
      [&](const ReachPair& pair) {
        return is_seen(pair, pair.distance) &&
               pair.distance < scene.margin(a, pair.a_vertices) + scene.margin(b, pair.b_vertices);
      },
      [](const ReachPair& x, const ReachPair& y) {
        return x.a_vertices == y.a_vertices && x.b_vertices == y.b_vertices && x.distance == y.distance;
      },
      seed);
  return left_out;
}

TEST(FeatureFilters, LeaveOutWhatBruteForceDoes) {
  std::size_t left_out = 0, points = 0, reach = 0, pairs = 0, impacts = 0, own = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const FilteredScene scene(seed, seed < 5 ? 1.0 : std::ldexp(1.0, seed == 5 ? -100 : 100));
    World world({.threads = 1, .outputs = kAllFound}), all({.threads = 1, .outputs = kAllFound});
    const std::vector<BodyId> ids = scene.add_to(world), same = scene.add_to(all);
    scene.filter(world, ids);
    static const Contact kNothing;
    const auto now = contacts_by_bodies(world.detect());
    for (const Contact& whole : all.detect().contacts()) {
      const auto found = now.find({whole.a.index, whole.b.index});
      const Contact& contact = found == now.end() ? kNothing : *found->second;
      left_out += expect_filtered(scene, whole, contact, seed);
      points += contact.points().size(), reach += contact.within_reach().size();
      pairs += contact.facet_pairs().size();
      own += whole.a == whole.b ? contact.within_reach().size() : 0;
    }
    scene.move(world, ids), scene.move(all, same);
    using Named = decltype(named_features(Impact{}));
    std::vector<Named> expected, met;
    for (const Impact& one : all.detect_motion().impacts()) {
      if (scene.are_tested(one.a.index, one.a_vertices, one.b.index, one.b_vertices))
        expected.push_back(named_features(one));
    }
    for (const Impact& one : world.detect_motion().impacts()) met.push_back(named_features(one));
    std::ranges::sort(expected), std::ranges::sort(met);
    EXPECT_EQ(met, expected) << "seed " << seed;
    impacts += met.size();
  }
  EXPECT_GT(left_out, 2000u);
  for (const std::size_t count : {points, reach, pairs, impacts, own}) EXPECT_GT(count, 30u);
}

// Each pair of features is within reach where it is in a world whose margins add up to its own.
TEST(MarginsOfVertices, GiveWhatUniformMarginsGive) {
  std::size_t compared = 0;
  using Named = std::tuple<std::uint32_t, std::uint32_t, FeaturePair, Corner3, Corner3, double>;
  const auto all_of = [](const Report& report, const auto& is_wanted) {
    std::set<Named> found;
    for (const Contact& contact : report.contacts()) {
      for (const ReachPair& pair : contact.within_reach()) {
        const Named named{contact.a.index, contact.b.index, pair.kind, pair.a_vertices, pair.b_vertices, pair.distance};
        if (is_wanted(contact, pair)) found.insert(named);
      }
    }
    return found;
  };
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const FilteredScene scene(seed);
    World world({.threads = 1, .outputs = kAllFound});
    const std::vector<BodyId> ids = scene.add_to(world);
    for (std::size_t i = 0; i < ids.size(); ++i)
      world.set_feature_settings(ids[i], {.margins = scene.bodies[i].margins});
    std::set<double> sums;
    for (const double x : kMargins) {
      for (const double y : kMargins) sums.insert(x + y);
    }
    std::set<Named> expected;
    for (const double sum : sums) {
      World uniform({.threads = 1, .outputs = {.within_reach = true}});
      scene.add_to(uniform, 0.5 * sum);
      expected.merge(all_of(uniform.detect(), [&](const Contact& contact, const ReachPair& pair) {
        return scene.margin(contact.a.index, pair.a_vertices) + scene.margin(contact.b.index, pair.b_vertices) == sum;
      }));
    }
    EXPECT_EQ(all_of(world.detect(), [](const Contact&, const ReachPair&) { return true; }), expected)
        << "seed " << seed;
    compared += expected.size();
  }
  EXPECT_GT(compared, 500u);
}

// A rope thicker than its segments are long.
TEST(SelfContactFilters, LetARopeBeThickerThanItsSegments) {
  constexpr int kVertices = 20;
  Eigen::Matrix3Xd straight(3, kVertices), bent(3, kVertices);
  Eigen::Matrix2Xi edges(2, kVertices - 1);
  for (int v = 0; v < kVertices; ++v) {
    const double along = 0.1 * v, turn = 0.33 * v;
    straight.col(v) << along, 0.0, 0.0;
    bent.col(v) << 0.3 * std::cos(turn), 0.3 * std::sin(turn), 0.005 * v;  // the ends come together
    if (v > 0) edges.col(v - 1) << v - 1, v;
  }
  for (const bool by_rings : {true, false}) {
    World world({.threads = 1, .outputs = {.within_reach = true}});
    const BodyId rope = world.add_body(
        {.positions = straight, .edges = edges, .margin = 0.12, .self_contact = true, .rest_offset = 0.0});
    const auto found = [&] {
      const Contact* const contact = world.detect().find_contact(rope, rope);
      return contact == nullptr ? std::size_t{0} : contact->within_reach().size();
    };
    EXPECT_GT(found(), 0u);
    world.set_self_contact_filter(rope,
                                  by_rings ? SelfContactFilter{.rings = 3} : SelfContactFilter{.rest_distance = 0.31});
    EXPECT_EQ(found(), 0u);
    world.set_positions(rope, bent);
    EXPECT_GT(found(), 0u) << "its ends are near, and no neighbours";
    for (const ReachPair& pair : world.detect().find_contact(rope, rope)->within_reach())
      EXPECT_GT(std::abs(pair.a_vertices[0] - pair.b_vertices[0]), 3);
    // Rings are those of the facets that there are; positions at rest go with vertices.
    const std::vector<int> same = first_numbers(kVertices);
    const std::size_t before = found();
    world.set_facets(rope, {.positions = bent, .edges = edges, .vertex_map = same});
    EXPECT_EQ(found(), before);
    const SelfContactFilter now = world.self_contact_filter(rope);
    EXPECT_EQ(now.rings, by_rings ? 3 : 0);
    EXPECT_EQ(now.rest_positions.cols(), by_rings ? 0 : kVertices);
    world.set_self_contact_filter(rope, {});
    EXPECT_GT(found(), before);
  }
}

// What is found of one body is cut into ranges, which several threads hold against its filters.
TEST(FeatureFilters, LeaveOutTheSameWithAnyNumberOfThreads) {
  const Mesh cloth = wrinkled_sheet(14, 1.0, 0.05, 1);
  Random random(5);
  FilteredBody body = filtered_body(cloth, random, 5);
  const auto found = [&](int threads) {
    World world({.threads = threads, .outputs = kAllFound});
    const BodyId id = world.add_body({.positions = body.mesh.positions,
                                      .facets = body.mesh.facets,
                                      .surface = Surface::sheet,
                                      .margin = kWide,
                                      .self_contact = true});
    world.set_feature_settings(id, body.settings());
    world.set_self_contact_filter(id, {.rings = 1});
    std::vector<std::pair<Corner3, Corner3>> pairs;
    const Contact& contact = *world.detect().find_contact(id, id);
    for (const ReachPair& pair : contact.within_reach()) pairs.emplace_back(pair.a_vertices, pair.b_vertices);
    for (const ContactPoint& point : contact.points()) pairs.emplace_back(point.a_vertices, point.b_vertices);
    return pairs;
  };
  const auto expected = found(1);
  EXPECT_GT(expected.size(), 1024u);
  EXPECT_EQ(found(3), expected);
}

TEST(FeatureFilters, GoWithFacetsThatChange) {
  World world({.threads = 1, .outputs = kAllFound});
  const Mesh mesh = icosphere(0);
  const BodyId body = world.add_body(
      {.positions = mesh.positions, .facets = mesh.facets, .layer = 4, .mask = 6, .margin = kWide, .rest_offset = 0.0});
  Random random(3);
  const FilteredBody given = filtered_body(mesh, random, 3);
  world.set_feature_settings(body, given.settings());
  world.set_self_contact_filter(body, {.rings = 1, .rest_distance = 0.1, .rest_positions = given.rest});
  const std::vector<int> vertex_map{3, -1, 5}, facet_map{7, -1};
  Eigen::Matrix3Xd x(3, 3);
  x << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0;
  Eigen::Matrix3Xi facets(3, 2);
  facets << 0, 1, 1, 2, 2, 0;
  world.set_facets(body, {.positions = x, .facets = facets, .vertex_map = vertex_map, .facet_map = facet_map});
  const FeatureSettings now = world.feature_settings(body);
  EXPECT_TRUE(std::ranges::equal(now.facet_layers, std::array{given.facet_layers[7], 4u}));
  EXPECT_TRUE(std::ranges::equal(now.facet_masks, std::array{given.facet_masks[7], 6u}));
  EXPECT_TRUE(std::ranges::equal(now.margins, std::array{given.margins[3], kWide, given.margins[5]}));
  const SelfContactFilter filter = world.self_contact_filter(body);
  ASSERT_EQ(filter.rest_positions.cols(), 3);
  for (int v = 0; v < 3; ++v) {
    const auto rest = filter.rest_positions.column(v);
    const int was = vertex_map[static_cast<std::size_t>(v)];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      EXPECT_EQ(rest[k], was < 0 ? x(axis, v) : given.rest(axis, was));
    }
  }
}

TEST(FeatureFilters, AreSavedAndRecorded) {
  const FilteredScene scene(4);
  std::ostringstream stream;
  Recorder recorder(stream);
  tact::World world({.threads = 1, .outputs = kAllFound});
  world.set_observer(&recorder);
  const std::vector<BodyId> ids = scene.add_to(world);
  scene.filter(world, ids);
  world.set_self_contact_filter(ids[3], {.rest_distance = 0.05});
  world.set_excluded_labels({ids[0], 9, ids[1], 8, LabelKind::vertex}, true);
  world.set_excluded_labels({ids[0], 9, ids[1], 8, LabelKind::vertex}, false);
  world.detect();
  tact::World other({.threads = 1, .outputs = kAllFound});
  other.restore(world.save());
  EXPECT_EQ(other.save(), world.save());
  const std::vector<BodyId> others = other.bodies();
  scene.move(world, ids);
  scene.move(other, {others.begin(), others.begin() + 4});
  EXPECT_EQ(other.detect_motion().impacts().size(), world.detect_motion().impacts().size());
  EXPECT_EQ(other.detect().hash(), world.detect().hash());
  EXPECT_EQ(other.save(), world.save());
  EXPECT_EQ(other.self_contact_filter(others[2]).rings, scene.bodies[2].rings);
  const std::string bytes = stream.str();
  RecordingPlayer player(bytes);
  while (const auto played = player.next()) EXPECT_TRUE(played->same());
  EXPECT_EQ(player.world().save(), world.save());
}

TEST(FeatureFilters, RefuseWhatHasNoMeaning) {
  World world;
  const Mesh mesh = icosphere(0);
  const BodyId body = world.add_body(
                   {.positions = mesh.positions, .facets = mesh.facets, .margin = 0.1, .rest_offset = 0.05}),
               plane = world.add_plane({});
  std::vector<double> margins(12, 0.07);
  world.set_feature_settings(body, {.margins = margins});
  const std::vector<std::byte> bytes = world.save();
  const auto refuses = [&](auto call, ErrorCode code, const char* word) {
    EXPECT_TRUE(throws_error(call, code, {word}));
    EXPECT_EQ(world.save(), bytes) << word;
  };
  const auto set = [&](const FeatureSettings& settings) { return [&] { world.set_feature_settings(body, settings); }; };
  const auto wrong = ErrorCode::invalid_argument;
  refuses([&] { world.set_margin(body, 0.06); }, wrong, "less than that of a vertex, 0.07");
  refuses([&] { world.set_rest_offset(body, 0.08); }, wrong, "rest offset is 0.08");
  const std::vector<double> offsets(12, 0.071);
  refuses(set({.rest_offsets = offsets, .margins = margins}), wrong, "rest offset of vertex 0");
  margins[4] = 0.04;
  refuses(set({.margins = margins}), wrong, "margin of vertex 4 is 0.04, less than the rest offset of the body");
  for (const double bad : {0.2, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    margins[4] = bad;
    refuses(set({.margins = margins}), wrong, "margin of vertex 4");
  }
  margins.pop_back();
  refuses(set({.margins = margins}), ErrorCode::wrong_size, "margins of vertices");
  const std::vector<std::uint32_t> two{1, 2};
  refuses(set({.facet_layers = two}), ErrorCode::wrong_size, "layers of facets");
  refuses(set({.facet_masks = two}), ErrorCode::wrong_size, "masks of facets");
  for (const int rings : {-1, 17})
    refuses([&] { world.set_self_contact_filter(body, {.rings = rings}); }, wrong, "rings");
  for (const double bad : {-1.0, 0x1p301, std::numeric_limits<double>::quiet_NaN()})
    refuses([&] { world.set_self_contact_filter(body, {.rest_distance = bad}); }, wrong, "distance at rest");
  Eigen::Matrix3Xd rest = mesh.positions;
  rest(1, 3) = std::numeric_limits<double>::infinity();
  const auto rest_at = [&](const Eigen::Matrix3Xd& x) {
    return [&] { world.set_self_contact_filter(body, {.rest_distance = 0.1, .rest_positions = x}); };
  };
  refuses(rest_at(rest), ErrorCode::non_finite_position, "vertex 3");
  const Eigen::Matrix3Xd fewer = mesh.positions.leftCols(4);
  refuses(rest_at(fewer), ErrorCode::wrong_size, "4 positions at rest");
  refuses([&] { world.set_excluded_labels({body, 0, body, 1}, true); }, wrong, "label 0");
  refuses([&] { world.set_excluded_labels({body, 1, plane, 1}, true); }, wrong, "is a plane");
  refuses(
      [&] {
        world.set_excluded_labels({body, 1, body, 1, static_cast<LabelKind>(2)}, true);
      },
      wrong, "kind of labels");
  refuses([&] { world.excluded_labels({body, 1, BodyId{}, 1}); }, ErrorCode::stale_body, "names no body");
}

}  // namespace
}  // namespace tact::tests
