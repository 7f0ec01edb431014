// A body gets other vertices and facets: what is made of them, before anything changes, and how they take their place.
#include <algorithm>
#include <utility>

#include "engine/bodies/bodies.h"
#include "engine/bodies/checks.h"
#include "engine/bodies/encloses.h"
#include "engine/bodies/given_mesh.h"
#include "narrowphase/mesh/cluster_quality.h"
#include "narrowphase/mesh/mended_order.h"

namespace tact {

namespace {

using narrowphase::ClusteredMesh;

// A map of what is new, `kind`, to what was there, of which there is so much.
void check_map(std::span<const int> map, std::size_t now, int was, const char* kind, const char* many,
               const std::string& name) {
  if (map.size() != now)
    throw Error(ErrorCode::wrong_size, quoted(name) + ": the " + kind + " map has " + std::to_string(map.size()) +
                                           " entries, but there are " + std::to_string(now) + " " + many);
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (map[i] >= -1 && map[i] < was) continue;
    throw Error(ErrorCode::invalid_argument, quoted(name) + ": the " + kind + " map names " + kind + " " +
                                                 std::to_string(map[i]) + " for " + kind + " " + std::to_string(i) +
                                                 ", but there were " + std::to_string(was));
  }
}

// Of each vertex that was, the one that keeps its name: the first of those that a facet uses, else the first.
std::vector<int> name_keepers(std::span<const int> was, std::span<const char> used, int count) {
  std::vector<int> keepers(static_cast<std::size_t>(count), -1);
  for (std::size_t v = 0; v < was.size(); ++v) {
    if (was[v] < 0) continue;
    int& keeper = keepers[was[v]];
    if (keeper < 0 || (used[keeper] == 0 && used[v] != 0)) keeper = static_cast<int>(v);
  }
  return keepers;
}

std::vector<char> used_vertices(std::span<const int> facets, std::size_t count) {
  std::vector<char> used(count, 0);
  for (const int v : facets) used[v] = 1;
  return used;
}

bool is_same_numbering(std::span<const int> was, int count) {
  if (was.size() != static_cast<std::size_t>(count)) return false;
  for (std::size_t v = 0; v < was.size(); ++v) {
    if (was[v] != static_cast<int>(v)) return false;
  }
  return true;
}

// Null as long as vertices are called by their numbers.
std::unique_ptr<LastingNames> make_names(const Body& body, std::span<const int> was, std::span<const int> keepers,
                                         std::span<const int> turned) {
  const ClusteredMesh& mesh = body.mesh;
  if (body.names == nullptr && turned.empty() && is_same_numbering(was, mesh.source_vertex_count())) return nullptr;
  auto names = std::make_unique<LastingNames>(body.names.get(), was, keepers);
  std::vector<LastingNames::Feature> orders;
  for (const int facet : turned)
    orders.push_back(LastingNames::of(body.names.get(), source_vertices(mesh, mesh.corners(facet))));
  if (!orders.empty()) names->keep_orders(std::move(orders));
  return names;
}

// Every vertex that was, with those that are it now.
void list_heirs(std::span<const int> was, std::span<const char> used, int count, Bodies::VertexChange& change) {
  std::vector<int>& begin = change.heirs_begin;
  begin.assign(static_cast<std::size_t>(count) + 1, 0);
  const auto is_heir = [&](std::size_t v) { return was[v] >= 0 && used[v] != 0; };
  for (std::size_t v = 0; v < was.size(); ++v) {
    if (is_heir(v)) ++begin[static_cast<std::size_t>(was[v]) + 1];
  }
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  change.heirs.resize(static_cast<std::size_t>(begin.back()));
  std::vector<int> next(begin.begin(), begin.end() - 1);
  for (std::size_t v = 0; v < was.size(); ++v) {
    if (is_heir(v)) change.heirs[next[was[v]]++] = static_cast<int>(v);
  }
}

std::vector<int> vertices_of_sources(const ClusteredMesh& mesh) {
  std::vector<int> vertices(static_cast<std::size_t>(mesh.source_vertex_count()), -1);
  for (int v = 0; v < mesh.vertex_count(); ++v) vertices[mesh.source_vertex(v)] = v;
  return vertices;
}

}  // namespace

// Where the new vertices were in the last step: where those were that they were, as far as facets used these. Nothing
// if that is where they are, or if no step knows the body.
std::vector<double> Bodies::begin_positions(std::uint32_t slot, std::span<const double> now,
                                            std::span<const int> was) const {
  if (!slots_[slot].seen) return {};
  const std::vector<int> vertices = vertices_of_sources(in_slot(slot).mesh);
  const narrowphase::PointArrays begin = moving(slot).begin.points;
  std::vector<double> positions(now.begin(), now.end());
  for (std::size_t v = 0; v < was.size(); ++v) {
    const int vertex = was[v] < 0 ? -1 : vertices[was[v]];
    if (vertex < 0) continue;
    double* const to = &positions[3 * v];
    to[0] = begin.x[vertex], to[1] = begin.y[vertex], to[2] = begin.z[vertex];
  }
  if (std::ranges::equal(positions, now)) positions.clear();
  return positions;
}

