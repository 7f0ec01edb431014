#include "narrowphase/curves/intersection_curves.h"

#include <algorithm>

#include "narrowphase/distance/segment_facet.h"

namespace tact::narrowphase {

namespace {

NumberedTriangle triangle_of(const ClusteredMesh& mesh, int source_facet) {
  const Corners corners = mesh.corners(mesh.facet_of_source(source_facet));
  NumberedTriangle triangle;
  for (std::size_t k = 0; k < 3; ++k) triangle[k] = {mesh.position(corners[k]), mesh.source_vertex(corners[k])};
  return triangle;
}

// Whether it is a segment that has two sides in one.
bool repeats_a_vertex(const NumberedTriangle& t) {
  return t[0].number == t[1].number || t[1].number == t[2].number || t[2].number == t[0].number;
}

// The corners of two facets, which of them are above the other's plane, and the signs of their edges.
class FacetCrossing {
 public:
  FacetCrossing(const NumberedTriangle& a, const NumberedTriangle& b, PerturbedSigns& signs)
      : facet_{a, b}, signs_(signs) {
    for (auto& row : edges_) row.fill(kUnknown);
  }

  int common_vertices() const {
    int count = 0;
    for (const NumberedPoint& p : facet_[0]) count += position_of(p.number, 1) >= 0 ? 1 : 0;
    return count;
  }
  // The corner of a facet with a number; -1: none.
  int position_of(int number, std::size_t whose) const {
    for (int k = 0; k < 3; ++k) {
      if (facet_[whose][static_cast<std::size_t>(k)].number == number) return k;
    }
    return -1;
  }

  // How the edge from corner k of one facet to the next goes through the other: 1 upwards, -1 downwards, 0 not at all.
  // Edges of which a corner is the other's, too, do not.
  int through(std::size_t whose, std::size_t k) {
    const std::size_t next = (k + 1) % 3;
    if (signs_.is_of_one() && (is_common(whose, k) || is_common(whose, next))) return 0;
    const int from = height(whose, k), to = height(whose, next);
    if (from * to >= 0) return 0;
    const int first = edges(whose, k, 0);
    return first != 0 && edges(whose, k, 1) == first && edges(whose, k, 2) == first ? to : 0;
  }

 private:
  static constexpr int kUnknown = 2;

  bool is_common(std::size_t whose, std::size_t k) const {
    return position_of(facet_[whose][k].number, 1 - whose) >= 0;
  }
  // 1 above the other's plane, -1 below.
  int height(std::size_t whose, std::size_t k) {
    int& known = height_[whose][k];
    if (known == kUnknown) known = -signs_.side(facet_[1 - whose], facet_[whose][k], static_cast<int>(whose));
    return known;
  }
  // Of the edge k of one facet with the edge m of the other.
  int edges(std::size_t whose, std::size_t k, std::size_t m) {
    const std::size_t of_a = whose == 0 ? k : m, of_b = whose == 0 ? m : k;
    int& known = edges_[of_a][of_b];
    if (known == kUnknown) {
      const auto &a = facet_[0], &b = facet_[1];
      known = signs_.edges(a[of_a], a[(of_a + 1) % 3], b[of_b], b[(of_b + 1) % 3]);
    }
    return known;
  }

  std::array<NumberedTriangle, 2> facet_;
  PerturbedSigns& signs_;
  std::array<std::array<int, 3>, 2> height_{{{kUnknown, kUnknown, kUnknown}, {kUnknown, kUnknown, kUnknown}}};
  std::array<std::array<int, 3>, 3> edges_{};
};

}  // namespace

void IntersectionCurves::find(const ClusteredMesh& a, const ClusteredMesh& b, std::span<const FacetPair> pairs,
                              Vec3 apart) {
  signs_ = &a == &b ? PerturbedSigns::of_one() : PerturbedSigns::of_two(apart);
  segments_.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) find_segment(a, b, pairs[i], static_cast<int>(i));
  link();
  walk(a, b, pairs);
}

