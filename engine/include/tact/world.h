// Bodies and the step over them.
#pragma once

#include <tact/body.h>
#include <tact/body_queries.h>
#include <tact/error.h>
#include <tact/motion.h>
#include <tact/queries.h>
#include <tact/report.h>
#include <tact/settings.h>
#include <tact/surface_check.h>
#include <tact/world_observer.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tact {

/// New positions of one body, for World::set_positions().
struct PositionsUpdate {
  BodyId body;          ///< the body
  Positions positions;  ///< 3 x V, metres
};

/// A new mesh of one body, for World::set_facets().
struct MeshUpdate {
  Positions positions;               ///< 3 x V, metres
  Facets facets = Facets::none();    ///< 3 x F, indices of vertices
  Edges edges = Edges::none();       ///< 2 x E, indices of vertices
  std::span<const int> points = {};  ///< vertices that stand alone
  std::span<const int> vertex_map;   ///< of each vertex the old one that it was, or -1
  /// Of each facet the old one whose label, layer and mask it has, or -1. An empty map names none.
  std::span<const int> facet_map = {};
};

/// A new pose of a rigid body, for World::set_poses().
struct PoseUpdate {
  BodyId body;                                             ///< the body
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< of determinant +1
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< metres
};

/// A box.
struct Bounds {
  std::array<double, 3> lower;  ///< metres
  std::array<double, 3> upper;  ///< metres
};

/// A set of bodies and the contacts among them.
///
///   tact::World world;
///   const tact::BodyId a = world.add_body({.positions = positions, .facets = facets});
///   ...
///   world.set_positions(a, new_positions);
///   for (const tact::Contact& contact : world.detect().contacts()) ...
///
/// A function that throws Error has changed nothing; see detect(). Many threads may call const functions of one world
/// at once, between calls that change it. Neither threads nor the caller's floating-point mode change answers. What is
/// cast before a call, such as a matrix of floats for one of doubles, is cast in the caller's mode.
class TACT_API World {
 public:
  /// Makes a world of no bodies. Errors: bad_settings, out_of_memory.
  explicit World(const Settings& settings = {});
  ~World();
  /// Leaves a world behind that refuses all calls but destruction, assignment and those that never throw (wrong_order).
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Returns the settings. They are valid as long as the world.
  const Settings& settings() const;
  /// Sets the settings for the next step, which looks at every pair again. Errors: bad_settings.
  void set_settings(const Settings& settings);

  /// Adds a body; copies its mesh and groups the facets into clusters. Errors: wrong_size, non_finite_position,
  /// position_out_of_range, facet_out_of_range, too_large, invalid_argument, out_of_memory.
  BodyId add_body(const BodyDefinition& definition);
  /// Adds a half-space, which is fixed and has no vertices: exact at any distance, and without a mesh. Errors:
  /// invalid_argument, too_large, out_of_memory.
  BodyId add_plane(const PlaneDefinition& definition);
  /// Removes a body. Errors: stale_body, foreign_body.
  void remove_body(BodyId body);

  /// Copies new positions of a body, 3 x V in metres; equal ones do not move it. Errors: stale_body, foreign_body,
  /// fixed_body, wrong_motion, wrong_size, non_finite_position, position_out_of_range, out_of_memory.
  void set_positions(BodyId body, const Positions& positions);
  /// Copies new positions of many bodies in parallel, all or none. Errors: wrong_order (a body named twice), and as
  /// above.
  void set_positions(std::span<const PositionsUpdate> updates);

  /// Gives a body other vertices and facets; `vertex_map` tells of each new vertex which old one it was, or -1. What is
  /// still there keeps ids and history; the manual tells how. Errors: stale_body, foreign_body, wrong_motion (a rigid
  /// body), invalid_argument (no such old vertex), and those of add_body().
  void set_facets(BodyId body, const Positions& positions, const Facets& facets, std::span<const int> vertex_map);
  /// The same with edges and points, of which the other leaves none, and with labels, layers and masks of facets.
  /// Errors: as above; invalid_argument also of a facet map.
  void set_facets(BodyId body, const MeshUpdate& update);

  /// Places a rigid body: a vertex added at p stands at rotation * p + translation. `rotation` is orthonormal to 1e-9.
  /// The manual names the order of rounding. Errors: stale_body, foreign_body, fixed_body, wrong_motion,
  /// not_a_rotation, non_finite_position, position_out_of_range, out_of_memory.
  void set_pose(BodyId body, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);
  /// Places many rigid bodies in parallel, all or none. Errors: wrong_order (a body named twice), and as above.
  void set_poses(std::span<const PoseUpdate> updates);

  /// Sets the layers of a body and those that it is tested against. Errors: stale_body, foreign_body.
  void set_layers(BodyId body, std::uint32_t layer, std::uint32_t mask);
  /// Sets the group of a body. Errors: stale_body, foreign_body.
  void set_group(BodyId body, std::uint32_t group);
  /// Sets whether two bodies are excluded from tests, whatever their layers: the two sides of a joint, say. Errors:
  /// stale_body, foreign_body, invalid_argument (one body twice).
  void set_excluded(BodyId a, BodyId b, bool excluded);
  /// Sets how a body moves. One that was added as rigid is rigid or fixed, any other deformable or fixed. Errors:
  /// stale_body, foreign_body, invalid_argument, wrong_motion.
  void set_motion(BodyId body, Motion motion);

