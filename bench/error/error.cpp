#include "bench/error/error.h"

#include <fmt/format.h>

#include <cstdio>

#include "bench/error/growth.h"
#include "bench/error/meshes.h"
#include "bench/error/recall.h"
#include "bench/error/report.h"
#include "bench/table.h"

namespace tact::bench {
namespace {

std::vector<HullMethodKind> hull_methods() {
  std::vector<HullMethodKind> all = tact_hull_methods();
  for (const auto& kinds : {libccd_hull_methods(), fcl_hull_methods(), bullet_hull_methods()})
    all.insert(all.end(), kinds.begin(), kinds.end());
  return all;
}

// Judges all methods, then times them, and says how many of tact's failed.
template <class Row, class Kind>
int run_row(const Row& row, Query query, const std::vector<Kind>& kinds, double seconds,
            std::vector<ErrorTable>& tables) {
  ErrorTable table{row.name, query, {}};
  int faults = 0;
  for (const Kind& kind : kinds) table.results.push_back(judge(row, kind));
  const std::vector<double> times = measure(row, kinds, seconds);
  for (std::size_t i = 0; i < kinds.size(); ++i) table.results[i].microseconds = times[i];
  print(table);
  print_verdict(table);
  for (const ErrorResult& r : table.results) {
    const std::string fault = r.library == "tact" ? fault_of(r, query) : "";
    if (fault.empty()) continue;
    fmt::print("WRONG: tact, {}: {}\n\n", r.setting, fault);
    ++faults;
  }
  std::fflush(stdout);
  tables.push_back(std::move(table));
  return faults;
}

}  // namespace

int run_error(const BenchOptions& options) {
  fmt::print("{}\n\n", machine_line(1));
  fmt::print(
      "Time: median over the steps of a slow motion, from new positions to the answer; one thread. Errors: the largest "
      "and\n"
      "the median, of depth in units of the pair's size, of direction in radians; against the smallest separation, or "
      "for\n"
      "carried directions against the nearest local minimum.\n\n");
  const double seconds = options.quick ? 0.01 : 0.5;
  std::vector<ErrorTable> tables;
  int faults = 0;
  for (const HullRow& row : hull_rows(options.quick))
    faults += run_row(row, Query::hulls, hull_methods(), seconds, tables);
  for (const MeshRow& row : mesh_rows(options.quick))
    faults += run_row(row, Query::facet_pairs, mesh_methods(), seconds, tables);
  faults += print_recall(options);
  faults += print_iterations(options);
  print_growth(options);
  if (!options.out.empty()) {
    write_csv(tables, options.out / "error.csv");
    plot_tables(tables, Query::hulls, options.out, "error_hulls");
    plot_tables(tables, Query::facet_pairs, options.out, "error_meshes");
  }
  return faults > 0 ? 1 : 0;
}

}  // namespace tact::bench
