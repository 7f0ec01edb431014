#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/motion/meeting.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/facet_filters.h"
#include "tests/support/inside/motion_queries.h"

namespace tact::tests {
namespace {

using narrowphase::MeetingSearch;
using narrowphase::MovingPolygon;
using narrowphase::MovingVertex;

// The filter leaves out nothing that meets, and every instruction set leaves out the same.
TEST(ApartThroughout, LeavesOutNothingThatMeets) {
  Random random(4);
  MeetingSearch search;
  std::int64_t left_out = 0, meeting = 0;
  for (int block = 0; block < 400; ++block) {
    for (const double reach : {0.0, 0.01, 0.5}) {
      const narrowphase::PolygonReach counts{reach, narrowphase::kShareOfGap};
      narrowphase::MovingPolygons polygons;
      polygons.corners = 3 + block % 2;
      std::vector<MovingPolygon> all;
      const int wanted = 1 + random.below(64);
      while (polygons.count < wanted) {
        MotionQuery query = random_query(random);
        if (query.edges != (polygons.corners == 4)) continue;
        for (MovingVertex& vertex : query.vertices) {
          for (Vec3& p : vertex.at) p = 1e-3 * p;
        }
        const MovingPolygon polygon = query.polygon();
        double size = 0.0;
        for (const auto& corners : polygon.corner) {
          for (int i = 0; i < polygon.count; ++i) size = std::max(size, norm(heads(corners[i])));
        }
        if (size > 2.0) continue;
        for (int time = 0; time < 2; ++time) {
          for (int i = 0; i < polygons.corners; ++i) {
            const Vec3 corner = heads(polygon.corner[time][std::min(i, polygon.count - 1)]);
            for (int axis = 0; axis < 3; ++axis) polygons.corner[time][i][axis][polygons.count] = corner[axis];
          }
        }
        ++polygons.count;
        all.push_back(polygon);
      }
      const std::uint64_t apart = narrowphase::scalar_kernels()->apart_throughout(polygons, counts);
      for (const narrowphase::Kernels* kernels : available_kernels())
        EXPECT_EQ(kernels->apart_throughout(polygons, counts), apart) << kernels->name;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const bool meets = search.first(all[i], reach).time <= 1.0;
        meeting += meets;
        if ((apart >> i & 1) == 0) continue;
        ++left_out;
        EXPECT_FALSE(meets);
      }
    }
  }
  EXPECT_GT(left_out, 5000);
  EXPECT_GT(meeting, 2000);
}

}  // namespace
}  // namespace tact::tests
