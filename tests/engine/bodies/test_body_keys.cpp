// Keys of bodies: the order of all answers, whatever the order in which bodies are added.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"

namespace tact::tests {
namespace {

constexpr std::uint64_t kLargestKey = std::numeric_limits<std::uint64_t>::max();

BodyId add_cube(tact::World& world, std::optional<std::uint64_t> key, double x = 0.0) {
  const Mesh mesh = cube(1.0, {x, 0.0, 0.0});
  return world.add_body({.positions = mesh.positions, .facets = mesh.facets, .key = key});
}

TEST(BodyKeys, AreIndicesByDefault) {
  World world;
  const BodyId a = add_cube(world, {}), b = add_cube(world, kLargestKey), c = add_cube(world, 2);
  EXPECT_EQ(world.key(a), a.index);
  EXPECT_EQ(world.key(b), kLargestKey);
  EXPECT_EQ(world.key(c), 2u);
}

TEST(BodyKeys, AreRefusedTwice) {
  World world;
  const BodyId first = add_cube(world, 1);
  EXPECT_TRUE(throws_error([&] { add_cube(world, 1); }, ErrorCode::invalid_argument, {"key 1", "body 0"}));
  EXPECT_TRUE(throws_error([&] { add_cube(world, {}); }, ErrorCode::invalid_argument, {"key 1"})) << "by default";
  add_cube(world, 7);
  const BodyId third = add_cube(world, {});
  EXPECT_TRUE(throws_error([&] { add_cube(world, third.index); }, ErrorCode::invalid_argument, {"key 2"}));
  EXPECT_EQ(world.body_count(), 3u);
  world.remove_body(first);
  add_cube(world, 1);  // free again
}

// Bodies of one world in some order: a pile of all kinds, of which some are removed, replaced and moved.
class Pile {
 public:
  explicit Pile(std::span<const int> order) : ids_(kBodies) {
    Settings settings{.threads = 2};
    settings.outputs.points = settings.outputs.patches = true;
    world_.set_settings(settings);
    for (const int i : order) add(i);
  }

  void step(int step) {
    if (step == 3) {
      world_.remove_body(ids_[5]);
      world_.remove_body(ids_[2]);
    }
    if (step == 4) add(5);
    if (step == 6) world_.remove_body(ids_[7]), add(7), add(2);  // in one step
    Random random(static_cast<std::uint64_t>(step));
    for (int i = 0; i < kBodies; ++i) {
      const Vec3 by = 0.2 * random.in_cube(1.0);
      if (world_.contains(id(i)) && world_.motion(id(i)) == Motion::deformable)
        world_.set_positions(id(i), translated(mesh(i), by).positions);
    }
    motion_ = &world_.detect_motion();
    report_ = &world_.detect();
  }

  // All answers of a step, bodies by key.
  std::vector<std::uint64_t> answers() const {
    std::vector<std::uint64_t> all{report_->hash(), report_->contacts().size()};
    const auto add_pair = [&](BodyId a, BodyId b) { all.insert(all.end(), {key(a), key(b)}); };
    for (const Contact& contact : report_->contacts()) {
      add_pair(contact.a, contact.b);
      all.push_back(contact.hash());
    }
    for (const auto events : {report_->began(), report_->ended()}) {
      for (const ContactEvent& event : events) add_pair(event.a, event.b);
    }
    for (const PatchEvent& event : report_->patch_events()) {
      add_pair(event.a, event.b);
      all.insert(all.end(), {static_cast<std::uint64_t>(event.kind), event.patch, event.other});
    }
    for (const Impact& impact : motion_->impacts()) {
      add_pair(impact.a, impact.b);
      all.push_back(std::bit_cast<std::uint64_t>(impact.time));
    }
    const RayHit hit = world_.cast_ray({.from = {-9, 0, 0}, .to = {9, 0.1, 0.1}});
    all.push_back(key(hit.body));
    for (const BodyId body : world_.bodies_containing({.point = {0.1, 0, 0}})) all.push_back(key(body));
    for (const FacetOfBody& facet : world_.overlap_box({.lower = {0, 0, 0}, .upper = {0.5, 0.5, 0.5}}))
      all.push_back(key(facet.body));
    all.push_back(key(world_.cast_ray({.from = {-9, 0, 0}, .to = {9, 0, 0}}, RayHits::any).body));
    return all;
  }

  const Report& report() const { return *report_; }
  BodyId id(int i) const { return ids_[static_cast<std::size_t>(i)]; }

  static constexpr int kBodies = 9;
  static std::uint64_t key_of(int i) {
    return i == 4 ? kLargestKey : 1000u + static_cast<std::uint64_t>(i * 7 % 9) * 5;
  }

