// The bodies of a world: slots that are used again, ids that are not, and what changed since the last step.
#pragma once

#include <tact/body.h>
#include <tact/world.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "broadphase/sweep_and_prune.h"
#include "engine/base/tuning.h"
#include "engine/bodies/body_kdops.h"
#include "engine/bodies/body_keys.h"
#include "engine/bodies/body_tree.h"
#include "engine/bodies/cluster_groupings.h"
#include "engine/bodies/excluded_labels.h"
#include "engine/bodies/excluded_pairs.h"
#include "engine/bodies/feature_arrays.h"
#include "engine/bodies/lasting_names.h"
#include "engine/bodies/packed_meshes.h"
#include "engine/bodies/pair_choice.h"
#include "engine/bodies/rigid_states.h"
#include "engine/bodies/self_filter.h"
#include "narrowphase/mesh/clustered_mesh.h"
#include "narrowphase/mesh/refit.h"
#include "narrowphase/motion/feature_rules.h"
#include "narrowphase/motion/moving_mesh.h"
#include "narrowphase/plane/half_space.h"
#include "narrowphase/self/cluster_neighbors.h"

namespace tact {

// What every step reads comes first, in few lines of memory.
struct alignas(64) Body {
  narrowphase::ClusteredMesh mesh;
  BodyId id;
  std::string name;
  Surface surface = Surface::closed;
  bool has_inside = true;  // it was added as closed, and is: see encloses.h; otherwise it is taken as a sheet
  std::uint64_t external_id = 0;
  bool self_contact = false;
  bool is_outward = false;  // it has an inside, and facets were counter-clockwise seen from outside: by its volume
  std::uint64_t birth = 0;  // a hash of the mesh and slot as they were when it was added, and of the step
  std::shared_ptr<const narrowphase::Features> features = nullptr;           // made when points are first requested
  std::unique_ptr<const narrowphase::ClusterNeighbors> neighbors = nullptr;  // when it is first held against itself
  std::unique_ptr<const narrowphase::HalfSpace> plane = nullptr;             // of a plane, whose mesh is empty
  std::vector<double> begin = {};  // where it was in the last step, once it has moved twice since: a placement
  std::unique_ptr<LastingNames> names = nullptr;      // once its facets have changed
  std::unique_ptr<FeatureArrays> arrays = nullptr;    // if there are any settings of vertices and facets
  std::unique_ptr<SelfFilter> self_filter = nullptr;  // if any neighbours are left out

  // Whether less is found of single features than of the whole body.
  bool filters_features() const { return (arrays != nullptr && arrays->filters()) || self_filter != nullptr; }
};

class Bodies {
  friend struct StateFields;

 public:
  Bodies(std::uint32_t world, const base::Tuning& tuning) : world_(world), tuning_(&tuning), groupings_(tuning) {}

  // Of the world.
  const base::Tuning& tuning() const { return *tuning_; }

  // Calls told(body) once the body has all but its place: what that throws comes out, and nothing has changed.
  BodyId add(const BodyDefinition& definition, const std::function<void(const Body&)>& told = {});
  BodyId add(const PlaneDefinition& definition);
  // Refuses what add() would, but for its key.
  void check(const BodyDefinition& definition) const;
  void check(const PlaneDefinition& definition) const;
  void remove(BodyId id);
  void set_positions(std::span<const PositionsUpdate> updates, int threads);
  void set_positions(BodyId id, const Positions& positions, int threads);
  void set_pose(const PoseUpdate& update);
  void set_poses(std::span<const PoseUpdate> updates, int threads);
  void set_layers(BodyId id, std::uint32_t layer, std::uint32_t mask);
  void set_motion(BodyId id, Motion motion);
  void set_group(BodyId id, std::uint32_t group);
  void set_excluded(BodyId a, BodyId b, bool excluded);
  // Errors: stale_body, foreign_body, invalid_argument (one body twice).
  bool excluded(BodyId a, BodyId b) const;
  void set_margin(BodyId id, double margin);
  void set_rest_offset(BodyId id, std::optional<double> rest_offset);
  void set_feature_settings(BodyId id, const FeatureSettings& settings);
  void set_self_contact(BodyId id, bool wanted);
  void set_self_filter(BodyId id, const SelfContactFilter& filter, int threads);
  void set_excluded_labels(const LabelPair& labels, bool excluded);
  // Errors: stale_body, foreign_body, invalid_argument.
  bool excluded_labels(const LabelPair& labels) const;

