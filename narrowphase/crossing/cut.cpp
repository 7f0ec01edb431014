#include "narrowphase/crossing/cut.h"

#include <algorithm>

#include "narrowphase/queries/mesh_queries.h"

namespace tact::narrowphase {

void Cut::begin(const FeaturedMesh& own, std::span<const FacetPair> pairs, Which which) {
  clear(own);
  // A facet comes again soon; to take it again changes nothing.
  std::array<int, 64> recent;
  recent.fill(-1);
  const auto take = [&](int source) {
    int& known = recent[static_cast<std::size_t>(source) % recent.size()];
    if (source != known) take_facet(known = source);
  };
  for (const FacetPair& pair : pairs) {
    if (which != Which::b) take(pair.a);
    if (which != Which::a) take(pair.b);
  }
}

void Cut::take_facet(int source_facet) {
  const ClusteredMesh& mesh = *own_.mesh;
  const Corners& corners = own_.features->corners(mesh.facet_of_source(source_facet));
  const int first = mesh.source_vertex(corners[0]);
  for (const int v : corners) {
    const int source_vertex = mesh.source_vertex(v);
    if (state_[source_vertex] == kUnknown) {
      touch(source_vertex);
      state_[source_vertex] = kRing;
      ring_.push_back(v);
    }
    join_sets(parent_, source_vertex, first);
  }
}

void Cut::order_hits() {
  for (std::size_t i = hits_.size(); i-- > 0;) first_hit_[hits_[i].vertices[0]] = static_cast<int>(i);
}

std::span<const EdgeHit> Cut::hits_of(const EdgeVertices& source_vertices) const {
  const int first = first_hit_[source_vertices[0]];
  if (first < 0) return {};
  const std::span<const EdgeHit> rest = std::span(hits_).subspan(static_cast<std::size_t>(first));
  const std::uint64_t key = EdgeHit{source_vertices}.key();
  return {std::ranges::lower_bound(rest, key, {}, &EdgeHit::key),
          std::ranges::upper_bound(rest, key, {}, &EdgeHit::key)};
}

bool Cut::is_cut_between(int v, int w) const {
  const auto [first, second] = std::minmax({own_.mesh->source_vertex(v), own_.mesh->source_vertex(w)});
  return is_cut({first, second});
}

void Cut::touch(int source_vertex) {
  touched_.push_back(source_vertex);
  parent_[source_vertex] = source_vertex;
}

void Cut::number_patches() {
  patch_count_ = 0;
  for (const int v : touched_) {
    if (parent_[v] == v) patch_[v] = patch_count_++;
  }
}

int Cut::patch_of(int source_vertex) const {
  return parent_[source_vertex] < 0 ? -1 : patch_[least_of_set(parent_, source_vertex)];
}

void Cut::clear(const FeaturedMesh& own) {
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
  own_ = own;
  touched_.clear();
  ring_.clear();
  past_.clear();
  patch_count_ = 0;
}

void Cut::find_inside(const ClusteredMesh& other) {
  const ClusteredMesh& mesh = *own_.mesh;
  find_past([&](int v) { return contains(other, mesh.position(v)); });
  // Parts of the mesh of which no edge is cut.
  const auto parts = own_.features->one_of_each_part();
  if (parts.size() == 1 && !ring_.empty()) return;
  for (const int v : parts) {
    if (state(v) != kUnknown || !base::contains(other.box(), mesh.position(v))) continue;
    if (contains(other, mesh.position(v))) flood_inside(v);
  }
}

void Cut::leave_out(int vertex) {
  if (state(vertex) == kUnknown) touch(own_.mesh->source_vertex(vertex));
  state(vertex) = kOutside;
}

void Cut::add_past(int vertex) {
  const int source = own_.mesh->source_vertex(vertex);
  if (state_[source] == kUnknown) touch(source);
  state_[source] = kPast;
  past_.push_back(vertex);
}

void Cut::flood_inside(int vertex) {
  const std::size_t first = past_.size();
  add_past(vertex);
  for (std::size_t i = first; i < past_.size(); ++i) {
    const int from = past_[i];
    for (const int to : own_.features->neighbors(from)) {
      const State known = state(to);
      if (known != kUnknown && known != kRing) continue;
      // An edge that is cut has both ends in the ring.
      if (known == kRing && is_cut_between(from, to)) continue;
      add_past(to);
      join_patches(own_.mesh->source_vertex(to), own_.mesh->source_vertex(from));
    }
  }
}

void Cut::flood_outside(int vertex) {
  state(vertex) = kOutside;
  for (next_.assign(1, vertex); !next_.empty();) {
    const int from = next_.back();
    next_.pop_back();
    for (const int to : own_.features->neighbors(from)) {
      if (state(to) != kRing || is_cut_between(from, to)) continue;
      state(to) = kOutside;
      next_.push_back(to);
    }
  }
}

}  // namespace tact::narrowphase
