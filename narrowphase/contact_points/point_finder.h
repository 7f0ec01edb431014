// The contact points among features of two meshes, or of one with itself, that lie side by side in open clusters.
#pragma once

#include <span>
#include <vector>

#include "narrowphase/contact_points/contact_points.h"
#include "narrowphase/contact_points/near_features.h"
#include "narrowphase/contact_points/waiting_edges.h"
#include "narrowphase/distance/surface_distance.h"

namespace tact::narrowphase {

class PointFinder {
 public:
  /// Memory is lent by `waiting` and `ways`; points are appended to `found`.
  PointFinder(const ScaledMesh& a, const ScaledMesh& b, double reach, const NearRules& rules, WaitingEdges& waiting,
              SurfaceWays& ways, std::vector<FeaturePoint>& found)
      : a_(a),
        b_(b),
        rules_(rules),
        same_(&a.mesh == &b.mesh),
        reach_(reach),
        found_(found),
        waiting_(waiting),
        ways_(ways) {}

  /// Of two open clusters. The boxes of `a` are wider by the reach.
  void search(const OpenFeatures& a, const OpenFeatures& b);
  /// Looks at all that waits.
  void finish();

 private:
  // A vertex and a facet, the meshes that they are of, and where they are.
  struct VertexAndFacet {
    const ScaledMesh &m, &surface;
    FeaturePair kind;
    int vertex, facet;
    Vec3 v;
    Vec3 corner[3];
  };

  void from_vertices(const OpenFeatures& one, const OpenFeatures& other, const NearFacets& near, FeaturePair kind);
  bool is_settled_corner(const VertexAndFacet& one) const;
  void look_inside_facet(const VertexAndFacet& one);
  void look_at_border(const VertexAndFacet& one);
  Vec3 way_where_they_touch(const ScaledMesh& surface, std::span<const int> feature, bool of_a) const;
  void add_vertex_point(const VertexAndFacet& pair, std::span<const int> feature, const Nearest& nearest);
  void add_edges(int e, int f);
  void look_at_edges(int e, int f);
  void add_edge_point(int edge_e, const EdgeEnds& at_e, int edge_f, const Nearest& nearest);
  bool runs_inside(std::span<const int> of_a, std::span<const int> of_b, Vec3 normal) const;
  void add(FeaturePoint point);

  const ScaledMesh a_, b_;
  const NearRules rules_;
  const bool same_;
  const double reach_;
  std::vector<FeaturePoint>& found_;
  WaitingEdges& waiting_;
  SurfaceWays& ways_;
};

}  // namespace tact::narrowphase
