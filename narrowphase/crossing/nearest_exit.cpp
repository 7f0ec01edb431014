#include "narrowphase/crossing/nearest_exit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "narrowphase/distance/short_ways.h"
#include "narrowphase/distance/vertex_facet.h"
#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/mesh/open_in_box.h"

namespace tact::narrowphase {

namespace {

// How far a vertex may seem to be before a plane that it is behind: lengths are near 1, so some thousand roundings.
constexpr double kFlat = 1e-12;

// A facet as a vertex sees it.
struct SeenFacet {
  Triangle t;  // from the vertex
  Vec3 normal;
  bool is_tiny = false;  // so that the normal is larger than twice the area
  double length = 0.0;   // of the normal, which need not be 1
  double height = 0.0;   // of the vertex above the facet's plane

  SeenFacet(const Triangle& facet, Vec3 v) {
    for (std::size_t k = 0; k < 3; ++k) t[k] = facet[k] - v;
    normal = moderate_cross(t[1] - t[0], t[2] - t[0]);
    length = norm(normal);
    is_tiny = normal != cross(t[1] - t[0], t[2] - t[0]);
    if (length > 0.0) height = height_above(v, facet, normal, length);
  }
};

// Facets whose angles have such a sine, or a smaller one, are left to nearest_weights(), which is exact enough for
// them.
constexpr double kSliver = 1e-4;

// The weights of the corners for the place that is nearest to the vertex.
std::array<double, 3> weights_of(const SeenFacet& seen) {
  const Vec3 p = seen.t[1] - seen.t[0], q = seen.t[2] - seen.t[0];
  const double square = seen.length * seen.length;
  if (seen.is_tiny || square <= kSliver * kSliver * norm_squared(p) * norm_squared(q))
    return nearest_weights({}, seen.t);
  std::array<double, 3> weight;
  for (std::size_t i = 0; i < 3; ++i) {
    weight[i] = dot(cross(seen.t[(i + 1) % 3], seen.t[(i + 2) % 3]), seen.normal) / square;
    if (!(weight[i] > 0.0)) return nearest_weights_on_sides({}, seen.t);
  }
  return weight;
}

Triangle scaled_triangle(const FacetBlock& facets, int i, double scale) {
  Triangle t;
  for (int k = 0; k < 3; ++k) {
    const auto& corner = facets.corner[k];
    t[k] = scale * Vec3{corner[0][i], corner[1][i], corner[2][i]};
  }
  return t;
}

// The way from the vertex to a place on a side of a facet, or in a corner.
Vec3 way_to_side(const ScaledMesh& m, Vec3 v, const SeenFacet& seen, int facet, const std::array<double, 3>& weight) {
  const Vec3 way = place_of(seen.t, weight);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    if (weight[k] > 0.0 || !(weight[i] > 0.0 && weight[j] > 0.0)) continue;
    if (norm_squared(way) > kSignRounding * kSignRounding * norm_squared(seen.t[j] - seen.t[i])) break;
    const Triangle t = m.triangle(facet);
    return fine_way_to_line(v, t[i], t[j]);
  }
  return way;
}

PlaceInFacet nearest_place(const ScaledMesh& m, Vec3 v, const SeenFacet& seen, int facet) {
  PlaceInFacet place;
  place.facet = facet;
  place.weight = weights_of(seen);
  const Vec3 unit = (1.0 / seen.length) * seen.normal;
  if (std::ranges::all_of(place.weight, [](double w) { return w > 0.0; })) {
    place.distance = std::abs(seen.height);
    place.direction = seen.height > 0.0 ? -unit : unit;
  } else {
    const Vec3 to = way_to_side(m, v, seen, facet, place.weight);
    place.distance = length_of(to);
    const bool is_short = place.distance < 0x1p-400;  // its inverse may overflow
    place.direction = to == Vec3{} ? unit : is_short ? unit_vector(to) : (1.0 / place.distance) * to;
  }
  return place;
}

NearestExit exit_at(const ScaledMesh& m, const PlaceInFacet& place) {
  return {place.facet, place.distance, place.direction, place_in_facet(m, place.facet, place.weight)};
}

// Facets that are about as near as the nearest are looked at, too: boxes round otherwise than facets.
double with_rounding(double distance) { return distance * (1.0 + 0x1p-40) + 0x1p-49; }

// Neither normals in the unit of the mesh nor the square of its scale vanish or overflow then.
bool is_near_one(double scale) { return scale > 0x1p-400 && scale < 0x1p400; }

struct SkipTurnedAway {
  const FacingClusters& clusters;
  const FacingNormals& facing;
  bool group(int group) const { return clusters.group_turned_away(group, facing); }
  bool cluster(int cluster) const { return clusters.cluster_turned_away(cluster, facing); }
};

// How high `v`, which is nearest to an edge, is above the edge's facets. The facet that sees it from more above or
// below tells: v is beyond the other's edge, where its plane says little. Zero at the border, and where facets see it
// as far above as below, as they may if they lie against each other.
double height_at_edge(const ScaledMesh& m, int facet, int side, Vec3 v, double own_height) {
  const int edge = m.features.facet_edge(facet, side);
  if (edge < 0) return own_height;
  const auto third = m.features.opposite(edge);
  if (third.size() == 1) return 0.0;
  const Corners& c = m.features.corners(facet);
  const auto k = static_cast<std::size_t>(side);
  const Vec3 p = m.position(c[k]), q = m.position(c[(k + 1) % 3]);
  double highest = own_height, lowest = own_height;
  for (const int other : third) {
    if (other == c[(k + 2) % 3]) continue;
    const Triangle t{q, p, m.position(other)};  // the neighbour has the edge the other way around
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double length = norm(normal);
    const double above = length > 0.0 ? height_above(v, t, normal, length) : 0.0;
    highest = std::max(highest, above);
    lowest = std::min(lowest, above);
  }
  if (highest == -lowest) return 0.0;
  return highest > -lowest ? highest : lowest;
}

}  // namespace