 private:
  static Mesh mesh(int i) {
    const Vec3 at{0.4 * (i % 3), 0.5 * (i / 3), 0.1 * i};
    return translated(i % 4 == 3 ? wrinkled_sheet(6, 2.0, 0.4, static_cast<std::uint64_t>(i))
                                 : blob(1, 0.6, 0.2, static_cast<std::uint64_t>(i)),
                      at);
  }
  void add(int i) {
    const Mesh body = mesh(i);
    ids_[static_cast<std::size_t>(i)] = world_.add_body({.positions = body.positions,
                                                         .facets = body.facets,
                                                         .surface = i % 4 == 3 ? Surface::sheet : Surface::closed,
                                                         .motion = i == 8 ? Motion::rigid : Motion::deformable,
                                                         .key = key_of(i),
                                                         .margin = 0.02 * (i % 3),
                                                         .self_contact = i % 4 == 3});
    keys_.push_back({id(i), key_of(i)});
  }
  // Also of bodies that were removed.
  std::uint64_t key(BodyId body) const {
    const auto found = std::ranges::find(keys_, body, &std::pair<BodyId, std::uint64_t>::first);
    return found == keys_.end() ? 0 : found->second;
  }

  World world_;
  std::vector<BodyId> ids_;
  std::vector<std::pair<BodyId, std::uint64_t>> keys_;
  const MotionReport* motion_ = nullptr;
  const Report* report_ = nullptr;
};

TEST(BodyKeys, GiveTheSameAnswersInAnyOrderOfBodies) {
  std::vector<int> order(Pile::kBodies);
  std::iota(order.begin(), order.end(), 0);
  Pile expected(order);
  Random random(3);
  std::vector<Pile> others;
  for (int i = 0; i < 3; ++i) {
    for (int k = Pile::kBodies - 1; k > 0; --k)
      std::swap(order[static_cast<std::size_t>(k)], order[static_cast<std::size_t>(random.below(k + 1))]);
    others.emplace_back(order);
  }
  std::size_t contacts = 0, events = 0;
  for (int step = 0; step < 9; ++step) {
    expected.step(step);
    contacts += expected.report().contacts().size();
    events += expected.report().ended().size() + expected.report().patch_events().size();
    for (Pile& other : others) {
      other.step(step);
      ASSERT_EQ(other.answers(), expected.answers()) << "step " << step;
      for (int i = 0; i < Pile::kBodies; ++i) {
        for (int k = 0; k < i; ++k) {
          const Contact* const found = other.report().find_contact(other.id(i), other.id(k));
          const Contact* const same = expected.report().find_contact(expected.id(k), expected.id(i));
          ASSERT_EQ(found == nullptr, same == nullptr);
          if (found != nullptr) {
            EXPECT_EQ(found->hash(), same->hash());
          }
        }
      }
    }
  }
  EXPECT_GT(contacts, 100u);
  EXPECT_GT(events, 20u);
}

TEST(BodyKeys, OrderThePairsOfAWorldThatHadIndicesBefore) {
  World world;
  const BodyId a = add_cube(world, {}), b = add_cube(world, {}, 0.5);
  EXPECT_EQ(world.detect().contacts()[0].a, a);
  const BodyId c = add_cube(world, 0x100000000, 0.7), d = add_cube(world, 12, 0.6);
  const Report& report = world.detect();
  ASSERT_EQ(report.contacts().size(), 6u);
  EXPECT_EQ(report.contacts()[0].source, DirectionSource::smallest);
  EXPECT_EQ(report.contacts()[1].b, d);
  EXPECT_EQ(report.contacts()[2].b, c);
  EXPECT_EQ(report.contacts()[5].a, d);
  EXPECT_TRUE(report.find_contact(c, d) == &report.contacts()[5]);
  world.remove_body(c), world.remove_body(d);
  EXPECT_EQ(world.detect().ended().size(), 5u) << "keys are indices again";
  EXPECT_TRUE(world.detect().find_contact(b, a) != nullptr);
}

TEST(BodyKeys, AloneNameBodiesInTheHashOfAContact) {
  World world, other;
  add_cube(other, 77, 9.0);  // so that indices differ
  for (World* const one : {&world, &other}) add_cube(*one, 5), add_cube(*one, 3, 0.5);
  EXPECT_EQ(world.detect().contacts()[0].hash(), other.detect().contacts()[0].hash());
  World third;
  add_cube(third, 5), add_cube(third, 4, 0.5);
  EXPECT_NE(world.detect().contacts()[0].hash(), third.detect().contacts()[0].hash());
}

}  // namespace
}  // namespace tact::tests
