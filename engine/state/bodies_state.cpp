// The bodies of a world as bytes: slots, ids that stay, meshes and where they are.
#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/bodies/checks.h"
#include "engine/state/archives.h"
#include "narrowphase/mesh/source_mesh.h"

namespace tact {

namespace {

using narrowphase::ClusteredMesh;

void check_positions_of(const StateReader& reader, const std::vector<double>& positions, const MeshState& state,
                        const std::string& name) {
  reader.check(positions.size() == 3 * std::size_t{state.vertex_count}, "there are not as many positions as vertices");
  check_positions(positions.data(), state.vertex_count, name);
}

// The last facets are edges and points.
void check_bare(const StateReader& reader, const MeshState& state, std::size_t facets) {
  for (std::size_t f = facets - state.edge_count - state.point_count; f < facets; ++f) {
    const int* const corner = &state.facets[3 * f];
    const bool is_point = f >= facets - state.point_count;
    reader.check(corner[1] == corner[2] && (!is_point || corner[0] == corner[1]), "an edge or a point has area");
  }
}

void check_mesh(const StateReader& reader, const MeshState& state, const std::string& name) {
  const std::size_t facets = state.facets.size() / 3;
  check_counts(static_cast<std::ptrdiff_t>(state.vertex_count), static_cast<std::ptrdiff_t>(facets), 0, name);
  reader.check(state.facets.size() == 3 * facets && state.order.size() == facets, "there are parts of facets");
  check_corners(state.facets, Facets::strided(state.facets.data(), facets),
                static_cast<std::ptrdiff_t>(state.vertex_count), name);
  reader.check(state.edge_count <= facets && state.point_count <= facets - state.edge_count,
               "there are more edges and points than facets");
  check_bare(reader, state, facets);
  std::vector<char> seen(facets, 0);
  for (const int facet : state.order)
    reader.check(facet >= 0 && static_cast<std::size_t>(facet) < facets && seen[facet]++ == 0, "facets have no order");
  check_positions_of(reader, state.positions, state, name);
  if (state.is_on_its_way && !state.is_rigid) check_positions_of(reader, state.begin, state, name);
}

PoseUpdate update_of(BodyId id, const narrowphase::Pose& pose) {
  PoseUpdate update{.body = id};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) update.rotation(i, k) = pose.rows[i][k];
    update.translation[i] = pose.translation[i];
  }
  return update;
}

ExcludedLabels::All read_excluded_labels(StateReader& reader) {
  ExcludedLabels::All all;
  for (std::size_t left = reader.read_size(1); left > 0; --left) {
    const auto pair = reader.read<broadphase::IndexPair>();
    reader.check(all.empty() || all.rbegin()->first < pair, "excluded labels are not in order");
    reader(all[pair]);
  }
  return all;
}

}  // namespace

MeshState StateFields::mesh_state(const Bodies& bodies, std::uint32_t slot) {
  const Bodies::Slot& from = bodies.slots_[slot];
  const ClusteredMesh& of_body = from.body->mesh;
  MeshState mesh;
  mesh.vertex_count = static_cast<std::uint32_t>(of_body.source_vertex_count());
  mesh.facets = source_facets(of_body);
  for (int f = 0; f < of_body.facet_count(); ++f) mesh.order.push_back(of_body.source_facet(f));
  mesh.edge_count = static_cast<std::uint32_t>(of_body.edge_count());
  mesh.point_count = static_cast<std::uint32_t>(of_body.point_count());
  mesh.is_plane = from.body->plane != nullptr;
  if (mesh.is_plane) mesh.plane = *from.body->plane;
  mesh.is_rigid = from.rigid != nullptr;
  mesh.is_on_its_way = bodies.on_its_way(slot);
  mesh.positions = source_positions(of_body, mesh.is_rigid ? of_body.placements().before().points : of_body.points());
  if (mesh.is_rigid) {
    const auto& [pose, begin_pose, begin_is_placed] = *from.rigid;
    mesh.pose = pose.pose();
    if (mesh.is_on_its_way) mesh.begin_pose = begin_pose;
  } else if (mesh.is_on_its_way) {
    mesh.begin = source_positions(of_body, bodies.moving(slot).begin.points);
  }
  return mesh;
}

