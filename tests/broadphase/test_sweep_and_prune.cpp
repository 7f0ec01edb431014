#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <ostream>
#include <set>
#include <vector>

#include "broadphase/sweep_and_prune.h"
#include "tests/support/checks/tunings.h"
#include "tests/support/generators/box_workloads.h"
#include "tests/support/generators/random.h"
#include "tests/support/oracles/box_pairs.h"

namespace tact::broadphase {

void PrintTo(const IndexPair& pair, std::ostream* out) { *out << '(' << pair.a << ',' << pair.b << ')'; }

namespace {

using base::Vec3;
using tests::BoxWorkload;
using tests::Random;

using Pairs = std::vector<IndexPair>;

Pairs copy(std::span<const IndexPair> pairs) { return {pairs.begin(), pairs.end()}; }

std::vector<std::uint32_t> all_indices(std::size_t count) {
  std::vector<std::uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

// The pairs of boxes that have never been seen before, with default filters.
Pairs fresh_pairs(const std::vector<Box>& boxes) {
  SweepAndPrune sweep;
  return copy(sweep.update(boxes, std::vector<Filter>(boxes.size()), all_indices(boxes.size()), 1));
}

Pairs expected_pairs(const std::vector<Box>& boxes) {
  return tests::all_overlapping_pairs(boxes, std::vector<Filter>(boxes.size()));
}

Box cube(Vec3 lower, double edge) { return {lower, lower + Vec3{edge, edge, edge}}; }

TEST(SweepAndPrune, NoBoxesHaveNoPairs) {
  SweepAndPrune sweep;
  EXPECT_TRUE(sweep.pairs().empty());
  EXPECT_TRUE(sweep.update({}, {}, {}, 1).empty());
  EXPECT_TRUE(fresh_pairs({cube({0, 0, 0}, 1)}).empty());
}

TEST(SweepAndPrune, FaceEdgeAndCornerContactCounts) {
  for (const Vec3 offset :
       {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{-1, 1, -1}}) {
    EXPECT_EQ(fresh_pairs({cube({0, 0, 0}, 1), cube(offset, 1)}), (Pairs{{0, 1}}));
    EXPECT_TRUE(fresh_pairs({cube({0, 0, 0}, 1), cube(std::nextafter(1.0, 2.0) * offset, 1)}).empty());
  }
}

// A float cannot tell these apart; a double can.
TEST(SweepAndPrune, GapsAndContactsOfOneUnitInTheLastPlaceAreTold) {
  for (const double x : {1.0, 1.0 / 3.0, 1e6 / 7.0, 1e15 / 3.0, 1e-300}) {
    const Box left{{-x, 0, 0}, {x, 1, 1}};
    const Box filler{{-4 * x, 5, 5}, {5 * x, 6, 6}};
    EXPECT_EQ(fresh_pairs({left, {{x, 0, 0}, {3 * x, 1, 1}}, filler}), (Pairs{{0, 1}})) << x;
    EXPECT_TRUE(fresh_pairs({left, {{std::nextafter(x, 1e16), 0, 0}, {3 * x, 1, 1}}, filler}).empty()) << x;
    EXPECT_EQ(fresh_pairs({left, {{std::nextafter(x, 0), 0, 0}, {3 * x, 1, 1}}, filler}), (Pairs{{0, 1}})) << x;
  }
}

TEST(SweepAndPrune, EmptyBoxesOverlapNothing) {
  const Box halfway{{1, 0, 0}, {0, 1, 1}};  // lower > upper on one axis alone
  EXPECT_EQ(fresh_pairs({Box{}, cube({0, 0, 0}, 1), Box{}, cube({0.5, 0, 0}, 1), halfway, Box{}}), (Pairs{{1, 3}}));
}

TEST(SweepAndPrune, EqualBoxesAllOverlap) {
  for (const double edge : {0.0, 1.0 / 3.0}) {
    const std::vector<Box> boxes(100, cube({0.1, -7.3, 1e5 / 3}, edge));
    EXPECT_EQ(fresh_pairs(boxes), expected_pairs(boxes));
  }
}

TEST(SweepAndPrune, ExtremeCoordinates) {
  const double huge = 0x1p300;
  const double tiny = 0x1p-1074;
  std::vector<Box> boxes{
      {{-huge, -huge, -huge}, {huge, huge, huge}},
      {{huge, huge, huge}, {huge, huge, huge}},
      {{-huge, 0, 0}, {-huge / 2, tiny, tiny}},
      {{-tiny, -tiny, -tiny}, {tiny, tiny, tiny}},
      {{2 * tiny, 0, 0}, {3 * tiny, 0, 0}},
      {{tiny, tiny, tiny}, {2 * tiny, 2 * tiny, 2 * tiny}},
      {{0, 0, 0}, {0, 0, 0}},
      {{-0.0, -0.0, -0.0}, {-0.0, -0.0, -0.0}},
      {{huge / 2, 0, 0}, {huge, 1, 1}},
      {{1, 1, 1}, {2, 2, 2}},
  };
  EXPECT_EQ(fresh_pairs(boxes), expected_pairs(boxes));
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const double scale = std::ldexp(1.0, random.below(1374) - 1074);
    boxes.push_back(cube(scale * random.in_cube(1.0), scale * random.uniform()));
  }
  EXPECT_EQ(fresh_pairs(boxes), expected_pairs(boxes));
}

TEST(SweepAndPrune, FarFromTheOrigin) {
  for (const double offset : {1e6, 1e9, -1e12}) {
    Random random(6);
    std::vector<Box> boxes;
    for (int i = 0; i < 500; ++i) boxes.push_back(cube(random.in_cube(5.0) + Vec3{offset, -offset, 0.5 * offset}, 1.0));
    for (int i = 0; i < 500; ++i) boxes.push_back(cube(random.in_cube(5.0), 1.0));
    EXPECT_EQ(fresh_pairs(boxes), expected_pairs(boxes)) << offset;
  }
}

TEST(SweepAndPrune, FiltersDecide) {
  const std::vector<Box> boxes(6, cube({0, 0, 0}, 1));
  const std::vector<Filter> filters{{.layer = 1, .mask = 2},
                                    {.layer = 2, .mask = 1},
                                    {.layer = 2, .mask = 2},
                                    {.layer = 3, .mask = 3, .fixed = true},
                                    {.layer = 3, .mask = 3, .fixed = true},
                                    {.layer = 4, .mask = 0}};
  SweepAndPrune sweep;
  EXPECT_EQ(copy(sweep.update(boxes, filters, all_indices(6), 1)),
            (Pairs{{0, 1}, {0, 3}, {0, 4}, {1, 3}, {1, 4}, {2, 3}, {2, 4}}));
}

// Every workload, at sizes around those of a block and of a block of blocks, on several numbers of threads.
TEST(SweepAndPrune, EveryWorkloadEqualsBruteForceOverSteps) {
  for (const tests::BoxWorkloadKind kind : tests::all_box_workloads()) {
    for (const std::size_t count : {1, 2, 15, 17, 256, 257, 1000}) {
      BoxWorkload workload(kind, count, 100 + count);
      SweepAndPrune one;
      SweepAndPrune two;
      for (int step = 0; step < 12; ++step) {
        if (step > 0) workload.step();
        const Pairs expected = tests::all_overlapping_pairs(workload.boxes(), workload.filters());
        const auto where = [&] {
          return name_of(kind) + ", " + std::to_string(count) + " boxes, step " + std::to_string(step);
        };
        ASSERT_EQ(copy(one.update(workload.boxes(), workload.filters(), workload.changed(), 1)), expected) << where();
        ASSERT_EQ(copy(two.update(workload.boxes(), workload.filters(), workload.changed(), 2)), expected) << where();
        ASSERT_TRUE(one.validate(workload.boxes())) << where();
      }
    }
  }
}

TEST(SweepAndPrune, ThreadsDoNotMatter) {
  for (const tests::BoxWorkloadKind kind : tests::all_box_workloads()) {
    BoxWorkload workload(kind, 10000, 3);
    SweepAndPrune one;
    SweepAndPrune two;
    SweepAndPrune eight;
    for (int step = 0; step < 3; ++step) {
      if (step > 0) workload.step();
      const Pairs pairs = copy(one.update(workload.boxes(), workload.filters(), workload.changed(), 1));
      ASSERT_EQ(copy(two.update(workload.boxes(), workload.filters(), workload.changed(), 2)), pairs) << name_of(kind);
      ASSERT_EQ(copy(eight.update(workload.boxes(), workload.filters(), workload.changed(), 8)), pairs)
          << name_of(kind);
    }
  }
}

// What a world may do between two calls, at random.
class RandomHistory {
 public:
  // `most` boxes, in a cube where most of them overlap a few others.
  RandomHistory(std::uint64_t seed, int most)
      : random_(seed), most_(most), edge_(most < 100 ? 1.5 : 4.0), size_(random_.chance(0.5) ? 1.0 : 0.25) {}

