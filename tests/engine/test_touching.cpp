// One meaning of touching: for contacts, for what began and ended, and for the counts of a step.
#include <gtest/gtest.h>
#include <tact/world.h>

#include <algorithm>
#include <vector>

#include "engine/touching.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {
namespace {

BodyDefinition definition(const Mesh& mesh, double margin) {
  return {.positions = mesh.positions, .facets = mesh.facets, .margin = margin};
}

ContactPoint point_with(double gap) {
  ContactPoint point;
  point.gap = gap;
  return point;
}

narrowphase::FeatureReach at(double sum) { return {.a = {.largest = sum}, .b = {}}; }

TEST(Touching, IsByFacetsOrByAGapBelowTheRestOffsets) {
  const std::vector<FacetPair> none, some{{0, 0}};
  const std::vector<ContactPoint> near{point_with(0.3), point_with(0.1)}, at_the_sum{point_with(0.2)};
  EXPECT_FALSE(is_touching(none, {}, at(0.2)));
  EXPECT_TRUE(is_touching(some, {}, at(0.0)));
  EXPECT_TRUE(is_touching(none, near, at(0.2)));
  EXPECT_FALSE(is_touching(none, at_the_sum, at(0.2)));
  EXPECT_TRUE(is_touching(none, std::vector{point_with(-1e-300)}, at(0.0)));
}

// Balls that drift through each other and rest, at every level, with points and without.
TEST(Touching, EventsAreItsChanges) {
  for (const Accuracy accuracy : {Accuracy::exact, Accuracy::paper, Accuracy::hulls}) {
    for (const bool points : {true, false}) {
      World world({.threads = 2, .accuracy = accuracy, .outputs = {.points = points}});
      Random random(7);
      const Mesh ball = icosphere(1, 0.5);
      std::vector<BodyId> ids;
      for (int i = 0; i < 8; ++i) ids.push_back(world.add_body(definition(ball, 0.05 * i)));
      std::vector<ContactEvent> touched;
      int by_points_alone = 0, began = 0;
      for (int step = 0; step < 40; ++step) {
        for (const BodyId id : ids) {
          const Vec3 place = 1.5 * random.in_ball();
          if (step % 4 == 0 || random.chance(0.3)) world.set_positions(id, translated(ball, place).positions);
        }
        const Report& report = world.detect();
        std::vector<ContactEvent> now;
        for (const Contact& contact : report.contacts()) {
          const double reach = world.margin(contact.a) + world.margin(contact.b);
          const bool is_near = std::ranges::any_of(contact.points(), [&](const auto& p) { return p.gap < reach; });
          const bool facets_meet = !contact.facet_pairs().empty();
          ASSERT_EQ(contact.touching(), facets_meet || is_near) << step;
          by_points_alone += contact.touching() && !facets_meet ? 1 : 0;
          if (contact.touching()) now.push_back({contact.a, contact.b});
        }
        const auto missing = [](const std::vector<ContactEvent>& all, const std::vector<ContactEvent>& from) {
          std::vector<ContactEvent> result;
          std::ranges::copy_if(all, std::back_inserter(result),
                               [&](const ContactEvent& event) { return std::ranges::count(from, event) == 0; });
          return result;
        };
        ASSERT_TRUE(std::ranges::equal(report.began(), missing(now, touched))) << step;
        ASSERT_TRUE(std::ranges::equal(report.ended(), missing(touched, now))) << step;
        ASSERT_EQ(report.stats().touching_contacts, static_cast<std::int64_t>(now.size())) << step;
        began += static_cast<int>(report.began().size());
        touched = std::move(now);
      }
      EXPECT_EQ(began > 10, points || accuracy != Accuracy::hulls);
      EXPECT_EQ(by_points_alone > 10, points);
    }
  }
}

}  // namespace
}  // namespace tact::tests
