// What the rivals share: a test of two facets, and lists of those that meet, one a thread.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "bench/rivals/rival.h"
#include "bench/workloads/workloads.h"
#include "engine/base/box.h"

namespace tact::bench {

using FacetCorners = std::array<base::Vec3, 3>;

// A body's mesh at one frame, where the caller has it.
struct MeshView {
  const double* positions = nullptr;  // 3 x V
  const int* facets = nullptr;        // 3 x F
  int vertex_count = 0;
  int facet_count = 0;

  base::Vec3 vertex(int v) const { return {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]}; }
  FacetCorners corners(int facet) const {
    const int* corner = facets + 3 * static_cast<std::ptrdiff_t>(facet);
    return {vertex(corner[0]), vertex(corner[1]), vertex(corner[2])};
  }
};

// Do two facets name a common vertex?
inline bool share_a_vertex(const MeshView& mesh, int f, int g) {
  const int *i = mesh.facets + 3 * static_cast<std::ptrdiff_t>(f),
            *k = mesh.facets + 3 * static_cast<std::ptrdiff_t>(g);
  return std::find_first_of(i, i + 3, k, k + 3) != i + 3;
}

inline MeshView view_of(const WorkloadBody& body, int frame) {
  const Eigen::Matrix3Xd& positions = body.positions(frame);
  return {positions.data(), body.facets.data(), static_cast<int>(positions.cols()),
          static_cast<int>(body.facets.cols())};
}

inline base::Box box_of(const FacetCorners& t) {
  return base::extended(base::extended(base::Box{t[0], t[0]}, t[1]), t[2]);
}

// Do the facets share a point? By CGAL, so that no code is shared with tact, with filtered predicates: right whatever
// the facets are. Facets must have an area.
template <class Kernel>
bool facets_meet_in(const FacetCorners& s, const FacetCorners& t) {
  const auto point = [](const base::Vec3& p) { return typename Kernel::Point_3(p.x, p.y, p.z); };
  return CGAL::do_intersect(typename Kernel::Triangle_3(point(s[0]), point(s[1]), point(s[2])),
                            typename Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2])));
}

// Of three heights over a plane, not all on one side: which corner is alone on its side, and on which? A height of zero
// counts as below where one is above, else as above.
struct LoneCorner {
  std::size_t corner = 0;
  bool above = false;

  explicit LoneCorner(const std::array<double, 3>& height) {
    const bool any_above = height[0] > 0.0 || height[1] > 0.0 || height[2] > 0.0;
    const auto is_above = [&](std::size_t k) { return any_above ? height[k] > 0.0 : height[k] >= 0.0; };
    corner = is_above(1) == is_above(2) ? 0 : is_above(0) == is_above(2) ? 1 : 2;
    above = is_above(corner);
  }
};

// Six times that of the tetrahedron of four points; positive if d is above the plane of a, b, c.
inline double volume(const base::Vec3& a, const base::Vec3& b, const base::Vec3& c, const base::Vec3& d) {
  return dot(cross(b - a, c - a), d - a);
}

// The same by the signs of plain doubles (Guigue and Devillers, 2003), as a program would write it that wants to be
// fast: right where nothing hangs on rounding.
inline bool facets_meet_plainly(const FacetCorners& s, const FacetCorners& t) {
  const auto heights = [](const FacetCorners& plane, const FacetCorners& of) {
    const base::Vec3 normal = cross(plane[1] - plane[0], plane[2] - plane[0]);
    return std::array{dot(normal, of[0] - plane[0]), dot(normal, of[1] - plane[0]), dot(normal, of[2] - plane[0])};
  };
  const auto on_one_side = [](const std::array<double, 3>& h) {
    return (h[0] > 0.0 && h[1] > 0.0 && h[2] > 0.0) || (h[0] < 0.0 && h[1] < 0.0 && h[2] < 0.0);
  };
  const std::array<double, 3> of_s = heights(t, s);
  if (on_one_side(of_s)) return false;
  const std::array<double, 3> of_t = heights(s, t);
  if (on_one_side(of_t)) return false;
  if (of_s == std::array{0.0, 0.0, 0.0}) return facets_meet_in<CGAL::Simple_cartesian<double>>(s, t);
  // Each crosses the other's plane: do the two pieces of the common line overlap?
  const LoneCorner of_s_alone(of_s), of_t_alone(of_t);
  const auto turned = [](const FacetCorners& x, std::size_t first, bool reversed) {
    const base::Vec3 &next = x[(first + 1) % 3], &last = x[(first + 2) % 3];
    return reversed ? FacetCorners{x[first], last, next} : FacetCorners{x[first], next, last};
  };
  const FacetCorners p = turned(s, of_s_alone.corner, !of_t_alone.above);
  const FacetCorners q = turned(t, of_t_alone.corner, !of_s_alone.above);
  return volume(p[0], p[1], q[0], q[1]) <= 0.0 && volume(p[0], p[2], q[2], q[0]) <= 0.0;
}

inline bool facets_meet(const MeshView& a, int facet_a, const MeshView& b, int facet_b, TriangleTest test) {
  const FacetCorners s = a.corners(facet_a), t = b.corners(facet_b);
  if (!base::overlaps(box_of(s), box_of(t))) return false;
  return test == TriangleTest::exact ? facets_meet_in<CGAL::Exact_predicates_inexact_constructions_kernel>(s, t)
                                     : facets_meet_plainly(s, t);
}

// Threads that pay off: waking them costs more than the whole frame of so small a workload, the organ and the tool.
inline int useful_threads(const Workload& workload, int threads) {
  constexpr std::size_t kSmall = 1000;  // facets
  return workload.facet_count() < kSmall ? 1 : threads;
}

// Lists that keep their memory from step to step.
class MeetingLists {
 public:
  explicit MeetingLists(int threads) : lists_(static_cast<std::size_t>(threads)) {}

  void clear() {
    for (List& list : lists_) list.meetings.clear();
  }
  std::vector<FacetMeeting>& of_thread(int thread) { return lists_[thread].meetings; }
  std::vector<FacetMeeting> sorted() const {
    std::vector<FacetMeeting> all;
    for (const List& list : lists_) all.insert(all.end(), list.meetings.begin(), list.meetings.end());
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  struct alignas(64) List {  // a cache line of its own
    std::vector<FacetMeeting> meetings;
  };
  std::vector<List> lists_;
};

}  // namespace tact::bench
