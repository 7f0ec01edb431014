// From a vertex that has crossed a surface: the way back.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

/// The place of a surface that a way leads to; lengths in the unit of the mesh.
struct WayOut {
  int facet = -1;                  // by the mesh's number, with the place in it
  double distance = 0.0;           // from the vertex
  std::array<double, 3> weight{};  // of the facet's corners, for the place
  Vec3 out;                        // unit, from the vertex to the place; where these are one, the facet's normal
  std::array<int, 3> feature{-1, -1, -1};  // the vertices of the smallest feature that holds the place, -1 fills up
  std::array<double, 3> feature_weight{};  // and their weights
};

/// A way to a sheet, and on which side of it the vertex is.
struct WayThrough {
  WayOut way;
  Vec3 normal;          // of the facet, of any length
  double height = 0.0;  // of the vertex: its sign tells the side, that of `normal` if it is positive

  /// Is the vertex on the other side than `facing` shows to?
  bool is_beyond(Vec3 facing) const {
    const double along = dot(normal, facing);
    return (along > 0.0 && height < 0.0) || (along < 0.0 && height > 0.0);
  }
};

/// Of many vertices, one after the other: clusters that were opened for one stay open for the next.
class WayFinder {
 public:
  WayFinder();
  ~WayFinder();
  WayFinder(WayFinder&&) noexcept;
  WayFinder& operator=(WayFinder&&) noexcept;

  /// Begins with a surface, which must not move until the next call.
  void begin(const ScaledMesh& surface);
  /// The same for vertices that all lie in `box`, in the unit of the mesh: the facets that ways not longer than
  /// `within` can lead to are opened at once, if they are few.
  void begin(const ScaledMesh& surface, const Box& box, double within);

  /// Of a closed mesh: the nearest place in those facets that see `v` from behind and whose outward normal is nearer to
  /// `facing`, a unit vector, than the angle of this cosine; if one is at most `within` away. Of equally near facets
  /// the one with the least number of the caller. `hint`, a facet or -1, changes no answer.
  std::optional<WayOut> nearest_out(Vec3 v, Vec3 facing, double cosine, double within, int hint);

  /// Of a sheet: the nearest place, if it is at most `within` away and not on the sheet's border.
  std::optional<WayThrough> nearest_through(Vec3 v, double within, int hint);

 private:
  struct Memory;
  template <class Counts>
  std::optional<WayOut> nearest(Vec3 v, double within, int hint, const FacingNormals* facing, const Counts& counts);

  std::unique_ptr<Memory> memory_;
};

/// The nearest place of one facet; none if it has no area.
std::optional<WayOut> way_to_facet(const ScaledMesh& surface, int facet, Vec3 v);

/// Of a closed mesh: along `direction`, a unit vector, at most `within` far.
std::optional<WayOut> way_out_along(const ScaledMesh& surface, Vec3 v, Vec3 direction, double within);

}  // namespace tact::narrowphase
