#include "narrowphase/motion/impacts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/lowest_bits.h"
#include "engine/base/moving_box.h"
#include "engine/base/parallel.h"
#include "narrowphase/motion/contact_on_way.h"
#include "narrowphase/motion/parting.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/pairs/box_reach.h"
#include "narrowphase/pairs/open_clusters.h"

namespace tact::narrowphase {

namespace {

// Polygons that come within 1e-11 of their size and way may count; that of their clusters is not smaller.
constexpr double kNearly = 0x1p-36;
constexpr double kEarlier = 0x1p-19;  // by less is the time of an impact earlier than the true one: see meeting.h

// Of candidates that are kept. Two positions that are wrong leave a distance wrong by less than 4 of kWrong: eight
// times that; and ten times what counts for near, so that no polygon that is not kept is decided by its last bits.
constexpr double kKeptOfCoordinate = 32.0 * ImpactFinder::kWrong, kKeptOfSize = 0x1p-33;

constexpr int kMostVertices = 3 * kClusterSize;
static_assert(kMostVertices + 64 <= VertexWays::kRoom && 3 * kClusterSize + 64 <= FeatureWays::kRoom);

// Clusters that go together are seen from what goes with them, if that is more than 1.5 steps; a step is between 1/32
// and 1/64 of their size, so that of many pairs the same is chosen.
constexpr int kStepsOfSize = 5;
constexpr double kFewSteps = 1.5;
// Meshes are, if they go farther together than this part of the smaller one.
constexpr double kFarTogether = 0x1p-6;

// The part of the way that counts, how much wider than the features their boxes are, and how far that goes from which
// they are seen.
struct Cut {
  double until = 1.0;
  double wider = 0.0;
  Vec3 frame{};

  friend bool operator==(const Cut&, const Cut&) = default;
};

// A cluster that stays open: where its vertices are at time 0 and 1, owned ones first. All lengths here are scaled.
struct MovingCluster {
  int cluster = -1;
  Box box_at[2];  // at time 0 and 1
  int vertex_count = 0;
  double at[2][3][kMostVertices];  // time, axis
  VertexWays ways;                 // up to the last cut; of no vertex before the first
  Cut cut;

  // On the way that counts.
  Box box_until(const Cut& by) const {
    const Box& begin = box_at[0];
    const Box end{box_at[1].lower - by.frame, box_at[1].upper - by.frame};
    if (by.until == 1.0) return merged(begin, end);
    return merged(begin, {begin.lower + by.until * (end.lower - begin.lower),
                          begin.upper + by.until * (end.upper - begin.upper)});
  }
};

void open(const MovingMesh& m, int cluster, double scale, MovingCluster& opened) {
  const ClusterFacets facets = m.mesh->facets_of(cluster, m.end.points);
  opened.cluster = cluster;
  opened.vertex_count = facets.owned_count + facets.borrowed_count;
  const PointArrays points[2] = {m.begin.points, facets.points};
  const BoxView boxes[2] = {m.begin.cluster_boxes, m.end.cluster_boxes};
  for (int time = 0; time < 2; ++time) {
    const Box box = boxes[time][cluster];
    opened.box_at[time] = {scale * box.lower, scale * box.upper};
    const double* const from[3] = {points[time].x, points[time].y, points[time].z};
    for (int axis = 0; axis < 3; ++axis) {
      double* const to = opened.at[time][axis];
      for (int i = 0; i < facets.owned_count; ++i) to[i] = scale * from[axis][facets.owned_begin + i];
      for (int i = 0; i < facets.borrowed_count; ++i)
        to[facets.owned_count + i] = scale * from[axis][facets.borrowed[i]];
    }
  }
  opened.ways.count = 0;
}

// Between which coordinates the vertices stay.
const VertexWays& find_ways(MovingCluster& cluster, const Cut& cut) {
  VertexWays& ways = cluster.ways;
  if (ways.count != 0 && cluster.cut == cut) return ways;
  ways.count = cluster.vertex_count;
  cluster.cut = cut;
  for (int axis = 0; axis < 3; ++axis) {
    const double *const from = cluster.at[0][axis], *const to = cluster.at[1][axis];
    double *const lower = ways.lower[axis], *const upper = ways.upper[axis];
    const double frame = cut.frame[axis];
    for (int i = 0; i < cluster.vertex_count; ++i) {
      const double begin = from[i], last = to[i] - frame,
                   end = cut.until == 1.0 ? last : begin + cut.until * (last - begin);
      lower[i] = (begin < end ? begin : end) - cut.wider;
      upper[i] = (begin < end ? end : begin) + cut.wider;
    }
  }
  return ways;
}

// The features of a cluster that come near the box of another one: its facets, and the vertices and edges that it has
// first.
struct NearFeatures {
  const MovingCluster* cluster = nullptr;
  FeatureWays vertices, edges, facets;
  int vertex_begin = 0, edge_begin = 0, facet_begin = 0;  // the first of the cluster in the mesh

