// Millions of moving features against roots of polynomials as algebraic numbers, in rational arithmetic; worlds that go
// a part of a way that they know, against worlds that do not. Not part of the ordinary tests: how many is read from the
// environment.
//   TACT_LONG_MOTION_QUERIES  that share a point, 2000 if not set
//   TACT_LONG_REACH_QUERIES   that come within a reach, 1000 if not set
//   TACT_LONG_WAYS            worlds of up to four bodies, five parts of a way each, 10 if not set
//   TACT_LONG_SEED            which queries, 1 if not set
#include <gtest/gtest.h>
#include <tact/tact.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "tests/support/environment/environment.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/hashes/answer_hash.h"
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

// Bodies at their places, of any unit, far from the origin or near, and where they go.
struct RandomWays {
  tact::World world{{.threads = 2}};
  struct Way {
    BodyId body;
    Eigen::Matrix3Xd begin, end;
  };
  std::vector<Way> ways;
  double unit = 1.0;

  explicit RandomWays(Random& random) {
    unit = std::ldexp(1.0, random.below(3) == 0 ? random.below(40) - 20 : 0);
    const double far = random.below(4) == 0 ? std::pow(10.0, random.below(6)) : 0.0;
    const double margin = random.below(2) == 0 ? 0.03 * unit : 0.0, wildness = 0.2 * random.below(3);
    const Vec3 carry = random.below(3) == 0 ? 5.0 * random.in_cube(1.0) : Vec3{};
    for (int bodies = 1 + random.below(4); bodies > 0; --bodies) {
      const auto seed = static_cast<std::uint64_t>(random.below(1 << 20));
      const std::vector<Mesh> meshes{blob(2, 1.0, 0.2, seed), sheet(8, 8, 2.0, 2.0), soup(60, 1.0, seed),
                                     lattice_soup(60, 3, seed), gridded_box({0, 0, 0}, {1, 1, 1}, 3)};
      const Mesh mesh = translated(meshes[random.below(static_cast<int>(meshes.size()))], random.in_cube(1.0));
      const Eigen::Matrix3Xd begin = unit * (mesh.positions.array() + far).matrix();
      const Vec3 way = carry + random.in_cube(1.0);
      Eigen::Matrix3Xd end = begin;
      for (Eigen::Index v = 0; v < end.cols(); ++v) {
        const Vec3 p = way + wildness * random.in_ball();
        end.col(v) += unit * Eigen::Vector3d(p.x, p.y, p.z);
      }
      const BodyId body = world.add_body({.positions = begin,
                                          .facets = mesh.facets,
                                          .surface = Surface::sheet,
                                          .margin = margin,
                                          .self_contact = random.below(3) == 0});
      ways.push_back({body, begin, end});
    }
    world.detect();
  }

  // As one of three solvers rounds it; a body may go another part.
  void go(double part, Random& random) {
    const int rounding = random.below(3);
    for (const auto& [body, begin, end] : ways) {
      const double of_body = random.below(12) == 0 ? 0.7 * part : part;
      Eigen::Matrix3Xd at = begin + of_body * (end - begin);
      if (rounding == 1) at = (1.0 - of_body) * begin + of_body * end;
      if (rounding == 2) at = end - (1.0 - of_body) * (end - begin);
      world.set_positions(body, at);
    }
  }
};

// A restored world knows nothing of its ways.
TEST(LongMotion, OnAPartOfAWayIsAsWithoutTheWholeOne) {
  const std::uint64_t first = from_environment("TACT_LONG_SEED", 1) * 1'000'000'007;
  const std::uint64_t count = from_environment("TACT_LONG_WAYS", 10);
  long known_calls = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    Random random(seed);
    RandomWays known(random);
    double free = 1.0;
    for (int call = 0; call < 5; ++call) {
      const double part = call == 0 ? 1.0 : random.below(3) == 0 ? 0.999 * free : 0.02 + 0.01 * random.below(98);
      MotionOptions options{.wanted = static_cast<Impacts>(random.below(3))};
      if (random.below(4) == 0) options.distance = 0.01 * known.unit * random.below(2);
      options.bounds = options.wanted == Impacts::all && random.below(6) == 0;
      known.go(part, random);
      tact::World without({.threads = 1});
      without.restore(known.world.save());
      AnswerHash answer, expected;
      const MotionReport &report = known.world.detect_motion(options), &other = without.detect_motion(options);
      answer.add(report);
      expected.add(other);
      for (const auto& way : known.ways) answer.add(report.bounds(way.body));
      for (const BodyId body : without.bodies()) expected.add(other.bounds(body));
      ASSERT_EQ(answer.hashes(), expected.hashes()) << "seed " << seed << ", call " << call;
      known_calls += report.stats().cluster_pairs < other.stats().cluster_pairs;
      free = std::max(part * std::min(report.first_time(), 1.0), 1e-3);
    }
  }
  EXPECT_GT(10 * known_calls, static_cast<long>(count));
}

}  // namespace
}  // namespace tact::tests
