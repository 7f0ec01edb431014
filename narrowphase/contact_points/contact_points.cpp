#include "narrowphase/contact_points/contact_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "narrowphase/contact_points/open_cluster.h"
#include "narrowphase/contact_points/surface_distance.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

double largest_coordinate(const Box& box) {
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
  return largest;
}

// A reach that box tests, which round, can take.
double box_reach(double reach, double largest) { return reach * (1.0 + 0x1p-40) + 0x1p-50 * largest; }

constexpr int kMostFeatures = 3 * kClusterSize;

// A cluster's facets, and the vertices and edges that it has first, scaled.
struct OpenCluster {
  int cluster = -1;
  Box box;
  ClusterFacets source;
  ClusterVertices at;
  PlacedFeatures<1, kMostFeatures> vertices;
  PlacedFeatures<2, kMostFeatures> edges;
  PlacedFacets facets;
};

void open(const ScaledMesh& m, int cluster, OpenCluster& opened) {
  const ClusterFacets facets = m.mesh.facets_of(cluster);
  opened.cluster = cluster;
  opened.source = facets;
  const Box box = m.mesh.cluster_boxes()[cluster];
  opened.box = {m.scale * box.lower, m.scale * box.upper};
  opened.at.take(facets, m.scale);
  take_facets(facets, opened.at, opened.facets);
  opened.vertices.take(facets.owned_begin, facets.owned_count, opened.at.at, [](int, int i) { return i; });
  const int begin = m.features.edge_begin(cluster), end = m.features.edge_end(cluster);
  opened.edges.take(begin, end - begin, opened.at.at,
                    [&](int c, int i) { return m.features.edge_in_cluster(begin + i)[c]; });
}

// As ClusteredMesh::corners(), of facet i of the cluster.
Corners corners_of(const ClusterFacets& facets, int i) {
  const auto vertex = [&](int c) {
    const int v = facets.corner[c][i];
    return v < facets.owned_count ? facets.owned_begin + v : facets.borrowed[v - facets.owned_count];
  };
  return {vertex(0), vertex(1), vertex(2)};
}

// Features that are near another cluster, and their boxes.
struct NearFeatures : FixedBoxes<kMostFeatures> {
  std::int32_t index[kMostFeatures + kPadding];
};

// The search among the clusters of two meshes.
class PointFinder {
 public:
  PointFinder(const ScaledMesh& a, const ScaledMesh& b, double reach, NearFeatures& near, SurfaceWays& ways,
              std::vector<FeaturePoint>& found)
      : a_(a), b_(b), same_(&a.mesh == &b.mesh), reach_(reach), near_(near), found_(found), ways_(ways) {
    const double largest = a.scale * std::max(largest_coordinate(a.mesh.box()), largest_coordinate(b.mesh.box()));
    box_reach_ = box_reach(reach, largest);
  }

  void search(const OpenCluster& a, const OpenCluster& b) {
    from_vertices(a_, a, b_, b, FeaturePair::vertex_facet);
    if (!same_) from_vertices(b_, b, a_, a, FeaturePair::facet_vertex);
    if (same_ && a.cluster != b.cluster) from_vertices(b_, b, a_, a, FeaturePair::vertex_facet);
    between_edges(a, b);
  }

 private:
  // First what of either is near the other's whole cluster.
  template <class Ones, class Others, class Visit>
  void for_each_near(const OpenCluster& one, const Ones& ones, const OpenCluster& other, const Others& others,
                     const Visit& visit) {
    std::int32_t mine[kMostFeatures + kPadding], near[kMostFeatures + kPadding];
    const int count =
        kernels().select_overlapping(ones.pointers(), ones.count, bounds_of(inflated(other.box, box_reach_)), mine);
    if (count == 0) return;
    near_.count = kernels().select_overlapping(others.pointers(), others.count,
                                               bounds_of(inflated(one.box, box_reach_)), near_.index);
    for (int side = 0; side < 6; ++side) {
      for (int k = 0; k < near_.count; ++k) near_.bounds[side][k] = others.bounds[side][near_.index[k]];
    }
    for (int i = 0; i < count && near_.count > 0; ++i) {
      const Box box = inflated(ones.box(mine[i]), box_reach_);
      const int found = kernels().select_overlapping(near_.pointers(), near_.count, bounds_of(box), near);
      for (int k = 0; k < found; ++k) visit(mine[i], near_.index[near[k]]);
    }
  }

