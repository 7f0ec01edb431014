#include "narrowphase/contact_points/contact_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "narrowphase/contact_points/surface_distance.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

Box inflated(const Box& box, double by) { return {box.lower - Vec3{by, by, by}, box.upper + Vec3{by, by, by}}; }

double largest_coordinate(const Box& box) {
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
  return largest;
}

// A reach that box tests, which round, can take.
double box_reach(double reach, double largest) { return reach * (1.0 + 0x1p-40) + 0x1p-50 * largest; }

// Boxes in arrays, and what they are the boxes of.
struct Boxed : FixedBoxes<3 * kClusterSize> {
  int index[kMost] = {};

  void clear() { count = 0; }
  void add(int what, const Box& box) {
    index[count] = what;
    set(count++, box);
  }
};

// A cluster's facets, and the vertices and edges that it has first, scaled.
struct OpenCluster {
  int cluster = -1;
  Box box;
  Boxed vertices, edges, facets;
};

struct ScaledMesh {
  const ClusteredMesh& mesh;
  const Features& features;
  double scale;

  Vec3 position(int vertex) const { return scale * mesh.position(vertex); }
  ScaledVertices around(std::span<const int> vertices) const { return {mesh.points(), vertices, scale}; }
};

void open(const ScaledMesh& m, int cluster, OpenCluster& opened) {
  opened.cluster = cluster;
  opened.box = {};
  opened.vertices.clear();
  opened.edges.clear();
  opened.facets.clear();
  for (int f = m.mesh.facet_begin(cluster); f < m.mesh.facet_end(cluster); ++f) {
    Box box;
    for (const int v : m.mesh.corners(f)) box = extended(box, m.position(v));
    opened.facets.add(f, box);
    opened.box = merged(opened.box, box);
  }
  for (int v = m.mesh.vertex_begin(cluster); v < m.mesh.vertex_end(cluster); ++v)
    opened.vertices.add(v, {m.position(v), m.position(v)});
  for (int e = m.features.edge_begin(cluster); e < m.features.edge_end(cluster); ++e) {
    const auto [v, w] = m.features.edge(e);
    opened.edges.add(e, extended({m.position(v), m.position(v)}, m.position(w)));
  }
}

// The search among the clusters of two meshes.
class PointFinder {
 public:
  PointFinder(const ScaledMesh& a, const ScaledMesh& b, double reach, std::vector<FeaturePoint>& found)
      : a_(a), b_(b), same_(&a.mesh == &b.mesh), reach_(reach), found_(found) {
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
  template <class Visit>
  void for_each_near(const Boxed& ones, const OpenCluster& other, const Boxed& others, const Visit& visit) const {
    std::int32_t near[Boxed::kMost + kPadding];
    const Box whole = inflated(other.box, box_reach_);
    for (int i = 0; i < ones.count; ++i) {
      const Box box = ones.box(i);
      if (!overlaps(box, whole)) continue;
      const int count =
          kernels().select_overlapping(others.pointers(), others.count, bounds_of(inflated(box, box_reach_)), near);
      for (int k = 0; k < count; ++k) visit(i, near[k]);
    }
  }

  // Vertices of `m`, facets of `surface`.
  void from_vertices(const ScaledMesh& m, const OpenCluster& vertices, const ScaledMesh& surface,
                     const OpenCluster& facets, FeaturePair kind) {
    for_each_near(vertices.vertices, facets, facets.facets, [&](int i, int k) {
      const int vertex = vertices.vertices.index[i], facet = facets.facets.index[k];
      const Vec3 v{vertices.vertices.bounds[0][i], vertices.vertices.bounds[1][i], vertices.vertices.bounds[2][i]};
      const auto add = [&](const std::optional<Nearest>& nearest, std::span<const int> feature) {
        if (nearest) add_vertex_point(m, vertex, surface, facet, feature, *nearest, kind);
      };
      const Corners corners = surface.mesh.corners(facet);
      const Vec3 corner[3] = {surface.position(corners[0]), surface.position(corners[1]), surface.position(corners[2])};
      add(nearest_inside_facet(v, corner, reach_), corners);
      for (int c = 0; c < 3; ++c) {
        const int edge = surface.features.facet_edge(facet, c);
        if (edge >= 0 && surface.features.first_facet_of_edge(edge) == facet) {
          const EdgeVertices ends = surface.features.edge(edge);
          add(nearest_inside_edge(v, surface.position(ends[0]), surface.position(ends[1]),
                                  surface.around(surface.features.opposite(edge)), reach_),
              ends);
        }
        const int w = corners[static_cast<std::size_t>(c)];
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
    for_each_near(a.edges, b, b.edges, [&](int i, int k) {
      const int e = a.edges.index[i], f = b.edges.index[k];
      const EdgeVertices ends_e = a_.features.edge(e), ends_f = b_.features.edge(f);
      if (same_ && (share_a_vertex(ends_e, ends_f) || (a.cluster == b.cluster && e > f))) return;
      const EdgeEnds at_e{a_.position(ends_e[0]), a_.position(ends_e[1])},
          at_f{b_.position(ends_f[0]), b_.position(ends_f[1])};
      const auto nearest = nearest_between_edges(at_e, a_.around(a_.features.opposite(e)), at_f,
                                                 b_.around(b_.features.opposite(f)), reach_);
      if (nearest) add_edge_point(ends_e, at_e, ends_f, *nearest);
    });
  }

  void add_edge_point(const EdgeVertices& e, const EdgeEnds& at_e, const EdgeVertices& f, const Nearest& nearest) {
    const Vec3 on_e = nearest.first[0] * at_e.p + nearest.first[1] * at_e.q;
    if (same_ && along_surface(e, on_e, f, on_e + nearest.distance * nearest.normal)) return;
    FeaturePoint point{.kind = FeaturePair::edge_edge,
                       .a = source_vertices(a_.mesh, e),
                       .b = source_vertices(b_.mesh, f),
                       .weight_a = {nearest.first[0], nearest.first[1], 0.0},
                       .weight_b = {nearest.weight[0], nearest.weight[1], 0.0},
                       .normal = nearest.normal,
                       .gap = nearest.distance / a_.scale};
    if (same_ && point.b < point.a) {
      std::swap(point.a, point.b);
      std::swap(point.weight_a, point.weight_b);
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
  std::vector<FeaturePoint>& found_;
  SurfaceWays ways_;
};

}  // namespace

std::span<const ClusterPair> NearClusters::find(const FeaturedMesh& a, const FeaturedMesh& b, double reach,
                                                EmbreeDevice& device) {
  const double both = box_reach(reach, std::max(largest_coordinate(a.mesh->box()), largest_coordinate(b.mesh->box())));
  const auto box_of = [](const ClusteredMesh& mesh, int c) {
    return mesh.cluster_boxes()[static_cast<std::size_t>(c)];
  };
  return finder_.find(
      *a.mesh, [&](int c) { return inflated(box_of(*a.mesh, c), both); },  //
      *b.mesh, [&](int c) { return box_of(*b.mesh, c); }, b.mesh->box(), device);
}

struct ContactPointSearch::Memory {
  static constexpr std::size_t kOpened = 16;  // clusters of b that stay open: neighbours come soon again
  OpenCluster a;
  OpenCluster b[kOpened];
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
  PointFinder finder(scaled_a, scaled_b, scale * reach, found);
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
