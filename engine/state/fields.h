// What each class that keeps state between steps saves of it: one list of fields, which an archive writes or reads.
//
// A list binds all members of its class by name, so that it compiles only if it names every one: a new member is either
// given to the archive or said to be dropped. `dropped` are memory that is used again, and what is computed anew.
#pragma once

#include <tact/report.h>
#include <tact/settings.h>

#include <array>
#include <type_traits>

#include "engine/bodies/bodies.h"
#include "engine/pair/pair_record.h"
#include "engine/self_record.h"
#include "engine/step.h"

namespace tact {

class StateWriter;
class StateReader;

/// What an archive visits: a constant if it writes.
template <class Archive, class T>
using Visited = std::conditional_t<Archive::kReads, T, const T>;

/// The last value of an enumeration that may be saved.
template <class Enumeration>
inline constexpr Enumeration kLastValue = Enumeration::none;
template <>
inline constexpr Accuracy kLastValue<Accuracy> = Accuracy::exact;
template <>
inline constexpr DirectionPolicy kLastValue<DirectionPolicy> = DirectionPolicy::smallest;
template <>
inline constexpr Surface kLastValue<Surface> = Surface::sheet;
template <>
inline constexpr Containment kLastValue<Containment> = Containment::b_in_a;
template <>
inline constexpr DirectionSource kLastValue<DirectionSource> = DirectionSource::smallest;
template <>
inline constexpr FeaturePair kLastValue<FeaturePair> = FeaturePair::plane_vertex;
template <>
inline constexpr PairHistory::Kind kLastValue<PairHistory::Kind> = PairHistory::Kind::overlapping;

/// The mesh of a body, in the caller's numbers.
struct MeshState {
  std::uint32_t vertex_count = 0;
  std::vector<int> facets;        ///< three vertices each
  std::vector<int> order;         ///< the facets, cluster by cluster
  std::vector<double> positions;  ///< of now, or of a rigid body at rest; zero where no facet uses the vertex
  std::vector<double> begin;      ///< of the last step, if it has other positions and is not rigid
  bool is_rigid = false, is_on_its_way = false;
  std::uint32_t edge_count = 0, point_count = 0;  ///< the last of the facets: see narrowphase::WithoutArea
  bool is_plane = false;
  narrowphase::HalfSpace plane;        ///< of a plane, which has no mesh
  narrowphase::Pose pose, begin_pose;  ///< of a rigid body: now, and in the last step if it is on its way
};

struct SavedPair;
class VertexNumbers;
struct FarContact;

struct StateFields {
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, base::Vec3>& v) {
    auto& [x, y, z] = v;
    archive(x, y, z);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, Eigen::Vector3d>& v) {
    archive(v[0], v[1], v[2]);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, broadphase::IndexPair>& pair) {
    auto& [a, b] = pair;
    archive(a, b);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, broadphase::Filter>& filter) {
    auto& [layer, mask, fixed, group] = filter;
    archive(layer, mask, fixed, group);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, narrowphase::Pose>& pose) {
    auto& [rows, translation] = pose;
    archive(rows, translation);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, narrowphase::HalfSpace>& plane) {
    auto& [normal, offset] = plane;
    archive(normal, offset);
  }

