// Millions of hard triangle pairs against CGAL and against rationals: the exact predicates, and the loops that the
// engine puts before them, in every instruction set. Not part of the ordinary tests: how many pairs is read from the
// environment.
//   TACT_LONG_CGAL_PAIRS      pairs against CGAL's exact predicates, 100000 if not set
//   TACT_LONG_RATIONAL_PAIRS  pairs against rational numbers alone, 10000 if not set
//   TACT_LONG_SEED            which pairs, 1 if not set
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "narrowphase/triangles/triangle_triangle.h"
#include "tests/support/environment/environment.h"
#include "tests/support/generators/triangle_pairs.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::tests {
namespace {

constexpr std::uint64_t kBlock = 156 * narrowphase::FacetBlock::kCapacity;  // pairs
constexpr std::size_t kFailuresShown = 5;

// What was seen of one kind of pair.
struct KindCounts {
  std::uint64_t pairs = 0;
  std::uint64_t meeting = 0;
  std::uint64_t left_out = 0;          // by boxes and planes
  std::uint64_t undecided = 0;         // of the others, left to the exact predicates
  std::uint64_t exact_pairs = 0;       // in which the exact path ran, asked about every pair
  std::uint64_t exact_predicates = 0;  // how often it ran
};

struct BlockResult {
  std::array<KindCounts, kPairKinds> kinds;
  std::vector<std::string> failures;
};

using Oracle = bool (*)(const Triangle&, const Triangle&);

void run_pairs(std::span<const TrianglePair> pairs, std::uint64_t first, Oracle oracle, BlockResult& result) {
  const std::vector<const narrowphase::Kernels*> kernels = available_kernels();
  std::vector<std::vector<Filtered>> by_kernels;
  for (const narrowphase::Kernels* one : kernels) by_kernels.push_back(filtered(*one, pairs));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto fail = [&](const std::string& who, bool meet) {
      result.failures.push_back("pair " + std::to_string(first + i) + ", " + who +
                                (meet ? ": meets, unnoticed: " : ": does not meet, unnoticed: ") + to_string(pairs[i]));
    };
    const bool meet = oracle(pairs[i].a, pairs[i].b);
    narrowphase::PredicateCounts counts;
    if (narrowphase::triangle_triangle_meet(pairs[i].a, pairs[i].b, counts) != meet) fail("predicates", meet);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      if (!is_right(by_kernels[k][i], pairs[i], meet)) fail(kernels[k]->name, meet);
    }
    const Filtered& first_filtered = by_kernels[0][i];
    KindCounts& kind = result.kinds[static_cast<std::size_t>(pairs[i].kind)];
    ++kind.pairs;
    kind.meeting += meet;
    kind.left_out += first_filtered.left_out;
    kind.undecided += first_filtered.undecided();
    kind.exact_pairs += counts.exact > 0;
    kind.exact_predicates += static_cast<std::uint64_t>(counts.exact);
  }
}

BlockResult run_block(std::uint64_t seed, std::uint64_t begin, std::uint64_t end, Oracle oracle) {
  BlockResult result;
  std::vector<TrianglePair> pairs;
  for (std::uint64_t i = begin; i < end; i += pairs.size()) {
    pairs.clear();
    for (std::uint64_t k = i; k < std::min<std::uint64_t>(i + narrowphase::FacetBlock::kCapacity, end); ++k)
      pairs.push_back(hard_triangle_pair(seed, k));
    run_pairs(pairs, i, oracle, result);
  }
  return result;
}

void add(KindCounts& sum, const KindCounts& one) {
  sum.pairs += one.pairs;
  sum.meeting += one.meeting;
  sum.left_out += one.left_out;
  sum.undecided += one.undecided;
  sum.exact_pairs += one.exact_pairs;
  sum.exact_predicates += one.exact_predicates;
}

void print(const std::array<KindCounts, kPairKinds>& kinds) {
  std::printf("%-14s %12s %9s %9s %10s %11s %18s\n", "kind", "pairs", "meet", "left out", "undecided", "exact path",
              "exact predicates");
  KindCounts all;
  const auto line = [](const char* name, const KindCounts& k) {
    const double pairs = static_cast<double>(std::max<std::uint64_t>(1, k.pairs));
    const auto percent = [&](std::uint64_t count) { return 100.0 * static_cast<double>(count) / pairs; };
    std::printf("%-14s %12llu %8.2f%% %8.2f%% %9.2f%% %10.3f%% %11.4f a pair\n", name,
                static_cast<unsigned long long>(k.pairs), percent(k.meeting), percent(k.left_out), percent(k.undecided),
                percent(k.exact_pairs), static_cast<double>(k.exact_predicates) / pairs);
  };
  for (int kind = 0; kind < kPairKinds; ++kind) {
    const KindCounts& k = kinds[static_cast<std::size_t>(kind)];
    const std::string text = to_string(TrianglePair{.a = {}, .b = {}, .kind = static_cast<PairKind>(kind)});
    line(text.substr(0, text.find('\n')).c_str(), k);
    add(all, k);
  }
  line("all", all);
  std::fflush(stdout);
}

void expect_agreement(std::uint64_t pairs, Oracle oracle) {
  const std::uint64_t seed = from_environment("TACT_LONG_SEED", 1);
  std::vector<BlockResult> blocks((pairs + kBlock - 1) / kBlock);
  base::parallel_for(blocks.size(), 1, base::default_threads(), [&](std::size_t i) {
    blocks[i] = run_block(seed, i * kBlock, std::min((i + 1) * kBlock, pairs), oracle);
  });
  std::array<KindCounts, kPairKinds> kinds{};
  std::vector<std::string> failures;
  for (const BlockResult& block : blocks) {
    for (std::size_t k = 0; k < kinds.size(); ++k) add(kinds[k], block.kinds[k]);
    failures.insert(failures.end(), block.failures.begin(), block.failures.end());
  }
  print(kinds);
  EXPECT_TRUE(failures.empty()) << failures.size() << " wrong, seed " << seed;
  for (std::size_t i = 0; i < std::min(failures.size(), kFailuresShown); ++i) ADD_FAILURE() << failures[i];
}

TEST(PredicatesLong, TrianglesMeetWhereCgalSaysSo) {
  expect_agreement(from_environment("TACT_LONG_CGAL_PAIRS", 100000), cgal_meet);
}

TEST(PredicatesLong, TrianglesMeetWhereRationalsSaySo) {
  expect_agreement(from_environment("TACT_LONG_RATIONAL_PAIRS", 10000), rational_meet);
}

}  // namespace
}  // namespace tact::tests
