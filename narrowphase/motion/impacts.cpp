#include "narrowphase/motion/impacts.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "engine/base/parallel.h"
#include "narrowphase/numeric/unit_scale.h"

namespace tact::narrowphase {

namespace {

constexpr int kMostVertices = 3 * kClusterSize, kMostEdges = 3 * kClusterSize;

// Features of a cluster with kCorners corners each, numbered in the mesh from `first` on: where their corners are at
// time 0 and 1, and their boxes on the way. All lengths here are scaled.
template <int kCorners, int kMostFeatures>
struct MovingFeatures : FixedBoxes<kMostFeatures> {
  using Boxes = FixedBoxes<kMostFeatures>;
  using Boxes::bounds, Boxes::count;
  int first = 0;
  double at[2][kCorners][3][kMostFeatures];  // time, corner, axis

  // Takes corner number corner(c, i) of `vertices` for corner c of feature i.
  template <int kVertices, class Corner>
  void take(int first_of_all, int number_of_all, const double (&vertices)[2][3][kVertices], const Corner& corner) {
    first = first_of_all;
    count = number_of_all;
    for (int c = 0; c < kCorners; ++c) {
      for (int i = 0; i < count; ++i) {
        const int v = corner(c, i);
        for (int time = 0; time < 2; ++time) {
          for (int axis = 0; axis < 3; ++axis) at[time][c][axis][i] = vertices[time][axis][v];
        }
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < count; ++i) {
        double low = at[0][0][axis][i], high = low;
        for (int k = 1; k < 2 * kCorners; ++k) {
          const double x = at[k / kCorners][k % kCorners][axis][i];
          low = x < low ? x : low;
          high = x > high ? x : high;
        }
        bounds[axis][i] = low;
        bounds[axis + 3][i] = high;
      }
    }
  }
};

// A cluster's facets, and the vertices and edges that it has first.
struct MovingCluster {
  const ClusteredMesh* mesh = nullptr;
  int cluster = -1;
  Box box;
  double at[2][3][kMostVertices];  // all its vertices, owned ones first
  MovingFeatures<1, kMostVertices> vertices;
  MovingFeatures<2, kMostEdges> edges;
  MovingFeatures<3, kClusterSize> facets;
};

void open(const MovingMesh& m, int cluster, double scale, MovingCluster& opened) {
  const ClusterFacets facets = m.mesh->facets_of(cluster);
  opened.mesh = m.mesh;
  opened.cluster = cluster;
  const Box box = m.cluster_box(cluster);
  opened.box = {scale * box.lower, scale * box.upper};
  const PointArrays points[2] = {m.begin.points, facets.points};
  for (int time = 0; time < 2; ++time) {
    const double* const from[3] = {points[time].x, points[time].y, points[time].z};
    for (int axis = 0; axis < 3; ++axis) {
      double* const to = opened.at[time][axis];
      for (int i = 0; i < facets.owned_count; ++i) to[i] = scale * from[axis][facets.owned_begin + i];
      for (int i = 0; i < facets.borrowed_count; ++i)
        to[facets.owned_count + i] = scale * from[axis][facets.borrowed[i]];
    }
  }
  opened.vertices.take(facets.owned_begin, facets.owned_count, opened.at, [](int, int i) { return i; });
  const int edge_begin = m.features->edge_begin(cluster), edge_end = m.features->edge_end(cluster);
  opened.edges.take(edge_begin, edge_end - edge_begin, opened.at, [&](int c, int i) {
    return m.features->edge_in_cluster(edge_begin + i)[static_cast<std::size_t>(c)];
  });
  opened.facets.take(facets.facet_begin, facets.facet_count, opened.at,
                     [&](int c, int i) { return facets.corner[c][i]; });
}

// Pairs of features that wait for the filter.
struct Waiting {
  MovingPolygons polygons;
  struct {
    FeaturePair kind;
    int a, b;  // in the meshes
  } pair[MovingPolygons::kCapacity];
};

constexpr std::size_t kOpened = 16;  // clusters of each side that stay open: they come soon again

// Clusters that stay open until others take their place.
class OpenClusters {
 public:
  void close() {
    for (MovingCluster& one : clusters_) one.mesh = nullptr;
  }
  const MovingCluster& get(const MovingMesh& m, int cluster, double scale) {
    MovingCluster& one = clusters_[static_cast<std::size_t>(cluster) % kOpened];
    if (one.mesh != m.mesh || one.cluster != cluster) open(m, cluster, scale, one);
    return one;
  }