  // False if none is near: a vertex or an edge is near only where a facet is.
  bool take(const MovingMesh& m, MovingCluster& from, const Cut& cut, const Box& near);

 private:
  std::uint8_t outside_[VertexWays::kRoom];
};

bool NearFeatures::take(const MovingMesh& m, MovingCluster& from, const Cut& cut, const Box& near) {
  cluster = &from;
  const VertexWays& ways = find_ways(from, cut);
  kernels().flag_ways(ways, bounds_of(near), outside_);
  const auto append = [&](const std::array<const std::uint8_t*, 3>& corner, int corners, int count, FeatureWays& to) {
    to.count = 0;
    for (int first = 0; first < count; first += 64) {
      FeatureCorners some{{}, corners, std::min(count - first, 64)};
      for (std::size_t k = 0; k < static_cast<std::size_t>(corners); ++k) some.corner[k] = corner[k] + first;
      kernels().append_near_ways(ways, outside_, some, first, &to);
    }
  };
  const ClusterFacets all = m.mesh->facets_of(from.cluster, m.end.points);
  facet_begin = all.facet_begin;
  append({all.corner[0], all.corner[1], all.corner[2]}, 3, all.facet_count, facets);
  if (facets.count == 0) return false;
  vertex_begin = all.owned_begin;
  append({kEachVertex.data()}, 1, all.owned_count, vertices);
  edge_begin = m.features->edge_begin(from.cluster);
  const auto [u, v] = m.features->edge_corners(edge_begin);
  append({u, v}, 2, m.features->edge_end(from.cluster) - edge_begin, edges);
  return true;
}

// Grown so far that no rounding of a sum with `reach` matters.
Box grown_generously(const Box& box, double reach) {
  return reach == 0.0 ? box : inflated(box, reach + 0x1p-50 * (largest_coordinate(box) + reach));
}

// Whether a vertex of the one stays level with a vertex of the other along an axis. What slides in a plane does so, if
// that stands across an axis; others have no gap that is exactly zero, but for chance.
bool stays_level(const MovingPolygon& polygon) {
  const auto is_zero = [&](int time, int corner, int axis) {
    const DoubleDoubleVec3& v = polygon.corner[time][corner];
    return (axis == 0 ? v.x : axis == 1 ? v.y : v.z) == DoubleDouble{};
  };
  for (int corner = 0; corner < polygon.count; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      if (is_zero(0, corner, axis) && is_zero(1, corner, axis)) return true;
    }
  }
  return false;
}

// Pairs of features that wait for the filter.
struct Waiting {
  MovingPolygons polygons;
  FeatureCandidate pair[MovingPolygons::kCapacity];

  // Leaves those of a mask.
  void keep(std::uint64_t lanes) {
    int count = 0;
    for (; lanes != 0; lanes &= lanes - 1, ++count) {
      const int from = std::countr_zero(lanes);
      pair[count] = pair[from];
      for (auto& corners : polygons.corner) {
        for (int c = 0; c < polygons.corners; ++c) {
          for (auto& axis : corners[c]) axis[count] = axis[from];
        }
      }
    }
    polygons.count = count;
  }
};

// Clusters of a mesh that stay open, 22 kB each.
struct OpenMesh {
  const ClusteredMesh* mesh = nullptr;
  OpenClusters<MovingCluster, 16> clusters;