  void step() {
    changed_.clear();
    const double busy = random_.uniform() * random_.uniform();
    if (random_.chance(0.3)) resize(static_cast<std::size_t>(random_.below(most_)));
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (random_.chance(busy)) change(i);
    }
    if (random_.chance(0.2) && !boxes.empty())
      changed_.push_back(static_cast<std::uint32_t>(random_.below(static_cast<int>(boxes.size()))));
    if (random_.chance(0.2) && !changed_.empty()) changed_.push_back(changed_.front());  // listed twice
  }

  const std::vector<std::uint32_t>& changed() const { return changed_; }
  std::vector<Box> boxes;
  std::vector<Filter> filters;

 private:
  void resize(std::size_t count) {
    const auto old_count = static_cast<std::uint32_t>(boxes.size());
    boxes.resize(count);
    filters.resize(count);
    for (std::uint32_t i = old_count; i < count; ++i) {
      boxes[i] = random_box();
      changed_.push_back(i);
    }
  }

  void change(std::uint32_t i) {
    changed_.push_back(i);
    switch (random_.below(5)) {
      case 0: boxes[i] = Box{}; break;
      case 1: boxes[i] = random_box(); break;
      case 2: filters[i] = {1u << random_.below(3), random_.chance(0.5) ? 0xffffffffu : 5u, random_.chance(0.2)}; break;
      default:
        if (boxes[i].empty()) break;
        const Vec3 motion = random_.in_cube(0.05);
        boxes[i] = {boxes[i].lower + motion, boxes[i].upper + motion};
    }
  }

