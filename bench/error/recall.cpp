#include "bench/error/recall.h"

#include <fmt/format.h>
#include <tact/world.h>

#include <functional>
#include <string>
#include <vector>

#include "bench/error/truth.h"
#include "bench/stability/cases.h"
#include "bench/stability/shapes.h"
#include "bench/table.h"
#include "bench/workloads/workloads.h"
#include "tests/support/oracles/facet_pair_oracle.h"

namespace tact::bench {
namespace {

struct RecallCase {
  std::vector<StabilityBody> bodies;  // two
};

struct RecallKind {
  std::string name;
  std::vector<RecallCase> cases;
};

struct Found {
  int pairs = 0;
  int missed = 0;
  int wrong = 0;
  long long kept = 0;
  long long facets = 0;
};

void count(const RecallCase& c, Accuracy accuracy, Found& sum) {
  World world({.threads = 1, .accuracy = accuracy});
  for (const StabilityBody& body : c.bodies) {
    world.add_body({.positions = body.mesh.positions, .facets = body.mesh.facets, .surface = body.surface});
  }
  const std::vector<FacetPair> expected = facet_pairs_by_oracle(c.bodies[0].mesh, c.bodies[1].mesh);
  std::vector<FacetPair> found;
  for (const Contact& contact : world.detect().contacts()) {
    found.assign(contact.facet_pairs().begin(), contact.facet_pairs().end());
    sum.kept += contact.kept_facets_a + contact.kept_facets_b;
    sum.facets += c.bodies[0].mesh.facets.cols() + c.bodies[1].mesh.facets.cols();
  }
  const SetDifference off = difference(expected, found);
  sum.pairs += static_cast<int>(expected.size());
  sum.missed += off.missed;
  sum.wrong += off.wrong;
}

using MakeRecallCase = std::function<RecallCase(StabilityRandom&)>;

RecallKind kind(std::string name, int cases, const MakeRecallCase& make) {
  RecallKind result{std::move(name), {}};
  StabilityRandom random(1);
  for (int i = 0; i < cases; ++i) result.cases.push_back(make(random));
  return result;
}

RecallKind frames_of(std::string name, const Workload& workload) {
  RecallKind result{std::move(name), {}};
  for (int frame = 0; frame < workload.frames; ++frame) {
    RecallCase c;
    for (std::size_t i = 0; i < 2; ++i) {
      const WorkloadBody& body = workload.bodies[i];
      c.bodies.push_back({{body.positions(frame), body.facets}, body.surface});
    }
    result.cases.push_back(std::move(c));
  }
  return result;
}

// Two jaws and a back, with a slab between the jaws that is thicker than the gap: held from two opposite sides.
RecallCase clamp(StabilityRandom& random) {
  const double gap = random.uniform(0.2, 0.4), slab = gap + random.uniform(0.01, 0.05);
  Mesh jaws = box_shape({-1.0, -0.5, 0.5 * gap}, {1.0, 0.5, 0.5 * gap + 0.4});
  jaws = joined(jaws, box_shape({-1.0, -0.5, -0.5 * gap - 0.4}, {1.0, 0.5, -0.5 * gap}));
  jaws = joined(jaws, box_shape({-1.2, -0.5, -0.5 * gap - 0.4}, {-1.0, 0.5, 0.5 * gap + 0.4}));
  Mesh held = moved(stretched(ball_shape(2), {0.9, 0.4, 0.5 * slab}), {random.uniform(0.2, 0.6), 0.0, 0.0});
  return {{{jaws}, {held}}};
}

// A spike into a slab: the facets that meet are nearly along the direction.
RecallCase spike(StabilityRandom& random) {
  const Eigen::Vector3d tip(0.0, 0.0, -random.uniform(0.1, 0.5));
  const Eigen::Vector3d p(0.05, 0.0, 1.0), q(-0.03, 0.05, 1.0), r(-0.03, -0.05, 1.0);
  Mesh mesh;
  mesh.positions.resize(3, 4);
  mesh.positions << tip, p, q, r;
  mesh.facets.resize(3, 4);
  mesh.facets << 0, 0, 0, 1, 2, 3, 1, 2, 1, 2, 3, 3;
  return {{{box_shape({-1, -1, -1}, {1, 1, 0})}, {mesh}}};
}

Eigen::Vector3d shallow(StabilityRandom& random) { return random.uniform(1.4, 1.8) * random.direction(); }

std::vector<RecallKind> recall_kinds(bool quick) {
  const int cases = quick ? 4 : 50, frames = quick ? 6 : 40;
  return {
      kind("spheres", cases,
           [](StabilityRandom& r) {
             return RecallCase{{{ball_shape(2)}, {moved(ball_shape(2), shallow(r))}}};
           }),
      kind("convex hulls", cases,
           [](StabilityRandom& r) {
             return RecallCase{{{hull_shape(40, r)}, {moved(hull_shape(40, r), shallow(r))}}};
           }),
      kind("boxes, turned", cases,
           [](StabilityRandom& r) {
             const Mesh box = box_shape({-1, -1, -1}, {1, 1, 1});
             return RecallCase{{{box}, {moved(rotated(box, r.rotation()), 1.2 * shallow(r))}}};
           }),
      kind("lumps", cases,
           [](StabilityRandom& r) {
             return RecallCase{{{lumpy_shape(3, 0.4, r)}, {moved(lumpy_shape(3, 0.4, r), shallow(r))}}};
           }),
      kind("lumps, deep", cases,
           [](StabilityRandom& r) {
             return RecallCase{{{lumpy_shape(3, 0.4, r)}, {moved(lumpy_shape(3, 0.4, r), 0.4 * shallow(r))}}};
           }),
      kind("sheet and sphere", cases,
           [](StabilityRandom& r) {
             return RecallCase{
                 {{stretched(sheet_shape(12), {3, 3, 1}), Surface::sheet}, {moved(ball_shape(2), r.in_cube(0.8))}}};
           }),
      kind("sheets", cases,
           [](StabilityRandom& r) {
             return RecallCase{{{rotated(sheet_shape(8), r.rotation()), Surface::sheet},
                                {rotated(sheet_shape(8), r.rotation()), Surface::sheet}}};
           }),
      kind("soups", cases,
           [](StabilityRandom& r) {
             return RecallCase{
                 {{soup_shape(60, r), Surface::sheet}, {moved(soup_shape(60, r), 0.5 * shallow(r)), Surface::sheet}}};
           }),
      kind("spike in slab", cases, spike),
      kind("clamp", cases, clamp),
      frames_of("organ and tool", organ_and_tool(frames)),
      frames_of("cloth on sphere", cloth(quick ? 16 : 32, frames)),
      frames_of("blobs of 1280 facets", large_pair(8, quick ? 2 : 10)),
  };
}

}  // namespace

int print_recall(const BenchOptions& options) {
  fmt::print("Facet pairs that meet, and the share of them that each level finds\n");
  Table table({"kind", "cases", "pairs", "paper: recall", "paper: kept", "exact: recall", "exact: kept", "wrong"});
  int faults = 0;
  for (const RecallKind& kind : recall_kinds(options.quick)) {
    Found paper, exact;
    for (const RecallCase& c : kind.cases) {
      count(c, Accuracy::paper, paper);
      count(c, Accuracy::exact, exact);
    }
    const auto recall = [](const Found& f) {
      return f.pairs == 0 ? 1.0 : 1.0 - static_cast<double>(f.missed) / f.pairs;
    };
    const auto kept = [](const Found& f) {
      return f.facets == 0 ? 0.0 : static_cast<double>(f.kept) / static_cast<double>(f.facets);
    };
    table.add({kind.name, fmt::format("{}", kind.cases.size()), fmt::format("{}", exact.pairs),
               fmt::format("{:.4f}", recall(paper)), fmt::format("{:.3f}", kept(paper)),
               fmt::format("{:.4f}", recall(exact)), fmt::format("{:.3f}", kept(exact)),
               fmt::format("{}", paper.wrong + exact.wrong)});
    faults += exact.missed + exact.wrong + paper.wrong > 0 ? 1 : 0;
  }
  table.print();
  if (!options.out.empty()) table.write_csv(options.out / "recall.csv");
  return faults;
}

}  // namespace tact::bench
