#include "engine/state/pair_state.h"

#include <algorithm>
#include <cmath>

namespace tact {

namespace {

using narrowphase::ClusteredMesh;
using narrowphase::SurfaceShape;

// Checks what later steps take as given: with that, whatever the bytes are, nothing is read where nothing is.
class Checks {
 public:
  Checks(const StateReader& reader, const Body& a, const Body& b)
      : reader_(reader), a_(a.mesh), b_(b.mesh), a_is_plane_(a.plane != nullptr), b_is_plane_(b.plane != nullptr) {}

  void simplex(const narrowphase::GjkSimplex& simplex) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(simplex.count); ++k) vertices(simplex.a[k], simplex.b[k]);
  }

  void history(const PairHistory& history) const {
    constexpr double kSkew = 1e-6;  // far more than rounding, and far less than what any search minds
    reader_.check(!(a_is_plane_ && b_is_plane_), "two planes have a history");
    reader_.check(history.kind == PairHistory::Kind::none || !(a_is_plane_ || b_is_plane_), "a plane has a history");
    simplex(history.hulls);
    if (history.kind == PairHistory::Kind::none) return;
    reader_.check(std::abs(dot(history.direction, history.direction) - 1.0) < kSkew, "a direction is no unit vector");
  }

  // That every side of a face is that of its neighbour, the other way round.
  void surface(const SurfaceShape& shape) const {
    for (std::size_t v = 0; v < static_cast<std::size_t>(shape.vertex_count); ++v) vertices(shape.a[v], shape.b[v]);
    for (std::size_t f = 0; f < static_cast<std::size_t>(shape.face_count); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = shape.corner[f][k], to = shape.corner[f][(k + 1) % 3], other = shape.neighbor[f][k];
        reader_.check(from < shape.vertex_count && other < shape.face_count, "a face names a corner that is not there");
        bool is_mutual = false;
        for (std::size_t j = 0; j < 3; ++j) {
          const auto& corners = shape.corner[static_cast<std::size_t>(other)];
          const auto& neighbors = shape.neighbor[static_cast<std::size_t>(other)];
          is_mutual |= corners[j] == to && corners[(j + 1) % 3] == from && neighbors[j] == f;
        }
        reader_.check(is_mutual, "faces are no neighbours of each other");
      }
    }
  }

  void facet_pairs(std::span<const FacetPair> pairs) const {
    for (const FacetPair& pair : pairs)
      reader_.check(is_below(pair.a, facets(a_, a_is_plane_)) && is_below(pair.b, facets(b_, b_is_plane_)),
                    "a facet is not there");
    reader_.check(std::ranges::is_sorted(pairs), "facet pairs are not sorted");
  }

  void points(std::span<const ContactPoint> points) const {
    for (const ContactPoint& point : points) {
      reader_.check(point.patch >= 0, "a number is negative");
      a_is_plane_ ? no_feature(point.a_vertices)
                  : feature(point.a_vertices, a_, point.kind == FeaturePair::facet_vertex);
      b_is_plane_ ? no_feature(point.b_vertices)
                  : feature(point.b_vertices, b_, point.kind == FeaturePair::vertex_facet);
    }
  }

  void within_reach(std::span<const ReachPair> pairs) const {
    for (const ReachPair& pair : pairs) {
      feature(pair.a_vertices, a_, false);
      feature(pair.b_vertices, b_, false);
    }
  }

  void patches(const PatchSet& set, std::size_t facet_pairs, std::size_t points) const {
    reader_.check(set.spanning.size() == set.patches.size(), "patches are spanned by nothing");
    for (const int i : set.facet_pairs) reader_.check(is_below(i, facet_pairs), "a facet pair of a patch is not there");
    for (const int i : set.points) reader_.check(is_below(i, points), "a point of a patch is not there");
    for (const Patch& patch : set.patches) {
      for (const int i : patch.spanning) reader_.check(i == -1 || is_below(i, points), "a point is not there");
    }
    for (const PatchVertex& vertex : set.vertices)
      reader_.check(is_below(vertex.patch, set.patches.size()), "a patch is not there");
    reader_.check(std::ranges::is_sorted(set.vertices), "vertices of patches are not sorted");
  }

  void curves(const CurveSet& set, std::size_t facet_pairs) const {
    for (const CurvePoint& point : set.points)
      reader_.check(point.facet_pair == -1 || is_below(point.facet_pair, facet_pairs),
                    "a facet pair of a curve is not there");
  }

 private:
  static bool is_below(int i, std::size_t count) { return i >= 0 && static_cast<std::size_t>(i) < count; }

  // The surface of a plane is a facet, and its history names vertex 0.
  static std::size_t facets(const ClusteredMesh& mesh, bool is_plane) {
    return is_plane ? 1 : static_cast<std::size_t>(mesh.facet_count());
  }
  static std::size_t vertices(const ClusteredMesh& mesh, bool is_plane) {
    return is_plane ? 1 : static_cast<std::size_t>(mesh.vertex_count());
  }
  void vertices(int a, int b) const {
    reader_.check(is_below(a, vertices(a_, a_is_plane_)) && is_below(b, vertices(b_, b_is_plane_)),
                  "a vertex is not there");
  }
  void no_feature(const std::array<int, 3>& vertices) const {
    reader_.check(vertices == std::array{-1, -1, -1}, "a plane has a vertex");
  }

  // One to three vertices of the caller's, each on a facet. Of the place that a vertex was near there may be none left.
  void feature(const std::array<int, 3>& vertices, const ClusteredMesh& mesh, bool may_be_gone) const {
    bool ended = false;
    for (std::size_t k = 0; k < 3; ++k) {
      ended |= vertices[k] == -1 && (k > 0 || may_be_gone);
      if (ended && vertices[k] == -1) continue;
      reader_.check(!ended && vertices[k] >= 0 && vertices[k] < mesh.source_vertex_count() &&
                        !std::ranges::binary_search(mesh.unused_source_vertices(), vertices[k]),
                    "a vertex of a point is not there");
    }
  }

  const StateReader& reader_;
  const ClusteredMesh &a_, &b_;
  bool a_is_plane_, b_is_plane_;
};

}  // namespace

