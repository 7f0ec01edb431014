// What World::check_surface() finds of a body's surface.
#pragma once

#include <tact/error.h>
#include <tact/facet_pair.h>

#include <array>
#include <vector>

namespace tact {

/// Facets that are joined by edges.
struct SurfaceComponent {
  int facet = 0;            ///< the first of its facets
  int facet_count = 0;      ///< how many there are
  bool closed = false;      ///< each edge joins two facets, which run along it in opposite directions
  bool inside_out = false;  ///< closed, and its facets are clockwise seen from outside
};

/// A body's surface, by its vertices and facets as they were added. Edges have the smaller vertex first, and all lists
/// are sorted.
struct SurfaceCheck {
  std::vector<SurfaceComponent> components;           ///< by their first facet
  std::vector<std::array<int, 2>> border_edges;       ///< edges of one facet
  std::vector<std::array<int, 2>> branching_edges;    ///< edges of three or more facets
  std::vector<int> turned_facets;                     ///< facets turned against most of their component
  std::vector<FacetPair> crossings;                   ///< facets that meet beyond what neighbours share
  std::vector<std::array<int, 2>> repeated_facets;    ///< a facet, and the first with the same corners
  std::vector<std::array<int, 2>> repeated_vertices;  ///< a vertex, and the first at the same place
  std::vector<int> slivers;                           ///< facets of hardly any height, or of no area
  std::vector<int> unused_vertices;                   ///< vertices of no facet, edge or point

  /// Whether it bounds a solid: there is a component, every one is closed, and none is inside out.
  TACT_API bool is_solid() const;
  /// Whether every list of faults is empty; borders are none, nor are unused vertices.
  TACT_API bool is_clean() const;
};

}  // namespace tact
