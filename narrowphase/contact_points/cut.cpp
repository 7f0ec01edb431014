#include "narrowphase/contact_points/cut.h"

#include <algorithm>
#include <utility>

#include "narrowphase/queries/mesh_queries.h"

namespace tact::narrowphase {

void Cut::begin(const FeaturedMesh& own, std::span<const FacetPair> pairs, Which which) {
  clear_state(own);
  const ClusteredMesh& mesh = *own.mesh;
  // A facet comes again soon; to take it again changes nothing.
  std::array<int, 64> recent;
  recent.fill(-1);
  for (const FacetPair& pair : pairs) {
    const int source = which == Which::a ? pair.a : pair.b;
    int& known = recent[static_cast<std::size_t>(source) % recent.size()];
    if (source == known) continue;
    known = source;
    const Corners& corners = own.features->corners(mesh.facet_of_source(source));
    const int first = mesh.source_vertex(corners[0]);
    for (const int v : corners) {
      const int source_vertex = mesh.source_vertex(v);
      if (state_[source_vertex] == kUnknown) {
        touch(source_vertex);
        state_[source_vertex] = kRing;
        ring_.push_back(v);
      }
      join(source_vertex, first);
    }
  }
}

void Cut::order_hits() {
  for (std::size_t i = hits_.size(); i-- > 0;) first_hit_[hits_[i].vertices[0]] = static_cast<int>(i);
}

std::span<const EdgeHit> Cut::hits_of(const EdgeVertices& vertices) const {
  const int first = first_hit_[vertices[0]];
  if (first < 0) return {};
  const std::uint64_t key = EdgeHit{vertices}.key();
  auto begin = static_cast<std::size_t>(first);
  while (begin < hits_.size() && hits_[begin].key() < key) ++begin;
  std::size_t end = begin;
  while (end < hits_.size() && hits_[end].key() == key) ++end;
  return std::span(hits_).subspan(begin, end - begin);
}

bool Cut::is_cut_between(const ClusteredMesh& mesh, int v, int w) const {
  const auto [first, second] = std::minmax({mesh.source_vertex(v), mesh.source_vertex(w)});
  return is_cut({first, second});
}

Cut::State& Cut::state(const ClusteredMesh& mesh, int vertex) { return state_[mesh.source_vertex(vertex)]; }

void Cut::touch(int source_vertex) {
  touched_.push_back(source_vertex);
  parent_[source_vertex] = source_vertex;
}

int Cut::root_of(int source_vertex) const {
  const auto parent = [&](int v) { return parent_[v]; };
  while (parent(source_vertex) != source_vertex) source_vertex = parent(source_vertex);
  return source_vertex;
}

// The root of a set is its least number; the way there is halved.
void Cut::join(int source_vertex, int other_source_vertex) {
  const auto root = [&](int v) {
    for (auto at = static_cast<std::size_t>(v); parent_[at] != v; at = static_cast<std::size_t>(v))
      v = parent_[at] = parent_[parent_[at]];
    return v;
  };
  const auto [first, second] = std::minmax({root(source_vertex), root(other_source_vertex)});
  parent_[second] = first;
}

void Cut::number_patches() {
  patch_count_ = 0;
  for (const int v : touched_) {
    if (parent_[v] == v) patch_[v] = patch_count_++;
  }
}

int Cut::patch_of(int source_vertex) const {
  if (parent_[source_vertex] < 0) return -1;
  return patch_[root_of(source_vertex)];
}

void Cut::clear_state(const FeaturedMesh& own) {
  for (const int v : touched_) {
    state_[v] = kUnknown;
    parent_[v] = first_hit_[v] = -1;
  }
  const auto count = static_cast<std::size_t>(own.mesh->source_vertex_count());
  if (state_.size() < count) {
    state_.resize(count, kUnknown);
    parent_.resize(count, -1);
    patch_.resize(count, -1);
    first_hit_.resize(count, -1);
  }
  touched_.clear();
  ring_.clear();
  inside_.clear();
  patch_count_ = 0;
}

void Cut::find_inside(const FeaturedMesh& own, const ClusteredMesh& other) {
  const ClusteredMesh& mesh = *own.mesh;
  for (const int v : ring_) {
    if (state(mesh, v) != kRing) continue;
    if (contains(other, mesh.position(v))) {
      flood_inside(own, v);
    } else {
      flood_outside(own, v);
    }
  }
  // Parts of the mesh of which no edge is cut.
  const auto parts = own.features->one_of_each_part();
  if (parts.size() == 1 && !ring_.empty()) return;
  for (const int v : parts) {
    if (state(mesh, v) != kUnknown || !base::contains(other.box(), mesh.position(v))) continue;
    if (contains(other, mesh.position(v))) flood_inside(own, v);
  }
}

void Cut::add_inside(const FeaturedMesh& own, int vertex, int from_source_vertex) {
  const int source = own.mesh->source_vertex(vertex);
  State& one = state(*own.mesh, vertex);
  if (one == kUnknown) touch(source);
  one = kInside;
  inside_.push_back(vertex);
  if (from_source_vertex >= 0) join(source, from_source_vertex);
}

void Cut::flood_inside(const FeaturedMesh& own, int vertex) {
  const std::size_t first = inside_.size();
  add_inside(own, vertex, -1);
  for (std::size_t i = first; i < inside_.size(); ++i) {
    const int from = inside_[i];
    for (const int to : own.features->neighbors(from)) {
      const State known = state(*own.mesh, to);
      if (known != kUnknown && known != kRing) continue;
      // An edge that is cut has both ends in the ring.
      if (known == kRing && is_cut_between(*own.mesh, from, to)) continue;
      add_inside(own, to, own.mesh->source_vertex(from));
    }
  }
}

void Cut::flood_outside(const FeaturedMesh& own, int vertex) {
  state(*own.mesh, vertex) = kOutside;
  for (next_.assign(1, vertex); !next_.empty();) {
    const int from = next_.back();
    next_.pop_back();
    for (const int to : own.features->neighbors(from)) {
      State& known = state(*own.mesh, to);
      if (known != kRing || is_cut_between(*own.mesh, from, to)) continue;
      known = kOutside;
      next_.push_back(to);
    }
  }
}

}  // namespace tact::narrowphase
