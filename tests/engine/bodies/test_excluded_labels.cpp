// Labels of two bodies whose features are not tested against each other.
#include <gtest/gtest.h>
#include <tact/world.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

constexpr double kMargin = 0.08;  // metres

// A collar that is sewn to what it lies on: facets of the seam never meet it, the others do.
TEST(ExcludedLabels, KeepASeamApart) {
  World world({.threads = 1, .outputs = {.points = true, .within_reach = true}});
  const Mesh body = box({-1.0, -1.0, -1.0}, {1.0, 1.0, 0.0}), collar = translated(sheet(4, 2, 0.8, 0.4), {0, 0, 0.01});
  const BodyId under = world.add_body({.positions = body.positions, .facets = body.facets, .margin = kMargin}),
               over = world.add_body({.positions = collar.positions,
                                      .facets = collar.facets,
                                      .surface = Surface::sheet,
                                      .margin = kMargin});
  const std::vector<std::uint32_t> of_body(static_cast<std::size_t>(body.facet_count()), 5);
  std::vector<std::uint32_t> of_collar;
  for (const auto& f : collar.facets.colwise()) {
    const double middle = (collar.positions(1, f[0]) + collar.positions(1, f[1]) + collar.positions(1, f[2])) / 3.0;
    of_collar.push_back(middle < 0.0 ? 7 : 8);
  }
  world.set_feature_settings(under, {.facet_labels = of_body});
  world.set_feature_settings(over, {.facet_labels = of_collar});
  const LabelPair seam{.a = over, .label_a = 7, .b = under, .label_b = 5};
  const auto vertices = [&] {
    std::set<double> found;
    for (const ContactPoint& point : world.detect().find_contact(under, over)->points()) {
      if (point.b_vertices[1] < 0) found.insert(collar.positions(1, point.b_vertices[0]));
    }
    return found;
  };
  EXPECT_EQ(vertices().size(), 3u);
  world.set_excluded_labels(seam, true);
  EXPECT_TRUE(world.excluded_labels({.a = under, .label_a = 5, .b = over, .label_b = 7}));
  EXPECT_FALSE(world.excluded_labels({.a = under, .label_a = 5, .b = over, .label_b = 7, .kind = LabelKind::vertex}));
  EXPECT_EQ(vertices().size(), 2u) << "the line between both has facets of both";
  // Labels of facets go with them, and the seam with the labels.
  std::vector<int> facets(static_cast<std::size_t>(collar.facet_count())),
      same(static_cast<std::size_t>(collar.vertex_count()));
  std::iota(facets.begin(), facets.end(), 0);
  std::iota(same.begin(), same.end(), 0);
  world.set_facets(over,
                   {.positions = collar.positions, .facets = collar.facets, .vertex_map = same, .facet_map = facets});
  EXPECT_EQ(vertices().size(), 2u);
  std::ranges::fill(of_collar, 7);
  world.set_feature_settings(over, {.facet_labels = of_collar});
  EXPECT_TRUE(vertices().empty());
  EXPECT_EQ(world.detect().ended().size(), 0u);
  world.set_excluded_labels(seam, false);
  EXPECT_EQ(world.detect().began().size(), 1u);
  world.set_excluded_labels(seam, true);
  world.remove_body(under);
  const BodyId next = world.add_body({.positions = body.positions, .facets = body.facets, .margin = kMargin});
  EXPECT_EQ(next.index, under.index);
  EXPECT_FALSE(world.excluded_labels({.a = next, .label_a = 5, .b = over, .label_b = 7})) << "of the body that went";
}

// Some bodies, and the labels that are excluded, in both orders.
class Excluded {
 public:
  Excluded() {
    for (int i = 0; i < kBodies; ++i) ids_.push_back(add());
  }

  World world{{.threads = 1}};

  static LabelPair drawn(Random& random) {
    const auto body = [&] { return BodyId{.index = static_cast<std::uint32_t>(random.below(kBodies))}; };
    const auto label = [&] { return static_cast<std::uint32_t>(1 + random.below(kLabels)); };
    const BodyId a = body(), b = body();
    return {a, label(), b, label(), random.chance(0.5) ? LabelKind::facet : LabelKind::vertex};
  }
  void set(LabelPair labels, bool excluded) {
    if (excluded) {
      named_.insert(name_of(labels)), named_.insert(name_of(swapped(labels)));
    } else {
      named_.erase(name_of(labels)), named_.erase(name_of(swapped(labels)));
    }
    world.set_excluded_labels(of_bodies(labels), excluded);
  }
  // A body goes, and another one comes in its place.
  void replace(int i) {
    world.remove_body(ids_[static_cast<std::size_t>(i)]);
    ids_[static_cast<std::size_t>(i)] = add();
    const auto place = static_cast<std::uint32_t>(i);
    std::erase_if(named_, [&](const Named& one) { return std::get<0>(one) == place || std::get<2>(one) == place; });
  }
  void expect_as_named() const {
    for (int n = 0; n < kBodies * kBodies * kLabels * kLabels * 2; ++n) {
      const auto digit = [&](int below, int count) { return static_cast<std::uint32_t>(n / below % count); };
      const LabelPair labels{
          .a = {.index = digit(1, kBodies)},
          .label_a = 1 + digit(kBodies, kLabels),
          .b = {.index = digit(kBodies * kLabels, kBodies)},
          .label_b = 1 + digit(kBodies * kLabels * kBodies, kLabels),
          .kind = digit(kBodies * kLabels * kBodies * kLabels, 2) == 0 ? LabelKind::facet : LabelKind::vertex};
      ASSERT_EQ(world.excluded_labels(of_bodies(labels)), named_.contains(name_of(labels)));
    }
  }
  std::size_t count() const { return named_.size(); }

 private:
  static constexpr int kBodies = 7, kLabels = 3;
  using Named = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, LabelKind>;

  static Named name_of(const LabelPair& one) { return {one.a.index, one.label_a, one.b.index, one.label_b, one.kind}; }
  static LabelPair swapped(const LabelPair& one) { return {one.b, one.label_b, one.a, one.label_a, one.kind}; }
  LabelPair of_bodies(LabelPair labels) const {
    labels.a = ids_[labels.a.index], labels.b = ids_[labels.b.index];
    return labels;
  }
  BodyId add() {
    const Mesh mesh = icosphere(0);
    return world.add_body({.positions = mesh.positions, .facets = mesh.facets});
  }

  std::vector<BodyId> ids_;
  std::set<Named> named_;
};

TEST(ExcludedLabels, AreThoseThatWereSet) {
  Random random(20261129);
  Excluded all;
  std::size_t most = 0;
  for (int step = 0; step < 3000; ++step) {
    all.set(Excluded::drawn(random), random.chance(0.6));
    if (random.chance(0.02)) all.replace(random.below(7));
    if (random.chance(0.02)) all.world.restore(all.world.save());
    most = std::max(most, all.count());
    if (step % 20 == 0) {
      ASSERT_NO_FATAL_FAILURE(all.expect_as_named()) << "step " << step;
    }
  }
  EXPECT_GT(most, 100u);
}

}  // namespace
}  // namespace tact::tests