  // Of the program, not of the world: threads, executor, on_message.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, Settings>& settings) {
    auto& [threads, accuracy, direction, gjk_tolerance, iteration_limit, outputs, executor, on_message] = settings;
    auto& [zones, patches, points, curves, trace, within_reach] = outputs;
    archive(accuracy, direction, gjk_tolerance, iteration_limit, zones, patches, points, curves, trace, within_reach);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, MeshState>& mesh) {
    auto& [vertex_count, facets, order, positions, begin, is_rigid, is_on_its_way, edge_count, point_count, is_plane,
           plane, pose, begin_pose] = mesh;
    archive(vertex_count, facets, order, positions, is_rigid, is_on_its_way, edge_count, point_count, is_plane);
    if (is_plane) archive(plane);
    if (is_rigid) archive(pose);
    if (is_on_its_way) is_rigid ? archive(begin_pose) : archive(begin);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, LastingNames>& names) {
    auto& [of_vertex, next, orders] = names;
    archive(of_vertex, next, orders);
  }

  // By others: mesh, plane and begin, as a MeshState; id. Dropped: features and neighbors.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, Body>& body) {
    auto& [mesh, id, name, surface, has_inside, external_id, self_contact, is_outward, birth, features, neighbors,
           plane, begin, names, arrays, self_filter] = body;
    archive(name, surface, has_inside, external_id, self_contact, is_outward, birth);
    bool has_names = names != nullptr, has_arrays = arrays != nullptr, has_self_filter = self_filter != nullptr;
    archive(has_names, has_arrays, has_self_filter);
    if (has_names) archive.pointee(names);
    if (has_arrays) archive.pointee(arrays);
    if (has_self_filter) archive.pointee(self_filter);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, FeatureArrays>& arrays) {
    // Found again: the largest and the least.
    auto& [rest_offsets, margins, vertex_labels, facet_labels, vertex_layers, vertex_masks, facet_layers, facet_masks,
           largest_rest_offset, largest_margin, least_margin] = arrays;
    archive(rest_offsets, margins, vertex_labels, facet_labels, vertex_layers, vertex_masks, facet_layers, facet_masks);
  }

  // Found again: neighbors.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, SelfFilter>& filter) {
    auto& [rings, rest_distance, rest_positions, neighbors] = filter;
    archive(rings, rest_distance, rest_positions);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, ExcludedLabels::OfBodies>& labels) {
    auto& [of_facets, of_vertices] = labels;
    archive(of_facets, of_vertices);
  }

  // By others: body, rigid and begin, as a MeshState; fixed, as part of the filter. Dropped: the rest.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, Bodies::Slot>& slot) {
    auto& [body, rigid, generation, vertex_count, fixed, knows_box, to_place, changed, seen, begin] = slot;
    archive(changed, seen);
  }

  // The quality may be infinite.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, ClusterGroupings::Entry>& entry) {
    auto& [quality, moves, tries, decayed] = entry;
    archive(quality, moves, tries, decayed);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, Bodies::Place>& place) {
    auto& [filter, margin, rest_offset, key, is_rigid] = place;
    archive(filter, margin, rest_offset, key, is_rigid);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, narrowphase::GjkSimplex>& simplex) {
    auto& [a, b, count] = simplex;
    archive.count(count, a.size());
    archive.first(count, a);
    archive.first(count, b);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, narrowphase::SurfaceShape>& shape) {
    auto& [vertex_count, face_count, fresh_face_count, a, b, corner, neighbor] = shape;
    archive.count(vertex_count, a.size());
    archive.count(face_count, corner.size());
    archive(fresh_face_count);
    archive.first(vertex_count, a);
    archive.first(vertex_count, b);
    archive.first(face_count, corner);
    archive.first(face_count, neighbor);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, PairHistory>& history) {
    auto& [direction, hulls, kind, has_surface] = history;
    archive(direction, hulls, kind, has_surface);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, ZoneDisk>& disk) {
    auto& [center, radius] = disk;
    archive(center, radius);
  }

  // By others: a, b and touching, as parts of the record. Dropped: what the report writer fills in.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, Contact>& contact) {
    auto& [a, b, direction, depth, containment, source, iterations, limit_reached, point_limit_reached, plane_a,
           plane_b, zone_a, zone_b, kept_facets_a, kept_facets_b, facet_pairs, patches, points, curves, within_reach,
           key_a, key_b, touching] = contact;
    archive(direction, depth, containment, source, iterations, limit_reached, point_limit_reached, plane_a, plane_b,
            zone_a, zone_b, kept_facets_a, kept_facets_b);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, FacetPair>& pair) {
    auto& [a, b] = pair;
    archive(a, b);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, ContactPoint>& point) {
    auto& [kind, patch, a_vertices, b_vertices, a_weights, b_weights, normal, gap, id, minimum] = point;
    archive(kind, patch, a_vertices, b_vertices, a_weights, b_weights, normal, gap, id, minimum);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, ReachPair>& pair) {
    auto& [kind, a_vertices, b_vertices, a_weights, b_weights, normal, distance] = pair;
    archive(kind, a_vertices, b_vertices, a_weights, b_weights, normal, distance);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, PatchVertex>& vertex) {
    auto& [number, patch] = vertex;
    archive(number, patch);
  }

  // By the set: the members, which its lists hold one patch after the other.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, Patch>& patch) {
    auto& [id, point, direction, depth, area, facet_pairs, points, spanning] = patch;
    archive(id, point, direction, depth, area, spanning);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, Spanning>& spanning) {
    auto& [ids] = spanning;
    archive(ids);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, PatchSet>& set) {
    auto& [patches, spanning, facet_pairs, points, vertices] = set;
    archive(patches);
    if (patches.empty()) return;  // the lists are old
    archive(spanning, facet_pairs, points, vertices);
    visit_members(archive, patches, facet_pairs, &Patch::facet_pairs);
    visit_members(archive, patches, points, &Patch::points);
  }

  // The last set is that of the step before, which no later step reads.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, PatchMemory>& memory) {
    auto& [now, last] = memory;
    archive(now);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, CurvePoint>& point) {
    auto& [position, fraction, edge, facet, facet_pair, edge_of_b] = point;
    archive(position, fraction, edge, facet, facet_pair, edge_of_b);
  }

  // By the set: the points.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, IntersectionCurve>& curve) {
    auto& [closed, points] = curve;
    archive(closed);
  }

  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, CurveSet>& set) {
    auto& [curves, points] = set;
    archive(curves, points);
    visit_members(archive, curves, points, &IntersectionCurve::points);
  }

  // What stands between a change of facets and the next step: no facets have the numbers that they had.
  static PatchSet without_members(const PatchSet& set) {
    PatchSet bare{
        .patches = set.patches, .spanning = set.spanning, .facet_pairs = {}, .points = {}, .vertices = set.vertices};
    for (Patch& patch : bare.patches) {
      patch.facet_pairs = patch.points = {};
      patch.spanning.fill(-1);
    }
    return bare;
  }
  template <class Archive, class Record>
  static void visit_points(Archive& archive, Record& record) {
    if constexpr (!Archive::kReads) {
      if (record.is_renumbered) return archive(std::vector<FacetPair>(), record.last_points, std::vector<ReachPair>());
    }
    archive(record.facet_pairs, record.points, record.within_reach);
  }
  template <class Archive, class Record, class Memory>
  static void visit_patches(Archive& archive, Record& record, Memory& patches) {
    if constexpr (!Archive::kReads) {
      if (record.is_renumbered) return archive(without_members(patches.now));
    }
    archive(patches);
  }

  // By others: a and b. Of the step before: was_in_contact; last_points unless it is renumbered, which a record that is
  // read is not. Dropped: times, surfaces, bare_pairs.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, PairRecord>& record) {
    auto& [a, b, hulls_overlap, near, was_in_contact, touching, history, times, slab_lower, slab_upper, face, contact,
           facet_pairs, points, last_points, within_reach, patches, curves, surfaces, surface, is_renumbered,
           bare_pairs] = record;
    archive(hulls_overlap, near, touching, history);
    if (history.has_surface) archive.pointee(surface);
    if (hulls_overlap) archive(slab_lower, slab_upper, face);
    if (hulls_overlap || near) {
      archive(contact);
      visit_points(archive, record);
    }
    bool has_patches = patches != nullptr && !patches->now.patches.empty();
    archive(has_patches);
    if (has_patches) {
      if constexpr (Archive::kReads) patches = std::make_unique<PatchMemory>();
      visit_patches(archive, record, *patches);
    }
    visit_curves(archive, record);
  }

  // By others: body. Of the step before: last_points, as of a pair. Dropped: the cluster pairs and the crossing.
  template <class Archive>
  static void visit(Archive& archive, Visited<Archive, SelfRecord>& record) {
    auto& [body, facet_pairs, points, last_points, within_reach, may_meet, may_contact, crossing, patches, curves,
           touching, point_limit_reached, bare_pairs, is_renumbered] = record;
    visit_points(archive, record);
    if constexpr (Archive::kReads) {
      archive(bare_pairs);
    } else {
      archive(is_renumbered ? std::vector<FacetPair>() : bare_pairs);
    }
    visit_patches(archive, record, patches);
    archive(touching, point_limit_reached);
    visit_curves(archive, record);
  }

  // One body that there is; and into a slot that holds none. Errors: bad_state, and those of World::add_body().
  static MeshState mesh_state(const Bodies& bodies, std::uint32_t slot);
  static void write_body(const Bodies& bodies, std::uint32_t slot, const MeshState& mesh, StateWriter& writer);
  static void read_body(StateReader& reader, Bodies& bodies, std::uint32_t slot);
  static void place_rigid(Bodies& bodies, std::uint32_t slot, const MeshState& state);
  static void read_neighbors(StateReader& reader, Body& body);

  // Of whole worlds: bodies_state.cpp, step_state.cpp. `gone`, sorted, are bodies that were removed since the last step
  // and that the next one names; `old` are those of the world, whose ids stay.
  static void write(const Bodies& bodies, std::span<const BodyId> gone, StateWriter& writer);
  static Bodies read_bodies(StateReader& reader, const Bodies& old);
  static std::vector<BodyId> gone_in(const Step& step, const Bodies& bodies);
  static void write(const Step& step, const Bodies& bodies, StateWriter& writer);
  static Step::Restored read_step(StateReader& reader, const Bodies& bodies);

  // Of worlds whose bodies come and go singly, with what is kept of them: world_parts.cpp.
  static void join(std::span<const std::byte> shape, std::span<const std::byte> rest, StateWriter& writer);
  static std::array<std::uint64_t, 2> keys_of(const Contact& contact) { return {contact.key_a_, contact.key_b_}; }
  static BodyId put_body(StateReader& reader, Bodies& bodies, bool is_copy);
  static void take_bodies(std::span<const BodyId> gone, Bodies& bodies, Step& step);
  static void remove_copy(BodyId body, Bodies& bodies);
  static void exclude(BodyId a, BodyId b, bool excluded, Bodies& bodies);
  static void exclude(const LabelPair& labels, bool excluded, Bodies& bodies);
  static void mark_moved(BodyId body, bool is_on_its_way, Bodies& bodies);
  static std::vector<SavedPair> pairs_of(std::span<const BodyId> those, const Bodies& bodies, Step& step);
  static std::vector<SavedPair> all_pairs(const Bodies& bodies, Step& step);
  static SavedPair saved_pair(std::size_t i, const Bodies& bodies, PairTable& table, VertexNumbers& numbers);
  static void set_birth(BodyId body, std::uint64_t birth, Bodies& bodies) {
    bodies.slots_[body.index].body->birth = birth;
  }
  static void write_steps(const Bodies& bodies, const Step& step, StateWriter& writer);
  static void read_steps(StateReader& reader, Bodies& bodies, Step& step);
  static bool put_pair(const SavedPair& pair, const Bodies& bodies, Step& step, VertexNumbers& numbers);
  static void write_self_of(BodyId body, Step& step, StateWriter& writer);
  static void read_self_of(StateReader& reader, BodyId body, const Bodies& bodies, Step& step);
  static void settle(Bodies& bodies, Step& step);
  static void write_contact(const Contact& contact, StateWriter& writer);
  static void read_contact(StateReader& reader, FarContact& far);

 private:
  static void add_slots(Bodies& bodies, std::size_t count);
  static void read_slots(StateReader& reader, Bodies& bodies);
  static void take_ids(Bodies& bodies, const Bodies& old);
  static BodyId read_named(StateReader& reader, const Bodies& bodies);
  static void write_pairs(const PairTable& table, const Bodies& bodies, StateWriter& writer);
  static void read_pairs(StateReader& reader, const Bodies& bodies, PairTable& table);
  static void write_selves(const SelfStage& selves, const Bodies& bodies, StateWriter& writer);
  static void read_selves(StateReader& reader, const Bodies& bodies, SelfStage& selves);

  // How many members of a list each patch, or each curve, has.
  template <class Archive, class Sets, class Members, class Set, class Member>
  static void visit_members(Archive& archive, Sets& sets, Members& members, std::span<const Member> Set::*shown) {
    std::size_t begin = 0;
    for (auto& set : sets) {
      auto count = static_cast<std::uint64_t>((set.*shown).size());
      archive(count);
      if constexpr (Archive::kReads) {
        archive.check(count <= members.size() - begin, "there are fewer members than one has");
        set.*shown = std::span(members).subspan(begin, count);
      }
      begin += count;
    }
  }

  template <class Archive, class Record>
  static void visit_curves(Archive& archive, Record& record) {
    bool has_curves = record.curves != nullptr && (Archive::kReads || !record.is_renumbered);
    archive(has_curves);
    if (has_curves) archive.pointee(record.curves);
  }
};

}  // namespace tact
