#include "narrowphase/queries/mesh_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "narrowphase/curves/intersection_curves.h"
#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/numeric/unit_scale.h"
#include "narrowphase/queries/facet_pair_descent.h"
#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

// The pairs of facets that meet.
class MeetingPairs {
 public:
  MeetingPairs(const ClusteredMesh& a, const ClusteredMesh& b) : a_(a), b_(b) {
    descend_to_facet_pairs(a, b, *this);
    std::ranges::sort(pairs_);
  }

  double rank(const Box& a, const Box& b) const { return overlaps(a, b) ? 0.0 : 1.0; }
  bool wants(double rank, int, int) const { return rank == 0.0; }
  void look_at(int a, int b, double) {
    const int of_a = a_.source_facet(a), of_b = b_.source_facet(b);
    if (!a_.is_of_surface(of_a) || !b_.is_of_surface(of_b)) return;
    if (triangle_triangle_meet(a_.triangle(a), b_.triangle(b), counts_)) pairs_.push_back({of_a, of_b});
  }
  std::span<const FacetPair> pairs() const { return pairs_; }

 private:
  const ClusteredMesh &a_, &b_;
  std::vector<FacetPair> pairs_;
  PredicateCounts counts_;
};

// Where an edge of a mesh goes through a facet of the other.
struct EdgeCrossed {
  std::array<int, 2> edge;  // the caller's numbers, ascending
  double fraction;
  Vec3 position;
  int facet;  // of the other
};

// What two facets have in common, along the normal of a's times that of b's.
struct CommonSegment {
  int facet;
  Vec3 begin, end;
};

// Of a list that is sorted by a member, those of which it has a value.
template <class Item, class Value>
std::span<const Item> those_with(const std::vector<Item>& sorted, const Value& value, Value Item::*member) {
  const auto begin = std::ranges::lower_bound(sorted, value, {}, member),
             end = std::ranges::upper_bound(sorted, value, {}, member);
  return {sorted.data() + (begin - sorted.begin()), static_cast<std::size_t>(end - begin)};
}

NumberedTriangle numbered(const ClusteredMesh& mesh, int facet) {
  const Corners corners = mesh.corners(facet);
  NumberedTriangle triangle;
  for (std::size_t k = 0; k < 3; ++k) triangle[k] = {mesh.position(corners[k]), mesh.source_vertex(corners[k])};
  return triangle;
}

// How often a mesh winds around a vertex of the other: along x, what is left through minus what is entered through.
int winding_around(const ClusteredMesh& mesh, const NumberedPoint& p, PerturbedSigns& signs, int whose) {
  int winding = 0;
  const Box half_line{p.at, {std::numeric_limits<double>::infinity(), p.at.y, p.at.z}};
  for_each_cluster_in(mesh, half_line, [&](int cluster) {
    for (int f = mesh.facet_begin(cluster); f < mesh.facet_end(cluster); ++f) {
      if (!mesh.is_of_surface(mesh.source_facet(f))) continue;
      const NumberedTriangle t = numbered(mesh, f);
      if (!overlaps(box_of({t[0].at, t[1].at, t[2].at}), half_line)) continue;
      const int side = signs.turn_along_x(t[0].at, t[1].at, p.at, whose);
      if (side == 0 || signs.turn_along_x(t[1].at, t[2].at, p.at, whose) != side ||
          signs.turn_along_x(t[2].at, t[0].at, p.at, whose) != side)
        continue;
      if (signs.side(t, p, whose) == side) winding += side;
    }
  });
  return winding;
}

// How often a mesh winds around the vertices of another, told from vertex to vertex along edges.
class VertexWindings {
 public:
  explicit VertexWindings(int vertices) : above_(static_cast<std::size_t>(vertices)), more_(above_.size(), 0) {
    std::iota(above_.begin(), above_.end(), 0);
  }

  // Around `v` it winds `more` times more often than around `u`.
  void connect(int u, int v, int more) {
    const int root_u = find_root(u), root_v = find_root(v);
    if (root_u == root_v) return;
    above_[at(root_v)] = root_u;
    more_[at(root_v)] = more_[at(u)] + more - more_[at(v)];
  }
  // winding(vertex) is called once for each connected part.
  template <class Winding>
  int around(int v, const Winding& winding) {
    const int root = find_root(v), offset = root == v ? 0 : more_[at(v)];
    if (known_.empty()) known_.resize(above_.size(), kUnknown);
    if (known_[at(root)] == kUnknown) known_[at(root)] = winding(root);
    return known_[at(root)] + offset;
  }