void StateFields::write_body(const Bodies& bodies, std::uint32_t slot, const MeshState& mesh, StateWriter& writer) {
  const Bodies::Slot& from = bodies.slots_[slot];
  writer(Bodies::Place{bodies.filters_[slot], bodies.margins_[slot], bodies.rest_offsets_[slot], bodies.keys_.of(slot),
                       mesh.is_rigid},
         mesh, *from.body, from, bodies.groupings_.entries_[slot]);
}

// Own: world, tuning, choice. Memory, or what only saves work: packed_meshes, rigid_states, tree, updates, new_kdops,
// feature_holders and all scratch. Found again from what is read: boxes, kdops, counts, planes, placed_boxes,
// farthest_rest. With each body: filters, margins, rest offsets, keys, groupings, and whether it is in `changed`. Not
// of a state: generations, former; see take_ids().
void StateFields::write(const Bodies& bodies, std::span<const BodyId> gone, StateWriter& writer) {
  const auto& [world, tuning, packed_meshes, slots, generations, former, rigid_states, free, boxes, filters, margins,
               rest_offsets, keys, tree, kdops, groupings, changed, count, removed, steps, excluded, excluded_labels,
               vertices, moved_vertices, rigid_count, self_count, filter_count, planes, placed_boxes, placed_count,
               farthest_rest, pose_changed, to_place, updates, new_kdops, without_features, feature_holders, named,
               choice] = bodies;
  writer(steps, std::uint64_t{count});
  std::vector<char> is_free(slots.size(), 0);
  for (const std::uint32_t slot : free) is_free[slot] = 1;
  std::vector<std::uint32_t> closed;  // that are not used again
  for (std::uint32_t slot = 0; slot < slots.size(); ++slot) {
    if (slots[slot].body == nullptr) {
      if (is_free[slot] == 0) closed.push_back(slot);
      continue;
    }
    writer(slot);
    write_body(bodies, slot, mesh_state(bodies, slot), writer);
  }
  const auto& [excluded_pairs, excluded_changed] = excluded;
  writer(free, closed, excluded_pairs, std::uint64_t{excluded_labels.all().size()});
  for (const auto& [pair, labels] : excluded_labels.all()) writer(pair, labels);
  std::vector<Bodies::Removed> kept;  // of those that the next step names
  std::ranges::copy_if(removed, std::back_inserter(kept),
                       [&](const Bodies::Removed& one) { return std::ranges::binary_search(gone, one.id); });
  std::ranges::sort(kept, {}, [](const Bodies::Removed& one) { return one.id.index; });
  writer(std::uint64_t{kept.size()});
  for (const auto& [id, key, birth] : kept) writer(id.index, key, birth);
}

// Finds what of a filter is not saved.
void StateFields::read_neighbors(StateReader& reader, Body& body) {
  constexpr const char* kName = "of a state";
  SelfFilter& filter = *body.self_filter;
  check_self_filter(filter.rings, filter.rest_distance, kName);
  const auto vertices = static_cast<std::size_t>(body.mesh.source_vertex_count());
  reader.check(filter.rest_positions.size() == (filter.rest_distance > 0.0 ? 3 * vertices : 0),
               "there are not as many positions at rest as vertices");
  check_positions(filter.rest_positions.data(), filter.rest_positions.size() / 3, kName);
  reader.check(filter.rings > 0 || filter.rest_distance > 0.0, "a filter leaves out nothing");
  body.features = std::make_shared<const narrowphase::Features>(body.mesh);
  find_neighbors(filter, {&body.mesh, body.features.get()});
}

// A rigid body that was put into its slot as it was added: where it stands.
void StateFields::place_rigid(Bodies& bodies, std::uint32_t slot, const MeshState& state) {
  const BodyId id{.index = slot};
  bodies.check_pose(update_of(id, state.pose));
  if (state.is_on_its_way) bodies.check_pose(update_of(id, state.begin_pose));
  Bodies::Slot& put = bodies.slots_[slot];
  put.rigid->begin_pose = state.begin_pose;
  if (state.pose == narrowphase::Pose{}) return;
  put.rigid->pose.set(state.pose);
  bodies.boxes_[slot] = base::grown(put.body->mesh.rough_box(), bodies.margins_[slot]);
  bodies.kdops_.forget(slot);
}

