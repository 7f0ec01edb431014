// Counts of what a step did not have to do.
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <array>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/checks/detection.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/generators/folds.h"

namespace tact::tests {
namespace {

// The names of the fields of StepStats, as its header has them.
std::vector<std::string> declared_fields() {
  std::ifstream header(TACT_SOURCE_DIR "/engine/include/tact/statistics.h");
  const std::regex field(R"(^  (?:std::int64_t|double) (\w+) = 0(?:\.0)?;.*$)");
  std::vector<std::string> names;
  std::string line;
  while (std::getline(header, line) && line != "};") {
    std::smatch match;
    if (std::regex_match(line, match, field)) names.push_back(match[1]);
  }
  return names;
}

TEST(Statistics, TablesHoldEveryFieldInOrderWithItsSentence) {
  std::vector<std::string> listed;
  StepStats stats;
  double next = 1.0;
  for (const auto& field : kStepCounts) {
    listed.emplace_back(field.name);
    EXPECT_FALSE(std::string(field.text).empty()) << field.name;
    stats.*field.value = static_cast<std::int64_t>(next++);
  }
  for (const auto& field : kStepTimes) {
    listed.emplace_back(field.name);
    EXPECT_FALSE(std::string(field.text).empty()) << field.name;
    stats.*field.value = next++;
  }
  EXPECT_EQ(listed, declared_fields());
  EXPECT_EQ(sizeof(StepStats), 8 * listed.size());
  double expected = 1.0;  // no member is listed twice
  for_each_count(stats, [&](const char* name, const char*, std::int64_t value) {
    EXPECT_EQ(static_cast<double>(value), expected++) << name;
  });
  for_each_time(stats, [&](const char* name, const char*, double value) { EXPECT_EQ(value, expected++) << name; });
}

const Mesh kSphere = icosphere(2);  // 162 vertices

TEST(Statistics, VerticesOfTheBodiesThatMoved) {
  World world;
  const auto ids = add_bodies(world, std::array{kSphere, translated(kSphere, {1.5, 0, 0}), icosphere(1)});
  const auto counts = [&] {
    const StepStats& stats = world.detect().stats();
    return std::array{stats.vertices, stats.moved_vertices};
  };
  using Counts = std::array<std::int64_t, 2>;
  EXPECT_EQ(counts(), (Counts{366, 366}));
  EXPECT_EQ(counts(), (Counts{366, 0}));
  world.set_positions(ids[0], translated(kSphere, {0.1, 0, 0}).positions);
  world.set_positions(ids[0], translated(kSphere, {0.2, 0, 0}).positions);
  world.set_positions(ids[1], translated(kSphere, {1.5, 0, 0}).positions);  // as it is
  EXPECT_EQ(counts(), (Counts{366, 162}));
  world.set_positions(ids[0], kSphere.positions);
  world.remove_body(ids[0]);
  EXPECT_EQ(counts(), (Counts{204, 0}));
  world.remove_body(ids[1]);
  const BodyId last = add_bodies(world, std::array{kSphere})[0];
  EXPECT_EQ(counts(), (Counts{204, 162}));
  world.set_layers(last, 2, 2);
  world.set_positions(last, translated(kSphere, {0.1, 0, 0}).positions);
  EXPECT_EQ(counts(), (Counts{204, 162}));
  world.set_motion(last, Motion::fixed);
  world.set_motion(last, Motion::fixed);  // as it is
  world.remove_body(last);
  EXPECT_EQ(counts(), (Counts{42, 0}));
}

TEST(Statistics, PairsThatLayersOrFixedBodiesExclude) {
  World world;
  const auto add = [&](double x, Motion motion, std::uint32_t layer, std::uint32_t mask) {
    const Mesh mesh = translated(kSphere, {x, 0, 0});
    return world.add_body(
        {.positions = mesh.positions, .facets = mesh.facets, .motion = motion, .layer = layer, .mask = mask});
  };
  add(0.0, Motion::fixed, 1, 1);
  add(0.1, Motion::fixed, 1, 1);
  const BodyId other_layer = add(0.2, Motion::deformable, 2, 2);
  EXPECT_EQ(world.detect().stats().excluded_pairs, 3);
  world.set_positions(other_layer, translated(kSphere, {0.3, 0, 0}).positions);
  EXPECT_EQ(world.detect().stats().excluded_pairs, 2);
  EXPECT_EQ(world.detect().stats().excluded_pairs, 0);
  EXPECT_EQ(world.detect().stats().candidate_pairs, 0);
}

TEST(Statistics, PairsThatNeedNoGjk) {
  World world;
  const auto ids = add_bodies(world, std::array{kSphere, translated(kSphere, {1.5, 0.13, 0.27})});
  EXPECT_EQ(world.detect().stats().still_overlapping_pairs, 0);
  world.set_positions(ids[1], translated(kSphere, {1.499, 0.13, 0.27}).positions);
  const StepStats& stats = world.detect().stats();
  EXPECT_EQ(stats.still_overlapping_pairs, 1);
  EXPECT_EQ(stats.gjk_ms, 0.0);
  EXPECT_GT(stats.hulls_ms, 0.0);
}

// Every cluster and facet of the bodies in contact is accounted for, whatever the number of threads.
TEST(Statistics, ClustersAndFacetsAddUp) {
  std::vector<Mesh> bodies = crowd_of_blobs(30, 1);
  bodies.push_back(icosphere(6));
  bodies.push_back(translated(scaled(icosphere(6), 0.98), {0.03, 0.01, 0.0}));  // a large pair
  std::vector<StepStats> found;
  for (const int threads : {1, 2}) {
    World world({.threads = threads});
    add_bodies(world, bodies);
    const StepStats& s = found.emplace_back(world.detect().stats());
    EXPECT_GT(s.clusters_outside_box, 0);
    EXPECT_GT(s.clusters_outside_slab, 0);
    EXPECT_GT(s.opened_clusters, 0);
    EXPECT_LE(s.clusters_outside_box + s.clusters_outside_slab + s.opened_clusters, s.clusters);
    EXPECT_LE(s.opened_facets, s.facets);
    EXPECT_LE(s.kept_facets, s.opened_facets);
    EXPECT_LE(s.opened_facets, 64 * s.opened_clusters);
    EXPECT_GT(s.facets_outside_slab, 0);
    EXPECT_GT(s.facets_outside_box, 0);
    EXPECT_EQ(s.facets_outside_slab + s.facets_outside_box + s.kept_facets, s.opened_facets);
  }
  EXPECT_EQ(found[0].facets_outside_slab, found[1].facets_outside_slab);
  EXPECT_EQ(found[0].clusters_outside_box, found[1].clusters_outside_box);
  EXPECT_EQ(found[0].clusters_outside_slab, found[1].clusters_outside_slab);
  EXPECT_EQ(found[0].opened_clusters, found[1].opened_clusters);
  EXPECT_EQ(found[0].opened_facets, found[1].opened_facets);
}

// Every stage has work here; the stages that all threads do together add up to the step.
TEST(Statistics, TimesOfTheStagesAddUpToTheStep) {
  for (const int threads : {1, 2}) {
    World world({.threads = threads, .outputs = {.patches = true, .points = true}});
    const Mesh cloth = jittered(rolled_sheet(30, 10, 2.2, 0.12, 0.05), 0.03, 1), small = scaled(kSphere, 0.1);
    for (const Mesh& mesh : {kSphere, translated(kSphere, {1.5, 0.0, 0.0}), small})
      world.add_body({.positions = mesh.positions, .facets = mesh.facets, .margin = 0.01});
    world.add_body({.positions = cloth.positions,
                    .facets = cloth.facets,
                    .surface = Surface::sheet,
                    .margin = 0.01,
                    .self_contact = true});
    world.set_positions(world.bodies()[0], translated(kSphere, {0.01, 0.0, 0.0}).positions);
    const StepStats& s = world.detect().stats();
    for (const double ms : {s.refresh_ms, s.sweep_ms, s.narrow_phase_ms, s.containment_ms, s.points_ms,
                            s.self_facets_ms, s.self_points_ms, s.patches_ms, s.report_ms})
      EXPECT_GT(ms, 0.0);
    EXPECT_NEAR(s.refresh_ms + s.sweep_ms + s.narrow_phase_ms + s.containment_ms + s.points_ms + s.self_facets_ms +
                    s.self_points_ms + s.patches_ms + s.report_ms,
                s.total_ms, 1e-9);
  }
}

}  // namespace
}  // namespace tact::tests
