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

inline MeshView view_of(const WorkloadBody& body, int frame) {
  const Eigen::Matrix3Xd& positions = body.positions(frame);
  return {positions.data(), body.facets.data(), static_cast<int>(positions.cols()),
          static_cast<int>(body.facets.cols())};
}

inline base::Box box_of(const FacetCorners& t) {
  return base::extended(base::extended(base::Box{t[0], t[0]}, t[1]), t[2]);
}

// Do the facets share a point? By CGAL, so that no code is shared with tact. `exact`: filtered predicates, right
// whatever the facets are. `plain`: the same predicates in doubles as they come, right where nothing hangs on rounding,
// and faster where the filters fail, as on a lattice. Facets must have an area.
template <class Kernel>
bool facets_meet_in(const FacetCorners& s, const FacetCorners& t) {
  const auto point = [](const base::Vec3& p) { return typename Kernel::Point_3(p.x, p.y, p.z); };
  return CGAL::do_intersect(typename Kernel::Triangle_3(point(s[0]), point(s[1]), point(s[2])),
                            typename Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2])));
}

inline bool facets_meet(const MeshView& a, int facet_a, const MeshView& b, int facet_b, TriangleTest test) {
  const FacetCorners s = a.corners(facet_a), t = b.corners(facet_b);
  if (!base::overlaps(box_of(s), box_of(t))) return false;
  return test == TriangleTest::exact ? facets_meet_in<CGAL::Exact_predicates_inexact_constructions_kernel>(s, t)
                                     : facets_meet_in<CGAL::Simple_cartesian<double>>(s, t);
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
  std::vector<FacetMeeting>& of_thread(int thread) { return lists_[static_cast<std::size_t>(thread)].meetings; }
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
