// Bodies of a world, one by one, and what is kept of their pairs: taken out of one world and put into another, with no
// bit of any later answer changed. For worlds that are spread over ranks; no part of the public interface.
#pragma once

#include <tact/world.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "broadphase/index_pair.h"
#include "engine/base/box.h"
#include "engine/bodies/pair_choice.h"
#include "engine/curve_set.h"
#include "engine/patch_set.h"

namespace tact {

struct Body;
class Bodies;
class MotionStage;
class Step;
using StateBytes = std::vector<std::byte>;

/// What is kept of a pair, by the numbers of the caller's vertices.
struct SavedPair {
  std::uint64_t key_a = 0, key_b = 0;
  std::uint64_t birth_a = 0, birth_b = 0;  ///< tell a body from another of its key; 0 of one that was removed
  StateBytes bytes;                        ///< empty if one of the bodies was removed: the pair has ended
  bool touching = false;                   ///< with `patches`: which events there are if it ends
  std::vector<std::uint64_t> patches;
};

/// The caller's numbers of vertices and the meshes', made once for each body. For many pairs, while no facets change.
class VertexNumbers {
 public:
  struct OfMesh {
    std::vector<int> source;  ///< the caller's, of each vertex of the mesh
    std::vector<int> mesh;    ///< the mesh's, of each vertex of the caller
  };
  const OfMesh& of(const Body& body);

 private:
  std::map<std::uint32_t, OfMesh> of_slot_;
};

/// A contact that another world found, with all that it views.
struct FarContact {
  Contact contact;
  std::vector<FacetPair> facet_pairs;
  std::vector<ContactPoint> points;
  std::vector<ReachPair> within_reach;
  PatchSet patches;
  CurveSet curves;

  FarContact() = default;
  FarContact(FarContact&&) = default;  // vectors that move keep what is viewed of them
  FarContact& operator=(FarContact&&) = default;
};

/// Ids are of this world. What is put in or taken out counts from settle() on.
class TACT_API WorldParts {
 public:
  explicit WorldParts(World& world);

  /// Which pairs the world looks at; the choice outlives the world.
  void set_choice(const PairChoice* choice);
  /// Called by each detect() when all is found, before anything of it counts. If it throws, the step fails.
  void set_commit(std::function<void(const Report&)> commit);

  /// Whether a body was added, moved or set otherwise since the last step; whether any was, or was removed; whether a
  /// body has other positions than then.
  bool moved(BodyId body) const;
  bool any_moved() const;
  bool on_its_way(BodyId body) const;
  /// The box of a body with its margin, or a larger one; and of its way since the last step.
  base::Box box(BodyId body) const;
  base::Box way_box(BodyId body) const;
  broadphase::Filter filter(BodyId body) const;
  /// The rest offset that a body was given.
  std::optional<double> rest_offset(BodyId body) const;
  /// Where a body is: zero where no facet uses the vertex; and the pose of a rigid one.
  std::vector<double> positions(BodyId body) const;
  PoseUpdate pose(BodyId body) const;

  /// The facets of a body in their order, and all else of it.
  StateBytes shape(BodyId body) const;
  StateBytes rest(BodyId body) const;
  /// Errors: those of World::add_body() and add_plane(), but for the key.
  void check(const BodyDefinition& definition) const;
  void check(const PlaneDefinition& definition) const;
  /// Puts a body in as it was. A copy is tested against no body by itself. Errors: bad_state, too_large.
  BodyId put(std::span<const std::byte> shape, std::span<const std::byte> rest, bool is_copy);
  /// Takes bodies out, and all that is kept of them, as if they had never been there.
  void take(std::span<const BodyId> bodies);
  /// Removes a copy as World::remove_body(): the next step tells what ended.
  void remove_copy(BodyId body);
  /// What tells a body from another of its key: for bodies that several worlds hold alike, in whichever slots.
  void set_birth(BodyId body, std::uint64_t birth);
  std::uint64_t birth(BodyId body) const;
  /// Notes that a body has moved, and is on its way even if it is where it was.
  void mark_moved(BodyId body, bool is_on_its_way);
  /// As World::set_excluded() and World::set_excluded_labels(), but that nothing has moved by that.
  void exclude(BodyId a, BodyId b, bool excluded);
  void exclude(const LabelPair& labels, bool excluded);

  /// What is kept of each pair with one of these bodies.
  std::vector<SavedPair> pairs_of(std::span<const BodyId> bodies) const;
  /// The same of all pairs; of those with a removed body, also of one with itself, what their end will tell.
  std::vector<SavedPair> all_pairs() const;
  /// Puts in what was kept of a pair; does nothing and returns false if one of its bodies is not here, or the pair has
  /// ended. Errors: bad_state.
  bool put(const SavedPair& pair, VertexNumbers& numbers);
  /// The same of a body with itself.
  StateBytes self_of(BodyId body) const;
  void put_self(BodyId body, std::span<const std::byte> bytes);
  /// The next step sees what came and went.
  void settle();

  /// The next step starts from nothing, as after one that failed.
  void forget_step();

  /// How many steps there were, and whether the next looks at every pair; for a world that goes on from there. Errors:
  /// bad_state.
  StateBytes steps() const;
  void set_steps(std::span<const std::byte> bytes);
  /// The settings that answers depend on, as bytes; and back, with the others of `kept`. Errors: bad_state.
  static StateBytes settings_bytes(const Settings& settings);
  static Settings settings_of(std::span<const std::byte> bytes, const Settings& kept);
  /// Tells bytes that were damaged by chance.
  static std::uint64_t checksum(std::span<const std::byte> bytes);

  /// A contact of a report as bytes, its bodies by their keys; and back. Errors: bad_state.
  static StateBytes contact_bytes(const Contact& contact);
  static FarContact contact_of(std::span<const std::byte> bytes);
  static std::array<std::uint64_t, 2> keys_of(const Contact& contact);

  /// The pairs of boxes that overlap and whose filters agree.
  static std::vector<broadphase::IndexPair> overlapping(std::span<const base::Box> boxes,
                                                        std::span<const broadphase::Filter> filters, int threads);

 private:
  // Bodies come and go, or begin elsewhere, by other ways than those of the world's own functions.
  void forget_ways();

  Bodies& bodies_;
  Step& step_;
  std::unique_ptr<MotionStage>& motion_;
};

}  // namespace tact
