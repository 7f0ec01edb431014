// Contact points with other libraries' boxes: facets' boxes, grown by the margins, propose pairs of facets, and a plain
// loop over their vertices and edges finds the points. Pairs of bodies are found, and points decided, as tact does it:
// what is compared is the way from bodies to features.
#pragma once

#include <tact/feature_pair.h>

#include <array>
#include <compare>
#include <memory>
#include <vector>

#include "bench/workloads/workloads.h"

namespace tact::bench {

struct NearPoint {
  int body_a = 0, body_b = 0;
  FeaturePair kind = FeaturePair::vertex_facet;
  std::array<int, 3> a{}, b{};  // vertices by the workload's numbers; -1 fills up
  double gap = 0.0;             // metres

  auto key() const { return std::tie(body_a, body_b, kind, a, b); }
};

enum class NearBoxes { embree, cgal };

class NearRival {
 public:
  virtual ~NearRival() = default;
  // From the positions of `frame` to the complete list of points. Fixed bodies were read when it was made.
  virtual void step(int frame) = 0;
  // What the last step found, sorted.
  virtual std::vector<NearPoint> points() const = 0;
};

// In one thread. `margins`: one a body, metres. The workload outlives it.
std::unique_ptr<NearRival> make_near_rival(NearBoxes boxes, const Workload& workload,
                                           const std::vector<double>& margins);

}  // namespace tact::bench
