// Bodies that are spread over the ranks of an MPI communicator, and the step over them: the answers of one machine.
#pragma once

#include <mpi.h>
#include <tact/mpi/report.h>
#include <tact/world.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tact::mpi {

/// How Zoltan cuts space into one part a rank.
enum class Partitioner {
  rcb,   ///< by planes across the longest side, halving the work: as many ghosts as hsfc, and fewer bytes of boxes
  hsfc,  ///< along a Hilbert curve
};

/// How a world works. All of it is the same on all ranks, but threads, executor and messages.
struct Settings {
  tact::Settings world = {};                   ///< as on one machine
  Partitioner partitioner = Partitioner::rcb;  ///< how rebalance() cuts space
  /// detect() rebalances first if the work of the busiest rank over the mean was larger; at least 1, or 0 for never.
  double rebalance_above = 0.0;
};

/// Who holds a body that is added.
enum class Holders {
  this_rank,   ///< the rank that adds it owns it
  every_rank,  ///< all ranks add the same fixed body, a floor say; it is sent to nobody
};

/// New positions of one body, for World::set_positions().
struct PositionsUpdate {
  std::uint64_t key = 0;  ///< the body
  Positions positions;    ///< 3 x V, metres
};

/// A new pose of a rigid body, for World::set_poses().
struct PoseUpdate {
  std::uint64_t key = 0;                                   ///< the body
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< of determinant +1
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< metres
};

/// A label of one body and a label of another, or of the same, for World::set_excluded_labels().
struct LabelPair {
  std::uint64_t key_a = 0;            ///< a body
  std::uint32_t label_a = 0;          ///< a label of it, not 0
  std::uint64_t key_b = 0;            ///< another body, or the same
  std::uint32_t label_b = 0;          ///< a label of that, not 0
  LabelKind kind = LabelKind::facet;  ///< what has the labels
};

/// State of the program's own that moves with a body. All three are given or none. They may throw, but for `drop`.
struct BodyState {
  std::function<std::vector<std::byte>(std::uint64_t key)> pack;                    ///< on the old owner
  std::function<void(std::uint64_t key, std::span<const std::byte> bytes)> unpack;  ///< on the new owner
  std::function<void(std::uint64_t key)> drop;  ///< on the rank that does not have the body any more
};

/// A set of bodies over many ranks and the contacts among them. Each body has a key of its own and one owner.
///
///   tact::mpi::World world(MPI_COMM_WORLD);
///   world.add_body({.positions = positions, .facets = facets, .key = key});
///   ...
///   world.set_positions(key, new_positions);
///   for (const tact::mpi::Contact& contact : world.detect().contacts()) ...
///
/// Functions marked "together" are called by all ranks in the same order. If one throws on any rank, it throws the same
/// code and message on all, and has changed nothing but what detect() says. Which rank owns a body changes no answer.
/// Functions that take a key throw stale_body where this rank does not own the body.
class TACT_API World {
 public:
  /// Makes a world of no bodies, together; duplicates the communicator. Errors: bad_settings (also where the ranks give
  /// different ones), out_of_memory, wrong_order (MPI was not initialized).
  explicit World(MPI_Comm communicator, const Settings& settings = {});
  /// Together, before MPI_Finalize().
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  int rank() const;                  ///< of this process
  int rank_count() const;            ///< of all
  const Settings& settings() const;  ///< valid until restore()
  /// Sets the settings for the next step, together. Errors: bad_settings, also where the ranks give different ones.
  void set_settings(const Settings& settings);

  /// Adds a body of this rank. Errors: those of tact::World::add_body(), and invalid_argument without a key. Keys that
  /// two ranks give are refused by the next call together.
  void add_body(const BodyDefinition& definition, Holders holders = Holders::this_rank);
  /// Adds a half-space that all ranks add alike. Errors: those of tact::World::add_plane(), and invalid_argument
  /// without a key.
  void add_plane(const PlaneDefinition& definition);
  /// Removes a body of this rank, or one that every rank holds: then all ranks do.
  void remove_body(std::uint64_t key);

  // As the functions of tact::World, with their errors.