// Along the normal of a's facet times that of b's, what of a's facet is above b's lies to the right: there a's border,
// counter-clockwise, goes upwards where the segment enters, and downwards where it leaves. Of b's it is the reverse.
void IntersectionCurves::find_segment(const ClusteredMesh& a, const ClusteredMesh& b, const FacetPair& pair,
                                      int number) {
  const NumberedTriangle of_a = triangle_of(a, pair.a), of_b = triangle_of(b, pair.b);
  if (repeats_a_vertex(of_a) || repeats_a_vertex(of_b)) return;
  FacetCrossing crossing(of_a, of_b, signs_);
  const int common = signs_.is_of_one() ? crossing.common_vertices() : 0;
  if (common > 1) return;
  Segment segment;
  segment.pair = number;
  int found = 0;
  for (std::size_t whose = 0; whose < 2; ++whose) {
    const NumberedTriangle& own = whose == 0 ? of_a : of_b;
    for (std::size_t k = 0; k < 3; ++k) {
      const int up = crossing.through(whose, k);
      if (up == 0) continue;
      const bool enters = (up > 0) == (whose == 0);
      const auto [first, second] = std::minmax(own[k].number, own[(k + 1) % 3].number);
      // Of one mesh both facets are of it.
      segment.end[enters ? 0 : 1] = {{first, second}, whose == 0 ? pair.b : pair.a, whose == 1 && &a != &b};
      found |= enters ? 1 : 2;
    }
  }
  if (found == 0) return;
  if (common == 1 && found != 3) {
    const auto shared =
        std::ranges::find_if(of_a, [&](const NumberedPoint& p) { return crossing.position_of(p.number, 1) >= 0; });
    segment.end[found == 1 ? 1 : 0] = {{shared->number, -1}, -1, false};
    found = 3;
  }
  if (found == 3) segments_.push_back(segment);
}

// Two segments at a node follow each other. Where there are one, or three and more, they end.
void IntersectionCurves::link() {
  nodes_.clear();
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    for (int end = 0; end < 2; ++end) {
      const CurveNode& node = segments_[i].end[static_cast<std::size_t>(end)];
      if (node.facet >= 0) nodes_.push_back({node, 2 * static_cast<int>(i) + end});
    }
  }
  std::ranges::sort(nodes_);
  for (std::size_t begin = 0, end = 0; begin < nodes_.size(); begin = end) {
    while (end < nodes_.size() && nodes_[end].node == nodes_[begin].node) ++end;
    if (end - begin != 2) continue;
    const auto next_of = [&](std::size_t i) -> int& {
      const auto place = static_cast<std::size_t>(nodes_[i].segment_end);
      return segments_[place / 2].next[place % 2];
    };
    next_of(begin) = nodes_[begin + 1].segment_end;
    next_of(begin + 1) = nodes_[begin].segment_end;
  }
}

void IntersectionCurves::walk(const ClusteredMesh& a, const ClusteredMesh& b, std::span<const FacetPair> pairs) {
  curves_.clear();
  corners_.clear();
  walked_.assign(segments_.size(), 0);
  const auto index_of = [](int end) { return static_cast<std::size_t>(end) / 2; };
  const auto segment = [&](int end) -> const Segment& { return segments_[index_of(end)]; };
  const auto node_of = [&](int end) { return segment(end).end[static_cast<std::size_t>(end) % 2]; };
  const auto pair_of = [&](int end) { return static_cast<std::size_t>(segment(end).pair); };
  const auto next = [&](int end) { return segment(end).next[static_cast<std::size_t>(end) % 2]; };
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    if (walked_[i] != 0) continue;
    // Back to where the curve begins: `first` is the end of a segment through which it comes in.
    const int own = 2 * static_cast<int>(i);
    int first = own;
    bool closed = false;
    while (next(first) >= 0 && !closed) {
      first = next(first) ^ 1;
      closed = first == own;
    }
    CurveRange curve{.begin = corners_.size(), .closed = closed};
    int in = first;
    do {
      const int out = in ^ 1;
      walked_[index_of(in)] = 1;
      append_corner(a, b, pairs[pair_of(in)], node_of(in), segment(in).pair);
      if (next(out) < 0) append_corner(a, b, pairs[pair_of(out)], node_of(out), -1);
      in = next(out);
    } while (in >= 0 && in != first);
    curve.end = corners_.size();
    curves_.push_back(curve);
  }
}

void IntersectionCurves::append_corner(const ClusteredMesh& a, const ClusteredMesh& b, const FacetPair& facets,
                                       const CurveNode& node, int pair) {
  const ClusteredMesh &own = node.edge_of_b ? b : a, &other = node.edge_of_b ? a : b;
  // Of one mesh the edge is of the facet that it does not go through.
  const bool is_of_b = &a == &b ? node.facet == facets.a : node.edge_of_b;
  const NumberedTriangle facet = triangle_of(own, is_of_b ? facets.b : facets.a);
  const auto place = [&](int number) { return std::ranges::find(facet, number, &NumberedPoint::number)->at; };
  CurveCorner corner{.node = node, .position = place(node.edge[0]), .pair = pair};
  if (node.facet >= 0 && place(node.edge[1]) != corner.position) {
    const PlaceOfSegment crossed =
        place_in_facet({corner.position, place(node.edge[1])}, other.triangle(other.facet_of_source(node.facet)));
    corner.position = crossed.position;
    corner.fraction = crossed.time;
  }
  corners_.push_back(corner);
}

}  // namespace tact::narrowphase
