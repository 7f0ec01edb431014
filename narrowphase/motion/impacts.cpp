#include "narrowphase/motion/impacts.h"

#include <algorithm>
#include <bit>

#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

constexpr int kMostVertices = 3 * kClusterSize, kMostEdges = 3 * kClusterSize;

// Features of a cluster with up to kCorners corners each: their boxes on the way, and where their corners are, scaled,
// at time 0 and 1.
template <int kCorners, int kMost>
struct MovingFeatures {
  int count = 0;
  int index[kMost];                    // in the mesh
  double bounds[6][kMost + kPadding];  // lower x, y, z, upper x, y, z
  double at[2][kCorners][3][kMost];    // time, corner, axis

  void add(int what, const MovingVertex (&corners)[kCorners], double scale) {
    Box box;
    for (int c = 0; c < kCorners; ++c) {
      for (int time = 0; time < 2; ++time) {
        const Vec3 p = corners[c].at[time];
        box = extended(box, p);
        for (int axis = 0; axis < 3; ++axis) at[time][c][axis][count] = scale * p[axis];
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      bounds[axis][count] = box.lower[axis];
      bounds[axis + 3][count] = box.upper[axis];
    }
    index[count++] = what;
  }
  Box box(int i) const {
    return {{bounds[0][i], bounds[1][i], bounds[2][i]}, {bounds[3][i], bounds[4][i], bounds[5][i]}};
  }
  BoxPointers pointers() const { return {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}}; }
};

// A cluster's facets, and the vertices and edges that it has first.
struct MovingCluster {
  int cluster = -1;
  Box box;
  MovingFeatures<1, kMostVertices> vertices;
  MovingFeatures<2, kMostEdges> edges;
  MovingFeatures<3, kClusterSize> facets;
};

void open(const MovingMesh& m, int cluster, double scale, MovingCluster& opened) {
  opened.cluster = cluster;
  opened.box = m.cluster_box(cluster);
  opened.vertices.count = opened.edges.count = opened.facets.count = 0;
  for (int v = m.mesh->vertex_begin(cluster); v < m.mesh->vertex_end(cluster); ++v)
    opened.vertices.add(v, {m.vertex(v)}, scale);
  for (int e = m.features->edge_begin(cluster); e < m.features->edge_end(cluster); ++e) {
    const auto [v, w] = m.features->edge(e);
    opened.edges.add(e, {m.vertex(v), m.vertex(w)}, scale);
  }
  for (int f = m.mesh->facet_begin(cluster); f < m.mesh->facet_end(cluster); ++f) {
    const auto [u, v, w] = m.mesh->corners(f);
    opened.facets.add(f, {m.vertex(u), m.vertex(v), m.vertex(w)}, scale);
  }
}

// Pairs of features that wait for the filter.
struct Waiting {
  MovingPolygons polygons;
  struct {
    FeaturePair kind;
    int a, b;  // in the meshes
  } pair[MovingPolygons::kCapacity];
};

double least_of(const std::atomic<double>* value) {
  return value == nullptr ? 1.0 : value->load(std::memory_order_relaxed);
}

constexpr std::size_t kOpened = 16;  // clusters of b that stay open: neighbours come soon again

// Features of a cluster, and their boxes.
struct BoxList {
  int count = 0;
  std::int32_t index[kMostEdges + kPadding];
  double bounds[6][kMostEdges + kPadding];
  BoxPointers pointers() const { return {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}}; }
};

struct SearchMemory {
  MovingCluster a;
  MovingCluster b[kOpened];
  BoxList near;
  Waiting facets, edges;
  MeetingSearch meeting;
};

// The search among the clusters of two meshes.
class ImpactSearch {
 public:
  ImpactSearch(const MovingMesh& a, const MovingMesh& b, double reach, std::atomic<double>* first, SearchMemory& memory,
               std::vector<FeatureImpact>& found, MotionCounts& counts)
      : a_(a),
        b_(b),
        same_(a.mesh == b.mesh),
        reach_(reach),
        first_(first),
        memory_(memory),
        found_(found),
        counts_(counts) {
    const Box all = merged(a.box(), b.box());
    const Vec3 size = all.upper - all.lower;
    scale_ = unit_scale(std::max({size.x, size.y, size.z}));
    memory.a.cluster = -1;
    for (MovingCluster& one : memory.b) one.cluster = -1;
    memory.facets.polygons.corners = 3;
    memory.edges.polygons.corners = 4;
    memory.facets.polygons.count = memory.edges.polygons.count = 0;
  }