  void begin(const ClusteredMesh* next) {
    if (std::exchange(mesh, next) != next) clusters.close();
  }
};

struct SearchMemory {
  double scale = 1.0;    // to lengths of at most 2
  double largest = 0.0;  // coordinate, scaled
  OpenMesh a, b;
  NearFeatures near_a, near_b;
  Waiting facets, edges;
  MeetingSearch meeting;
  ContactOnWay contact;
  PartingSearch parting;
};

// The search among the clusters of two meshes.
class ImpactSearch {
 public:
  ImpactSearch(const MovingMesh& a, const MovingMesh& b, const FeatureRules& rules, std::atomic<double>* first,
               SearchMemory& memory, std::vector<FeatureImpact>& found, MotionCounts& counts,
               std::vector<FeatureCandidate>* kept)
      : a_(a),
        b_(b),
        same_(a.mesh == b.mesh),
        rules_(rules),
        are_uniform_(rules.are_uniform()),
        largest_reach_(rules.reach.largest()),
        first_(first),
        memory_(memory),
        found_(found),
        counts_(counts),
        kept_(kept) {
    scale_ = memory.scale;
    largest_ = memory.largest;
    if (kept != nullptr) kept_wider_ = kKeptOfCoordinate * largest_;
    memory.a.begin(a.mesh);
    memory.b.begin(b.mesh);
    scaled_reach_ = scaled(largest_reach_);
    memory.facets.polygons.corners = 3;
    memory.edges.polygons.corners = 4;
    memory.facets.polygons.count = memory.edges.polygons.count = 0;
  }

  void search(const ClusterPair& pair) {
    MovingCluster &of_a = opened(a_, pair.a, memory_.a), &of_b = opened(b_, pair.b, memory_.b);
    NearFeatures &a = memory_.near_a, &b = memory_.near_b;
    const Cut cut = cut_of(of_a, of_b);
    if (kept_ != nullptr) kept_size_ = std::max(kept_size_, longest_side(whole_ways(of_a, of_b)));
    const auto near = [&](const MovingCluster& cluster) {
      return grown_generously(cluster.box_until(cut), scaled_reach_ + cut.wider);
    };
    if (!a.take(a_, of_a, cut, near(of_b)) || !b.take(b_, of_b, cut, near(of_a))) return;
    from_vertices(a, b, FeaturePair::vertex_facet);
    if (!same_) from_vertices(b, a, FeaturePair::facet_vertex);
    if (same_ && pair.a != pair.b) from_vertices(b, a, FeaturePair::vertex_facet);
    between_edges(a, b, pair.a == pair.b);
  }

  // One that was kept.
  void look_again(const FeatureCandidate& one) {
    const bool edges = one.kind == FeaturePair::edge_edge;
    Waiting& waiting = edges ? memory_.edges : memory_.facets;
    const int lane = waiting.polygons.count;
    waiting.pair[lane] = one;
    std::array<MovingVertex, 4> ends;  // of the polygon's corners each is what goes from one of the first to another
    if (edges) {
      const EdgeVertices e = a_.features->edge(one.a), f = b_.features->edge(one.b);
      ends = {scaled(a_.vertex(e[0])), scaled(a_.vertex(e[1])), scaled(b_.vertex(f[0])), scaled(b_.vertex(f[1]))};
    } else {
      const bool vertex_is_a = one.kind == FeaturePair::vertex_facet;
      const MovingMesh &of_vertex = vertex_is_a ? a_ : b_, &surface = vertex_is_a ? b_ : a_;
      const Corners c = surface.mesh->corners(vertex_is_a ? one.b : one.a);
      ends = {scaled(of_vertex.vertex(vertex_is_a ? one.a : one.b)), scaled(surface.vertex(c[0])),
              scaled(surface.vertex(c[1])), scaled(surface.vertex(c[2]))};
    }
    constexpr std::array<std::array<std::size_t, 2>, 4> kOfEdges{{{0, 2}, {0, 3}, {1, 3}, {1, 2}}},
        kOfFacet{{{0, 1}, {0, 2}, {0, 3}, {0, 3}}};
    for (int time = 0; time < 2; ++time) {
      for (int c = 0; c < waiting.polygons.corners; ++c) {
        const auto [from, to] = (edges ? kOfEdges : kOfFacet)[static_cast<std::size_t>(c)];
        const Vec3 corner = ends[to].at[time] - ends[from].at[time];
        for (int axis = 0; axis < 3; ++axis) waiting.polygons.corner[time][c][axis][lane] = corner[axis];
      }
    }
    added(waiting);
  }