  // Now and then on a lattice, so that faces touch.
  Box random_box() {
    const Vec3 place = random_.in_cube(edge_);
    if (random_.chance(0.3)) return cube({std::round(place.x), std::round(place.y), std::round(place.z)}, 1.0);
    return cube(place, size_ * (random_.chance(0.02) ? 8.0 : 1.0) * random_.uniform());
  }

  Random random_;
  int most_;
  double edge_, size_;
  std::vector<std::uint32_t> changed_;
};

// Of overlapping pairs with a changed box, those that filters keep out.
std::size_t excluded_pairs(const RandomHistory& history) {
  const std::vector<Filter> none(history.boxes.size());
  const std::set<std::uint32_t> changed(history.changed().begin(), history.changed().end());
  const Pairs all = tests::all_overlapping_pairs(history.boxes, none);
  return static_cast<std::size_t>(std::ranges::count_if(all, [&](IndexPair pair) {
    return (changed.contains(pair.a) || changed.contains(pair.b)) &&
           !tested(history.filters[pair.a], history.filters[pair.b]);
  }));
}

TEST(SweepAndPrune, RandomHistoriesEqualBruteForce) {
  for (std::uint64_t seed = 1; seed <= 90; ++seed) {
    RandomHistory history(seed, seed % 3 == 0 ? 33 : 400);
    SweepAndPrune sweep;
    for (int step = 0; step < 40; ++step) {
      history.step();
      const int threads = seed % 4 == 0 ? 2 : 1;
      const Pairs pairs = copy(sweep.update(history.boxes, history.filters, history.changed(), threads));
      ASSERT_EQ(pairs, tests::all_overlapping_pairs(history.boxes, history.filters))
          << "seed " << seed << ", step " << step;
      ASSERT_EQ(copy(sweep.pairs()), pairs);
      ASSERT_EQ(sweep.excluded(), excluded_pairs(history)) << "seed " << seed << ", step " << step;
      ASSERT_TRUE(sweep.validate(history.boxes)) << "seed " << seed << ", step " << step;
    }
  }
}

TEST(SweepAndPrune, RandomHistoriesEqualBruteForceByEveryWay) {
  for (const tests::NamedTuning& way : tests::kTunings) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      RandomHistory history(seed, seed % 3 == 0 ? 12 : 100);
      SweepAndPrune sweep;
      for (int step = 0; step < 20; ++step) {
        history.step();
        ASSERT_EQ(copy(sweep.update(history.boxes, history.filters, history.changed(), 1, way.tuning)),
                  tests::all_overlapping_pairs(history.boxes, history.filters))
            << way.name << ", seed " << seed << ", step " << step;
        ASSERT_TRUE(sweep.validate(history.boxes)) << way.name << ", seed " << seed << ", step " << step;
      }
    }
  }
}

