// Something that finds the facets that meet: tact, or a library it is held against.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bench/workloads/workloads.h"

namespace tact::bench {

// A facet of one body meets one of another; body_a < body_b.
struct FacetMeeting {
  std::int32_t body_a = 0;
  std::int32_t body_b = 0;
  std::int32_t facet_a = 0;
  std::int32_t facet_b = 0;
  friend auto operator<=>(const FacetMeeting&, const FacetMeeting&) = default;
};

class Rival {
 public:
  virtual ~Rival() = default;
  Rival() = default;
  Rival(const Rival&) = delete;
  Rival& operator=(const Rival&) = delete;

  // All that is timed: from the positions of `frame`, doubles in the workload's memory, to the complete list of pairs
  // of facets that meet, in memory of its own. Fixed bodies were read when it was made.
  virtual void step(int frame) = 0;
  // The list that the last step made, sorted.
  virtual std::vector<FacetMeeting> meetings() const = 0;
};

struct RivalKind {
  std::string name;
  // The workload outlives the rival. At most `threads` threads run.
  std::unique_ptr<Rival> (*make)(const Workload& workload, int threads) = nullptr;
  // Some decide triangles, or their boxes, with rounding. They compete where they find every pair, and need not.
  bool complete = true;
};

// How rivals decide what their boxes propose, see meeting_lists.h.
enum class TriangleTest { exact, plain };

std::unique_ptr<Rival> make_tact(const Workload& workload, int threads);
std::unique_ptr<Rival> make_embree_scene_a_body(const Workload& workload, int threads);
std::unique_ptr<Rival> make_embree_scene_a_body_plain(const Workload& workload, int threads);
std::unique_ptr<Rival> make_embree_one_scene(const Workload& workload, int threads);
std::unique_ptr<Rival> make_cgal_boxes(const Workload& workload, int threads);
std::unique_ptr<Rival> make_cgal_clipped(const Workload& workload, int threads);
std::unique_ptr<Rival> make_cgal_clipped_plain(const Workload& workload, int threads);
std::unique_ptr<Rival> make_fcl_aabb(const Workload& workload, int threads);
std::unique_ptr<Rival> make_fcl_obbrss(const Workload& workload, int threads);
std::unique_ptr<Rival> make_fcl_own_test(const Workload& workload, int threads);
std::unique_ptr<Rival> make_bullet_gimpact(const Workload& workload, int threads);

// All but tact.
std::vector<RivalKind> all_rivals();

// Facets of one body that name no common vertex and meet, which all of these find: the bodies of a workload against
// themselves alone. What neighbours share beyond their vertices, tact alone and CGAL look at, in the time that is told.
std::unique_ptr<Rival> make_tact_self(const Workload& workload, int threads);
std::unique_ptr<Rival> make_embree_self(const Workload& workload, int threads);
std::unique_ptr<Rival> make_embree_self_plain(const Workload& workload, int threads);
std::unique_ptr<Rival> make_cgal_self(const Workload& workload, int threads);

}  // namespace tact::bench