  // Vertices of `m`, facets of `surface`.
  void from_vertices(const ScaledMesh& m, const OpenCluster& vertices, const ScaledMesh& surface,
                     const OpenCluster& facets, FeaturePair kind) {
    for_each_near(vertices, vertices.vertices, facets, facets.facets, [&](int i, int k) {
      const int vertex = vertices.vertices.first + i, facet = facets.facets.first + k;
      const Vec3 v = vertices.vertices.corner(0, i);
      const auto add = [&](const std::optional<Nearest>& nearest, std::span<const int> feature) {
        if (nearest) add_vertex_point(m, vertex, surface, facet, feature, *nearest, kind);
      };
      const Corners corners = corners_of(facets.source, k);
      const Vec3 corner[3] = {facets.facets.corner(0, k), facets.facets.corner(1, k), facets.facets.corner(2, k)};
      add(nearest_inside_facet(v, corner, reach_), corners);
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t next = (c + 1) % 3;
        const int edge = surface.features.facet_edge(facet, static_cast<int>(c));
        if (edge >= 0 && surface.features.first_facet_of_edge(edge) == facet) {
          const EdgeVertices ends = surface.features.edge(edge);
          const bool forward = ends[0] == corners[c];
          add(nearest_inside_edge(v, corner[forward ? c : next], corner[forward ? next : c],
                                  surface.around(surface.features.opposite(edge)), reach_),
              ends);
        }
        const int w = corners[c];
        const bool repeated = w == corners[0] ? c > 0 : c == 2 && w == corners[1];
        if (!repeated && surface.features.first_facet_of_vertex(w) == facet && !(same_ && w == vertex))
          add(nearest_in_vertex(v, corner[c], surface.around(surface.features.neighbors(w)), reach_), {&w, 1});
      }
    });
  }

  void add_vertex_point(const ScaledMesh& m, int vertex, const ScaledMesh& surface, int facet,
                        std::span<const int> feature, const Nearest& nearest, FeaturePair kind) {
    if (same_ && along_surface({&vertex, 1}, m.position(vertex), feature,
                               m.position(vertex) + nearest.distance * nearest.normal))
      return;
    FeaturePoint point;
    point.kind = kind;
    point.gap = nearest.distance / m.scale;
    const bool of_a = kind == FeaturePair::vertex_facet;
    auto& own = of_a ? point.a : point.b;
    auto& others = of_a ? point.b : point.a;
    own = source_vertices(m.mesh, {&vertex, 1});
    others = source_vertices(surface.mesh, feature);
    (of_a ? point.weight_a : point.weight_b) = {1.0, 0.0, 0.0};
    std::ranges::copy(nearest.weight, (of_a ? point.weight_b : point.weight_a).begin());
    const Vec3 normal = nearest.normal == Vec3{} ? -facet_normal(surface, facet) : nearest.normal;
    point.normal = of_a ? normal : -normal;
    found_.push_back(point);
  }

  void between_edges(const OpenCluster& a, const OpenCluster& b) {
    for_each_near(a, a.edges, b, b.edges, [&](int i, int k) {
      const int e = a.edges.first + i, f = b.edges.first + k;
      const EdgeVertices ends_e = a_.features.edge(e), ends_f = b_.features.edge(f);
      if (same_ && (share_a_vertex(ends_e, ends_f) || (a.cluster == b.cluster && e > f))) return;
      const EdgeEnds at_e{a.edges.corner(0, i), a.edges.corner(1, i)}, at_f{b.edges.corner(0, k), b.edges.corner(1, k)};
      const auto nearest = nearest_between_edges(at_e, a_.around(a_.features.opposite(e)), at_f,
                                                 b_.around(b_.features.opposite(f)), reach_);
      if (nearest) add_edge_point(e, at_e, f, *nearest);
    });
  }

  void add_edge_point(int edge_e, const EdgeEnds& at_e, int edge_f, const Nearest& nearest) {
    const EdgeVertices e = a_.features.edge(edge_e), f = b_.features.edge(edge_f);
    const Vec3 on_e = nearest.first[0] * at_e.p + nearest.first[1] * at_e.q;
    if (same_ && along_surface(e, on_e, f, on_e + nearest.distance * nearest.normal)) return;
    FeaturePoint point{.kind = FeaturePair::edge_edge,
                       .a = source_vertices(a_.mesh, e),
                       .b = source_vertices(b_.mesh, f),
                       .weight_a = {nearest.first[0], nearest.first[1], 0.0},
                       .weight_b = {nearest.weight[0], nearest.weight[1], 0.0},
                       .normal = nearest.normal,
                       .gap = nearest.distance / a_.scale,
                       .edge_a = edge_e,
                       .edge_b = edge_f};
    if (same_ && point.b < point.a) {
      std::swap(point.a, point.b);
      std::swap(point.weight_a, point.weight_b);
      std::swap(point.edge_a, point.edge_b);
      point.normal = -point.normal;
    }
    found_.push_back(point);
  }

  static Vec3 facet_normal(const ScaledMesh& m, int facet) {
    const Corners c = m.mesh.corners(facet);
    const Vec3 normal = cross(m.position(c[1]) - m.position(c[0]), m.position(c[2]) - m.position(c[0]));
    return normal == Vec3{} ? Vec3{0.0, 0.0, 1.0} : normalized(normal);
  }

  // Is the way along the edges of the mesh from one point to the other too short for a contact?
  bool along_surface(std::span<const int> from, Vec3 from_point, std::span<const int> to, Vec3 to_point) {
    const double limit = 0.5 * std::numbers::pi * reach_;
    return surface_distance_below(limit, a_.mesh, a_.features, a_.scale, {from, from_point}, {to, to_point}, ways_);
  }

  const ScaledMesh a_, b_;
  const bool same_;
  const double reach_;
  double box_reach_ = 0.0;
  NearFeatures& near_;
  std::vector<FeaturePoint>& found_;
  SurfaceWays& ways_;
};

}  // namespace

