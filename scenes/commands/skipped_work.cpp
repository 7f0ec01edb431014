#include "scenes/commands/skipped_work.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

namespace tact::scenes {
namespace {

// A mean over the run.
struct Mean {
  double ms = 0.0;
  std::int64_t count = 0;
  const char* of = "";
};

constexpr Mean kNotMeasured;

class Ledger {
 public:
  void add(const char* what, std::int64_t count, const char* why, const Mean& mean) {
    if (count <= 0) return;
    SkippedWork& line = lines.emplace_back(SkippedWork{what, count, why, std::nullopt, ""});
    if (mean.count <= 0) return;
    line.ms_each = mean.ms / static_cast<double>(mean.count);
    line.measured_on = mean.of;
  }
  std::vector<SkippedWork> lines;
};

void add_pairs(const StepStats& s, Ledger& ledger) {
  const std::int64_t moved = s.candidate_pairs - s.kept_pairs, looked_at = moved - s.kdop_separated_pairs;
  const Mean pair{s.hulls_ms + s.direction_ms + s.cull_ms + s.confirm_ms, moved, "stages 3 to 6 of a pair"};
  const Mean hulls{s.hulls_ms - s.kdop_ms, looked_at, "stage 3 of a pair that no axis of the 18-DOPs separates"};
  const Mean gjk{s.gjk_ms, looked_at - s.still_separated_pairs - s.still_overlapping_pairs, "GJK of a pair"};
  ledger.add("pairs excluded", s.excluded_pairs, "by layer, or both bodies are fixed", pair);
  ledger.add("pairs kept", s.kept_pairs, "neither body moved", pair);
  ledger.add("pairs separated", s.kdop_separated_pairs, "an axis of the 18-DOPs separates them", hulls);
  ledger.add("GJK, apart", s.still_separated_pairs, "the last direction still separates the hulls", gjk);
  ledger.add("GJK, overlapping", s.still_overlapping_pairs, "the last vertices still show the overlap", gjk);
}

void add_facets(const StepStats& s, Ledger& ledger) {
  const Mean cluster{s.confirm_ms, s.opened_clusters, "stage 6 of an opened cluster"};
  const std::int64_t far = s.clusters - s.opened_clusters - s.clusters_outside_box - s.clusters_outside_slab;
  ledger.add("clusters, box", s.clusters_outside_box, "outside the box of what is left of the other", cluster);
  ledger.add("clusters, criterion 2", s.clusters_outside_slab, "outside the slab", cluster);
  ledger.add("clusters, far", far, "no cluster of the other is near", cluster);
  const Mean facet{s.confirm_ms, s.kept_facets, "stage 6 of a kept facet, at most"};
  ledger.add("facets, box", s.facets_outside_box, "outside the box of what is left of the other", facet);
  ledger.add("facets, criterion 1", s.facets_facing_away, "facing away", facet);
  ledger.add("facets, criterion 2", s.facets_outside_slab, "outside the slab", facet);
  ledger.add("facets, criterion 3", s.facets_outside_zone, "outside the impact zone", facet);
}

void add_outputs(const StepStats& s, const Settings& settings, Ledger& ledger) {
  const bool has_facets = settings.accuracy != Accuracy::hulls;
  const bool has_zones = settings.outputs.zones || settings.accuracy == Accuracy::paper;
  if (!has_facets) ledger.add("stages 5 and 6", s.contacts, "facet pairs were not requested", kNotMeasured);
  if (has_facets) ledger.add("Embree", s.contacts - s.tree_pairs, "the clusters are few: a plain loop", kNotMeasured);
  if (has_facets && !has_zones) ledger.add("zones", s.contacts, "not requested", kNotMeasured);
  if (!settings.outputs.patches) ledger.add("patches", s.touching_contacts, "not requested", kNotMeasured);
}

std::string time_each_text(double ms) {
  if (ms >= 1.0) return fmt::format("{:.3g} ms", ms);
  return ms >= 1e-3 ? fmt::format("{:.3g} µs", 1e3 * ms) : fmt::format("{:.3g} ns", 1e6 * ms);
}

}  // namespace

std::vector<SkippedWork> skipped_work(const StepStats& sums, const Settings& settings) {
  Ledger ledger;
  ledger.add("vertices", sums.vertices - sums.moved_vertices, "their bodies are fixed or did not move",
             {sums.refresh_ms - sums.regroup_ms, sums.moved_vertices, "refresh of a vertex"});
  add_pairs(sums, ledger);
  if (settings.accuracy != Accuracy::hulls) add_facets(sums, ledger);
  add_outputs(sums, settings, ledger);
  return ledger.lines;
}

void print_skipped_work(std::ostream& out, const StepStats& sums, int steps, const Settings& settings) {
  fmt::print(
      out,
      "\nskipped by the engine, a step, and what it would have taken: an estimate, the number times the mean of\n"
      "this run that stands in brackets; \"-\" where nothing was measured\n");
  for (const SkippedWork& line : skipped_work(sums, settings)) {
    const std::optional<double> ms = line.ms();
    fmt::print(out, "  {:<22} {:>11.1f} {:>10}  {}{}\n", line.what, static_cast<double>(line.count) / steps,
               ms ? fmt::format("{:.3f} ms", *ms / steps) : "-", line.why,
               line.ms_each ? fmt::format(" ({}: {})", line.measured_on, time_each_text(*line.ms_each)) : "");
  }
}

}  // namespace tact::scenes
