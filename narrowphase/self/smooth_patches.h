// Which pairs of clusters of one mesh cannot meet, or cannot be in contact, because the surface around them is smooth:
// shown from the directions of normals and a test of boundaries, after Volino and Magnenat-Thalmann ("Efficient
// self-collision detection on smoothly discretized surface animations using geometrical shape regularity", 1994) and
// Provot ("Collision and self-collision handling in cloth model dedicated to design garments", 1997). Of the 1994 test
// the condition on the boundary is kept, in a form that is cheap; without it the test of normals proves nothing.
//
// **What is proved.** Let P be the facets of some clusters, and v a direction with n · v > 0 for the normal n of every
// facet of P. Seen along v the facets then are triangles in the plane, all with the same orientation. Their *boundary*
// is that of the chain of these triangles: each edge that one facet of P has and no other one has against it. Let D be
// a closed convex set of the plane that the boundary avoids. How many of the triangles cover a point of D is the
// winding number of the boundary about it, the same for all of D (points on edges apart). Is it 1, the triangles tile
// D: none overlaps another one, and above D the surface is the graph of a function.
//
//   1. Facets that lie above D meet only where they share a vertex or an edge. For let two have a point x. Every edge
//      above D has a facet on either side, and the facets around a vertex go round it: those at the smallest feature of
//      the one that holds x cover all around x, so the other one, which overlaps none of them, is one of them.
//   2. Is every normal within an angle t < 45 degrees of v, no place of the surface above D is a local minimum of the
//      distance from another one, at any distance. For let q be seen from p along the straight way in D, d long: the
//      surface rises along it by at most d tan t, so the distance falls, as one leaves p along it, at a rate of at
//      least d (1 - tan² t) over the distance. So there is no contact point, see nearest.h.
//
// **Where the surface ends**, at edges that only one facet of all has, P is continued: by strips that run from these
// edges straight on in one direction o of the plane, if no edge runs against that. They count as triangles do, and what
// is left as boundary are the rays at the ends of a chain of such edges. 1 holds as it stands. In 2 the straight way
// may leave the surface and come back; there it follows the edges instead. Let m < 90 degrees be the most by which the
// edges turn inwards on any part of a chain. Where the straight way leaves the surface and comes back, the edges
// between turn by more than 0 inwards, and none of them deviates by more than m from the straight way. So the way along
// them is at most d / cos m long, and p is left at a rate of at least d (cos m - tan² t / cos m): tan t < cos m will
// do.
//
// **Where D is not needed.** If the boundary is one closed line that, seen along v, does not come to any place twice,
// no point is covered more than once, as no winding number about such a line is beyond 1. Then facets of P meet only
// where they share a vertex, those at the boundary among them. For a point x of two facets that is not seen on the
// boundary 1 holds as it stands. If x is seen on it, within an edge, that edge's facet covers all of P's side around x,
// and no other facet holds x. At a vertex of it that do the facets around the vertex, which go from the one of its two
// edges to the other, and all that hold x are among them.
//
// **How it is tested.** For some clusters that lie together, P is all clusters around them, v the mean of their axes,
// and D a polygon around the given ones. In tight turns such a P leaves the half space of v, and P is three
// or four clusters that meet at a vertex, without D. Cones bound the normals of each cluster. All is computed in
// doubles, with bounds of rounding (kSlack, kViewSlack), and what they cannot tell is not proved.
//
// **What is not proved** is anything else: clusters in folds, at borders with notches, around edges that three facets
// have. They are looked at facet by facet. A proof changes no answer.
#pragma once

#include <array>
#include <vector>

#include "narrowphase/pairs/cluster_pair.h"
#include "narrowphase/self/cluster_neighbors.h"

namespace tact::narrowphase {

/// A cone of less than 90 degrees about its axis that holds the normals of a cluster's facets. If there is none, or
/// rounding cannot tell, all is zero: then its normals have a cosine of zero with every direction.
struct NormalCone {
  Vec3 axis;                        // unit
  double cosine = 0.0, sine = 0.0;  // of the half angle
};

/// A box, that of the vertices of a rim.
struct RimBox {
  Vec3 middle, half;  // half its edges
};

/// What is known of two clusters of one mesh, or of one with itself.
enum class SelfVerdict {
  open,          ///< nothing
  never_meet,    ///< facets meet in the vertices and edges that they share alone
  never_contact  ///< nor is there a contact point, at any distance
};

class SmoothPatches {
 public:
  /// To be called when the mesh has moved, then look_at() for each cluster, in any order.
  void begin(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors);
  void look_at(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors, int cluster);

