#include "narrowphase/contact_points/way_out.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "narrowphase/contact_points/facing_clusters.h"
#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/mesh/open_in_box.h"
#include "narrowphase/queries/mesh_queries.h"

namespace tact::narrowphase {

namespace {

// How far a vertex may seem to be before a plane that it is behind: lengths are near 1, so some thousand roundings.
constexpr double kFlat = 1e-12;

// A facet as a vertex sees it.
struct SeenFacet {
  Triangle t;  // from the vertex
  Vec3 normal;
  double length = 0.0;  // of the normal, which need not be 1
  double height = 0.0;  // of the vertex above the facet's plane

  SeenFacet(const ScaledMesh& m, int facet, Vec3 v) { see(m.triangle(facet), v); }
  SeenFacet(const Triangle& facet, Vec3 v) { see(facet, v); }

 private:
  void see(const Triangle& facet, Vec3 v) {
    for (std::size_t k = 0; k < 3; ++k) t[k] = facet[k] - v;
    normal = cross(t[1] - t[0], t[2] - t[0]);
    length = norm(normal);
    if (length > 0.0) height = -dot(normal, t[0]) / length;
  }
};

// Facets whose angles have such a sine, or a smaller one, are left to nearest_weights(), which is exact enough for
// them.
constexpr double kSliver = 1e-4;

// The weights of the corners for the place that is nearest to the vertex.
std::array<double, 3> weights_of(const SeenFacet& seen) {
  const Vec3 p = seen.t[1] - seen.t[0], q = seen.t[2] - seen.t[0];
  const double square = seen.length * seen.length;
  if (square <= kSliver * kSliver * norm_squared(p) * norm_squared(q)) return nearest_weights({}, seen.t);
  std::array<double, 3> weight;
  for (std::size_t i = 0; i < 3; ++i) {
    weight[i] = dot(cross(seen.t[(i + 1) % 3], seen.t[(i + 2) % 3]), seen.normal) / square;
    if (!(weight[i] > 0.0)) return nearest_weights_on_sides({}, seen.t);
  }
  return weight;
}

WayOut way_to(const SeenFacet& seen, int facet) {
  WayOut way;
  way.facet = facet;
  way.weight = weights_of(seen);
  const Vec3 unit = (1.0 / seen.length) * seen.normal;
  const Vec3 to = way.weight[0] * seen.t[0] + way.weight[1] * seen.t[1] + way.weight[2] * seen.t[2];
  const bool within = std::ranges::all_of(way.weight, [](double w) { return w > 0.0; });
  way.distance = within ? std::abs(seen.height) : norm(to);
  way.out = within ? (seen.height > 0.0 ? -unit : unit) : way.distance > 0.0 ? (1.0 / way.distance) * to : unit;
  return way;
}

// The smallest feature with the place: corners without weight are left out, those of an edge in the caller's order.
void name_feature(const ScaledMesh& m, WayOut& way) {
  const Corners& c = m.features.corners(way.facet);
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (way.weight[k] <= 0.0) continue;
    way.feature[count] = c[k];
    way.feature_weight[count++] = way.weight[k];
  }
  if (count == 2 && m.mesh.source_vertex(way.feature[1]) < m.mesh.source_vertex(way.feature[0])) {
    std::swap(way.feature[0], way.feature[1]);
    std::swap(way.feature_weight[0], way.feature_weight[1]);
  }
}

// Facets that are about as near as the nearest are looked at, too: boxes round otherwise than facets.
double with_rounding(double distance) { return distance * (1.0 + 0x1p-40) + 0x1p-49; }

// Neither normals in the unit of the mesh nor the square of its scale vanish or overflow then.
bool is_near_one(double scale) { return scale > 0x1p-400 && scale < 0x1p400; }

double largest_of(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

struct SkipTurnedAway {
  const FacingClusters& clusters;
  const FacingNormals& facing;
  bool group(int group) const { return clusters.group_turned_away(group, facing); }
  bool cluster(int cluster) const { return clusters.cluster_turned_away(cluster, facing); }
};

// Which side of an edge's facets is `v` on that is nearest to the edge? The facet that sees it from more above or below
// tells: v is beyond the other's edge, where its plane says little. Zero at the border.
double height_at_edge(const ScaledMesh& m, int facet, int side, Vec3 v, double own_height) {
  const int edge = m.features.facet_edge(facet, side);
  if (edge < 0) return own_height;
  const auto third = m.features.opposite(edge);
  if (third.size() == 1) return 0.0;
  const Corners& c = m.features.corners(facet);
  const auto k = static_cast<std::size_t>(side);
  const Vec3 p = m.position(c[k]), q = m.position(c[(k + 1) % 3]);
  double height = own_height;
  for (const int other : third) {
    if (other == c[(k + 2) % 3]) continue;
    const Vec3 normal = cross(p - q, m.position(other) - q);  // the neighbour has the edge the other way around
    const double length = norm(normal);
    const double above = length > 0.0 ? dot(normal, v - q) / length : 0.0;
    if (std::abs(above) > std::abs(height)) height = above;
  }
  return height;
}

}  // namespace

struct WayFinder::Memory {
  static constexpr std::size_t kOpened = 32, kGathered = 3;
  std::optional<ScaledMesh> surface;
  struct Opened {
    int cluster = -1;
    FacetBlock facets;
  };
  Opened opened[kOpened];
  std::vector<std::int32_t> clusters;
  FacetBlock gathered[kGathered];  // all facets that ways not longer than `gathered_within` lead to
  std::size_t gathered_count = 0;
  double gathered_within = -1.0;  // scaled; negative: none are gathered
  FacetDistances near;
  FacingClusters facing;  // known as soon as that is worth it
  int fruitless = 0;      // clusters that were looked into for a facet that faces a direction, and had none