  /// Sets how far ahead of a body's surface contact points are seen, metres. Errors: stale_body, foreign_body,
  /// invalid_argument (also below a rest offset, or a margin of a vertex).
  void set_margin(BodyId body, double margin);
  /// Sets what a body adds to the distance that surfaces keep, metres; none takes the margin, whatever that becomes.
  /// Errors: stale_body, foreign_body, invalid_argument (not 0 to the margin, or above that
  /// of a vertex).
  void set_rest_offset(BodyId body, std::optional<double> rest_offset);
  /// Replaces the settings of single vertices and facets of a body. Errors: stale_body, foreign_body, wrong_size,
  /// invalid_argument (a margin or a rest offset is not 0 to the one above it), out_of_memory.
  void set_feature_settings(BodyId body, const FeatureSettings& settings);
  /// Sets whether a body is tested against itself. Errors: stale_body, foreign_body.
  void set_self_contact(BodyId body, bool wanted);
  /// Sets which features of a body are too near to each other to be tested against each other. Errors: stale_body,
  /// foreign_body, invalid_argument, wrong_size, non_finite_position, position_out_of_range, out_of_memory.
  void set_self_contact_filter(BodyId body, const SelfContactFilter& filter);
  /// Sets whether features of two labels are excluded from tests: a collar and what it is sewn to, say. Errors:
  /// stale_body, foreign_body, invalid_argument (a label 0, a plane), out_of_memory.
  void set_excluded_labels(const LabelPair& labels, bool excluded);

  /// Takes one step: finds the contacts of the current positions. It does not throw for positions that set_positions()
  /// accepted. Errors: out_of_memory, backend_failure; bodies stay, and the next step starts from scratch.
  const Report& detect();

  /// Finds what meets between the positions of the last detect() and the current ones, every vertex moving straight. No
  /// meeting is left out, and no time is late. It changes no later answer. The manual shows its use. Errors:
  /// invalid_argument, out_of_memory, backend_failure.
  const MotionReport& detect_motion(Impacts wanted = Impacts::all);
  /// The same by options: the distance at which features meet; bounds of how far each vertex may go. Errors: as above.
  const MotionReport& detect_motion(const MotionOptions& options);

  /// Returns all that later answers depend on as bytes: settings, bodies, histories. Worlds in one state have the same
  /// bytes. Left out are threads, executor, messages and observer. Errors: out_of_memory.
  std::vector<std::byte> save() const;
  /// Goes back to the state of `bytes`, of this world or another: later calls answer as after save(), bit for bit. The
  /// manual tells which ids name which bodies then. Errors: bad_state, too_large, out_of_memory.
  void restore(std::span<const std::byte> bytes);

  // Queries see the current positions, whether or not a step has. Errors of these: non_finite_position,
  // position_out_of_range, invalid_argument, wrong_size (not as many answers as queries), out_of_memory.

  /// Returns the first facet that a ray meets, or any.
  RayHit cast_ray(const Ray& ray, RayHits wanted = RayHits::first) const;
  /// Answers many rays in parallel.
  void cast_rays(std::span<const Ray> rays, std::span<RayHit> hits, RayHits wanted = RayHits::first) const;
  /// Returns all facets that a ray meets, sorted by fraction, body and facet.
  std::vector<RayHit> cast_ray_all(const Ray& ray) const;
  /// Returns the nearest place of all surfaces to a point.
  ClosestPoint closest_point(const PointQuery& query) const;
  /// Finds the nearest places to many points in parallel.
  void closest_points(std::span<const PointQuery> queries, std::span<ClosestPoint> answers) const;
  /// Returns the facets that share a point with a box, decided exactly; sorted by body and facet.
  std::vector<FacetOfBody> overlap_box(const BoxQuery& query) const;
  /// Returns the closed bodies that contain a point or have it on their surface, decided exactly, at any `within`.
  std::vector<BodyId> bodies_containing(const PointQuery& query) const;
  /// Finds the facets in many boxes in parallel. It replaces what the answers held.
  void overlap_boxes(std::span<const BoxQuery> queries, std::span<std::vector<FacetOfBody>> answers) const;
  /// Finds the bodies that contain many points in parallel. It replaces what the answers held.
  void bodies_containing_each(std::span<const PointQuery> queries, std::span<std::vector<BodyId>> answers) const;
  /// Returns the nearest surface of closed bodies and planes; its distance is minus the depth where one contains the
  /// point: the deepest, at any depth. Exactly zero on a surface.
  ClosestPoint signed_distance(const PointQuery& query) const;
  /// Finds the signed distances of many points in parallel.
  void signed_distances(std::span<const PointQuery> queries, std::span<ClosestPoint> answers) const;