  bool contains(BodyId id) const noexcept;
  // Whether a body was ever added, also one that was removed.
  bool ever_held_any() const noexcept { return !generations_.empty(); }
  // Errors: stale_body, foreign_body.
  const Body& at(BodyId id) const;
  const broadphase::Filter& filter(BodyId id) const { return filters_[at(id).id.index]; }
  const Body& in_slot(std::uint32_t slot) const { return *slots_[slot].body; }
  // The order of bodies in all answers; a step and detect_motion() update it before they use ranks.
  const BodyKeys& keys() const { return keys_; }
  void update_order();
  // The key of a body that there is, or was in the last step.
  std::uint64_t key(BodyId id) const;
  // Steps that had an answer.
  std::uint64_t steps() const { return steps_; }
  std::size_t count() const noexcept { return count_; }
  // Vertices of all bodies, and of those that moved.
  std::int64_t vertices() const noexcept { return vertices_; }
  std::int64_t moved_vertices() const noexcept { return moved_vertices_; }
  // Whether what a step reads of the bodies, about 100 bytes a vertex, is likely in the second level of the cache
  // still. Then nothing of it is prefetched.
  bool stay_in_cache() const noexcept {
    constexpr std::int64_t kMostVertices = 4096;  // 400 kB
    return vertices_ <= kMostVertices;
  }
  std::vector<BodyId> ids() const;

  double margin(std::uint32_t slot) const { return margins_[slot]; }
  // How near surfaces of two bodies, or of one, must come to be in contact.
  double reach(std::uint32_t a, std::uint32_t b) const { return margins_[a] + margins_[b]; }
  double rest_offset(std::uint32_t slot) const {
    return rest_offsets_[slot] == kAsMargin ? margins_[slot] : rest_offsets_[slot];
  }
  std::optional<double> given_rest_offset(std::uint32_t slot) const {
    return rest_offsets_[slot] == kAsMargin ? std::nullopt : std::optional(rest_offsets_[slot]);
  }
  // How near surfaces of two bodies, or of one, must come to touch.
  narrowphase::FeatureReach rest(std::uint32_t a, std::uint32_t b) const { return {offset_of(a), offset_of(b)}; }
  // Which of their features are tested against each other; whether there are any bodies of which not all are.
  narrowphase::FeatureFilter feature_filter(std::uint32_t a, std::uint32_t b) const;
  bool any_feature_filter() const { return filter_count_ > 0 || !excluded_labels_.empty(); }
  // The same, and how near features must come to be in contact, at most reach().
  narrowphase::FeatureRules contact_rules(std::uint32_t a, std::uint32_t b) const {
    return {.reach = {margin_of(a), margin_of(b)}, .filter = feature_filter(a, b)};
  }
  // The mesh of a body with its features, which make_features() made.
  narrowphase::FeaturedMesh featured(std::uint32_t slot) const {
    return {&in_slot(slot).mesh, in_slot(slot).features.get()};
  }
  // Whether a body has an inside and is turned outwards.
  bool is_solid(std::uint32_t slot) const {
    const Body& body = in_slot(slot);
    return body.has_inside && body.is_outward;
  }
  // Whether a body has other positions than in the last step; and the body with its way since.
  bool on_its_way(std::uint32_t slot) const { return slots_[slot].begin != Begin::here; }
  // Whether a step has seen it. Until then it begins where it is, wherever it is put.
  bool seen(std::uint32_t slot) const { return slots_[slot].seen; }
  narrowphase::Placement begin_of(std::uint32_t slot) const;
  narrowphase::MovingMesh moving(std::uint32_t slot) const;
  // Makes the features that are missing of some bodies, which may be named more than once, in parallel. Bodies with the
  // same facets in the same clusters share them.
  void make_features(std::span<const std::uint32_t> slots, int threads);
  // The same of their neighbours, and the features of these; each body is named once.
  void make_neighbors(std::span<const std::uint32_t> slots, int threads);
  const narrowphase::ClusterNeighbors& neighbors(std::uint32_t slot) const { return *in_slot(slot).neighbors; }