  /// True if facets of the clusters at a corner certainly meet in the vertices and edges that they share alone. Shown
  /// without D.
  bool never_meet_at(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors, int corner) const;

  /// Memory of a thread, used again.
  class Judge {
   public:
    /// Of all pairs of some different clusters, and each with itself; the more these are, the less is proved.
    SelfVerdict operator()(const SmoothPatches& patches, const ClusteredMesh& mesh, const ClusterNeighbors& neighbors,
                           std::span<const int> clusters);

   private:
    // A plane to look at the mesh in, and a point in it.
    struct View {
      Vec3 origin, x, y;
    };
    struct Flat {
      double x, y;
    };
    // A convex polygon in it: where it lies along x, y and some directions between.
    static constexpr int kBetween = 6;
    struct Region {
      double low_x, high_x, low_y, high_y;
      double low[kBetween], high[kBetween];
      double ray() const { return 0.5 * (low_x + high_x); }
    };
    // A vertex of the boundary: which sides of a rectangle it lies beyond.
    struct Seen {
      Flat at;
      unsigned beyond;
    };
    // An edge at which the surface ends.
    struct End {
      ClusterNeighbors::Side side;
      Flat from, to;
    };
    enum class Boundary { crosses, ends, avoids };  // `ends`: but for edges at which the surface ends

    bool gather(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors, std::span<const int> clusters);
    bool in_patch(int cluster) const { return marks_[cluster] >= mark_; }
    bool in_core(int cluster) const { return marks_[cluster] > mark_; }
    Vec3 along(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors, std::span<const int> clusters) const;
    static Flat seen(const View& view, Vec3 p) {
      const Vec3 d = p - view.origin;
      return {dot(view.x, d), dot(view.y, d)};
    }
    static std::array<double, kBetween> between(const Flat& p) {
      return {p.y + p.x, p.y - p.x, p.y + 2 * p.x, p.y - 2 * p.x, 2 * p.y + p.x, 2 * p.y - p.x};
    }
    Region region_of(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors, std::span<const int> clusters,
                     const View& view) const;
    static bool lies_beyond(const Region& region, const Flat& p, const Flat& q, bool& above);
    double half_along(const RimBox& rim, Vec3 axis) const;
    bool passes_by(const RimBox& rim, const View& view, const Region& region) const;
    bool walk_along(const ClusteredMesh& mesh, const ClusterNeighbors& neighbors, const ClusterNeighbors::Rim& rim,
                    const View& view, const Region& region, int& covered);
    Boundary walk(const SmoothPatches& patches, const ClusteredMesh& mesh, const ClusterNeighbors& neighbors,
                  const View& view, const Region& region);
    SelfVerdict look(const SmoothPatches& patches, const ClusteredMesh& mesh, const ClusterNeighbors& neighbors,
                     std::span<const int> clusters, Vec3 up, double least_cosine);
    bool continues(const Region& region);
    double cosine_of_inward_turn() const;

    // Of each cluster: mark_ if it is one of the patch, mark_ + 1 if it is one of the given ones.
    std::vector<int> marks_;
    int mark_ = 0;
    std::vector<int> patch_;
    double slack_ = 0.0;
    std::vector<End> ends_;
  };

 private:
  // A direction to look at some clusters along.
  struct Outlook {
    Vec3 up;
    double least_cosine =
        0.0;            // its angle with every normal has at least this cosine; zero: there is no such direction
    double size = 0.0;  // of the box of the clusters: the sum of its sides
  };

  void find_cone(const ClusteredMesh& mesh, int cluster);
  Outlook outlook_on(const ClusteredMesh& mesh, std::span<const int> clusters) const;

  std::vector<NormalCone> cones_;
  std::vector<RimBox> rims_;  // as ClusterNeighbors counts them
  bool usable_ = false;
};

}  // namespace tact::narrowphase
