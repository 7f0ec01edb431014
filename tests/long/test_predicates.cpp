// Millions of hard triangle pairs against CGAL and against rationals: one by one, and many at a time by every kernel
// that the machine has. Not part of the ordinary tests: how many pairs is read from the environment.
//   TACT_LONG_CGAL_PAIRS      pairs against CGAL's exact predicates, 100000 if not set
//   TACT_LONG_RATIONAL_PAIRS  pairs against rational numbers alone, 10000 if not set
//   TACT_LONG_SEED            which pairs, 1 if not set
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "narrowphase/kernels/kernels.h"
#include "narrowphase/triangle_triangle.h"
#include "tests/support/triangle_oracle.h"
#include "tests/support/triangle_pairs.h"

namespace tact::tests {
namespace {

constexpr std::uint64_t kBlock = 10000;  // pairs
constexpr std::size_t kFailuresShown = 5;

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value ? std::strtoull(value, nullptr, 10) : otherwise;
}

// What was seen of one kind of pair.
struct KindCounts {
  std::uint64_t pairs = 0;
  std::uint64_t meeting = 0;
  std::uint64_t exact_pairs = 0;       // in which the exact path ran
  std::uint64_t exact_predicates = 0;  // how often it ran
};

struct BlockResult {
  std::array<KindCounts, kPairKinds> kinds;
  std::vector<std::string> failures;
};

using Oracle = bool (*)(const Triangle&, const Triangle&);

using narrowphase::FacetBlock;
using narrowphase::Kernels;
using narrowphase::PairMatches;

void set_corners(FacetBlock& block, int i, const Triangle& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) block.corner[k][axis][i] = t[k][axis];
  }
}

// What kernels say of up to 64 pairs.
class Batch {
 public:
  bool full() const { return list_.count == narrowphase::FacetPairList::kCapacity; }

  void add(const TrianglePair& pair, bool meet) {
    const int i = list_.count++;
    set_corners(a_, i, pair.a);
    set_corners(b_, i, pair.b);
    list_.a[i] = list_.b[i] = i;
    pairs_.push_back(pair);
    meeting_ |= static_cast<std::uint64_t>(meet) << i;
  }

  // Appends what is wrong and empties the batch.
  void check(std::vector<std::string>& failures) {
    const std::uint64_t all = full() ? ~std::uint64_t{0} : (std::uint64_t{1} << list_.count) - 1;
    for (const Kernels* kernels :
         {narrowphase::scalar_kernels(), narrowphase::avx2_kernels(), narrowphase::avx512_kernels()}) {
      if (kernels == nullptr) continue;
      const PairMatches simple = kernels->match_pairs(a_, b_, list_);
      const PairMatches wide = kernels->match_pairs_wide(a_, b_, list_, all);
      const std::uint64_t sharing = kernels->sharing_pairs(a_, b_, list_, all);
      const std::string name = kernels->name;
      note(simple.meeting ^ (meeting_ & ~simple.undecided), name + " in doubles", failures);
      note(wide.meeting ^ (meeting_ & ~wide.undecided), name + " with twice the digits", failures);
      note(sharing & ~meeting_, name + " by equal corners", failures);
      note(((simple.flat | wide.flat) & ~flat()), name + " lies in the plane", failures);
    }
    list_.count = 0;
    meeting_ = 0;
    pairs_.clear();
  }

 private:
  std::uint64_t flat() const {
    std::uint64_t flat = 0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      narrowphase::PredicateCounts counts;
      const Triangle& b = pairs_[i].b;
      const bool all =
          narrowphase::sides_of_plane(b[0], b[1], b[2], pairs_[i].a, counts) == std::array<int, 3>{0, 0, 0};
      flat |= static_cast<std::uint64_t>(all) << i;
    }
    return flat;
  }

  void note(std::uint64_t wrong, const std::string& who, std::vector<std::string>& failures) const {
    for (; wrong != 0; wrong &= wrong - 1) {
      failures.push_back(who + ", wrongly: " + to_string(pairs_[static_cast<std::size_t>(std::countr_zero(wrong))]));
    }
  }

  FacetBlock a_{}, b_{};
  narrowphase::FacetPairList list_;
  std::vector<TrianglePair> pairs_;
  std::uint64_t meeting_ = 0;  // in truth
};

BlockResult run_block(std::uint64_t seed, std::uint64_t begin, std::uint64_t end, Oracle oracle) {
  BlockResult result;
  Batch batch;
  for (std::uint64_t i = begin; i < end; ++i) {
    const TrianglePair pair = hard_triangle_pair(seed, i);
    narrowphase::PredicateCounts counts;
    const bool meet = narrowphase::triangle_triangle_meet(pair.a, pair.b, counts), truth = oracle(pair.a, pair.b);
    KindCounts& kind = result.kinds[static_cast<std::size_t>(pair.kind)];
    ++kind.pairs;
    kind.meeting += meet;
    kind.exact_pairs += counts.exact > 0;
    kind.exact_predicates += static_cast<std::uint64_t>(counts.exact);
    if (meet != truth) {
      result.failures.push_back("pair " + std::to_string(i) +
                                (meet ? " meets, wrongly: " : " does not meet, wrongly: ") + to_string(pair));
    }
    batch.add(pair, truth);
    if (batch.full() || i + 1 == end) batch.check(result.failures);
  }
  return result;
}

void print(const std::array<KindCounts, kPairKinds>& kinds) {
  std::printf("%-14s %12s %9s %12s %18s\n", "kind", "pairs", "meet", "exact path", "exact predicates");
  KindCounts all;
  const auto line = [](const char* name, const KindCounts& k) {
    const double pairs = static_cast<double>(std::max<std::uint64_t>(1, k.pairs));
    std::printf("%-14s %12llu %8.2f%% %11.3f%% %11.4f a pair\n", name, static_cast<unsigned long long>(k.pairs),
                100.0 * static_cast<double>(k.meeting) / pairs, 100.0 * static_cast<double>(k.exact_pairs) / pairs,
                static_cast<double>(k.exact_predicates) / pairs);
  };
  for (int kind = 0; kind < kPairKinds; ++kind) {
    const KindCounts& k = kinds[static_cast<std::size_t>(kind)];
    const std::string text = to_string(TrianglePair{.a = {}, .b = {}, .kind = static_cast<PairKind>(kind)});
    line(text.substr(0, text.find('\n')).c_str(), k);
    all.pairs += k.pairs;
    all.meeting += k.meeting;
    all.exact_pairs += k.exact_pairs;
    all.exact_predicates += k.exact_predicates;
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
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      kinds[k].pairs += block.kinds[k].pairs;
      kinds[k].meeting += block.kinds[k].meeting;
      kinds[k].exact_pairs += block.kinds[k].exact_pairs;
      kinds[k].exact_predicates += block.kinds[k].exact_predicates;
    }
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