 private:
  static constexpr int kUnknown = std::numeric_limits<int>::min();
  static std::size_t at(int v) { return static_cast<std::size_t>(v); }
  // Afterwards `v` is right below its root, or is it, with more_ of zero.
  int find_root(int v) {
    int root = v, sum = 0;
    for (; above_[at(root)] != root; root = above_[at(root)]) sum += more_[at(root)];
    while (above_[at(v)] != v) {
      const int next = above_[at(v)], own = more_[at(v)];
      above_[at(v)] = root;
      more_[at(v)] = sum;
      sum -= own;
      v = next;
    }
    return root;
  }

  std::vector<int> above_, more_;  // how much more than around the vertex above
  std::vector<int> known_;
};

// What of a mesh's surface is inside the other.
class SurfaceInside {
 public:
  SurfaceInside(const ClosedMesh& own, const ClosedMesh& other, int whose, PerturbedSigns& signs)
      : mesh_(*own.mesh),
        other_(*other.mesh),
        whose_(whose),
        signs_(signs),
        turned_(own.is_outward ? 1.0 : -1.0),
        times_(other.is_outward ? 1.0 : -1.0),
        windings_(mesh_.vertex_count()) {}

  void take(const IntersectionCurves& curves, std::span<const FacetPair> pairs) {
    const std::span<const CurveCorner> corners = curves.corners();
    for (const CurveRange& curve : curves.curves()) {
      for (std::size_t i = curve.begin; i < curve.end; ++i) {
        if (corners[i].node.edge_of_b == (whose_ == 1)) take_node(corners[i]);
        if (corners[i].pair < 0) continue;
        const FacetPair& pair = pairs[static_cast<std::size_t>(corners[i].pair)];
        const CurveCorner& next = corners[i + 1 < curve.end ? i + 1 : curve.begin];
        // What is inside the other lies to the left of a segment on a, and to the right of it on b.
        if (whose_ == 0) segments_.push_back({pair.a, corners[i].position, next.position});
        if (whose_ == 1) segments_.push_back({pair.b, next.position, corners[i].position});
      }
    }
    std::ranges::sort(segments_, {}, &CommonSegment::facet);
    std::ranges::sort(nodes_, is_before);
    const auto is_same = [](const EdgeCrossed& p, const EdgeCrossed& q) {
      return p.edge == q.edge && p.facet == q.facet;
    };
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end(), is_same), nodes_.end());
    // Along an edge.
    std::ranges::stable_sort(nodes_, [](const EdgeCrossed& p, const EdgeCrossed& q) {
      return p.edge != q.edge ? p.edge < q.edge : p.fraction < q.fraction;
    });
  }

  // Adds what it is of the volume around `origin`, and of the surface, in a unit of 1 / `scale` metres.
  void add_to(OverlapSize& sum, Vec3 origin, double scale) {
    std::vector<int> facets;
    for_each_cluster_in(mesh_, other_.box(), [&](int cluster) {
      for (int f = mesh_.facet_begin(cluster); f < mesh_.facet_end(cluster); ++f) {
        if (mesh_.is_of_surface(mesh_.source_facet(f)) && overlaps(box_of(mesh_.triangle(f)), other_.box()))
          facets.push_back(f);
      }
    });
    // In an order that does not depend on clusters.
    std::ranges::sort(facets, {}, [&](int f) { return mesh_.source_facet(f); });
    for (const int f : facets) connect(f);
    for (const int f : facets) {
      const Triangle t = triangle_from(origin, scale, f);
      const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
      if (!(norm_squared(normal) > 0.0)) continue;
      const Vec3 inside = (0.5 * times_) * area_inside(f, scale);
      sum.volume += turned_ * dot(t[0], inside) / 3.0;
      sum.area += dot(normalized(normal), inside);
    }
  }

 private:
  static bool is_before(const EdgeCrossed& p, const EdgeCrossed& q) {
    return p.edge != q.edge ? p.edge < q.edge : p.facet < q.facet;
  }
  Triangle triangle_from(Vec3 origin, double scale, int f) const {
    const Triangle t = mesh_.triangle(f);
    return {scale * (t[0] - origin), scale * (t[1] - origin), scale * (t[2] - origin)};
  }

  void take_node(const CurveCorner& corner) {
    nodes_.push_back({corner.node.edge, corner.fraction, corner.position, corner.node.facet});
  }
  std::span<const EdgeCrossed> crossings(int from, int to) const {
    const std::array<int, 2> edge{std::min(from, to), std::max(from, to)};
    return those_with(nodes_, edge, &EdgeCrossed::edge);
  }
  // How much more the other winds behind a crossing, along its edge, whose beginning is given.
  int step_at(const EdgeCrossed& crossing, const NumberedPoint& begin) {
    return -signs_.side(numbered(other_, other_.facet_of_source(crossing.facet)), begin, whose_);
  }

  // Of the edges of a facet.
  void connect(int f) {
    const NumberedTriangle t = numbered(mesh_, f);
    const Corners corners = mesh_.corners(f);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const bool ascends = t[k].number < t[next].number;
      const std::size_t low = ascends ? k : next, high = ascends ? next : k;
      int more = 0;
      for (const EdgeCrossed& crossing : crossings(t[k].number, t[next].number)) more += step_at(crossing, t[low]);
      windings_.connect(corners[low], corners[high], more);
    }
  }

  // Twice the part of a facet that is inside, as a vector.
  Vec3 area_inside(int f, double scale) {
    const NumberedTriangle t = numbered(mesh_, f);
    const Vec3 origin = t[0].at;
    const Corners corners = mesh_.corners(f);
    Vec3 sum;
    const auto add = [&](Vec3 p, Vec3 q, int times) {
      if (times != 0) sum = sum + static_cast<double>(times) * cross(scale * (p - origin), scale * (q - origin));
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const bool ascends = t[k].number < t[next].number;
      const std::size_t low = ascends ? k : next, high = ascends ? next : k;
      int winding = windings_.around(corners[low], [&](int v) {
        return winding_around(other_, {mesh_.position(v), mesh_.source_vertex(v)}, signs_, whose_);
      });
      Vec3 last = t[low].at;
      const auto go_to = [&](Vec3 p) { ascends ? add(last, p, winding) : add(p, last, winding), last = p; };
      for (const EdgeCrossed& crossing : crossings(t[k].number, t[next].number)) {
        go_to(crossing.position);
        winding += step_at(crossing, t[low]);
      }
      go_to(t[high].at);
    }
    for (const CommonSegment& segment : those_with(segments_, mesh_.source_facet(f), &CommonSegment::facet))
      add(segment.begin, segment.end, 1);
    return sum;
  }

  const ClusteredMesh &mesh_, &other_;
  int whose_;
  PerturbedSigns& signs_;
  double turned_, times_;
  VertexWindings windings_;
  std::vector<EdgeCrossed> nodes_;
  std::vector<CommonSegment> segments_;
};

}  // namespace