  void search(const ClusterPair& pair) {
    MovingCluster &a = memory_.a, &b = memory_.b[static_cast<std::size_t>(pair.b) % kOpened];
    if (a.cluster != pair.a) open(a_, pair.a, scale_, a);
    if (b.cluster != pair.b) open(b_, pair.b, scale_, b);
    from_vertices(a, b, FeaturePair::vertex_facet);
    if (!same_) from_vertices(b, a, FeaturePair::facet_vertex);
    if (same_ && a.cluster != b.cluster) from_vertices(b, a, FeaturePair::vertex_facet);
    between_edges(a, b);
  }

  // Decides what still waits.
  void finish() {
    decide(memory_.facets);
    decide(memory_.edges);
  }

 private:
  template <class Ones, class Others, class Visit>
  void for_each_near(const MovingCluster& one, const Ones& ones, const MovingCluster& other, const Others& others,
                     const Visit& visit) {
    // First the others that are near the whole cluster, next to each other.
    BoxList& list = memory_.near;
    list.count = kernels().select_overlapping(others.pointers(), others.count, bounds_of(base::grown(one.box, reach_)),
                                              list.index);
    for (int side = 0; side < 6; ++side) {
      for (int k = 0; k < list.count; ++k) list.bounds[side][k] = others.bounds[side][list.index[k]];
    }
    std::int32_t near[kMostEdges + kPadding];
    for (int i = 0; i < ones.count && list.count > 0; ++i) {
      const Box box = base::grown(ones.box(i), reach_);
      if (!overlaps(box, other.box)) continue;
      const int count = kernels().select_overlapping(list.pointers(), list.count, bounds_of(box), near);
      for (int k = 0; k < count; ++k) visit(i, list.index[near[k]]);
    }
  }

  void from_vertices(const MovingCluster& vertices, const MovingCluster& facets, FeaturePair kind) {
    const ClusteredMesh& surface = kind == FeaturePair::vertex_facet ? *b_.mesh : *a_.mesh;
    for_each_near(vertices, vertices.vertices, facets, facets.facets, [&](int i, int k) {
      const int vertex = vertices.vertices.index[i], facet = facets.facets.index[k];
      if (same_) {
        const Corners c = surface.corners(facet);
        if (c[0] == vertex || c[1] == vertex || c[2] == vertex) return;
      }
      const bool vertex_is_a = kind == FeaturePair::vertex_facet;
      Waiting& waiting = memory_.facets;
      const int lane = waiting.polygons.count;
      waiting.pair[lane] = {kind, vertex_is_a ? vertex : facet, vertex_is_a ? facet : vertex};
      for (int time = 0; time < 2; ++time) {
        for (int axis = 0; axis < 3; ++axis) {
          const double from = vertices.vertices.at[time][0][axis][i];
          for (int c = 0; c < 3; ++c)
            waiting.polygons.corner[time][c][axis][lane] = facets.facets.at[time][c][axis][k] - from;
        }
      }
      added(waiting);
    });
  }

  void between_edges(const MovingCluster& a, const MovingCluster& b) {
    for_each_near(a, a.edges, b, b.edges, [&](int i, int k) {
      const int e = a.edges.index[i], f = b.edges.index[k];
      if (same_ && ((a.cluster == b.cluster && e >= f) || share_a_vertex(a_.features->edge(e), b_.features->edge(f))))
        return;
      Waiting& waiting = memory_.edges;
      const int lane = waiting.polygons.count;
      waiting.pair[lane] = {FeaturePair::edge_edge, e, f};
      for (int time = 0; time < 2; ++time) {
        for (int axis = 0; axis < 3; ++axis) {
          const double p = a.edges.at[time][0][axis][i], q = a.edges.at[time][1][axis][i];
          const double r = b.edges.at[time][0][axis][k], s = b.edges.at[time][1][axis][k];
          auto& corner = waiting.polygons.corner[time];
          corner[0][axis][lane] = r - p;
          corner[1][axis][lane] = s - p;
          corner[2][axis][lane] = s - q;
          corner[3][axis][lane] = r - q;
        }
      }
      added(waiting);
    });
  }

  void added(Waiting& waiting) {
    if (++waiting.polygons.count == MovingPolygons::kCapacity) decide(waiting);
  }

  void decide(Waiting& waiting) {
    const int count = waiting.polygons.count;
    if (count == 0) return;
    static_assert(MovingPolygons::kCapacity == 64);
    std::uint64_t left =
        ~std::uint64_t{0} >> (64 - count) & ~kernels().apart_throughout(waiting.polygons, scale_ * reach_);
    waiting.polygons.count = 0;
    counts_.candidates += count;
    counts_.searched += std::popcount(left);
    for (; left != 0; left &= left - 1) {
      const auto& pair = waiting.pair[std::countr_zero(left)];
      const Meeting meeting = memory_.meeting.first(polygon(pair.kind, pair.a, pair.b), reach_, least_of(first_));
      counts_.spans += meeting.spans;
      if (meeting.time <= 1.0) add(pair.kind, pair.a, pair.b, meeting.time);
    }
  }