  // Slots of planes, ascending. Such a body has no box, and so no pair in the sweep: see PlanePairs.
  std::span<const std::uint32_t> planes() const { return planes_; }
  // The half-space of a plane, null of any other body.
  const narrowphase::HalfSpace* plane(std::uint32_t slot) const {
    return planes_.empty() || !used(slot) ? nullptr : in_slot(slot).plane.get();
  }
  // Whether the boxes of a pair overlap in truth, bodies being placed.
  bool boxes_meet(broadphase::IndexPair pair) const;

  // Whether there are rigid bodies. They are placed by their poses when a call needs their vertices.
  bool any_rigid() const { return rigid_count_ > 0; }
  // The body, placed. Several threads may call this.
  const Body& placed(std::uint32_t slot) const {
    slots_[slot].body->mesh.place();
    return in_slot(slot);
  }
  // Places the bodies of those pairs that are tested and whose boxes overlap.
  void place(std::span<const broadphase::IndexPair> pairs, int threads);
  // The same of bodies, which may be named more than once, and where they were in the last step.
  void place_ways(std::span<const std::uint32_t> slots, int threads);
  // Bodies that place() placed since end_step().
  std::int64_t placed_count() const { return placed_count_; }
  // The box of a body with its margin: boxes() may hold a larger one of a rigid body.
  base::Box exact_box(std::uint32_t slot) const {
    if (!slots_[slot].rigid) return boxes_[slot];
    if (slots_[slot].knows_box) return placed_boxes_[slot];
    return base::grown(placed(slot).mesh.box(), margins_[slot]);
  }
  // Whether any body is tested against itself.
  bool any_self_contact() const { return self_count_ > 0; }
  bool is_rigid(std::uint32_t slot) const { return slots_[slot].rigid != nullptr; }
  // A box with its margin of where a body was in the last step: its box, if it is not rigid or place_ways() placed it.
  base::Box begin_box(std::uint32_t slot) const;

  // Of slots.
  const ExcludedPairs& excluded_pairs() const { return excluded_; }
  // Which pairs are looked at, besides; null: all. It outlives its use here.
  void set_choice(const PairChoice* choice) { choice_ = choice; }
  bool has_choice() const { return choice_ != nullptr; }
  bool is_chosen(const broadphase::IndexPair& pair) const {
    return choice_ == nullptr || choice_->looks_at(pair.a, pair.b);
  }

  // What the broad phase sees, an entry a slot: boxes with their margins; the box of an empty slot is empty. Those of
  // rigid bodies may be larger.
  std::span<const base::Box> boxes() const { return boxes_; }
  std::span<const broadphase::Filter> filters() const { return filters_; }
  // Where queries look for boxes. So many of them are about to come; any thread may say so.
  const BodyTree& tree() const { return *tree_; }
  void expect_queries(std::size_t count) const { tree_->expect(count, boxes_); }
  const BodyKdops& kdops() const { return kdops_; }
  void want_kdop(std::uint32_t slot, bool wanted) { kdops_.want(slot, wanted); }
  // Finds those that are wanted and not known.
  void find_kdops(int threads);
  // From now on the body's mesh keeps how far it goes.
  void keep_travel(std::uint32_t slot) { slots_[slot].body->mesh.keep_travel(true); }
  // Slots whose body was added, removed, moved or given another filter since end_step().
  std::span<const std::uint32_t> changed() const { return changed_; }
  bool moved(std::uint32_t slot) const { return slots_[slot].changed; }
  bool used(std::uint32_t slot) const { return slots_[slot].body != nullptr; }
  // Whether any body was removed since end_step(). Another may stand in its slot.
  bool removed_any() const { return !removed_.empty(); }

  // A body that was grouped again: which numbers its vertices have now, each under the number that it had.
  struct Regrouped {
    BodyId id;
    std::vector<int> numbers;
  };
  // Whether the clusters of any body have lost their shape.
  bool any_decayed() const { return groupings_.any_decayed(); }
  // Groups the facets of these bodies by where they are now, if it gains something. Sorted by slot. If it fails,
  // nothing has changed.
  std::vector<Regrouped> regroup(int threads);
  // Does without: the groups stay as they are, until the bodies are looked at again.
  void keep_groups() noexcept { groupings_.clear_decayed(); }