PlaceOnFeature place_in_facet(const ScaledMesh& m, int facet, const std::array<double, 3>& weights) {
  const Corners& c = m.features.corners(facet);
  PlaceOnFeature place;
  auto& [vertices, weight] = place;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[k] <= 0.0) continue;
    vertices[count] = c[k];
    weight[count++] = weights[k];
  }
  if (count == 2 && m.mesh.source_vertex(vertices[1]) < m.mesh.source_vertex(vertices[0])) {
    std::swap(vertices[0], vertices[1]);
    std::swap(weight[0], weight[1]);
  }
  return place;
}

void ExitFinder::begin(const ScaledMesh& surface) {
  constexpr std::size_t kOpen = 32, kGathered = 3;  // clusters and blocks: they stay in the nearest caches
  surface_.emplace(surface);
  open_.resize(kOpen);
  gathered_.resize(kGathered);
  for (OpenCluster& one : open_) one.cluster = -1;
  gathered_within_ = -1.0;
  facing_clusters_.clear();
  fruitless_ = 0;
}

void ExitFinder::begin(const ScaledMesh& surface, const Box& box, double within) {
  begin(surface);
  // Lengths are near 1: the last term is far more than a distance or a box is rounded by.
  const double more = (with_rounding(within) + 1e-9) / surface.scale;
  if (gather(grown(box, more))) gathered_within_ = within;
}

// Takes the facets that reach into a box, in the unit of the mesh; false if they are too many.
bool ExitFinder::gather(const Box& box) {
  const CullPlanes planes = planes_of(box);
  gathered_count_ = 1;
  gathered_[0].count = 0;
  bool fits = true;
  for_each_cluster_in(surface_->mesh, box, [&](int cluster) {
    if (!fits) return;
    const ClusterFacets facets = surface_->mesh.facets_of(cluster);
    FacetBlock& last = gathered_[gathered_count_ - 1];
    const int before = last.count;
    const Culled taken = kernels().open_cluster(facets, planes, &last);
    if (before + taken.left <= FacetBlock::kCapacity) return;
    fits = gathered_count_ < gathered_.size();
    if (!fits) return;
    gathered_[gathered_count_].count = 0;
    kernels().open_cluster(facets, planes, &gathered_[gathered_count_++]);
  });
  return fits;
}

// To find all normals costs what it costs to look into each cluster once.
void ExitFinder::find_facing_clusters() {
  const ClusteredMesh& mesh = surface_->mesh;
  for (int c = 0; c < mesh.cluster_count(); ++c) facing_clusters_.add(facets_of(c), surface_->scale);
  facing_clusters_.merge_groups(mesh);
}

const FacetBlock& ExitFinder::facets_of(int cluster) {
  OpenCluster& one = open_[static_cast<std::size_t>(cluster) % open_.size()];
  if (one.cluster != cluster) {
    one.cluster = cluster;
    one.facets.count = 0;
    kernels().open_cluster(surface_->mesh.facets_of(cluster), planes_of(everywhere()), &one.facets);
  }
  return one.facets;
}