// Reads a body into a slot that is there: first where it was in the last step, then where it is now.
void StateFields::read_body(StateReader& reader, Bodies& bodies, std::uint32_t slot) {
  constexpr const char* kName = "of a state";
  const auto place = reader.read<Bodies::Place>();
  check_margin(place.margin, kName);
  if (place.rest_offset != Bodies::kAsMargin) check_rest_offset(place.rest_offset, place.margin, kName);
  reader.check(!bodies.keys_.find(place.key), "two bodies have one key");
  auto state = reader.read<MeshState>();
  reader.check(state.is_rigid == place.is_rigid, "a body is rigid and is not");
  if (state.is_plane) {
    const base::Vec3& n = state.plane.normal;
    check_plane({n.x, n.y, n.z}, state.plane.offset, kName);
    reader.check(state.facets.empty() && place.filter.fixed && !place.is_rigid, "a plane moves, or has facets");
  }
  check_mesh(reader, state, kName);
  const bool has_begin = state.is_on_its_way && !state.is_rigid;
  auto body =
      std::make_unique<Body>(Body{.mesh = {has_begin ? state.begin : state.positions,
                                           state.facets,
                                           state.order,
                                           {static_cast<int>(state.edge_count), static_cast<int>(state.point_count)}},
                                  .id = {},
                                  .name = {}});
  if (state.is_plane) body->plane = std::make_unique<const narrowphase::HalfSpace>(state.plane);
  if (has_begin) {
    const narrowphase::MeshPlacements& placements = body->mesh.placements();
    body->begin.resize(placements.size());
    std::copy_n(placements.now_memory(), placements.size() - narrowphase::kPadding, body->begin.data());
    refit(body->mesh, state.positions.data());
  }
  Bodies::Slot saved;
  ClusterGroupings::Entry grouping;
  reader(*body, saved, grouping);
  reader.check(body->names == nullptr || body->names->vertex_count() == state.vertex_count,
               "there are not as many names as vertices");
  if (body->arrays != nullptr) {
    check_feature_settings(
        body->arrays->view(), state.vertex_count, static_cast<std::size_t>(body->mesh.surface_facet_count()),
        {place.margin, place.rest_offset == Bodies::kAsMargin ? std::nullopt : std::optional(place.rest_offset)},
        kName);
    body->arrays = copy_of(body->arrays->view());
  }
  if (body->self_filter != nullptr) read_neighbors(reader, *body);
  reader.check(grouping.quality >= 0.0 && grouping.tries <= ClusterGroupings::kMostDoublings,
               "clusters have no quality");
  bodies.make_room_for(slot, place);
  bodies.put(slot, std::move(body), place);
  Bodies::Slot& put = bodies.slots_[slot];
  put.seen = saved.seen;
  put.changed = saved.changed;
  put.begin = state.is_on_its_way ? Bodies::Begin::kept : Bodies::Begin::here;
  bodies.groupings_.entries_[slot] = grouping;
  if (grouping.decayed) bodies.groupings_.decayed_.push_back(slot);
  if (place.is_rigid) place_rigid(bodies, slot, state);
}

void StateFields::add_slots(Bodies& bodies, std::size_t count) {
  while (bodies.slots_.size() < count) {
    const auto slot = static_cast<std::uint32_t>(bodies.slots_.size());
    bodies.make_room_for(slot, {.key = slot});
    bodies.add_slot();
  }
}