  // To find all normals costs what it costs to look into each cluster once.
  void find_facing(const ScaledMesh& m) {
    for (int c = 0; c < m.mesh.cluster_count(); ++c) facing.add(facets_of(m.mesh, c), m.scale);
    facing.merge_groups(m.mesh);
  }

  // Takes the facets that reach into a box, in the unit of the mesh; false if they are too many.
  bool gather(const ClusteredMesh& mesh, const Box& box) {
    gathered_count = 1;
    gathered[0].count = 0;
    const CullPlanes planes = planes_of(box);
    const int found = kernels().select_overlapping(mesh.cluster_boxes().pointers(), mesh.cluster_count(), planes.box,
                                                   clusters.data());
    for (int c = 0; c < found; ++c) {
      const ClusterFacets facets = mesh.facets_of(clusters[c]);
      const FacetBlock& last = gathered[gathered_count - 1];
      const int before = last.count;
      const Culled taken = kernels().open_cluster(facets, planes, &gathered[gathered_count - 1]);
      if (before + taken.left <= FacetBlock::kCapacity) continue;
      if (gathered_count == kGathered) return false;
      gathered[gathered_count].count = 0;
      kernels().open_cluster(facets, planes, &gathered[gathered_count++]);
    }
    return true;
  }

  const FacetBlock& facets_of(const ClusteredMesh& mesh, int cluster) {
    Opened& one = opened[static_cast<std::size_t>(cluster) % kOpened];
    if (one.cluster != cluster) {
      one.cluster = cluster;
      one.facets.count = 0;
      kernels().open_cluster(mesh.facets_of(cluster), planes_of(everywhere()), &one.facets);
    }
    return one.facets;
  }
};

WayFinder::WayFinder() : memory_(std::make_unique<Memory>()) {}
WayFinder::~WayFinder() = default;
WayFinder::WayFinder(WayFinder&&) noexcept = default;
WayFinder& WayFinder::operator=(WayFinder&&) noexcept = default;

void WayFinder::begin(const ScaledMesh& surface) {
  memory_->surface.emplace(surface);
  for (Memory::Opened& one : memory_->opened) one.cluster = -1;
  memory_->clusters.resize(surface.mesh.cluster_count() + kPadding);
  memory_->gathered_within = -1.0;
  memory_->facing.clear();
  memory_->fruitless = 0;
}

void WayFinder::begin(const ScaledMesh& surface, const Box& box, double within) {
  begin(surface);
  // Lengths are near 1: the last term is far more than a way or a box is rounded by.
  const double more = (with_rounding(within) + 1e-9) / surface.scale;
  if (memory_->gather(surface.mesh, grown(box, more))) memory_->gathered_within = within;
}

template <class Counts>
std::optional<WayOut> WayFinder::nearest(Vec3 v, double within, int hint, const FacingNormals* facing,
                                         const Counts& counts) {
  const ScaledMesh& m = *memory_->surface;
  std::optional<WayOut> best;
  double least = within;
  const auto look_at = [&](int facet, const SeenFacet& seen) {
    if (seen.length == 0.0 || std::abs(seen.height) > with_rounding(least) || !counts(seen)) return;
    const WayOut way = way_to(seen, facet);
    if (way.distance > least) return;
    if (best && way.distance == best->distance && m.mesh.source_facet(facet) > m.mesh.source_facet(best->facet)) return;
    best = way;
    least = way.distance;
  };
  if (hint >= 0) look_at(hint, SeenFacet(m, hint, v));
  // In the unit of the mesh, where the scaled lengths are as they are but for a power of two.
  const Vec3 at = (1.0 / m.scale) * v;
  const double point[3] = {at.x, at.y, at.z};
  const double rounding = 0x1p-50 * largest_of(v);
  const auto most = [&] {
    const double one = with_rounding(least) + rounding;
    return one * one;
  };
  const auto wants = [&](double distance_squared) { return distance_squared <= most(); };
  const auto look_into = [&](const FacetBlock& facets) {
    FacetDistances& near = memory_->near;
    kernels().rank_block(facets, point, m.scale, most(), facing, &near);
    const bool any = near.count > 0;
    take_by_rank(near.least_squared, near.facet, near.count, wants, [&](int i) {
      if (facets.facet[i] == hint) return;
      Triangle corners;
      for (int j = 0; j < 3; ++j) {
        const auto& corner = facets.corner[j];
        corners[j] = m.scale * Vec3{corner[0][i], corner[1][i], corner[2][i]};
      }
      look_at(facets.facet[i], SeenFacet(corners, v));
    });
    return any;
  };
  if (within <= memory_->gathered_within) {
    for (std::size_t k = 0; k < memory_->gathered_count; ++k) look_into(memory_->gathered[k]);
    return best;
  }
  const auto rank = [&](const BoxPointers& boxes, int count, RankedBoxes& ranked) {
    kernels().rank_by_distance(boxes, count, point, m.scale, most(), &ranked);
  };
  const auto open = [&](int cluster) {
    const bool any = look_into(memory_->facets_of(m.mesh, cluster));
    memory_->fruitless += facing != nullptr && !any;
  };
  const bool worth_it = facing != nullptr && memory_->fruitless >= m.mesh.cluster_count();
  if (worth_it && !memory_->facing.are_known()) memory_->find_facing(m);
  if (worth_it) {
    for_each_cluster_by_rank(m.mesh, rank, wants, open, SkipTurnedAway{memory_->facing, *facing});
  } else {
    for_each_cluster_by_rank(m.mesh, rank, wants, open);
  }
  return best;
}

std::optional<WayOut> WayFinder::nearest_out(Vec3 v, Vec3 facing, double cosine, double within, int hint) {
  const FacingNormals normals{{facing.x, facing.y, facing.z}, cosine};
  const bool filters = cosine > 0.0 && is_near_one(memory_->surface->scale);
  auto way = nearest(v, within, hint, filters ? &normals : nullptr, [&](const SeenFacet& seen) {
    return seen.height <= kFlat && dot(seen.normal, facing) > cosine * seen.length;
  });
  if (way) name_feature(*memory_->surface, *way);
  return way;
}

std::optional<WayThrough> WayFinder::nearest_through(Vec3 v, double within, int hint) {
  const ScaledMesh& sheet = *memory_->surface;
  auto way = nearest(v, within, hint, nullptr, [](const SeenFacet&) { return true; });
  if (!way) return {};
  name_feature(sheet, *way);
  const SeenFacet seen(sheet, way->facet, v);
  double height = seen.height;
  // Corner k has no weight: the place is on the side across, from k + 1 to k + 2.
  for (int k = 0; k < 3; ++k) {
    if (way->weight[k] > 0.0) continue;
    height = height_at_edge(sheet, way->facet, (k + 1) % 3, v, height);
    if (height == 0.0) return {};
  }
  return WayThrough{*way, seen.normal, height};
}

std::optional<WayOut> way_to_facet(const ScaledMesh& surface, int facet, Vec3 v) {
  const SeenFacet seen(surface, facet, v);
  if (seen.length == 0.0) return {};
  WayOut way = way_to(seen, facet);
  name_feature(surface, way);
  return way;
}

std::optional<WayOut> way_out_along(const ScaledMesh& surface, Vec3 v, Vec3 direction, double within) {
  const Vec3 from = (1.0 / surface.scale) * v;
  const Vec3 way = (within / surface.scale) * direction;
  const auto hit = first_hit(surface.mesh, PreparedSegment({from, from + way}), 1.0);
  if (!hit) return {};
  WayOut out;
  out.facet = surface.mesh.facet_of_source(hit->facet);
  out.distance = hit->time * within;
  out.weight = hit->weight;
  out.out = direction;
  name_feature(surface, out);
  return out;
}

}  // namespace tact::narrowphase