// Clusters without a facet that faces the direction are left out as soon as it is worth it to know them.
template <class Wants, class Rank, class LookInto>
void ExitFinder::open_clusters(const FacingNormals* facing, const Wants& wants, const Rank& rank,
                               const LookInto& look_into) {
  const ClusteredMesh& mesh = surface_->mesh;
  const auto open = [&](int cluster) {
    const bool any = look_into(facets_of(cluster));
    fruitless_ += facing != nullptr && !any;
  };
  if (facing == nullptr || fruitless_ < mesh.cluster_count()) return for_each_cluster_by_rank(mesh, rank, wants, open);
  if (!facing_clusters_.are_known()) find_facing_clusters();
  for_each_cluster_by_rank(mesh, rank, wants, open, SkipTurnedAway{facing_clusters_, *facing});
}

// The nearest place in the facets that count. `facing`, if given, skips facets that do not count.
template <class Counts>
std::optional<PlaceInFacet> ExitFinder::search(Vec3 v, double within, int hint, const FacingNormals* facing,
                                               const Counts& counts) {
  const ScaledMesh& m = *surface_;
  std::optional<PlaceInFacet> best;
  double least = within;
  const auto look_at = [&](int facet, const SeenFacet& seen) {
    if (seen.length == 0.0 || std::abs(seen.height) > with_rounding(least) || !counts(seen)) return;
    const PlaceInFacet place = nearest_place(m, v, seen, facet);
    if (place.distance > least) return;
    if (best && place.distance == best->distance && m.mesh.source_facet(facet) > m.mesh.source_facet(best->facet))
      return;
    best = place;
    least = place.distance;
  };
  if (hint >= 0) look_at(hint, SeenFacet(m.triangle(hint), v));
  // In the unit of the mesh, from which scaled lengths differ by a power of two.
  const Vec3 at = (1.0 / m.scale) * v;
  const double point[3] = {at.x, at.y, at.z};
  const double rounding = 0x1p-50 * largest_coordinate(v);
  const auto most = [&] {
    const double one = with_rounding(least) + rounding;
    return one * one;
  };
  const auto wants = [&](double distance_squared) { return distance_squared <= most(); };
  const auto look_into = [&](const FacetBlock& facets) {
    FacetDistances near;
    kernels().rank_block(facets, point, m.scale, most(), facing, &near);
    const bool any = near.count > 0;
    take_by_rank(near.least_squared, near.facet, near.count, wants, [&](int i) {
      if (facets.facet[i] != hint) look_at(facets.facet[i], SeenFacet(scaled_triangle(facets, i, m.scale), v));
    });
    return any;
  };
  if (within <= gathered_within_) {
    for (std::size_t k = 0; k < gathered_count_; ++k) look_into(gathered_[k]);
    return best;
  }
  const auto rank = [&](const BoxPointers& boxes, int count, RankedBoxes& ranked) {
    kernels().rank_by_distance(boxes, count, point, m.scale, most(), &ranked);
  };
  open_clusters(facing, wants, rank, look_into);
  return best;
}

std::optional<NearestExit> ExitFinder::nearest_exit(Vec3 v, Vec3 facing, double cosine, double within, int hint) {
  const FacingNormals normals{{facing.x, facing.y, facing.z}, cosine};
  const bool filters = cosine > 0.0 && is_near_one(surface_->scale);
  const auto place = search(v, within, hint, filters ? &normals : nullptr, [&](const SeenFacet& seen) {
    return seen.height <= kFlat && dot(seen.normal, facing) > cosine * seen.length;
  });
  if (!place) return {};
  return exit_at(*surface_, *place);
}

std::optional<ExitThrough> ExitFinder::nearest_exit_through(Vec3 v, double within, int hint) {
  const ScaledMesh& sheet = *surface_;
  const auto place = search(v, within, hint, nullptr, [](const SeenFacet&) { return true; });
  if (!place) return {};
  const SeenFacet seen(sheet.triangle(place->facet), v);
  double height = seen.height;
  // Corner k has no weight: the place is on the side across, from k + 1 to k + 2.
  for (int k = 0; k < 3; ++k) {
    if (place->weight[k] > 0.0) continue;
    height = height_at_edge(sheet, place->facet, (k + 1) % 3, v, height);
    if (height == 0.0) return {};
  }
  return ExitThrough{exit_at(sheet, *place), seen.normal, height};
}

std::optional<NearestExit> exit_to_facet(const ScaledMesh& surface, int facet, Vec3 v) {
  const SeenFacet seen(surface.triangle(facet), v);
  if (seen.length == 0.0) return {};
  return exit_at(surface, nearest_place(surface, v, seen, facet));
}

}  // namespace tact::narrowphase
