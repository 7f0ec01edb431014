// From a vertex that is past a surface: the nearest place on the surface through which it leaves.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "narrowphase/contact_points/feature_point.h"
#include "narrowphase/crossing/facing_clusters.h"

namespace tact::narrowphase {

/// The place of a surface where a vertex leaves; lengths in the unit of the mesh.
struct NearestExit {
  int facet = -1;         // by the mesh's number, with the place in it
  double distance = 0.0;  // from the vertex
  Vec3 direction;         // unit, from the vertex to the place; where these are one, the facet's normal
  PlaceOnFeature place;
};

/// An exit through a sheet, and on which side of it the vertex is.
struct ExitThrough {
  NearestExit exit;
  Vec3 normal;          // of the facet, of any length
  double height = 0.0;  // of the vertex: its sign tells the side, that of `normal` if it is positive

  /// Whether the vertex is on the other side than `facing` shows to.
  bool is_beyond(Vec3 facing) const {
    const double along = dot(normal, facing);
    return (along > 0.0 && height < 0.0) || (along < 0.0 && height > 0.0);
  }
};

/// The place of a facet that is nearest to a vertex.
struct PlaceInFacet {
  int facet = -1;
  double distance = 0.0;
  Vec3 direction;                  // these three as above
  std::array<double, 3> weight{};  // of the corners
};

/// A place of a facet on the smallest feature that has it: corners without weight are left out, the vertices of an edge
/// stand in the caller's order.
PlaceOnFeature place_in_facet(const ScaledMesh& mesh, int facet, const std::array<double, 3>& weights);

/// Of many vertices, one after the other: clusters that were opened for one stay open for the next. Buffers are reused.
class ExitFinder {
 public:
  /// Begins with a surface, which must not move until the next call.
  void begin(const ScaledMesh& surface);
  /// The same for vertices that all lie in `box`, in the unit of the mesh: the facets of exits that are at most
  /// `within` away are opened at once, if they are few.
  void begin(const ScaledMesh& surface, const Box& box, double within);

  /// Of a closed mesh: the nearest place in those facets that see `v` from behind and whose outward normal is nearer to
  /// `facing`, a unit vector, than the angle of this cosine; if one is at most `within` away. Of equally near facets
  /// the one with the least number of the caller. `hint`, a facet or -1, changes no answer.
  std::optional<NearestExit> nearest_exit(Vec3 v, Vec3 facing, double cosine, double within, int hint);

  /// Of a sheet: the nearest place, if it is at most `within` away and not on the sheet's border.
  std::optional<ExitThrough> nearest_exit_through(Vec3 v, double within, int hint);

 private:
  struct OpenCluster {
    int cluster = -1;
    FacetBlock facets;
  };

  bool gather(const Box& box);
  void find_facing_clusters();
  const FacetBlock& facets_of(int cluster);
  template <class Counts>
  std::optional<PlaceInFacet> search(Vec3 v, double within, int hint, const FacingNormals* facing,
                                     const Counts& counts);
  template <class Wants, class Rank, class LookInto>
  void open_clusters(const FacingNormals* facing, const Wants& wants, const Rank& rank, const LookInto& look_into);

  std::optional<ScaledMesh> surface_;
  std::vector<OpenCluster> open_;
  std::vector<FacetBlock> gathered_;  // all facets of exits that are at most `gathered_within_` away
  std::size_t gathered_count_ = 0;
  double gathered_within_ = -1.0;  // scaled; negative: none are gathered
  FacingClusters facing_clusters_;
  int fruitless_ = 0;  // clusters that were looked into for a facet that faces a direction, and had none
};

/// The nearest place of one facet; none if it has no area.
std::optional<NearestExit> exit_to_facet(const ScaledMesh& surface, int facet, Vec3 v);

}  // namespace tact::narrowphase
