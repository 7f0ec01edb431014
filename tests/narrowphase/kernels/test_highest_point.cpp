#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"
#include "tests/support/inside/facet_blocks.h"
#include "tests/support/inside/facet_filters.h"

namespace tact::narrowphase {
namespace {

// Points of few heights in some ranges, with numbers or without: wherever the first of the highest stands, it is found,
// if it is as high as was asked for.
TEST(HighestPoint, OfEquallyHighPointsIsTheFirst) {
  tests::Random random(4);
  const std::vector<double> zero(60, 0.0);
  for (int repeat = 0; repeat < 2000; ++repeat) {
    std::vector<double> x(60, 9.0);  // outside of the ranges it is higher
    std::vector<IndexRange> ranges;
    std::vector<int> inside;
    for (int begin = random.below(4); begin < 40 && repeat % 50 != 49;) {  // none, once in a while
      const int end = std::min(begin + random.below(20), 40);
      ranges.push_back({begin, end});
      for (int i = begin; i < end; ++i) inside.push_back(i);
      begin = end + random.below(5);
    }
    for (const int i : inside) x[i] = random.below(1 + repeat % 40) - 1.0;
    const auto height = [&](int i) { return x[i]; };
    const double leasts[] = {-1.0, -std::numeric_limits<double>::infinity(), random.below(1 + repeat % 40) - 1.5};
    const double least = leasts[repeat % 3];
    const bool numbered = random.chance(0.5);
    const std::vector<int> number = random.permutation(60);
    const auto rank = [&](int i) { return std::pair(-height(i), numbered ? number[i] : i); };
    const auto first = std::ranges::min_element(inside, {}, rank);
    const int index = first == inside.end() || height(*first) < least ? -1 : *first;
    for (const Kernels* kernels : tests::available_kernels()) {
      const HighestPoint top =
          kernels->highest_point({x.data(), zero.data(), zero.data()}, numbered ? number.data() : nullptr,
                                 ranges.data(), static_cast<int>(ranges.size()), {1, 0, 0, 0, 0, 0}, least);
      EXPECT_EQ(top.index, index) << kernels->name;
      EXPECT_EQ(top.height, index < 0 ? -std::numeric_limits<double>::infinity() : height(index)) << kernels->name;
    }
  }
}

// The points of a mesh, as every instruction set sees them: the same height and vertex, and none above it.
TEST(HighestPoint, IsTheSameForEveryInstructionSet) {
  for (int seed = 0; seed < 12; ++seed) {
    const ClusteredMesh mesh = tests::clustered(tests::bodies(seed).second);
    const HeightAxis axis{0.48, -0.6, 0.64, 0.01, 0.02, -0.03};
    const IndexRange all{0, mesh.vertex_count()};
    const HighestPoint highest = scalar_kernels()->highest_point(mesh.points(), nullptr, &all, 1, axis, -1e300);
    for (const Kernels* kernels : tests::available_kernels()) {
      const HighestPoint top = kernels->highest_point(mesh.points(), nullptr, &all, 1, axis, highest.height);
      EXPECT_EQ(top.height, highest.height) << kernels->name;
      EXPECT_EQ(top.index, highest.index) << kernels->name;
      const double above = std::nextafter(highest.height, 1e300);
      EXPECT_EQ(kernels->highest_point(mesh.points(), nullptr, &all, 1, axis, above).index, -1) << kernels->name;
    }
  }
}

}  // namespace
}  // namespace tact::narrowphase