 private:
  MovingCluster clusters_[kOpened];
};

// Features of a cluster, and their boxes.
struct BoxList : FixedBoxes<kMostEdges> {
  std::int32_t index[kMostEdges + kPadding];
};

struct SearchMemory {
  double scale = 1.0;  // to lengths of at most 2
  OpenClusters a, b;
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
    scale_ = memory.scale;
    scaled_reach_ = reach > 0.0 ? std::max(scale_ * reach, std::numeric_limits<double>::denorm_min()) : 0.0;
    memory.facets.polygons.corners = 3;
    memory.edges.polygons.corners = 4;
    memory.facets.polygons.count = memory.edges.polygons.count = 0;
  }

  void search(const ClusterPair& pair) {
    const MovingCluster &a = memory_.a.get(a_, pair.a, scale_), &b = memory_.b.get(b_, pair.b, scale_);
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
    list.count = kernels().select_overlapping(others.pointers(), others.count,
                                              bounds_of(base::grown(one.box, scaled_reach_)), list.index);
    for (int side = 0; side < 6; ++side) {
      for (int k = 0; k < list.count; ++k) list.bounds[side][k] = others.bounds[side][list.index[k]];
    }
    std::int32_t near[kMostEdges + kPadding];
    for (int i = 0; i < ones.count && list.count > 0; ++i) {
      const Box box = base::grown(ones.box(i), scaled_reach_);
      if (!overlaps(box, other.box)) continue;
      const int count = kernels().select_overlapping(list.pointers(), list.count, bounds_of(box), near);
      for (int k = 0; k < count; ++k) visit(i, list.index[near[k]]);
    }
  }

  void from_vertices(const MovingCluster& vertices, const MovingCluster& facets, FeaturePair kind) {
    const ClusteredMesh& surface = kind == FeaturePair::vertex_facet ? *b_.mesh : *a_.mesh;
    for_each_near(vertices, vertices.vertices, facets, facets.facets, [&](int i, int k) {
      const int vertex = vertices.vertices.first + i, facet = facets.facets.first + k;
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
      const int e = a.edges.first + i, f = b.edges.first + k;
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
        ~std::uint64_t{0} >> (64 - count) & ~kernels().apart_throughout(waiting.polygons, scaled_reach_);
    waiting.polygons.count = 0;
    counts_.candidates += count;
    counts_.searched += std::popcount(left);
    for (; left != 0; left &= left - 1) {
      const double latest = first_ != nullptr ? first_->load(std::memory_order_relaxed) : 1.0;
      const auto& pair = waiting.pair[std::countr_zero(left)];
      const Meeting meeting = memory_.meeting.first(polygon(pair.kind, pair.a, pair.b), reach_, latest);
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
    if (first_ != nullptr) base::lower_to(*first_, time);
  }

  const MovingMesh &a_, &b_;
  const bool same_;
  const double reach_;
  double scale_ = 1.0, scaled_reach_ = 0.0;
  std::atomic<double>* const first_;
  SearchMemory& memory_;
  std::vector<FeatureImpact>& found_;
  MotionCounts& counts_;
};

}  // namespace

std::span<const ClusterPair> PassingClusters::find(const MovingMesh& a, const MovingMesh& b, double reach,
                                                   EmbreeDevice& device) {
  return finder_.find(
      *a.mesh, [&](int c) { return base::grown(a.cluster_box(c), reach); },  //
      *b.mesh, [&](int c) { return b.cluster_box(c); }, b.box(), device);
}

struct ImpactFinder::Memory : SearchMemory {};

ImpactFinder::ImpactFinder() : memory_(std::make_unique<Memory>()) {}
ImpactFinder::~ImpactFinder() = default;
ImpactFinder::ImpactFinder(ImpactFinder&&) noexcept = default;
ImpactFinder& ImpactFinder::operator=(ImpactFinder&&) noexcept = default;

void ImpactFinder::begin(const Box& all) {
  const Vec3 size = all.upper - all.lower;
  memory_->scale = unit_scale(std::max({size.x, size.y, size.z}));
  memory_->a.close();
  memory_->b.close();
}

void ImpactFinder::run(const MovingMesh& a, const MovingMesh& b, double reach, std::span<const ClusterPair> pairs,
                       std::atomic<double>* first, std::vector<FeatureImpact>& found, MotionCounts& counts) {
  ImpactSearch search(a, b, reach, first, *memory_, found, counts);
  for (const ClusterPair& pair : pairs) search.search(pair);
  search.finish();
}

}  // namespace tact::narrowphase