OverlapSize overlap_size(const ClosedMesh& a, const ClosedMesh& b) {
  if (!overlaps(a.mesh->box(), b.mesh->box())) return {};
  const auto middle = [](const Box& box) { return 0.5 * box.lower + 0.5 * box.upper; };
  const Vec3 apart = middle(b.mesh->box()) - middle(a.mesh->box());
  const MeetingPairs pairs(*a.mesh, *b.mesh);
  IntersectionCurves curves;
  curves.find(*a.mesh, *b.mesh, pairs.pairs(), apart);
  PerturbedSigns signs = PerturbedSigns::of_two(apart);
  const Box common = intersection(a.mesh->box(), b.mesh->box());
  const Vec3 origin = middle(common);
  // In metres products of lengths would overflow, or be nothing.
  const double scale = unit_scale(largest_coordinate(common.upper - common.lower));
  OverlapSize sum;
  SurfaceInside of_a(a, b, 0, signs), of_b(b, a, 1, signs);
  for (SurfaceInside* const surface : {&of_a, &of_b}) {
    surface->take(curves, pairs.pairs());
    surface->add_to(sum, origin, scale);
  }
  const int exponent = -std::ilogb(scale);
  return {std::ldexp(std::max(sum.volume, 0.0), 3 * exponent), std::ldexp(std::max(sum.area, 0.0), 2 * exponent)};
}

}  // namespace tact::narrowphase
