// Where two parts of surfaces touch last as they are moved apart along a direction.
#pragma once

#include <cstddef>
#include <vector>

#include "narrowphase/contact_points/feature_point.h"
#include "narrowphase/crossing/surface_part.h"

namespace tact::narrowphase {

/// Buffers are reused.
class LastTouch {
 public:
  /// Appends the points of vertices and facets that touch last as b is moved along `direction`, a unit vector; those of
  /// two edges if there are no such vertices. Each gap is the negative of the way until then. At least one, of parts
  /// that meet.
  void append_points(const SurfacePart& a, const SurfacePart& b, Vec3 direction, std::vector<FeaturePoint>& found);

 private:
  /// Seen along the direction: x and y across it, z along it, so far above a point near both.
  struct SeenFacet {
    int facet, place;  // by the mesh's number; in the part
    Vec3 corner[3];
    double bottom, top;
  };
  /// Features that touch, and after which way.
  struct Touch {
    FeaturePair kind;
    int facet_a, facet_b;             // by the meshes' numbers
    int corner_a, corner_b;           // the vertex, or where the edge begins
    double weight_a[3], weight_b[3];  // of the facet's corners
    double way;
  };

  void see(const SurfacePart& part, std::vector<SeenFacet>& seen) const;
  void look_at(const SeenFacet& a, const SeenFacet& b);
  void look_at_vertex(const SeenFacet& own, const SeenFacet& other, int corner, bool of_a);
  void look_at_edges(const SeenFacet& a, const SeenFacet& b, int edge_a, int edge_b);
  void take(const Touch& touch);
  FeaturePoint point_of(const Touch& touch, const SurfacePart& a, const SurfacePart& b) const;

  Vec3 origin_, u_, v_, direction_;
  std::vector<SeenFacet> a_, b_;
  std::vector<Touch> touches_;
  std::vector<FeaturePoint> points_;  // of these
  std::vector<std::size_t> order_;    // of points
  double last_way_ = 0.0;
};

}  // namespace tact::narrowphase