  // A body whose facets change: numbers of the mesh that have none any more are -1; and of each vertex that was, by the
  // caller's number, those that are it now and that a facet uses, ascending.
  struct VertexChange : Regrouped {
    std::vector<int> heirs_begin, heirs;
    std::span<const int> heirs_of(int vertex) const {
      const auto v = static_cast<std::size_t>(vertex);
      return std::span(heirs).subspan(heirs_begin[v], heirs_begin[v + 1] - heirs_begin[v]);
    }
  };
  struct NewMesh;
  // Makes what World::set_facets() puts in the place of a body's mesh.
  NewMesh make_mesh(BodyId id, const MeshUpdate& update, int threads) const;
  void set_mesh(NewMesh&& made) noexcept;

  // A step has seen the changes and has an answer: nothing has moved.
  void end_step();
  // Everything has moved: after a step that failed half-way.
  void mark_all_changed();

 private:
  // Where the positions of the last step are: those of now, those before the last refit, or in Body::begin. A body
  // that the last step did not know begins where it is.
  enum class Begin : std::uint8_t { here, before, kept };

  struct Slot {
    std::unique_ptr<Body> body;
    RigidState* rigid = nullptr;  // if it is
    std::uint32_t generation = 0;
    std::int32_t vertex_count = 0;  // the caller's; with `fixed`, so that a batch can be looked over without the bodies
    bool fixed = false;
    bool knows_box = false;  // of a rigid body: whether its entry of placed_boxes_ is that of its pose
    bool to_place = false;
    bool changed = false;
    bool seen = false;  // by a step
    Begin begin = Begin::here;
  };

  // A body that was removed since the last step.
  struct Removed {
    BodyId id;
    std::uint64_t key, birth;
  };
  // The id of a body that is gone: it names that body again if restore() brings it back. 16 bytes each.
  struct Former {
    std::uint64_t birth;
    std::uint32_t slot, generation;
  };
  // Errors: those of add(), but for the key and what the mesh holds. Returns the name that a body will have.
  std::string checked_name(const BodyDefinition& definition) const;
  std::string checked_name(const PlaneDefinition& definition) const;
  std::string name_of_next(const std::string& given) const;
  void check_key(std::uint64_t key, const std::string& name) const;
  template <class Definition>
  BodyId add_made(std::unique_ptr<Body> body, const Definition& definition, std::uint32_t slot, Motion motion);
  BodyId id_of_next(std::uint32_t slot) const;
  std::uint32_t next_slot() const { return free_.empty() ? static_cast<std::uint32_t>(slots_.size()) : free_.back(); }
  static constexpr double kAsMargin = -1.0;  // a rest offset that is the margin
  // What a body has in its slot.
  struct Place {
    broadphase::Filter filter = {};
    double margin = 0.0, rest_offset = kAsMargin;
    std::uint64_t key = 0;
    bool is_rigid = false;
  };

  // New positions of a body: prepared; its mesh refitted, and put back if any of a batch is bad; published.
  struct Update {
    Body* body = nullptr;
    std::uint32_t slot = 0;
    const Positions* given = nullptr;  // where the caller has them; packed when it is this body's turn
    std::span<const double> positions;
    std::vector<double> copy;
    narrowphase::Refit refitted{};
    base::Box box;
    bool knows_kdop = false;
    double quality = 0.0;  // of the clusters, if it was time to look
  };

  // facets.cpp
  std::vector<double> begin_positions(std::uint32_t slot, std::span<const double> now, std::span<const int> was) const;

  // shared_features.cpp
  std::uint32_t holder_of_features(std::uint32_t slot, std::uint64_t hash);

  // regroup.cpp
  Begin go_the_way(std::uint32_t slot, narrowphase::ClusteredMesh& anew) const;

  // bodies.cpp
  // The next put() into that slot cannot fail.
  void make_room_for(std::uint32_t slot, const Place& place);
  void add_slot();
  void put(std::uint32_t slot, std::unique_ptr<Body> body, const Place& place);
  void mark_changed(std::uint32_t slot);
  void mark_moved(std::uint32_t slot);
  static broadphase::IndexPair slots_of(BodyId a, BodyId b) {
    return {std::min(a.index, b.index), std::max(a.index, b.index)};
  }
  void set_filter(BodyId id, const broadphase::Filter& filter);
  narrowphase::SurfaceOffset offset_of(std::uint32_t slot) const;
  narrowphase::SurfaceOffset margin_of(std::uint32_t slot) const;
  narrowphase::SurfaceFilter surface_filter(std::uint32_t slot, bool by_labels) const;
  void check_labels(const LabelPair& labels) const;
  template <class OfBody>
  void check_named_once(std::span<const OfBody> updates);