std::span<const ClusterPair> NearClusters::find(const FeaturedMesh& a, const FeaturedMesh& b, double reach,
                                                const base::Tuning& tuning, EmbreeDevice& device) {
  const double both = box_reach(reach, std::max(largest_coordinate(a.mesh->box()), largest_coordinate(b.mesh->box())));
  const auto box_of = [](const ClusteredMesh& mesh, int c) { return mesh.cluster_boxes()[c]; };
  return finder_.find(
      *a.mesh, [&](int c) { return inflated(box_of(*a.mesh, c), both); },  //
      *b.mesh, [&](int c) { return box_of(*b.mesh, c); }, b.mesh->box(), tuning, device);
}

struct ContactPointSearch::Memory {
  static constexpr std::size_t kOpened = 16;  // clusters of b that stay open: neighbours come soon again
  OpenCluster a;
  OpenCluster b[kOpened];
  NearFeatures near;
  SurfaceWays ways;
};

ContactPointSearch::ContactPointSearch() : memory_(std::make_unique<Memory>()) {}
ContactPointSearch::~ContactPointSearch() = default;
ContactPointSearch::ContactPointSearch(ContactPointSearch&&) noexcept = default;
ContactPointSearch& ContactPointSearch::operator=(ContactPointSearch&&) noexcept = default;

void ContactPointSearch::run(const FeaturedMesh& a, const FeaturedMesh& b, double reach,
                             std::span<const ClusterPair> pairs, std::vector<FeaturePoint>& found) {
  const Box whole = merged(a.mesh->box(), b.mesh->box());
  const Vec3 size = whole.upper - whole.lower;
  const double scale = unit_scale(std::max({size.x, size.y, size.z}));
  const ScaledMesh scaled_a{*a.mesh, *a.features, scale}, scaled_b{*b.mesh, *b.features, scale};
  PointFinder finder(scaled_a, scaled_b, scale * reach, memory_->near, memory_->ways, found);
  memory_->a.cluster = -1;
  for (OpenCluster& one : memory_->b) one.cluster = -1;
  for (const ClusterPair& pair : pairs) {
    OpenCluster& open_b = memory_->b[static_cast<std::size_t>(pair.b) % Memory::kOpened];
    if (memory_->a.cluster != pair.a) open(scaled_a, pair.a, memory_->a);
    if (open_b.cluster != pair.b) open(scaled_b, pair.b, open_b);
    finder.search(memory_->a, open_b);
  }
}

}  // namespace tact::narrowphase