  // Decides what still waits.
  void finish() {
    decide(memory_.facets);
    decide(memory_.edges);
  }

 private:
  double scaled(double reach) const {
    return reach > 0.0 ? std::max(scale_ * reach, std::numeric_limits<double>::denorm_min()) : 0.0;
  }

  MovingVertex scaled(const MovingVertex& vertex) const { return {{scale_ * vertex.at[0], scale_ * vertex.at[1]}}; }

  MovingCluster& opened(const MovingMesh& m, int cluster, OpenMesh& memory) const {
    return memory.clusters.get(cluster, [&](MovingCluster& one) { open(m, cluster, scale_, one); });
  }

  template <class Visit>
  void for_each_near(const FeatureWays& ones, const FeatureWays& others, const Visit& visit) {
    if (others.count == 0) return;
    const BoxPointers boxes{{others.lower[0], others.lower[1], others.lower[2]},
                            {others.upper[0], others.upper[1], others.upper[2]}};
    std::int32_t near[FeatureWays::kRoom];
    const double grown_by = box_reach(scaled_reach_, largest_);
    for (int i = 0; i < ones.count; ++i) {
      const Box way{{ones.lower[0][i], ones.lower[1][i], ones.lower[2][i]},
                    {ones.upper[0][i], ones.upper[1][i], ones.upper[2][i]}};
      const BoxBounds box = bounds_of(grown_by > 0.0 ? inflated(way, grown_by) : way);
      const int count = kernels().select_overlapping(boxes, others.count, box, near);
      for (int k = 0; k < count; ++k) visit(i, near[k]);
    }
  }

  void from_vertices(const NearFeatures& vertices, const NearFeatures& facets, FeaturePair kind) {
    const MovingMesh& surface = kind == FeaturePair::vertex_facet ? b_ : a_;
    for_each_near(vertices.vertices, facets.facets, [&](int i, int k) {
      const int vertex = vertices.vertex_begin + vertices.vertices.feature[i];
      const int facet = facets.facet_begin + facets.facets.feature[k];
      if ((surface.features->firsts_of_facet(facet) & Features::kRepeatsFacet) != 0) return;
      if (same_) {
        const Corners c = surface.mesh->corners(facet);
        if (c[0] == vertex || c[1] == vertex || c[2] == vertex) return;
      }
      const bool vertex_is_a = kind == FeaturePair::vertex_facet;
      Waiting& waiting = memory_.facets;
      const int lane = waiting.polygons.count;
      waiting.pair[lane] = {kind, vertex_is_a ? vertex : facet, vertex_is_a ? facet : vertex};
      const int v = vertices.vertices.corner[0][i];
      for (int time = 0; time < 2; ++time) {
        for (int axis = 0; axis < 3; ++axis) {
          const double from = vertices.cluster->at[time][axis][v], *const to = facets.cluster->at[time][axis];
          for (std::size_t c = 0; c < 3; ++c)
            waiting.polygons.corner[time][c][axis][lane] = to[facets.facets.corner[c][k]] - from;
        }
      }
      added(waiting);
    });
  }

