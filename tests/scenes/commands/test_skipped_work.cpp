// The ledger: numbers of things skipped, and estimates from what the others took.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "scenes/commands/skipped_work.h"

namespace tact::scenes {
namespace {

const SkippedWork* find(const std::vector<SkippedWork>& lines, const std::string& what) {
  const auto line = std::ranges::find(lines, what, &SkippedWork::what);
  return line == lines.end() ? nullptr : &*line;
}

void expect_line(const std::vector<SkippedWork>& lines, const std::string& what, std::int64_t count, double ms) {
  const SkippedWork* line = find(lines, what);
  ASSERT_NE(line, nullptr) << what;
  EXPECT_EQ(line->count, count) << what;
  ASSERT_TRUE(line->ms()) << what;
  EXPECT_DOUBLE_EQ(*line->ms(), ms) << what;
  EXPECT_FALSE(line->measured_on.empty()) << what;
}

// Twenty candidate pairs: four kept, ten separated by 18-DOPs, one still separated, two still overlapping, three that
// needed GJK.
StepStats full_step() {
  StepStats s;
  s.vertices = 1000, s.moved_vertices = 200, s.refresh_ms = 0.4;
  s.excluded_pairs = 5, s.candidate_pairs = 20, s.kept_pairs = 4, s.kdop_separated_pairs = 10;
  s.still_separated_pairs = 1, s.still_overlapping_pairs = 2, s.contacts = 5, s.touching_contacts = 3;
  s.gjk_ms = 0.9, s.hulls_ms = 1.0, s.kdop_ms = 0.1, s.direction_ms = 2.0, s.cull_ms = 1.0, s.confirm_ms = 8.0;
  s.clusters = 100, s.clusters_outside_box = 20, s.clusters_outside_slab = 30, s.opened_clusters = 40;
  s.facets = 6400, s.opened_facets = 2560, s.kept_facets = 1600;
  s.facets_facing_away = 100, s.facets_outside_slab = 500, s.facets_outside_box = 300, s.facets_outside_zone = 60;
  s.tree_pairs = 1;
  return s;
}

TEST(SkippedWork, IsTheNumberTimesTheMeanOfWhatWasDone) {
  const auto lines = skipped_work(full_step(), {.accuracy = Accuracy::paper});
  expect_line(lines, "vertices", 800, 800 * (0.4 / 200));
  expect_line(lines, "pairs excluded", 5, 5 * (12.0 / 16));
  expect_line(lines, "pairs kept", 4, 4 * (12.0 / 16));
  expect_line(lines, "pairs separated", 10, 10 * (0.9 / 6));
  expect_line(lines, "GJK, apart", 1, 0.9 / 3);
  expect_line(lines, "GJK, overlapping", 2, 2 * (0.9 / 3));
  expect_line(lines, "clusters, box", 20, 20 * (8.0 / 40));
  expect_line(lines, "clusters, criterion 2", 30, 30 * (8.0 / 40));
  expect_line(lines, "clusters, far", 10, 10 * (8.0 / 40));
  expect_line(lines, "facets, criterion 1", 100, 100 * (8.0 / 1600));
  expect_line(lines, "facets, criterion 2", 500, 500 * (8.0 / 1600));
  expect_line(lines, "facets, box", 300, 300 * (8.0 / 1600));
  expect_line(lines, "facets, criterion 3", 60, 60 * (8.0 / 1600));
}

TEST(SkippedWork, HasNoFigureWhereNothingWasMeasured) {
  const auto lines = skipped_work(full_step(), {});
  for (const auto& [what, count] : {std::pair{"Embree", 4}, {"zones", 5}, {"patches", 3}}) {
    const SkippedWork* line = find(lines, what);
    ASSERT_NE(line, nullptr) << what;
    EXPECT_EQ(line->count, count);
    EXPECT_FALSE(line->ms());
  }
  StepStats at_rest;
  at_rest.vertices = 50;
  at_rest.candidate_pairs = at_rest.kept_pairs = 7;
  for (const SkippedWork& line : skipped_work(at_rest, {})) EXPECT_FALSE(line.ms()) << line.what;
  EXPECT_EQ(skipped_work(at_rest, {}).size(), 2u);
}

TEST(SkippedWork, OutputsThatWereAskedForAreNoneOfIt) {
  const auto lines = skipped_work(full_step(), {.outputs = {.zones = true, .patches = true}});
  EXPECT_EQ(find(lines, "zones"), nullptr);
  EXPECT_EQ(find(lines, "patches"), nullptr);
  EXPECT_NE(find(skipped_work(full_step(), {.accuracy = Accuracy::hulls}), "stages 5 and 6"), nullptr);
}

TEST(SkippedWork, IsPrintedAStepWithItsReasonAndItsBasis) {
  StepStats sums;
  sums.vertices = 3000, sums.moved_vertices = 1000, sums.refresh_ms = 0.01;
  std::ostringstream out;
  print_skipped_work(out, sums, 10, {});
  EXPECT_NE(out.str().find("an estimate"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("200.0   0.002 ms  their bodies are fixed or did not move (refresh of a vertex: 10 ns)"),
            std::string::npos)
      << out.str();
}

}  // namespace
}  // namespace tact::scenes
