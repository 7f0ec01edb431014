// Where two bodies touch in several places, each place with a direction and depth of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/bodies/bodies.h"
#include "engine/patch_set.h"

namespace tact {

/// Two bodies, or one twice, and what was found between them.
struct PatchInput {
  const Body& a;
  const Body& b;
  base::Vec3 direction;                    // of the contact, for a patch that has no other
  double reach = 0.0;                      // the sum of the margins
  std::span<const FacetPair> facet_pairs;  // sorted
  std::span<ContactPoint> points;          // sorted
  const PatchSet* last = nullptr;          // of the step before
};

/// Memory of a thread, used again.
class PatchFinder {
 public:
  /// Writes the number of its patch into each point. Facet pairs are neighbours if they share a facet; points if they
  /// share a vertex of either body and their normals are not opposite; a point and a facet pair if a vertex of the
  /// point is a corner of the facet of the same body; points with a plane also if an edge joins their vertices. Patches
  /// are numbered by their first facet pair, then by their first point. Returns how many there are.
  int number(std::span<const FacetPair> facet_pairs, std::span<ContactPoint> points, const Body* a, const Body* b);

  /// All but the ids.
  void find(const PatchInput& input, PatchSet& set);

 private:
  struct PointAtVertex {
    int point;
    int next;  // of the same vertex, -1: none
  };
  struct PlanePoint {
    double x, y;
    friend auto operator<=>(const PlanePoint&, const PlanePoint&) = default;
  };
  /// Points of a patch, by their places in Patch::points.
  struct Spanned {
    std::array<std::size_t, 4> place{};
    std::size_t count = 0;
  };
  /// A point that spanned a patch in the last step.
  struct LastSpanning {
    std::uint64_t id = 0;
    std::size_t patch = 0, place = 0;  // which patch, and which of its four
  };
  int root(int i);
  void join(int i, int k);
  void join_facet_pairs(std::span<const FacetPair> pairs);
  void join_facets_by_corners(std::span<const FacetPair> pairs, const Body& a, const Body& b);
  void join_points(std::span<const ContactPoint> points, int first_point, const Body* a, const Body* b);
  void join_at_vertex(std::span<const ContactPoint> points, int first_point, int point, std::size_t vertex,
                      bool by_normal);
  void join_along_edges(std::span<const ContactPoint> points, int first_point, const Body& body, int side);
  void join_points_and_facets(std::span<const FacetPair> pairs, const Body* a, const Body* b);
  void list_members(const PatchInput& input, int count, PatchSet& set);
  void shape_by_points(const PatchInput& input, Patch& patch);
  void list_counting(const PatchInput& input, const Patch& patch);
  void list_last_spanning(const PatchSet* last);
  Spanned find_spanning(const PatchInput& input, const Patch& patch, double scale) const;
  Spanned find_last_spanning(const PatchInput& input, const Patch& patch, const PatchSet& last);
  static double turn(PlanePoint p, PlanePoint q, PlanePoint r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }
  /// Twice what s adds to the area of the triangle of the others.
  static double area_beside(PlanePoint p, PlanePoint q, PlanePoint r, PlanePoint s) {
    const double side = turn(p, q, r) > 0.0 ? 1.0 : -1.0;
    return std::max({-side * turn(p, q, s), -side * turn(q, r, s), -side * turn(r, p, s)});
  }
  double area_spanned(const Spanned& spanned) const;
  void span(const PatchInput& input, Patch& patch, Spanning& spanning, double scale);
  double area_of_hull(double scale);

  std::vector<int> parent_, number_, by_b_, begin_;
  std::vector<int> first_at_vertex_;      // by vertex, as in PatchVertex; -1: none
  std::vector<PointAtVertex> at_vertex_;  // of the points at a vertex, one for each way that normals point
  std::vector<PatchVertex> corners_;      // of facets that meet a plane, and the numbers of their pairs
  std::vector<base::Vec3> places_;        // of the members of a patch
  std::vector<PlanePoint> flat_, hull_;
  std::vector<std::size_t> counting_;        // of the points of a patch, those that may span it
  std::vector<base::Vec3> minimum_normals_;  // of its minima, each way once
  std::vector<LastSpanning> last_spanning_;  // sorted by ids
  std::vector<Spanned> last_spanned_;        // of each patch of the last step; empty but while one of now is looked at
  std::vector<std::size_t> met_;             // patches of the last step that were spanned by points of this one
};

}  // namespace tact
