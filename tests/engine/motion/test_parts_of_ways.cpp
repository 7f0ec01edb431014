// World::detect_motion() on a part of a way that an earlier call has looked at, as line searches ask for.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "tests/engine/motion/couples.h"
#include "tests/support/hashes/answer_hash.h"

namespace tact::tests {
namespace {

// A couple in a world that has seen where it begins.
struct CoupleOnItsWay {
  tact::World world;
  BodyId a, b;

  CoupleOnItsWay(const Couple& couple, double margin, int threads) : world({.threads = threads}) {
    a = world.add_body({.positions = couple.a.begin.positions, .facets = couple.a.begin.facets, .margin = margin});
    b = world.add_body({.positions = couple.b.begin.positions, .facets = couple.b.begin.facets, .margin = margin});
    world.detect();
  }
  void go(const Couple& couple, double part_a, double part_b) {
    // As two solvers write it.
    world.set_positions(a, couple.a.begin.positions + part_a * (couple.a.end - couple.a.begin.positions));
    world.set_positions(b, (1.0 - part_b) * couple.b.begin.positions + part_b * couple.b.end);
  }
};

AnswerHashes answer_of(tact::World& world, const MotionOptions& options) {
  AnswerHash answer;
  answer.add(world.detect_motion(options));
  return answer.hashes();
}

// What a call knows of an earlier one on a longer way changes no answer: two bodies that go the same part, or each its
// own, which is another way; and farther again.
TEST(DetectMotion, OnAPartOfAWayIsAsWithoutTheWholeOne) {
  const std::vector<Couple> every = couples();
  std::vector<Couple> all{every[2], every[5], every[10], every[1]};
  all.back().name = "balls that graze, far away";
  for (MovingMesh* const mesh : {&all.back().a, &all.back().b}) {
    mesh->begin.positions.array() += 3e5;
    mesh->end.array() += 3e5;
  }
  std::int64_t candidates = 0, without = 0;
  for (const Couple& couple : all) {
    for (const Impacts wanted : {Impacts::all, Impacts::first, Impacts::first_of_pair}) {
      const double margin = wanted == Impacts::first ? 0.02 : 0.0;
      CoupleOnItsWay known(couple, margin, 2), scratch(couple, margin, 1);
      known.go(couple, 1.0, 1.0);
      const double first = std::min(known.world.detect_motion(wanted).first_time(), 1.0);
      for (const auto [part, of_b] : {std::array{0.9, 0.9}, {0.6, 0.5}, {0.999 * first, 0.999 * first}, {0.3, 0.3}}) {
        if (!(part > 0.0)) continue;
        const MotionOptions options{.wanted = part == 0.3 ? Impacts::all : wanted, .bounds = part == 0.3};
        for (CoupleOnItsWay* const two : {&known, &scratch}) two->go(couple, part, of_b);
        scratch.world.set_margin(scratch.a, margin);  // it knows nothing of its way
        EXPECT_EQ(answer_of(known.world, options), answer_of(scratch.world, options))
            << couple.name << ", " << part << " and " << of_b << " of the way";
        if (&couple != &all.front() || wanted != Impacts::all || part != 0.9) continue;
        candidates += known.world.detect_motion(options).stats().candidates;
        scratch.world.set_margin(scratch.a, margin);
        without += scratch.world.detect_motion(options).stats().candidates;
      }
    }
  }
  EXPECT_LT(2 * candidates, without);
}

// Two sheets that lie on each other and part, slide, or go through each other, vertex by vertex: what begins to cross,
// and what touches and does not, is told again on each part of the way.
TEST(DetectMotion, OnAPartOfAWayWhatTouchesAtTheStartIsAsFromScratch) {
  Random random(54);
  std::int64_t stops = 0, all = 0;
  for (int k = 0; k < 8; ++k) {
    const Mesh flat = sheet(4, 4, 2.0, 2.0), under = translated(sheet(3, 3, 2.0, 2.0), {0.1, 0.15, 0});
    Couple couple{"sheets on each other", {flat, flat.positions}, {under, under.positions}};
    for (Eigen::Index v = 0; v < flat.positions.cols(); ++v) {
      const double up = random.uniform(k % 3 == 0 ? 0.0 : -0.05, 0.2);
      couple.a.end.col(v) += Eigen::Vector3d(k % 2 == 0 ? 0.25 : 0.0, 0.0, k % 4 == 3 && up < 0.1 ? 0.0 : up);
    }
    CoupleOnItsWay known(couple, 0.0, 1), scratch(couple, 0.0, 1);
    known.go(couple, 1.0, 1.0);
    known.world.detect_motion();
    for (const double part : {0.5, 0.25, 0.3}) {
      for (CoupleOnItsWay* const two : {&known, &scratch}) two->go(couple, part, part);
      scratch.world.set_margin(scratch.a, 0.0);
      EXPECT_EQ(answer_of(known.world, {}), answer_of(scratch.world, {})) << k << ", " << part << " of the way";
      const MotionReport& report = known.world.detect_motion();
      stops += std::ranges::count_if(report.impacts(), &Impact::stops);
      all += std::ssize(report.impacts());
    }
  }
  EXPECT_GT(stops, 100);
  EXPECT_GT(all - stops, 100);
}

// What changes besides positions is seen by the next call on the same way.
TEST(DetectMotion, OnAPartOfAWayGoesByTheSettingsOfNow) {
  const Couple couple = couples()[2];
  using Change = std::function<void(CoupleOnItsWay&)>;
  const std::vector<Change> changes{
      [](CoupleOnItsWay& two) { two.world.set_margin(two.a, 0.1); },
      [](CoupleOnItsWay& two) { two.world.set_rest_offset(two.b, 0.01); },
      [](CoupleOnItsWay& two) { two.world.set_layers(two.a, 2, 2); },
      [](CoupleOnItsWay& two) { two.world.set_excluded(two.a, two.b, true); },
      [](CoupleOnItsWay& two) { two.world.set_self_contact(two.a, true); },
      [](CoupleOnItsWay& two) { two.world.set_motion(two.b, Motion::fixed); },
      [&](CoupleOnItsWay& two) {
        std::vector<int> map(static_cast<std::size_t>(couple.a.end.cols()));
        std::iota(map.begin(), map.end(), 0);
        two.world.set_facets(two.a, couple.a.end, couple.a.begin.facets.leftCols(100), map);
      },
      [](CoupleOnItsWay& two) { two.world.detect(); },
      [](CoupleOnItsWay& two) { two.world.restore(two.world.save()); },
  };
  for (const Change& change : changes) {
    CoupleOnItsWay known(couple, 0.02, 1), scratch(couple, 0.02, 1);
    for (CoupleOnItsWay* const two : {&known, &scratch}) {
      two->go(couple, 1.0, 1.0);
      if (two == &known) two->world.detect_motion();
      change(*two);
      if (two->world.motion(two->b) != Motion::fixed) two->go(couple, 0.7, 0.7);
    }
    EXPECT_EQ(answer_of(known.world, {}), answer_of(scratch.world, {})) << "change " << &change - changes.data();
  }
}

// A body that no step has seen has no way, wherever it is put: what was found of it at one place tells nothing of
// another.
TEST(DetectMotion, OnAPartOfAWayBodiesThatNoStepHasSeenMayBeAnywhere) {
  constexpr double kBeside =
      2.09;  // metres along x and y: the wall's corner is in the box of the ball's way, and not met
  for (const Motion motion : {Motion::deformable, Motion::rigid}) {
    BallAndWall scene;
    scene.world.remove_body(scene.standing);
    scene.world.detect();
    const BodyId late = scene.world.add_body(
        {.positions = scene.wall.positions, .facets = scene.wall.facets, .surface = Surface::sheet, .motion = motion});
    const auto put_late = [&](double beside) {
      if (motion == Motion::rigid) {
        scene.world.set_pose(late, Eigen::Matrix3d::Identity(), {beside, beside, 0.0});
      } else {
        scene.world.set_positions(late, translated(scene.wall, {beside, beside, 0.0}).positions);
      }
    };
    put_late(kBeside);
    scene.put(-1.0);
    EXPECT_TRUE(scene.world.detect_motion().impacts().empty());
    put_late(0.0);
    EXPECT_FALSE(scene.world.detect_motion().impacts().empty()) << static_cast<int>(motion);
  }
}

}  // namespace
}  // namespace tact::tests