  MovingPolygon polygon(FeaturePair kind, int a, int b) const {
    const auto facet_from = [](const MovingMesh& m, int vertex, const MovingMesh& surface, int facet) {
      const auto [u, v, w] = surface.mesh->corners(facet);
      return facet_seen_from(m.vertex(vertex), {surface.vertex(u), surface.vertex(v), surface.vertex(w)});
    };
    if (kind == FeaturePair::vertex_facet) return facet_from(a_, a, b_, b);
    if (kind == FeaturePair::facet_vertex) return facet_from(b_, b, a_, a);
    EdgeVertices e = a_.features->edge(a), f = b_.features->edge(b);
    // Of one mesh, in an order that no grouping changes.
    if (same_ && source_vertices(*b_.mesh, f) < source_vertices(*a_.mesh, e)) std::swap(e, f);
    return edge_seen_from({a_.vertex(e[0]), a_.vertex(e[1])}, {b_.vertex(f[0]), b_.vertex(f[1])});
  }

  void add(FeaturePair kind, int a, int b, double time) {
    const auto sources = [&](const MovingMesh& m, bool is_edge, bool is_facet, int feature) {
      if (is_edge) return source_vertices(*m.mesh, m.features->edge(feature));
      if (is_facet) return source_vertices(*m.mesh, m.mesh->corners(feature));
      return source_vertices(*m.mesh, {&feature, 1});
    };
    const bool edges = kind == FeaturePair::edge_edge;
    FeatureImpact impact{.kind = kind,
                         .a = sources(a_, edges, kind == FeaturePair::facet_vertex, a),
                         .b = sources(b_, edges, kind == FeaturePair::vertex_facet, b),
                         .time = time};
    if (same_ && edges && impact.b < impact.a) std::swap(impact.a, impact.b);
    found_.push_back(impact);
    if (first_ == nullptr) return;
    for (double known = *first_; time < known && !first_->compare_exchange_weak(known, time);) {
    }
  }

  const MovingMesh &a_, &b_;
  const bool same_;
  const double reach_;
  double scale_ = 1.0;
  std::atomic<double>* const first_;
  SearchMemory& memory_;
  std::vector<FeatureImpact>& found_;
  MotionCounts& counts_;
};

void keep_passing(const MovingMesh& mesh, const Box& other, double reach, KeptClusters& kept) {
  kept.cluster.clear();
  kept.bounds = {};
  kept.boxes.resize(static_cast<std::size_t>(mesh.mesh->cluster_count()));
  for (int c = 0; c < mesh.mesh->cluster_count(); ++c) {
    const Box box = base::grown(mesh.cluster_box(c), reach);
    if (!overlaps(box, other)) continue;
    kept.boxes.set(kept.cluster.size(), box);
    kept.cluster.push_back(c);
    kept.bounds = merged(kept.bounds, box);
  }
}

}  // namespace

std::span<const ClusterPair> PassingClusters::find(const MovingMesh& a, const MovingMesh& b, double reach,
                                                   EmbreeDevice& device) {
  keep_passing(a, b.box(), reach, kept_a_);
  keep_passing(b, kept_a_.bounds, 0.0, kept_b_);
  find_cluster_pairs(kept_a_, kept_b_, ClusterPairSource::automatic, device, pairs_, work_);
  for (ClusterPair& pair : pairs_)
    pair = {kept_a_.cluster[static_cast<std::size_t>(pair.a)], kept_b_.cluster[static_cast<std::size_t>(pair.b)]};
  if (a.mesh == b.mesh) std::erase_if(pairs_, [](const ClusterPair& pair) { return pair.b < pair.a; });
  return pairs_;
}

struct ImpactFinder::Memory : SearchMemory {};

ImpactFinder::ImpactFinder() : memory_(std::make_unique<Memory>()) {}
ImpactFinder::~ImpactFinder() = default;
ImpactFinder::ImpactFinder(ImpactFinder&&) noexcept = default;
ImpactFinder& ImpactFinder::operator=(ImpactFinder&&) noexcept = default;

void ImpactFinder::run(const MovingMesh& a, const MovingMesh& b, double reach, std::span<const ClusterPair> pairs,
                       std::atomic<double>* first, std::vector<FeatureImpact>& found, MotionCounts& counts) {
  ImpactSearch search(a, b, reach, first, *memory_, found, counts);
  for (const ClusterPair& pair : pairs) search.search(pair);
  search.finish();
}

}  // namespace tact::narrowphase
