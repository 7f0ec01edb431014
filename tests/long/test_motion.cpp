// Millions of moving features against roots of polynomials as algebraic numbers, in rational arithmetic. Not part of
// the ordinary tests: how many is read from the environment.
//   TACT_LONG_MOTION_QUERIES  that share a point, 2000 if not set
//   TACT_LONG_REACH_QUERIES   that come within a reach, 1000 if not set
//   TACT_LONG_SEED            which queries, 1 if not set
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "tests/support/environment/environment.h"
#include "tests/support/inside/motion_queries.h"

namespace tact::tests {
namespace {

constexpr std::uint64_t kBlock = 500;  // queries
constexpr std::size_t kFailuresShown = 5;

struct BlockResult {
  std::uint64_t meeting = 0, counted = 0;
  std::vector<std::string> failures;
};

// check(random, k, search) for each query; `counted` says what those are that miss and are reported.
template <class Check>
void expect_right(std::uint64_t count, const char* counted_by, const Check& check) {
  const std::uint64_t seed = from_environment("TACT_LONG_SEED", 1);
  std::vector<BlockResult> blocks((count + kBlock - 1) / kBlock);
  base::parallel_for(blocks.size(), 1, base::default_threads(), [&](std::size_t i) {
    Random random(seed * 1'000'000'007 + i);
    narrowphase::MeetingSearch search;
    for (std::uint64_t k = 0; k < kBlock; ++k) {
      const auto [answer, failure] = check(random, k, search);
      blocks[i].meeting += answer == QueryAnswer::meets;
      blocks[i].counted += answer == QueryAnswer::misses_but_counts;
      if (!failure.empty()) blocks[i].failures.push_back("block " + std::to_string(i) + ", " + failure);
    }
  });
  std::uint64_t meeting = 0, counted = 0;
  std::size_t failed = 0;
  for (const BlockResult& block : blocks) {
    meeting += block.meeting;
    counted += block.counted;
    for (const std::string& failure : block.failures) {
      if (++failed <= kFailuresShown) ADD_FAILURE() << "seed " << seed << ", " << failure;
    }
  }
  std::printf("seed %llu, %llu queries: %llu meet, %llu %s by less than 1e-11 and are reported, %zu failures\n",
              static_cast<unsigned long long>(seed), static_cast<unsigned long long>(blocks.size() * kBlock),
              static_cast<unsigned long long>(meeting), static_cast<unsigned long long>(counted), counted_by, failed);
  EXPECT_EQ(failed, 0u);
}

TEST(LongMotion, FirstTimesEqualRationalArithmetic) {
  expect_right(from_environment("TACT_LONG_MOTION_QUERIES", 2000), "miss",
               [](Random& random, std::uint64_t k, narrowphase::MeetingSearch& search) {
                 return check(k % 5 == 0   ? query_in_plane(random)
                              : k % 5 == 1 ? query_of_layers(random)
                              : k % 2 == 0 ? random_query(random)
                                           : grazing_query(random),
                              search);
               });
}

TEST(LongMotion, FirstTimesWithinAReachEqualRationalArithmetic) {
  expect_right(from_environment("TACT_LONG_REACH_QUERIES", 1000), "stay beyond",
               [](Random& random, std::uint64_t k, narrowphase::MeetingSearch& search) {
                 const MotionQuery query = k % 6 == 0   ? query_in_plane(random)
                                           : k % 6 == 1 ? query_of_layers(random)
                                           : k % 6 == 2 ? grazing_query(random)
                                           : k % 6 == 3 ? random_query(random)
                                                        : query_past_corner(random);
                 return check_within(query, reach_for(query, random), search);
               });
}

}  // namespace
}  // namespace tact::tests
