#include "narrowphase/criteria/criteria.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/base/lowest_bits.h"

namespace tact::narrowphase {

namespace {

Criteria make_criteria(const Slab& slab, Vec3 outward, double plane, const ImpactZone* other_zone, bool facing_away) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Criteria criteria{.outward = outward,
                    .origin = slab.origin,
                    .lowest = std::nextafter(plane - 2.0 * slab.error, -kInfinity),
                    .facing_away = facing_away,
                    .zone = other_zone != nullptr,
                    .u = {},
                    .v = {},
                    .other_zone = {}};
  if (other_zone != nullptr) {
    // The unit is a power of two in which the slab's error is about 1: no square vanishes nor overflows.
    const double scale = std::ldexp(1.0, -std::clamp(std::ilogb(slab.error), -1000, 1000));
    const Disk& disk = other_zone->disk;
    const double radius = disk.radius >= 0.0 ? disk.radius + (other_zone->error + 2.0 * slab.error) : disk.radius;
    criteria.u = scale * slab.u;
    criteria.v = scale * slab.v;
    criteria.other_zone = {{scale * disk.center.x, scale * disk.center.y}, scale * radius};
  }
  return criteria;
}

HeightAxis height_axis(const Criteria& criteria) {
  const Vec3 n = criteria.outward, o = criteria.origin;
  return {n.x, n.y, n.z, o.x, o.y, o.z};
}

double squared(double x) { return x * x; }

double distance_squared(Point2 p, Point2 a, Point2 b) {
  const double ex = b.x - a.x, ey = b.y - a.y, length = ex * ex + ey * ey;
  const double t = length > 0.0 ? std::clamp(((p.x - a.x) * ex + (p.y - a.y) * ey) / length, 0.0, 1.0) : 0.0;
  return squared(a.x + t * ex - p.x) + squared(a.y + t * ey - p.y);
}

double turn(Point2 a, Point2 b, Point2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// True if the disk reaches the triangle. Distances from its centre round by less than 1e-14 of themselves; the disk is
// widened by that. A point of a side, a.x + t * ex, also rounds by a roundoff of |a.x|, at most e / 4 of the slab's
// error e. The disk is wider by 2 e already, and sqrt(2) e, for the facet's projection, + e / 4 < 2 e.
bool meets(const Disk& disk, Point2 a, Point2 b, Point2 c) {
  if (disk.radius < 0.0) return false;
  const double reach =
      std::max({std::abs(a.x - disk.center.x), std::abs(a.y - disk.center.y), std::abs(b.x - disk.center.x),
                std::abs(b.y - disk.center.y), std::abs(c.x - disk.center.x), std::abs(c.y - disk.center.y)});
  const double radius = disk.radius + 1e-14 * (disk.radius + reach);
  const Point2 p = disk.center;
  const double ab = turn(a, b, p), bc = turn(b, c, p), ca = turn(c, a, p);
  if ((ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0)) return true;
  return std::min({distance_squared(p, a, b), distance_squared(p, b, c), distance_squared(p, c, a)}) <= squared(radius);
}

std::uint64_t inside_zone(const FacetBlock& block, std::uint64_t candidates, const Criteria& criteria) {
  std::uint64_t inside = 0;
  for (std::uint64_t left = candidates; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    Point2 corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 d = Vec3{block.corner[k][0][i], block.corner[k][1][i], block.corner[k][2][i]} - criteria.origin;
      corner[k] = {dot(criteria.u, d), dot(criteria.v, d)};
    }
    if (meets(criteria.other_zone, corner[0], corner[1], corner[2])) inside |= std::uint64_t{1} << i;
  }
  return inside;
}

}  // namespace

CullCounts& CullCounts::operator+=(const CullCounts& one) {
  opened_clusters += one.opened_clusters;
  facing_away += one.facing_away;
  outside_slab += one.outside_slab;
  outside_box += one.outside_box;
  outside_zone += one.outside_zone;
  kept += one.kept;
  kept_bare += one.kept_bare;
  return *this;
}

Criteria criteria_for_a(const Slab& slab, const ImpactZone* zone_b, bool facing_away) {
  return make_criteria(slab, slab.n, slab.lower, zone_b, facing_away);
}

Criteria criteria_for_b(const Slab& slab, const ImpactZone* zone_a, bool facing_away) {
  return make_criteria(slab, -slab.n, -slab.upper, zone_a, facing_away);
}

void cull_clusters(const ClusteredMesh& mesh, const Criteria& criteria, const Box& other, KeptClusters& kept) {
  const LeastHeight plane{.axis = height_axis(criteria), .lowest = criteria.lowest};
  keep_clusters({.mesh = &mesh, .least_height = &plane}, 0.0, other, kept);
}

bool append_facets(const ClusteredMesh& mesh, int cluster, const Criteria& criteria, const Box& other, KeptFacets& kept,
                   CullCounts& counts) {
  const CullPlanes planes{.axis = height_axis(criteria), .lowest = criteria.lowest, .box = bounds_of(other)};
  const ClusterFacets facets = mesh.facets_of(cluster);
  const int before = kept.block.count;
  const Culled opened = kernels().open_cluster(facets, planes, &kept.block);
  if (before + opened.left > FacetBlock::kCapacity) return false;
  const std::uint64_t appended = base::lowest_bits(before + opened.left) & ~base::lowest_bits(before);
  const std::uint64_t away = criteria.facing_away ? appended & kernels().facing_away(kept.block, planes.axis) : 0;
  const std::uint64_t left = appended & ~away;
  const std::uint64_t inside = criteria.zone ? inside_zone(kept.block, left, criteria) : left;
  ++counts.opened_clusters;
  counts.outside_slab += opened.low;
  counts.outside_box += facets.facet_count - opened.left - opened.low;
  counts.facing_away += std::popcount(away);
  counts.outside_zone += std::popcount(left & ~inside);
  counts.kept += std::popcount(inside);
  for (std::uint64_t all = mesh.has_surface_alone() ? 0 : inside; all != 0; all &= all - 1) {
    const int facet = kept.block.facet[std::countr_zero(all)];
    if (!mesh.is_of_surface(mesh.source_facet(facet))) ++counts.kept_bare;
  }
  kept.facets |= inside;
  kept.bounds = merged(kept.bounds, mesh.cluster_boxes()[cluster]);
  return true;
}

}  // namespace tact::narrowphase