Bodies::NewMesh Bodies::make_mesh(BodyId id, const MeshUpdate& update, int threads) const {
  const Body& body = at(id);
  const ClusteredMesh& last = body.mesh;
  if (last.is_rigid())
    throw Error(ErrorCode::wrong_motion, quoted(body.name) + " was added as rigid: its facets cannot be set");
  if (body.plane != nullptr)
    throw Error(ErrorCode::invalid_argument, quoted(body.name) + " is a plane: it has no facets that can be set");
  check_shape(arguments_of(update), 0, body.name);
  const GivenMesh given(arguments_of(update), body.name);
  const std::span<const int> vertex_map = update.vertex_map;
  check_map(vertex_map, given.vertex_count(), last.source_vertex_count(), "vertex", "vertices", body.name);
  if (!update.facet_map.empty())
    check_map(update.facet_map, given.surface().size() / 3, last.surface_facet_count(), "facet", "facets", body.name);
  const std::vector<char> used = used_vertices(given.facets(), given.vertex_count());
  const std::vector<int> keepers = name_keepers(vertex_map, used, last.source_vertex_count());
  const narrowphase::ChangedMesh now{given.facets(), vertex_map, keepers};
  const narrowphase::FacetsNow still = narrowphase::facets_now(last, now);
  const std::vector<int> order = narrowphase::mended_order(last, now, still);
  const std::vector<double> begin = begin_positions(id.index, given.positions(), vertex_map);
  const std::span<const double> first = begin.empty() ? given.positions() : std::span<const double>(begin);
  NewMesh made{
      .vertices = {},
      .has_inside = !given.is_bare() && body.surface == Surface::closed && encloses(given.positions(), given.surface()),
      .mesh = order.empty() ? ClusteredMesh(first, given.facets(), given.last())
                            : ClusteredMesh(first, given.facets(), order, given.last()),
      .names = make_names(body, vertex_map, keepers, still.turned),
      .arrays = carried(body.arrays.get(), vertex_map, update.facet_map,
                        {margins_[id.index], rest_offset(id.index), filters_[id.index].layer, filters_[id.index].mask}),
      .self_filter = carried(body.self_filter.get(), vertex_map, given.positions()),
      .features = nullptr,
      .neighbors = nullptr,
      .begin = Begin::here,
      .grouped_from_scratch = order.empty()};
  if (!begin.empty() && refit(made.mesh, given.positions().data(), {.threads = threads}) == narrowphase::Refit::changed)
    made.begin = Begin::before;
  made.mesh.begin_travel_after(last);
  if (body.features != nullptr || made.self_filter != nullptr)
    made.features = std::make_shared<const narrowphase::Features>(made.mesh);
  if (body.neighbors != nullptr)
    made.neighbors = std::make_unique<const narrowphase::ClusterNeighbors>(made.mesh, *made.features);
  if (made.self_filter != nullptr) find_neighbors(*made.self_filter, {&made.mesh, made.features.get()});
  made.is_outward = made.has_inside && is_outward(made.mesh);
  made.vertices.id = id;
  const std::vector<int> vertex_of_source = vertices_of_sources(made.mesh);
  made.vertices.numbers.reserve(last.vertex_count());
  for (int v = 0; v < last.vertex_count(); ++v) {
    const int keeper = keepers[last.source_vertex(v)];
    made.vertices.numbers.push_back(keeper < 0 ? -1 : vertex_of_source[keeper]);
  }
  list_heirs(vertex_map, used, last.source_vertex_count(), made.vertices);
  return made;
}

void Bodies::set_mesh(NewMesh&& made) noexcept {
  const std::uint32_t slot = made.vertices.id.index;
  Slot& of_slot = slots_[slot];
  Body& body = *of_slot.body;
  packed_meshes_.remove(body.mesh);
  body.mesh = std::move(made.mesh);
  packed_meshes_.add(body.mesh);
  body.has_inside = made.has_inside;
  body.is_outward = made.is_outward;
  body.names = std::move(made.names);
  filter_count_ -= body.filters_features() ? 1 : 0;
  body.arrays = std::move(made.arrays);
  body.self_filter = std::move(made.self_filter);
  filter_count_ += body.filters_features() ? 1 : 0;
  body.features = std::move(made.features);
  body.neighbors = std::move(made.neighbors);
  of_slot.begin = made.begin;
  const std::int64_t more = body.mesh.source_vertex_count() - of_slot.vertex_count;
  of_slot.vertex_count = body.mesh.source_vertex_count();
  vertices_ += more;
  if (moved(slot)) moved_vertices_ += more;
  boxes_[slot] = base::grown(body.mesh.box(), margins_[slot]);
  kdops_.find(slot, body.mesh);
  const double quality = cluster_quality(body.mesh);
  if (made.grouped_from_scratch) {
    groupings_.forget(slot);
    groupings_.start(slot, quality);
  } else if (groupings_.is_looked_at(body.mesh)) {
    groupings_.note_quality(slot, quality);
  }
  mark_moved(slot);
}

}  // namespace tact
