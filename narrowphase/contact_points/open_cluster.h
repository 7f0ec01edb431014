// A cluster's features side by side: where their corners are, and their boxes, for loops that compare many at once.
#pragma once

#include "narrowphase/contact_points/open_features.h"

namespace tact::narrowphase {

/// Features with kCorners corners each, numbered in the mesh from `first` on; scaled.
template <int kCorners, int kMostFeatures>
struct PlacedFeatures : FixedBoxes<kMostFeatures> {
  using Boxes = FixedBoxes<kMostFeatures>;
  using Boxes::bounds, Boxes::count;
  int first = 0;
  double at[kCorners][3][kMostFeatures];  // corner, axis

  Vec3 corner(int c, int i) const { return {at[c][0][i], at[c][1][i], at[c][2][i]}; }

  /// Takes corner number corner(c, i) of `vertices` for corner c of feature i.
  template <int kVertices, class Corner>
  void take(int first_of_all, int number_of_all, const double (&vertices)[3][kVertices], const Corner& corner) {
    first = first_of_all;
    count = number_of_all;
    for (int c = 0; c < kCorners; ++c) {
      for (int i = 0; i < count; ++i) {
        const int v = corner(c, i);
        for (int axis = 0; axis < 3; ++axis) at[c][axis][i] = vertices[axis][v];
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < count; ++i) {
        double low = at[0][axis][i], high = low;
        for (int c = 1; c < kCorners; ++c) {
          const double x = at[c][axis][i];
          low = x < low ? x : low;
          high = x > high ? x : high;
        }
        bounds[axis][i] = low;
        bounds[axis + 3][i] = high;
      }
    }
  }
};

using PlacedFacets = PlacedFeatures<3, kClusterSize>;

/// The positions of a cluster's vertices, owned ones first, scaled.
struct ClusterVertices {
  static constexpr int kMost = 3 * kClusterSize;
  double at[3][kMost];

  void take(const ClusterFacets& facets, double scale) {
    const double* const from[3] = {facets.points.x, facets.points.y, facets.points.z};
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < facets.owned_count; ++i) at[axis][i] = scale * from[axis][facets.owned_begin + i];
      for (int i = 0; i < facets.borrowed_count; ++i)
        at[axis][facets.owned_count + i] = scale * from[axis][facets.borrowed[i]];
    }
  }
};

inline void take_facets(const ClusterFacets& facets, const ClusterVertices& vertices, PlacedFacets& placed) {
  placed.take(facets.facet_begin, facets.facet_count, vertices.at, [&](int c, int i) { return facets.corner[c][i]; });
}



}  // namespace tact::narrowphase