  void between_edges(const NearFeatures& a, const NearFeatures& b, bool one_cluster) {
    for_each_near(a.edges, b.edges, [&](int i, int k) {
      const int e = a.edge_begin + a.edges.feature[i], f = b.edge_begin + b.edges.feature[k];
      if (same_ && ((one_cluster && e >= f) || share_a_vertex(a_.features->edge(e), b_.features->edge(f)))) return;
      Waiting& waiting = memory_.edges;
      const int lane = waiting.polygons.count;
      waiting.pair[lane] = {FeaturePair::edge_edge, e, f};
      const int of_p = a.edges.corner[0][i], of_q = a.edges.corner[1][i];
      const int of_r = b.edges.corner[0][k], of_s = b.edges.corner[1][k];
      for (int time = 0; time < 2; ++time) {
        for (int axis = 0; axis < 3; ++axis) {
          const double *const at_a = a.cluster->at[time][axis], *const at_b = b.cluster->at[time][axis];
          const double p = at_a[of_p], q = at_a[of_q], r = at_b[of_r], s = at_b[of_s];
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

  // What is later than the first impact so far does not count. A time found may be a little too early.
  Cut cut_of(const MovingCluster& a, const MovingCluster& b) const {
    Cut cut{.frame = frame_of(a, b)};
    const bool has_frame = cut.frame != Vec3{};
    const double until = first_ == nullptr ? 1.0 : first_->load(std::memory_order_relaxed) + kEarlier;
    cut.wider = kept_wider_;
    if (!has_frame && !(until < 1.0)) return cut;
    const Box all = whole_ways(a, b);
    cut.until = std::min(until, 1.0);
    cut.wider += kNearly * longest_side(all) + 0x1p-50 * largest_coordinate(all);
    return cut;
  }

  static Box whole_ways(const MovingCluster& a, const MovingCluster& b) {
    return merged(merged(a.box_at[0], a.box_at[1]), merged(b.box_at[0], b.box_at[1]));
  }

  // What both go together along an axis, in whole steps.
  static Vec3 frame_of(const MovingCluster& a, const MovingCluster& b) {
    const Vec3 way_a = base::way_of({a.box_at[0], a.box_at[1]}), way_b = base::way_of({b.box_at[0], b.box_at[1]});
    const double size = std::min(longest_side(a.box_at[0]), longest_side(b.box_at[0]));
    Vec3 frame;
    if (!(size > std::numeric_limits<double>::min())) return frame;
    const double step = std::ldexp(1.0, std::ilogb(size) - kStepsOfSize);
    for (int axis = 0; axis < 3; ++axis) {
      const double way = base::common_way(way_a[axis], way_b[axis]);
      if (std::abs(way) > kFewSteps * step) frame[axis] = step * std::nearbyint(way / step);
    }
    return frame;
  }

  void added(Waiting& waiting) {
    if (++waiting.polygons.count == MovingPolygons::kCapacity) decide(waiting);
  }

  void decide(Waiting& waiting) {
    const int count = waiting.polygons.count;
    if (count == 0) return;
    counts_.candidates += count;
    const std::size_t kept_before = kept_ == nullptr ? 0 : kept_->size();
    if (kept_ != nullptr) {
      waiting.keep(open_lanes(waiting, kept_wider_ + kKeptOfSize * kept_size_));
      kept_->insert(kept_->end(), waiting.pair, waiting.pair + waiting.polygons.count);
      if (waiting.polygons.count == 0) return;
    }
    std::uint64_t left = open_lanes(waiting, 0.0);
    waiting.polygons.count = 0;
    counts_.searched += std::popcount(left);
    for (; left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      settle(kept_ == nullptr ? waiting.pair[lane] : (*kept_)[kept_before + lane]);
    }
  }

  // Those, of one or more, that the filter does not leave out.
  std::uint64_t open_lanes(const Waiting& waiting, double wider) const {
    static_assert(MovingPolygons::kCapacity == 64);
    // Where reaches differ, that of a pair may lie between its distance and the largest reach.
    const PolygonReach reach{scaled_reach_, rules_.reach.is_uniform() ? kShareOfGap : 1.0, wider};
    return base::lowest_bits(waiting.polygons.count) & ~kernels().apart_throughout(waiting.polygons, reach);
  }

  void settle(FeatureCandidate& pair) {
    const FeaturePair kind = pair.kind;
    const int a = pair.a, b = pair.b;
    if (!are_uniform_ && !rules_.filter.allows(sources_a(kind, a), sources_b(kind, b))) return;
    const double latest = first_ != nullptr ? first_->load(std::memory_order_relaxed) : 1.0;
    const MovingPolygon features = polygon(kind, a, b);
    double time = meeting(features, kind, a, b, latest, 0.0);
    if (!(time <= 1.0)) return;
    if (time > 0.0 && !stays_level(features)) return add(kind, a, b, time, true);
    const double apart_until = memory_.parting.apart_until(a_, b_, kind, a, b, time, pair.planes);
    if (apart_until > 0.0) {
      if (first_ == nullptr) add(kind, a, b, time, false);
      if (apart_until == 1.0) return;
      time = meeting(features, kind, a, b, latest, apart_until);
      if (!(time <= 1.0)) return;
    }
    add(kind, a, b, time, true);
  }

  double meeting(const MovingPolygon& features, FeaturePair kind, int a, int b, double latest, double begin) {
    const double reach = reach_of(kind, a, b);
    Meeting found = memory_.meeting.first(features, reach, latest, begin);
    counts_.spans += found.spans;
    if (same_ && reach > 0.0 && found.time <= 1.0 && !is_contact(kind, a, b, found.time, scaled(reach))) {
      found = memory_.meeting.first(features, 0.0, latest, begin);
      counts_.spans += found.spans;
    }
    return found.time;
  }

  // Of one mesh.
  bool is_contact(FeaturePair kind, int a, int b, double time, double reach) const {
    return kind == FeaturePair::edge_edge ? memory_.contact.of_edges(a_, scale_, time, reach, a, b)
                                          : memory_.contact.of_vertex(a_, scale_, time, reach, a, b);
  }

  // Metres.
  double reach_of(FeaturePair kind, int a, int b) const {
    return are_uniform_ ? largest_reach_ : rules_.reach.of(sources_a(kind, a), sources_b(kind, b));
  }

  // The caller's numbers of the vertices of a feature.
  std::array<int, 3> sources_a(FeaturePair kind, int a) const {
    return sources(a_, kind, FeaturePair::facet_vertex, a);
  }
  std::array<int, 3> sources_b(FeaturePair kind, int b) const {
    return sources(b_, kind, FeaturePair::vertex_facet, b);
  }
  // Of one that is a facet in the kind `with_facet`.
  static std::array<int, 3> sources(const MovingMesh& m, FeaturePair kind, FeaturePair with_facet, int feature) {
    if (kind == FeaturePair::edge_edge) return source_vertices(*m.mesh, m.features->edge(feature));
    if (kind == with_facet) return source_vertices(*m.mesh, m.mesh->corners(feature));
    return source_vertices(*m.mesh, {&feature, 1});
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

  // Of an edge or a point in the place of a facet.
  static void name_bare(const ClusteredMesh& mesh, int facet, FeaturePair as_edge, std::array<int, 3>& vertices,
                        FeaturePair& kind) {
    if (mesh.is_of_surface(mesh.source_facet(facet))) return;
    const auto [first, last] = std::minmax(vertices[0], vertices[1]);
    kind = first == last ? FeaturePair::vertex_vertex : as_edge;
    vertices = {first, first == last ? -1 : last, -1};
  }

  void add(FeaturePair kind, int a, int b, double time, bool stops) {
    const bool edges = kind == FeaturePair::edge_edge;
    FeatureImpact impact{.kind = kind, .a = sources_a(kind, a), .b = sources_b(kind, b), .time = time, .stops = stops};
    if (kind == FeaturePair::vertex_facet) name_bare(*b_.mesh, b, FeaturePair::vertex_edge, impact.b, impact.kind);
    if (kind == FeaturePair::facet_vertex) name_bare(*a_.mesh, a, FeaturePair::edge_vertex, impact.a, impact.kind);
    const bool is_symmetric = edges || impact.kind == FeaturePair::vertex_vertex;
    if (same_ && is_symmetric && impact.b < impact.a) std::swap(impact.a, impact.b);
    found_.push_back(impact);
    if (first_ != nullptr) base::lower_to(*first_, time);
  }

  const MovingMesh &a_, &b_;
  const bool same_;
  const FeatureRules& rules_;
  const bool are_uniform_;
  const double largest_reach_;
  double scale_ = 1.0, scaled_reach_ = 0.0;
  double largest_ = 0.0;  // coordinate, scaled
  std::atomic<double>* const first_;
  SearchMemory& memory_;
  std::vector<FeatureImpact>& found_;
  MotionCounts& counts_;
  std::vector<FeatureCandidate>* const kept_;  // null: none are
  double kept_wider_ = 0.0, kept_size_ = 0.0;  // of those that are, and of the clusters on their ways so far
};

}  // namespace

Vec3 common_frame(const MovingMesh& a, const MovingMesh& b) {
  const Vec3 way_a = base::way_of({a.begin.box, a.end.box}), way_b = base::way_of({b.begin.box, b.end.box});
  const double far = kFarTogether * std::min(longest_side(a.begin.box), longest_side(b.begin.box));
  Vec3 frame;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = base::common_way(way_a[axis], way_b[axis]);
    if (std::abs(way) > far) frame[axis] = way;
  }
  return frame;
}

double earliest_time(const MovingMesh& a, int cluster_a, const MovingMesh& b, int cluster_b, double reach) {
  const auto boxes = [](const MovingMesh& m, int cluster) {
    const auto c = static_cast<std::size_t>(cluster);
    return base::MovingBox{m.begin.cluster_boxes[c], m.end.cluster_boxes[c]};
  };
  const base::MovingBox box_a = boxes(a, cluster_a), box_b = boxes(b, cluster_b);
  const Box all = merged(merged(box_a.begin, box_a.end), merged(box_b.begin, box_b.end));
  const base::TimeSpan span = near_span(box_a, box_b, kNearly * longest_side(all) + reach);
  if (span.from > span.to + kEarlier) return std::numeric_limits<double>::infinity();
  return std::max(span.from - kEarlier, 0.0);
}

struct ImpactFinder::Memory : SearchMemory {};

ImpactFinder::ImpactFinder() : memory_(std::make_unique<Memory>()) {}
ImpactFinder::~ImpactFinder() = default;
ImpactFinder::ImpactFinder(ImpactFinder&&) noexcept = default;
ImpactFinder& ImpactFinder::operator=(ImpactFinder&&) noexcept = default;

void ImpactFinder::begin(const Box& all) {
  memory_->scale = unit_scale(longest_side(all));
  memory_->largest = memory_->scale * largest_coordinate(all);
  memory_->a.begin(nullptr);
  memory_->b.begin(nullptr);
}

double ImpactFinder::kept_reach(const MovingMesh& a, const MovingMesh& b) const {
  const Box all = merged(merged(a.begin.box, a.end.box), merged(b.begin.box, b.end.box));
  return kKeptOfCoordinate * (memory_->largest / memory_->scale) + kNearly * longest_side(all);
}

void ImpactFinder::run(const MovingMesh& a, const MovingMesh& b, const FeatureRules& rules,
                       std::span<const ClusterPair> pairs, std::atomic<double>* first,
                       std::vector<FeatureImpact>& found, MotionCounts& counts, std::vector<FeatureCandidate>* kept) {
  ImpactSearch search(a, b, rules, first, *memory_, found, counts, kept);
  const double reach = rules.reach.largest() + (kept == nullptr ? 0.0 : kept_reach(a, b));
  for (const ClusterPair& pair : pairs) {
    if (first != nullptr && earliest_time(a, pair.a, b, pair.b, reach) > first->load(std::memory_order_relaxed))
      continue;
    search.search(pair);
  }
  search.finish();
}

void ImpactFinder::run_again(const MovingMesh& a, const MovingMesh& b, const FeatureRules& rules,
                             std::span<const FeatureCandidate> kept, std::atomic<double>* first,
                             std::vector<FeatureImpact>& found, MotionCounts& counts) {
  ImpactSearch search(a, b, rules, first, *memory_, found, counts, nullptr);
  for (const FeatureCandidate& one : kept) search.look_again(one);
  search.finish();
}

}  // namespace tact::narrowphase
