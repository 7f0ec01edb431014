#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "narrowphase/crossing/edge_through.h"
#include "narrowphase/triangles/triangle_triangle.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"
#include "tests/support/inside/clustered.h"

namespace tact::narrowphase {
namespace {

using tests::Random;

struct LinePlaces {
  long double on_first = -1.0L, height = 0.0L;
  bool inside_both = false;
};

// Where two lines are nearest, in long doubles.
LinePlaces places_of_lines(const EdgeEnds& e, const EdgeEnds& f) {
  using Long = std::array<long double, 3>;
  const auto away = [](const Vec3& from, const Vec3& to) {
    return Long{static_cast<long double>(to.x) - from.x, static_cast<long double>(to.y) - from.y,
                static_cast<long double>(to.z) - from.z};
  };
  const auto product = [](const Long& x, const Long& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; };
  const Long u = away(e.p, e.q), w = away(f.p, f.q), r = away(e.p, f.p);
  const long double uu = product(u, u), uw = product(u, w), ww = product(w, w), ur = product(u, r), wr = product(w, r);
  const long double determinant = uu * ww - uw * uw;
  if (!(determinant > 1e-6L * uu * ww)) return {};
  const long double s = (ur * ww - uw * wr) / determinant, t = (ur * uw - uu * wr) / determinant;
  long double square = 0.0L;
  for (std::size_t k = 0; k < 3; ++k) square += (r[k] + t * w[k] - s * u[k]) * (r[k] + t * w[k] - s * u[k]);
  return {s, std::sqrt(square), s > 0 && s < 1 && t > 0 && t < 1};
}

// An edge that runs through a wrinkled ball: whatever edge of the ball is nearest to its inside, between the first and
// the last facet that it meets, is among those that are found, and most others are not.
TEST(EdgesBeside, HoldEveryEdgeThatIsNearestToThePartInside) {
  Random random(8);
  const ClusteredMesh ball = tests::clustered(tests::blob(3, 1.0, 0.15, 5));
  const Features features(ball);
  std::int64_t found_edges = 0, all_edges = 0, nearest = 0;
  int runs = 0;
  EdgesBeside beside;
  for (int trial = 0; trial < 400; ++trial) {
    const double scale = trial % 2 == 0 ? 0.5 : 1.0, within = trial % 3 == 0 ? 0.05 : 2.0;
    const ScaledMesh surface{ball, features, scale};
    const Vec3 middle = 0.95 * normalized(random.in_cube(1.0)),
               along = (trial % 4 == 0 ? 4.0 : 0.6) * random.in_cube(1.0);
    const Segment edge{middle - along, middle + along};
    EdgeThrough running({scale * edge[0], scale * edge[1]});
    std::vector<long double> places;
    PredicateCounts counts;
    for (int f = 0; f < ball.facet_count(); ++f) {
      const Triangle t = ball.triangle(f);
      if (!segment_triangle_meet(edge, t, counts)) continue;
      running.add_hit(surface.triangle(f));
      const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
      places.push_back(dot(normal, t[0] - edge[0]) / dot(normal, edge[1] - edge[0]));
    }
    if (places.size() < 2) continue;
    ++runs;
    const auto [first, last] = std::ranges::minmax(places);
    const auto found = beside.find(running, surface, within);
    const std::vector<int> listed(found.begin(), found.end());
    EXPECT_TRUE(std::ranges::is_sorted(listed));
    for (int f = 0; f < features.edge_count(); ++f) {
      const EdgeVertices ends = features.edge(f);
      const LinePlaces at =
          places_of_lines({scale * edge[0], scale * edge[1]}, {surface.position(ends[0]), surface.position(ends[1])});
      if (!at.inside_both || !(at.height < within) || at.on_first < first || at.on_first > last) continue;
      ++nearest;
      EXPECT_TRUE(std::ranges::binary_search(listed, f)) << "edge " << f << " trial " << trial;
    }
    found_edges += static_cast<std::int64_t>(listed.size());
    all_edges += features.edge_count();
  }
  EXPECT_GT(runs, 50);
  EXPECT_GT(nearest, 500);
  EXPECT_LT(2 * found_edges, all_edges);
}

// A facet along which the edge runs tells nothing: the whole edge is looked at.
TEST(EdgeThrough, IsWholeWhereAFacetIsMetAtNextToNoAngle) {
  EdgeThrough cut({{0, 0, 0}, {1, 0, 0}}), flat = cut;
  for (EdgeThrough* one : {&cut, &flat}) {
    one->add_hit({Vec3{0.4, -1, -1}, Vec3{0.4, 1, -1}, Vec3{0.4, 0, 1}});
    one->add_hit({Vec3{0.6, -1, -1}, Vec3{0.6, 1, -1}, Vec3{0.6, 0, 1}});
  }
  flat.add_hit({Vec3{0.2, -1, -1e-9}, Vec3{0.8, -1, 1e-9}, Vec3{0.5, 1, 0}});
  const Box before{{0.1, 0, 0}, {0.2, 1, 1}}, between{{0.45, 0, 0}, {0.5, 1, 1}}, beyond{{1.1, 0, 0}, {1.2, 1, 1}};
  EXPECT_FALSE(cut.reaches(before));
  EXPECT_TRUE(cut.reaches(between));
  EXPECT_TRUE(flat.reaches(before));
  EXPECT_FALSE(flat.reaches(beyond));
}

}  // namespace
}  // namespace tact::narrowphase
