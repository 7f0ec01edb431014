#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "tests/support/generators/triangle_pairs.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/oracles/triangle_oracle.h"

namespace tact::tests {
namespace {

using narrowphase::EdgesThrough;
using narrowphase::TrianglePairs;

// What is said to meet meets, what is said to miss misses, and every instruction set says the same.
TEST(EdgesThrough, AreThoseOfCgal) {
  std::int64_t meeting = 0, missing = 0, undecided = 0;
  std::uint64_t index = 0;
  for (int block = 0; block < 120; ++block) {
    TrianglePairs pairs;
    std::vector<TrianglePair> all;
    const int wanted = 1 + block % TrianglePairs::kCapacity;
    for (; pairs.count < wanted; ++pairs.count) {
      all.push_back(hard_triangle_pair(5, index++));
      for (std::size_t corner = 0; corner < 3; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
          pairs.corner[0][corner][axis][pairs.count] = all.back().a[corner][axis];
          pairs.corner[1][corner][axis][pairs.count] = all.back().b[corner][axis];
        }
      }
    }
    const EdgesThrough through = narrowphase::scalar_kernels()->edges_through(pairs);
    for (const narrowphase::Kernels* kernels : available_kernels()) {
      const EdgesThrough same = kernels->edges_through(pairs);
      for (int edge = 0; edge < 6; ++edge) {
        ASSERT_EQ(same.meeting[edge], through.meeting[edge]) << kernels->name;
        ASSERT_EQ(same.undecided[edge], through.undecided[edge]) << kernels->name;
      }
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t edge = 0; edge < 6; ++edge) {
        if ((through.undecided[edge] >> i & 1) != 0) {
          ++undecided;
          continue;
        }
        const Triangle &own = edge < 3 ? all[i].a : all[i].b, &other = edge < 3 ? all[i].b : all[i].a;
        const Vec3 p = own[edge % 3], q = own[(edge + 1) % 3];
        const bool meets = (through.meeting[edge] >> i & 1) != 0;
        ASSERT_EQ(meets, cgal_meet({p, q, q}, other)) << "block " << block << ", pair " << i << ", edge " << edge;
        ++(meets ? meeting : missing);
      }
    }
    for (int edge = 0; edge < 6 && all.size() < 64; ++edge)
      ASSERT_EQ((through.meeting[edge] | through.undecided[edge]) >> all.size(), 0u);
  }
  EXPECT_GT(meeting, 1000);
  EXPECT_GT(missing, 5000);
  EXPECT_GT(undecided, 1000);
}

}  // namespace
}  // namespace tact::tests