// Every slot once, among the bodies, the free ones or the closed ones.
void StateFields::read_slots(StateReader& reader, Bodies& bodies) {
  const std::size_t count = reader.read_size(1);
  for (std::size_t i = 0; i < count; ++i) {
    const auto slot = reader.read<std::uint32_t>();
    reader.check(slot >= bodies.slots_.size() && slot - bodies.slots_.size() <= reader.bytes_left(), "a slot is wrong");
    add_slots(bodies, slot + std::size_t{1});
    read_body(reader, bodies, slot);
  }
  std::vector<std::uint32_t> closed;
  std::vector<broadphase::IndexPair>& excluded = bodies.excluded_.pairs_;
  reader(bodies.free_, closed, excluded);
  ExcludedLabels::All labels = read_excluded_labels(reader);
  const std::size_t slots = count + bodies.free_.size() + closed.size();
  add_slots(bodies, slots);
  std::vector<char> is_empty(slots, 0);
  for (const std::vector<std::uint32_t>* const some : {&std::as_const(bodies.free_), &std::as_const(closed)}) {
    for (const std::uint32_t slot : *some)
      reader.check(slot < slots && !bodies.used(slot) && is_empty[slot]++ == 0, "a slot is wrong");
  }
  reader.check(slots == bodies.slots_.size(), "slots are missing");
  for (const auto& [a, b] : excluded)
    reader.check(a < b && b < slots && bodies.used(a) && bodies.used(b), "an excluded body is not there");
  reader.check(std::ranges::is_sorted(excluded), "excluded pairs are not sorted");
  for (const auto& [pair, of_bodies] : labels)
    reader.check(pair.a < slots && pair.b < slots && bodies.used(pair.a) && bodies.used(pair.b) &&
                     bodies.plane(pair.a) == nullptr && bodies.plane(pair.b) == nullptr,
                 "a body with excluded labels is not there");
  reader.check(bodies.excluded_labels_.put(std::move(labels)), "excluded labels are not in order");
}

// A body has the id that it has in the other world, or had there last: that with the same birth in the same slot.
// Others get one that was never given out.
void StateFields::take_ids(Bodies& bodies, const Bodies& old) {
  bodies.former_ = old.former_;
  for (const auto& slot : old.slots_) {
    if (slot.body) bodies.former_.push_back({slot.body->birth, slot.body->id.index, slot.generation});
  }
  const auto order = [](const Bodies::Former& one) { return std::pair(one.slot, one.birth); };
  std::vector<Bodies::Former>& former = bodies.former_;
  std::ranges::stable_sort(former, {}, order);
  // Of one body added alike several times the last one counts: it is there, or has the latest id.
  const auto last = [&](auto begin, auto end) {
    return std::unique(begin, end, [&](const auto& x, const auto& y) { return order(x) == order(y); });
  };
  former.erase(former.begin(), last(former.rbegin(), former.rend()).base());
  bodies.generations_ = old.generations_;
  bodies.generations_.resize(std::max(old.generations_.size(), bodies.slots_.size()));
  const auto id_of = [&](std::uint32_t slot, std::uint64_t birth) -> BodyId {
    const auto found = std::ranges::lower_bound(former, std::pair(slot, birth), {}, order);
    if (found != former.end() && order(*found) == std::pair(slot, birth))
      return {slot, found->generation, bodies.world_};
    if (bodies.generations_[slot] == std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorCode::too_large, "a slot has no more generations");
    return {slot, ++bodies.generations_[slot], bodies.world_};
  };
  for (std::uint32_t slot = 0; slot < bodies.slots_.size(); ++slot) {
    if (!bodies.used(slot)) continue;
    Body& body = *bodies.slots_[slot].body;
    body.id = id_of(slot, body.birth);
    bodies.slots_[slot].generation = body.id.generation;
  }
  for (Bodies::Removed& removed : bodies.removed_) removed.id = id_of(removed.id.index, removed.birth);
  for (const auto& [id, key, birth] : bodies.removed_) former.push_back({birth, id.index, id.generation});
}

Bodies StateFields::read_bodies(StateReader& reader, const Bodies& old) {
  Bodies bodies(old.world_, old.tuning());
  reader(bodies.steps_);
  read_slots(reader, bodies);
  bodies.changed_.clear();
  bodies.moved_vertices_ = 0;
  for (std::uint32_t slot = 0; slot < bodies.slots_.size(); ++slot) {
    if (std::exchange(bodies.slots_[slot].changed, false)) bodies.mark_moved(slot);
  }
  const std::size_t removed = reader.read_size(1);
  for (std::size_t i = 0; i < removed; ++i) {
    Bodies::Removed one{};
    reader(one.id.index, one.key, one.birth);
    reader.check(one.id.index < bodies.slots_.size() &&
                     (bodies.removed_.empty() || bodies.removed_.back().id.index < one.id.index),
                 "a removed body was not there");
    bodies.removed_.push_back(one);
    bodies.mark_changed(one.id.index);
  }
  take_ids(bodies, old);
  bodies.make_room_for(0, {});
  bodies.update_order();
  return bodies;
}

}  // namespace tact