  // poses.cpp
  // Makes a mesh rigid, in the pose in which it is.
  void make_rigid(narrowphase::ClusteredMesh& mesh, RigidState& state);
  // Throws if a pose is bad. Reads nothing of the body's shape, unless that may stand too far away.
  void check(const PoseUpdate& update) const;
  void check_pose(const PoseUpdate& update) const;  // of a body that takes one
  // Sets a pose that is good; returns whether it is another one.
  bool publish(const PoseUpdate& update);
  void note_to_place(std::uint32_t index);
  void forget_to_place();
  bool place_in_cache(std::uint32_t index);
  void prefetch_poses(std::span<const PoseUpdate> updates, std::size_t i) const;

  // positions.cpp
  void pack_meshes(int threads);
  void make_updates(std::size_t count);
  void prepare(Update& update, BodyId id, const Positions& positions);
  void refresh(std::size_t i, int threads);
  void refresh_all(std::size_t count, int threads);
  void prefetch_updates(std::size_t i, std::size_t grain, std::size_t own_end, std::size_t count) const;
  void take_back_if_bad(std::size_t count);
  void keep_begin(Body& body, Slot& slot);
  void publish(std::size_t i);
  void note_change(const Update& update);

  std::uint32_t world_;
  const base::Tuning* tuning_;
  PackedMeshes packed_meshes_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> generations_;  // the last one that was given out for a slot, also for those beyond slots_
  std::vector<Former> former_;
  RigidStates rigid_states_;
  std::vector<std::uint32_t> free_;
  std::vector<base::Box> boxes_;
  std::vector<broadphase::Filter> filters_;
  std::vector<double> margins_, rest_offsets_;
  BodyKeys keys_;
  std::unique_ptr<BodyTree> tree_ = std::make_unique<BodyTree>();
  BodyKdops kdops_;
  ClusterGroupings groupings_;
  std::vector<std::uint32_t> changed_;
  std::size_t count_ = 0;
  std::vector<Removed> removed_;  // sorted by id from update_order() on
  std::uint64_t steps_ = 0;
  ExcludedPairs excluded_;
  ExcludedLabels excluded_labels_;
  std::int64_t vertices_ = 0;
  std::int64_t moved_vertices_ = 0;
  std::size_t rigid_count_ = 0, self_count_ = 0, filter_count_ = 0;
  std::vector<std::uint32_t> planes_;
  std::vector<base::Box> placed_boxes_;  // with their margins, of rigid bodies that place() placed
  std::int64_t placed_count_ = 0;
  double farthest_rest_ = 0.0;                              // coordinate of rigid bodies that there were, or more
  std::vector<char> pose_changed_;                          // scratch, of each update
  std::vector<std::uint32_t> to_place_;                     // scratch: those with Slot::to_place are among them
  std::vector<Update> updates_;                             // scratch
  std::vector<narrowphase::Kdop> new_kdops_;                // of those that know them
  std::vector<std::uint32_t> without_features_;             // scratch
  std::map<std::uint64_t, std::uint32_t> feature_holders_;  // by topology_hash(): a slot that had such features
  std::vector<char> named_;                                 // scratch, an entry a slot
  const PairChoice* choice_ = nullptr;
};

struct Bodies::NewMesh {
  VertexChange vertices;
  bool has_inside = false, is_outward = false;  // see Body
  narrowphase::ClusteredMesh mesh;
  std::unique_ptr<LastingNames> names;
  std::unique_ptr<FeatureArrays> arrays;
  std::unique_ptr<SelfFilter> self_filter;
  std::shared_ptr<const narrowphase::Features> features;           // if the body had some
  std::unique_ptr<const narrowphase::ClusterNeighbors> neighbors;  // likewise
  Begin begin;
  bool grouped_from_scratch;
};

}  // namespace tact