  void set_positions(std::uint64_t key, const Positions& positions);  ///< copies new positions, 3 x V metres
  /// Copies new positions of many bodies in parallel, all or none.
  void set_positions(std::span<const PositionsUpdate> updates);
  /// Gives a body other vertices and facets. Errors: also wrong_order, between move_bodies(), rebalance() or restore()
  /// and the next detect().
  void set_facets(std::uint64_t key, const MeshUpdate& update);
  /// Places a rigid body.
  void set_pose(std::uint64_t key, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);
  /// Places many rigid bodies in parallel, all or none.
  void set_poses(std::span<const PoseUpdate> updates);
  void set_layers(std::uint64_t key, std::uint32_t layer, std::uint32_t mask);  ///< sets layer and mask
  void set_group(std::uint64_t key, std::uint32_t group);                       ///< sets the group
  void set_motion(std::uint64_t key, Motion motion);                            ///< sets how the body moves
  void set_margin(std::uint64_t key, double margin);                            ///< sets the margin, metres
  void set_rest_offset(std::uint64_t key, std::optional<double> rest_offset);   ///< sets the rest offset, metres
  /// Replaces the settings of single vertices and facets.
  void set_feature_settings(std::uint64_t key, const FeatureSettings& settings);
  void set_self_contact(std::uint64_t key, bool wanted);  ///< sets whether it is tested against itself
  /// Sets which features of a body are too near to each other to be tested against each other.
  void set_self_contact_filter(std::uint64_t key, const SelfContactFilter& filter);
  /// Sets whether two bodies are excluded from tests. One rank that owns one of them says so; the other owner learns it
  /// in the next call together. Errors: also stale_body, then, if nobody owns the other.
  void set_excluded(std::uint64_t key, std::uint64_t other, bool excluded);
  /// Sets whether features of two labels are excluded from tests. Who says so and who learns it as above. Errors: as
  /// above.
  void set_excluded_labels(const LabelPair& labels, bool excluded);

  /// Takes one step, together. Errors: out_of_memory, backend_failure; bodies stay, and the next step starts from
  /// scratch. invalid_argument: two ranks own bodies of one key, or the ranks hold different bodies that every rank
  /// should hold. Till one of them takes that back, or the others do likewise, each call together says so.
  const Report& detect();
  /// Finds what meets between the positions of the last detect() and the current ones, together. `wanted` is the same
  /// on all ranks. Impacts::first gives the earliest of all ranks.
  const MotionReport& detect_motion(Impacts wanted = Impacts::all);

  /// Returns this rank's share of all that later answers depend on as bytes, together; the program's state of its
  /// bodies with them. Errors: out_of_memory, those of BodyState.
  std::vector<std::byte> save() const;
  /// Goes back to what all ranks saved, together. Each share is given to one rank, whichever, of as many ranks as there
  /// are. References to local() and settings() end. Errors: bad_state, out_of_memory, those of BodyState.
  void restore(std::span<const std::span<const std::byte>> shares);

  /// Sets the program's state that moves with bodies.
  void set_body_state(BodyState state);
  /// Cuts space anew by the work of the last step and gives each body to the rank of its middle, together. Errors:
  /// those of BodyState, out_of_memory.
  void rebalance();
  /// Gives a body to another rank, in the next call of move_bodies(). Errors: invalid_argument (no such rank).
  void set_owner(std::uint64_t key, int rank);
  /// Moves the bodies that set_owner() named, together. Errors: as rebalance().
  void move_bodies();

  /// Sends `give(key)` of each body of this rank, once, to every other rank with a body in contact with it, and calls
  /// `take(key, bytes)` for what comes, by ascending keys; together. Velocities for a solver, say.
  /// Errors: wrong_order (bodies have moved to other ranks since the last detect()).
  void exchange(const std::function<std::vector<std::byte>(std::uint64_t key)>& give,
                const std::function<void(std::uint64_t key, std::span<const std::byte> bytes)>& take);

  /// Whether this rank owns a body. Never throws.
  bool owns(std::uint64_t key) const noexcept;
  /// Returns the keys of the bodies that this rank owns, ascending.
  std::vector<std::uint64_t> bodies() const;
  /// Returns the number of bodies that this rank owns. Never throws.
  std::size_t body_count() const noexcept;
  /// Returns the id of a body in local(): one that this rank owns or every rank holds.
  BodyId id(std::uint64_t key) const;
  /// Returns the world of this rank, for reading and for queries: its bodies, and copies of bodies of other ranks that
  /// were near in the last step. It has no observer; save() is what can be kept of a run.
  const tact::World& local() const;

 private:
  struct Implementation;
  Implementation& implementation() const;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tact::mpi
