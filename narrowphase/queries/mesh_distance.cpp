#include "narrowphase/queries/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/distance/facet_distance.h"
#include "narrowphase/distance/facet_facet.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/queries/facet_pair_descent.h"
#include "narrowphase/queries/mesh_queries.h"
#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

// Lengths are scaled so that no square vanishes or overflows, except where it says metres.
class DistanceSearch {
 public:
  DistanceSearch(const ClusteredMesh& a, const ClusteredMesh& b, double within) : a_(a), b_(b) {
    const Box all = merged(a.box(), b.box());
    scale_ = unit_scale(std::max({all.upper.x - all.lower.x, all.upper.y - all.lower.y, all.upper.z - all.lower.z}));
    best_.value = scale_ * within * kAsNear;
  }

  // The distance of two boxes. Rounding keeps the order of boxes inside each other.
  double rank(const Box& a, const Box& b) const {
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double away = std::max(std::max(a.lower[axis] - b.upper[axis], b.lower[axis] - a.upper[axis]), 0.0);
      square += (scale_ * away) * (scale_ * away);
    }
    return std::sqrt(square);
  }
  bool wants(double rank, int a, int b) const { return best_.wants(rank, a, b); }

  void look_at(int facet_a, int facet_b, double rank) {
    const Triangle t = a_.triangle(facet_a), u = b_.triangle(facet_b);
    const bool meet = overlaps(box_of(t), box_of(u)) && triangle_triangle_meet(t, u, counts_);
    const NearestOfFacets nearest = meet ? NearestOfFacets{} : nearest_of_facets(scaled(t, t[0]), scaled(u, t[0]));
    const double value = meet ? 0.0 : std::max(std::max(nearest.distance, rank), kLeast);
    const int a = a_.source_facet(facet_a), b = b_.source_facet(facet_b);
    if (!best_.wants(value, a, b)) return;
    best_ = {value, a, b};
    nearest_ = nearest;
    first_ = t, second_ = u;
  }

  // In metres.
  std::optional<MeshDistance> found(double within) const {
    if (best_.a < 0) return {};
    const bool meet = best_.value == 0.0;
    const NearestOfFacets place = meet ? common_place(first_, second_) : nearest_;
    const double distance = meet ? 0.0 : std::max(metres(), std::numeric_limits<double>::denorm_min());
    if (distance > within) return {};
    return MeshDistance{best_.a, best_.b, distance, weights_of_source(a_, best_.a, place.first),
                        weights_of_source(b_, best_.b, place.second)};
  }

 private:
  // What is as near as is wanted is not lost by rounding.
  static constexpr double kAsNear = 1.0 + 0x1p-40;
  // Apart, but not by what doubles tell.
  static constexpr double kLeast = std::numeric_limits<double>::min();

  Triangle scaled(const Triangle& t, Vec3 origin) const {
    return {scale_ * (t[0] - origin), scale_ * (t[1] - origin), scale_ * (t[2] - origin)};
  }
  double metres() const {
    const auto corner = static_cast<std::size_t>(nearest_.vertex);
    if (nearest_.vertex_of == 0) return rounded_distance(first_[corner], second_);
    if (nearest_.vertex_of == 1) return rounded_distance(second_[corner], first_);
    return nearest_.distance / scale_;
  }

  const ClusteredMesh &a_, &b_;
  double scale_ = 1.0;
  BestFacetPair best_{};
  NearestOfFacets nearest_;
  Triangle first_{}, second_{};  // of the best pair, metres
  PredicateCounts counts_;
};

}  // namespace

std::optional<MeshDistance> least_distance(const ClusteredMesh& a, const ClusteredMesh& b, double within) {
  if (a.facet_count() == 0 || b.facet_count() == 0) return {};
  DistanceSearch search(a, b, within);
  descend_to_facet_pairs(a, b, search);
  return search.found(within);
}

std::optional<MeshDistance> least_distance(const ClusteredMesh& mesh, const HalfSpace& space, double within) {
  std::optional<MeshDistance> best;
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    const int source = mesh.source_facet(f);
    for (std::size_t k = 0; k < 3; ++k) {
      // What doubles tell is higher is not computed exactly.
      const double error = height_error(space, {t[k], t[k]});
      if (rough_height_over(space, t[k]) - error > (best ? best->distance : within)) continue;
      const double height = std::max(height_over(space, t[k]), 0.0);
      if (height > within || (best && std::pair(height, source) >= std::pair(best->distance, best->facet_a))) continue;
      best = {source, 0, height, {}, {}};
      best->weight_a[k] = 1.0;
    }
  }
  if (best) best->weight_a = weights_of_source(mesh, best->facet_a, best->weight_a);
  return best;
}

}  // namespace tact::narrowphase
