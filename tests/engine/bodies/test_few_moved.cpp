// A step looks at what moved and keeps the rest: its report must be that of a step that looks at everything.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/hashes/work_hash.h"

namespace tact::tests {
namespace {

// What a report says, bodies by their index.
struct Answer {
  using Pair = std::array<std::uint32_t, 2>;
  std::vector<std::array<std::uint32_t, 3>> candidates;  // with: do the hulls overlap
  std::vector<Pair> contacts, began, ended;
  std::vector<std::vector<FacetPair>> facet_pairs;  // of each contact
  std::vector<std::size_t> patches;
  std::array<std::int64_t, 4> totals{};
  bool operator==(const Answer&) const = default;
};

Answer answer_of(const Report& report) {
  Answer answer;
  for (const CandidatePair& pair : report.candidate_pairs()) {
    answer.candidates.push_back({pair.a.index, pair.b.index, pair.hulls_overlap ? 1u : 0u});
  }
  for (const Contact& contact : report.contacts()) {
    answer.contacts.push_back({contact.a.index, contact.b.index});
    answer.facet_pairs.emplace_back(contact.facet_pairs().begin(), contact.facet_pairs().end());
    answer.patches.push_back(contact.patches().size());
  }
  for (const ContactEvent& event : report.began()) answer.began.push_back({event.a.index, event.b.index});
  for (const ContactEvent& event : report.ended()) answer.ended.push_back({event.a.index, event.b.index});
  const StepStats& stats = report.stats();
  answer.totals = {stats.candidate_pairs, stats.contacts, stats.facet_pairs, stats.touching_contacts};
  return answer;
}

enum class Looks { at_what_moved, at_everything };

constexpr int kBodies = 30, kSteps = 400;

// A crowd of which a few bodies move in each step, by little or by much, and now and then another takes one's place.
// Settings that are set again make a step look at everything.
std::vector<Answer> play(Looks looks, std::uint64_t seed) {
  Random random(seed);
  const auto offset = [&](double reach) {
    const Vec3 v = random.in_cube(reach);
    return Eigen::Vector3d(v.x, v.y, v.z);
  };
  const Settings settings{.threads = 1, .outputs = {.patches = true}};
  World world(settings);
  std::vector<Mesh> meshes;
  std::vector<BodyId> ids;
  const auto new_mesh = [&] {
    Mesh mesh = blob(1, 0.5, 0.2, random.bits());
    mesh.positions.colwise() += offset(1.2);
    return mesh;
  };
  for (int k = 0; k < kBodies; ++k) {
    meshes.push_back(new_mesh());
    ids.push_back(world.add_body({.positions = meshes.back().positions, .facets = meshes.back().facets}));
  }
  std::vector<Answer> answers;
  for (int step = 0; step < kSteps; ++step) {
    for (int moves = random.below(4); moves > 0; --moves) {
      const auto i = static_cast<std::size_t>(random.below(kBodies));
      if (random.chance(0.03)) {
        meshes[i] = new_mesh();
        world.remove_body(ids[i]);
        ids[i] = world.add_body({.positions = meshes[i].positions, .facets = meshes[i].facets});
      } else {
        meshes[i].positions.colwise() += offset(random.chance(0.1) ? 0.5 : 0.01);
        world.set_positions(ids[i], meshes[i].positions);
      }
    }
    if (looks == Looks::at_everything) world.set_settings(settings);
    answers.push_back(answer_of(world.detect()));
  }
  return answers;
}

TEST(FewMoved, TheReportIsThatOfAStepThatLooksAtEverything) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Answer> few = play(Looks::at_what_moved, seed), all = play(Looks::at_everything, seed);
    std::size_t events = 0, quiet = 0;
    for (std::size_t step = 0; step < few.size(); ++step) {
      ASSERT_EQ(few[step], all[step]) << "seed " << seed << ", step " << step;
      events += few[step].began.size() + few[step].ended.size();
      quiet += step > 0 && few[step].candidates == few[step - 1].candidates;
    }
    EXPECT_GT(events, 50u);
    EXPECT_GT(quiet, 100u);  // steps that keep all pairs, and the answer whether they overlap
    EXPECT_LT(quiet, few.size() - 50);
  }
}

// All numbers of a contact.
std::vector<double> numbers_of(const Contact& contact) {
  std::vector<double> numbers(contact.direction.begin(), contact.direction.end());
  for (const ZoneDisk& zone : {contact.zone_a, contact.zone_b}) {
    numbers.insert(numbers.end(), zone.center.begin(), zone.center.end());
    numbers.push_back(zone.radius);
  }
  for (const double number : {contact.depth, contact.plane_a, contact.plane_b, static_cast<double>(contact.iterations),
                              static_cast<double>(contact.source), static_cast<double>(contact.kept_facets_a),
                              static_cast<double>(contact.kept_facets_b)}) {
    numbers.push_back(number);
  }
  for (const FacetPair& pair : contact.facet_pairs()) numbers.insert(numbers.end(), {1.0 * pair.a, 1.0 * pair.b});
  return numbers;
}

// More contacts than one thread reports alone, some of which begin and end in every step: those of pairs at rest stand.
TEST(FewMoved, ContactsOfPairsAtRestStandToTheLastBit) {
  constexpr int kSide = 8;
  const Mesh ball = icosphere(1);
  std::vector<Mesh> meshes;
  for (int k = 0; k < kSide * kSide * kSide; ++k) {
    meshes.push_back(translated(ball, {1.8 * (k % kSide), 1.8 * (k / kSide % kSide), 1.8 * (k / kSide / kSide)}));
  }
  World one({.threads = 1, .outputs = {.zones = true}}), two({.threads = 2, .outputs = {.zones = true}});
  const std::vector<BodyId> ids = add_bodies(one, meshes), ids_of_two = add_bodies(two, meshes);
  Random random(8);
  std::map<std::array<std::uint32_t, 2>, std::vector<double>> last;
  std::size_t stood = 0, changes = 0;
  for (int step = 0; step < 12; ++step) {
    std::set<std::uint32_t> moved;
    for (int k = 0; step > 0 && k < 3; ++k) {
      const auto i = static_cast<std::size_t>(random.below(static_cast<int>(meshes.size())));
      const Vec3 v = random.in_cube(0.6);
      meshes[i].positions.colwise() += Eigen::Vector3d(v.x, v.y, v.z);
      one.set_positions(ids[i], meshes[i].positions);
      two.set_positions(ids_of_two[i], meshes[i].positions);
      moved.insert(ids[i].index);
    }
    const Report& report = one.detect();
    const Report& of_two = two.detect();
    ASSERT_EQ(report.hash(), of_two.hash()) << "step " << step;
    ASSERT_EQ(work_hash(report), work_hash(of_two)) << "step " << step;
    ASSERT_GT(report.contacts().size(), 1100u);
    std::map<std::array<std::uint32_t, 2>, std::vector<double>> now;
    for (const Contact& contact : report.contacts()) now[{contact.a.index, contact.b.index}] = numbers_of(contact);
    for (const auto& [pair, numbers] : last) {
      if (moved.contains(pair[0]) || moved.contains(pair[1])) continue;
      ASSERT_EQ(now[pair], numbers) << "step " << step << ", bodies " << pair[0] << ", " << pair[1];
      ++stood;
    }
    changes += report.began().size() + report.ended().size();
    last = std::move(now);
  }
  EXPECT_GT(stood, 11000u);
  EXPECT_GT(changes, 1100u + 30u);
}

}  // namespace
}  // namespace tact::tests