  // Errors of these besides: stale_body, foreign_body, and invalid_argument where a plane is swept or two are compared.

  /// Returns the least distance of two bodies. Errors: also invalid_argument (one body twice).
  BodyDistance distance(const DistanceQuery& query) const;
  /// Finds the distances of many pairs of bodies in parallel.
  void distances(std::span<const DistanceQuery> queries, std::span<BodyDistance> answers) const;
  /// Returns the bodies nearest to one, sorted by distance and body.
  std::vector<BodyDistance> nearest_bodies(const NearestBodiesQuery& query) const;
  /// Returns what a body meets first when it is moved straight or turned, all others standing still.
  SweepHit sweep(const Sweep& sweep) const;
  /// Finds what many sweeps meet in parallel.
  void sweeps(std::span<const Sweep> queries, std::span<SweepHit> hits) const;
  /// Returns volume and surface of what two closed bodies that do not cross themselves have in common. Errors: also
  /// invalid_argument (one body twice, or one without an inside).
  Overlap overlap(BodyId a, BodyId b) const;

  /// Sets the observer of all mutating calls, which outlives the world; null removes it. Errors: wrong_order (bodies
  /// were added before).
  void set_observer(WorldObserver* observer);

  /// Whether `body` names a body of this world. Never throws.
  bool contains(BodyId body) const noexcept;
  /// Returns the number of bodies. Never throws.
  std::size_t body_count() const noexcept;
  /// Returns the bodies in the order of their index. Errors: out_of_memory.
  std::vector<BodyId> bodies() const;

  // Errors of these: stale_body, foreign_body.

  /// Returns the name of a body, valid until the body is removed.
  const std::string& name(BodyId body) const;
  Surface surface(BodyId body) const;      ///< what the facets of a body are
  Motion motion(BodyId body) const;        ///< how a body moves
  std::uint32_t layer(BodyId body) const;  ///< the layers that a body is on
  std::uint32_t mask(BodyId body) const;   ///< the layers that a body is tested against
  std::uint32_t group(BodyId body) const;  ///< the group of a body, or 0
  /// Whether set_excluded() excludes two bodies. Errors: also invalid_argument (one body twice).
  bool excluded(BodyId a, BodyId b) const;
  std::uint64_t external_id(BodyId body) const;  ///< the number that the program gave a body
  std::uint64_t key(BodyId body) const;          ///< the key of a body: given, or its index
  double margin(BodyId body) const;              ///< the margin of a body, metres
  double rest_offset(BodyId body) const;         ///< the rest offset of a body, or its margin, metres
  /// Returns the settings of single vertices and facets of a body, valid until they or its facets change.
  FeatureSettings feature_settings(BodyId body) const;
  /// Returns the labels of a feature of a body, whose vertices are named as in a point, a pair or an impact. Errors:
  /// also invalid_argument (no such vertex).
  FeatureLabels labels(BodyId body, const std::array<int, 3>& vertices) const;
  bool self_contact(BodyId body) const;  ///< whether a body is tested against itself
  /// Returns which features of a body are too near to be tested, valid until that or its facets change.
  SelfContactFilter self_contact_filter(BodyId body) const;
  /// Whether set_excluded_labels() excludes two labels. Errors: also invalid_argument.
  bool excluded_labels(const LabelPair& labels) const;
  std::size_t vertex_count(BodyId body) const;  ///< the number of vertices that were added
  std::size_t facet_count(BodyId body) const;   ///< the number of facets that were added
  std::size_t edge_count(BodyId body) const;    ///< the number of edges that were added
  std::size_t point_count(BodyId body) const;   ///< the number of points that were added
  /// Returns the half-space of a body that add_plane() added; none for any other.
  std::optional<Plane> plane(BodyId body) const;

  /// Copies the current positions of a body, 3 x V metres, column by column; a vertex that no facet, edge or point uses
  /// is NaN. Errors: also wrong_size.
  void copy_positions(BodyId body, std::span<double> coordinates) const;
  /// Copies the facets of a body, 3 x F indices, column by column. Errors: also wrong_size.
  void copy_facets(BodyId body, std::span<int> corners) const;
  /// Copies the edges of a body, 2 x E indices, column by column. Errors: also wrong_size.
  void copy_edges(BodyId body, std::span<int> ends) const;
  /// Copies the points of a body, P indices. Errors: also wrong_size.
  void copy_points(BodyId body, std::span<int> vertices) const;
  /// Checks what a body's surface is: borders, turned facets, crossings with itself and more. A facet is a sliver whose
  /// height is at most `sliver` times its longest side. Errors: also invalid_argument, out_of_memory, backend_failure.
  SurfaceCheck check_surface(BodyId body, double sliver = 1e-6) const;
  /// Returns the box of a body with its margin, metres; that of a plane is infinite. Without a facet, edge or point,
  /// lower is above upper.
  Bounds bounds(BodyId body) const;

 private:
  friend class FailedStep;
  friend class WorldParts;
  friend class WorldTuning;
  struct Implementation;
  Implementation& implementation() const;
  const struct Body& body_of(BodyId body) const;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tact
