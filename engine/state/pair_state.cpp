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
  Checks(const StateReader& reader, const ClusteredMesh& a, const ClusteredMesh& b) : reader_(reader), a_(a), b_(b) {}

  void simplex(const narrowphase::GjkSimplex& simplex) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(simplex.count); ++k) vertices(simplex.a[k], simplex.b[k]);
  }

  void history(const PairHistory& history) const {
    constexpr double kSkew = 1e-6;  // far more than rounding, and far less than what any search minds
    reader_.check(a_.vertex_count() > 0 && b_.vertex_count() > 0, "a body without facets has a history");
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
      reader_.check(pair.a >= 0 && pair.a < a_.facet_count() && pair.b >= 0 && pair.b < b_.facet_count(),
                    "a facet is not there");
    reader_.check(std::ranges::is_sorted(pairs), "facet pairs are not sorted");
  }

  void points(std::span<const ContactPoint> points) const {
    for (const ContactPoint& point : points) {
      reader_.check(point.patch >= 0, "a number is negative");
      feature(point.a_vertices, a_);
      feature(point.b_vertices, b_);
    }
  }

  void within_reach(std::span<const ReachPair> pairs) const {
    for (const ReachPair& pair : pairs) {
      feature(pair.a_vertices, a_);
      feature(pair.b_vertices, b_);
    }
  }

  void patches(const PatchSet& set, std::size_t facet_pairs, std::size_t points) const {
    for (const int i : set.facet_pairs) reader_.check(is_below(i, facet_pairs), "a facet pair of a patch is not there");
    for (const int i : set.points) reader_.check(is_below(i, points), "a point of a patch is not there");
    for (const Patch& patch : set.patches) {
      for (const int i : patch.spanning) reader_.check(i == -1 || is_below(i, points), "a point is not there");
    }
    for (const PatchVertex& vertex : set.vertices)
      reader_.check(is_below(vertex.patch, set.patches.size()), "a patch is not there");
    reader_.check(std::ranges::is_sorted(set.vertices), "vertices of patches are not sorted");
  }

 private:
  static bool is_below(int i, std::size_t count) { return i >= 0 && static_cast<std::size_t>(i) < count; }

  void vertices(int a, int b) const {
    reader_.check(a >= 0 && a < a_.vertex_count() && b >= 0 && b < b_.vertex_count(), "a vertex is not there");
  }

  // One to three vertices of the caller's, each on a facet.
  void feature(const std::array<int, 3>& vertices, const ClusteredMesh& mesh) const {
    bool ended = false;
    for (std::size_t k = 0; k < 3; ++k) {
      ended |= vertices[k] == -1 && k > 0;
      if (ended && vertices[k] == -1) continue;
      reader_.check(!ended && vertices[k] >= 0 && vertices[k] < mesh.source_vertex_count() &&
                        !std::ranges::binary_search(mesh.unused_source_vertices(), vertices[k]),
                    "a vertex of a point is not there");
    }
  }

  const StateReader& reader_;
  const ClusteredMesh &a_, &b_;
};

}  // namespace

void write_pair(const PairRecord& record, StateWriter& writer) { writer(record); }

void read_pair(StateReader& reader, const ClusteredMesh& a, const ClusteredMesh& b, PairRecord& record) {
  reader(record);
  const Checks checks(reader, a, b);
  checks.history(record.history);
  if (record.history.has_surface) checks.surface(*record.surface);
  if (record.hulls_overlap) checks.simplex(record.face);
  checks.facet_pairs(record.facet_pairs);
  checks.points(record.points);
  checks.within_reach(record.within_reach);
  if (record.patches != nullptr) checks.patches(record.patches->now, record.facet_pairs.size(), record.points.size());
  record.contact.a = record.a;
  record.contact.b = record.b;
}

void write_self(const SelfRecord& record, StateWriter& writer) { writer(record); }

void read_self(StateReader& reader, const ClusteredMesh& mesh, SelfRecord& record) {
  reader(record);
  const Checks checks(reader, mesh, mesh);
  checks.facet_pairs(record.facet_pairs);
  checks.points(record.points);
  checks.within_reach(record.within_reach);
  checks.patches(record.patches.now, record.facet_pairs.size(), record.points.size());
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
