// Contact points with other libraries' boxes: facets' boxes, grown by the margins, propose pairs of facets, and a plain
// loop over their vertices and edges finds the points. Pairs of bodies are found, and points decided, as tact does it:
// what is compared is the way from bodies to features.
//
// Distances have no sign. The rival that tells signs, too, finds what a solver needs where surfaces cross: which
// vertices are inside. It still knows no sides of sheets, no signs of edges and no sides that a body came from.
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

/// A vertex inside the other body, and how far it is to that body's surface.
struct CrossedVertex {
  int body_a = 0, body_b = 0;
  FeaturePair kind = FeaturePair::vertex_facet;
  int vertex = 0;
  double depth = 0.0;  // metres

  auto key() const { return std::tie(body_a, body_b, kind, vertex); }
};

class NearRival {
 public:
  virtual ~NearRival() = default;
  /// From the positions of `frame` to the complete list of points. Fixed bodies were read when it was made.
  virtual void step(int frame) = 0;
  /// What the last step found, sorted.
  virtual std::vector<NearPoint> points() const = 0;
  /// Of those that tell signs, too.
  virtual std::vector<CrossedVertex> crossed() const { return {}; }
};

// Each in one thread. `margins`: one a body, metres. The workload outlives it.

/// A tree a body, refitted in every frame.
std::unique_ptr<NearRival> make_near_embree(const Workload& workload, const std::vector<double>& margins);
/// The same; and where surfaces cross, which vertices are inside a closed body, and how deep, by rays and point queries
/// into these trees.
std::unique_ptr<NearRival> make_signed_embree(const Workload& workload, const std::vector<double>& margins);
/// Nothing is kept between frames.
std::unique_ptr<NearRival> make_near_cgal(const Workload& workload, const std::vector<double>& margins);

}  // namespace tact::bench
