// Where two facets are nearest.
#pragma once

#include <array>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

/// The places of two triangles that are nearest, as weights of their corners.
struct NearestOfFacets {
  std::array<double, 3> first{}, second{};
  Vec3 way{};                      // from the first place to the second; no unit vector
  double distance = 0.0;           // in the unit of the corners
  int vertex_of = -1, vertex = 0;  // 0, 1: the place of the first, or second, is this corner; -1: both are inside edges
};

/// Of two triangles that do not meet and whose lengths are near 1 or below: a vertex and a facet, or two edges. Of
/// equally near ones the first counts. Triangles may be degenerate.
NearestOfFacets nearest_of_facets(const Triangle& t, const Triangle& u);

/// A place that two triangles share that meet: what is in a corner of one, or where an edge goes through.
NearestOfFacets common_place(const Triangle& t, const Triangle& u);

}  // namespace tact::narrowphase