TEST(SweepAndPrune, ManyBoxesEqualThoseFoundAfresh) {
  for (const tests::BoxWorkloadKind kind : tests::all_box_workloads()) {
    BoxWorkload workload(kind, 10000, 8);
    SweepAndPrune carried;
    for (int step = 0; step < 60; ++step) {
      if (step > 0) workload.step();
      carried.update(workload.boxes(), workload.filters(), workload.changed(), 1);
      if (step % 20 != 19) continue;
      SweepAndPrune fresh;
      const auto expected = fresh.update(workload.boxes(), workload.filters(), all_indices(10000), 1);
      ASSERT_TRUE(std::ranges::equal(carried.pairs(), expected)) << name_of(kind) << ", step " << step;
    }
  }
}

// Known from other libraries: an update with nothing moved reorders the pairs, or costs as much as any other. Here it
// does not even see that boxes, against what was said, are elsewhere.
TEST(SweepAndPrune, NothingChangedLooksAtNoBox) {
  BoxWorkload workload(tests::BoxWorkloadKind::small_motion, 10000, 4);
  SweepAndPrune sweep;
  const auto pairs = sweep.update(workload.boxes(), workload.filters(), workload.changed(), 1);
  const Pairs before = copy(pairs);
  const std::vector<Box> elsewhere(workload.boxes().size(), cube({0, 0, 0}, 1));
  EXPECT_EQ(sweep.update(elsewhere, workload.filters(), {}, 2).data(), pairs.data());
  EXPECT_EQ(copy(sweep.pairs()), before);
  EXPECT_FALSE(sweep.pairs_changed());
}

TEST(SweepAndPrune, TellsWhetherPairsChanged) {
  const std::vector<Filter> filters(3);
  std::vector<Box> boxes{cube({0, 0, 0}, 1), cube({0.5, 0, 0}, 1), cube({9, 0, 0}, 1)};
  SweepAndPrune sweep;
  const auto changes = [&](std::span<const std::uint32_t> changed) {
    sweep.update(boxes, filters, changed, 1);
    return sweep.pairs_changed();
  };
  const std::vector<std::uint32_t> all = all_indices(3), last{2};
  EXPECT_TRUE(changes(all));
  for (Box& box : boxes) box.upper.y += 0.1;
  EXPECT_FALSE(changes(all));
  boxes[2] = cube({8, 0, 0}, 1);
  EXPECT_FALSE(changes(last));
  boxes[2] = cube({1, 0, 0}, 1);
  EXPECT_TRUE(changes(last));
  EXPECT_FALSE(changes(all));
  boxes[0] = cube({-9, 0, 0}, 1);
  EXPECT_TRUE(changes(all));
}

TEST(SweepAndPrune, BoxesPastTheEndLeave) {
  const std::vector<Box> boxes(5, cube({0, 0, 0}, 1));
  const std::vector<Filter> filters(5, Filter{.layer = 2, .mask = 2});
  SweepAndPrune sweep;
  sweep.update(boxes, filters, all_indices(5), 1);
  EXPECT_EQ(copy(sweep.update(std::span(boxes).first(3), std::span(filters).first(3), {}, 1)),
            (Pairs{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_TRUE(sweep.validate(std::span(boxes).first(3)));
  EXPECT_TRUE(sweep.update({}, {}, {}, 1).empty());
  EXPECT_EQ(sweep.update(boxes, filters, all_indices(5), 1).size(), 10u);
}

}  // namespace
}  // namespace tact::broadphase