void write_pair(const PairRecord& record, StateWriter& writer) { writer(record); }

void read_pair(StateReader& reader, const Body& a, const Body& b, PairRecord& record) {
  reader(record);
  check_pair(reader, a, b, record);
}

void check_pair(const StateReader& reader, const Body& a, const Body& b, PairRecord& record) {
  const Checks checks(reader, a, b);
  checks.history(record.history);
  if (record.history.has_surface) checks.surface(*record.surface);
  if (record.hulls_overlap) checks.simplex(record.face);
  checks.facet_pairs(record.facet_pairs);
  checks.points(record.points);
  checks.within_reach(record.within_reach);
  if (record.patches != nullptr) checks.patches(record.patches->now, record.facet_pairs.size(), record.points.size());
  if (record.curves != nullptr) checks.curves(*record.curves, record.facet_pairs.size());
  record.contact.a = record.a;
  record.contact.b = record.b;
}

void write_self(const SelfRecord& record, StateWriter& writer) { writer(record); }

void read_self(StateReader& reader, const Body& body, SelfRecord& record) {
  reader(record);
  const Checks checks(reader, body, body);
  checks.facet_pairs(record.facet_pairs);
  checks.facet_pairs(record.bare_pairs);
  checks.points(record.points);
  checks.within_reach(record.within_reach);
  checks.patches(record.patches.now, record.facet_pairs.size(), record.points.size());
  if (record.curves != nullptr) checks.curves(*record.curves, record.facet_pairs.size());
}

void write_gone(bool touching, const PatchSet* patches, StateWriter& writer) {
  std::vector<std::uint64_t> ids;
  if (patches != nullptr) {
    for (const Patch& patch : patches->patches) ids.push_back(patch.id);
  }
  writer(touching, ids);
}

void read_gone(StateReader& reader, bool& touching, PatchSet& patches) {
  std::vector<std::uint64_t> ids;
  reader(touching, ids);
  for (const std::uint64_t id : ids) patches.patches.emplace_back().id = id;
}

}  // namespace tact
