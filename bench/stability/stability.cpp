#include "bench/stability/stability.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cstdio>

#include "bench/stability/check.h"
#include "engine/base/timer.h"

namespace tact::bench {
namespace {

constexpr std::uint64_t kCases = 1000;
constexpr std::uint64_t kQuickCases = 24;

struct KindResult {
  std::uint64_t cases = 0;
  StabilityFailures failures;
  std::uint64_t first_seed = 0;
};

std::uint64_t cases_of(const StabilityKind& kind, const BenchOptions& options) {
  return std::max<std::uint64_t>(1, (options.quick ? kQuickCases : kCases) / static_cast<std::uint64_t>(kind.rarity));
}

KindResult run_kind(const StabilityKind& kind, std::uint64_t cases) {
  KindResult row{.cases = cases, .failures = {}};
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    const StabilityFailures failures = check_stability(kind.make(seed));
    if (failures.sum() > 0 && row.failures.sum() == 0) row.first_seed = seed;
    add(row.failures, failures);
  }
  return row;
}

void print(const char* name, const KindResult& row, double seconds) {
  const StabilityFailures& f = row.failures;
  fmt::print("{:<32}{:>7}{:>8}{:>7}{:>8}{:>12}{:>8}{:>12}{:>8}{:>9.1f}\n", name, row.cases, f.facet_sets, f.hulls,
             f.depths, f.directions, f.limits, f.exceptions, f.hashes, seconds);
  if (row.first_seed > 0) fmt::print("  first: seed {}: {}\n", row.first_seed, f.first);
  std::fflush(stdout);
}

}  // namespace

int run_stability(const BenchOptions& options) {
  fmt::print(
      "Each case with carried and smallest directions, 1 and 2 threads, every step. Everything but the number of "
      "cases\n"
      "must be zero.\n\n");
  fmt::print("{:<32}{:>7}{:>8}{:>7}{:>8}{:>12}{:>8}{:>12}{:>8}{:>9}\n", "kind", "cases", "facets", "hulls", "depths",
             "directions", "limits", "exceptions", "hashes", "seconds");
  std::string csv = "kind,cases,facets,hulls,depths,directions,limits,exceptions,hashes\n";
  KindResult total;
  base::Timer all, timer;
  for (const StabilityKind& kind : stability_kinds()) {
    const KindResult row = run_kind(kind, cases_of(kind, options));
    print(kind.name, row, timer.lap() / 1e3);
    const StabilityFailures& f = row.failures;
    csv += fmt::format("\"{}\",{},{},{},{},{},{},{},{}\n", kind.name, row.cases, f.facet_sets, f.hulls, f.depths,
                       f.directions, f.limits, f.exceptions, f.hashes);
    total.cases += row.cases;
    add(total.failures, f);
  }
  print("all", total, all.lap() / 1e3);
  if (!options.out.empty()) fmt::output_file((options.out / "stability.csv").string()).print("{}", csv);
  return total.failures.sum() > 0 ? 1 : 0;
}

}  // namespace tact::bench
