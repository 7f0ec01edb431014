// Bodies and the step over them.
#pragma once

#include <tact/body.h>
#include <tact/error.h>
#include <tact/motion.h>
#include <tact/queries.h>
#include <tact/report.h>
#include <tact/settings.h>
#include <tact/world_observer.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tact {

/// New positions of one body, for World::set_positions of many:
///
///   std::vector<tact::PositionsUpdate> updates;
///   for (Cloth& cloth : cloths) updates.push_back({cloth.body, cloth.positions});
///   world.set_positions(updates);
struct PositionsUpdate {
  BodyId body;
  Positions positions;  ///< 3 x V, metres
};

/// A new pose of a rigid body, for World::set_poses(): a vertex that was added at p stands at rotation p + translation.
struct PoseUpdate {
  BodyId body;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< metres
};

/// A box, metres.
struct Bounds {
  std::array<double, 3> lower;
  std::array<double, 3> upper;
};

/// A set of bodies and the contacts among them.
///
///   tact::World world;
///   const tact::BodyId a = world.add_body({.positions = positions, .facets = facets});
///   ...
///   world.set_positions(a, new_positions);
///   for (const tact::Contact& contact : world.detect().contacts()) ...
///
/// Every function throws Error for data that it cannot take, and has then changed nothing (for detect(), which takes
/// none, see there). Const functions of one world may be called by many threads at once, between the calls that change
/// it; different worlds may be used by different threads. The answers do not depend on the number of threads, nor on
/// the floating-point mode of the caller.
class TACT_API World {
 public:
  /// Errors: bad_settings, out_of_memory.
  explicit World(const Settings& settings = {});
  ~World();
  /// A world that was moved from holds no body, and refuses all calls but these and those that never throw
  /// (wrong_order).
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Valid as long as the world. (So is the name of a body, until the body is removed.)
  const Settings& settings() const;
  /// Takes effect with the next step, which then looks at every pair anew; directions are carried on.
  /// Errors: bad_settings.
  void set_settings(const Settings& settings);

  /// Copies the mesh and groups its facets into clusters, which is costly. detect() does that again for a body whose
  /// facets have changed places so much that their groups have lost their shape (StepStats::regrouped_bodies).
  /// Errors: wrong_size, non_finite_position, position_out_of_range, facet_out_of_range, too_large, bad_settings (a
  /// surface or motion that is none), out_of_memory.
  BodyId add_body(const BodyDefinition& definition);
  /// Errors: stale_body, foreign_body.
  void remove_body(BodyId body);

  /// Copies the new positions of a body, 3 x V in metres, V as when it was added. A body whose coordinates are all
  /// equal to the old ones has not moved. Errors: stale_body, foreign_body, fixed_body, wrong_motion, wrong_size,
  /// non_finite_position, position_out_of_range, out_of_memory.
  void set_positions(BodyId body, const Positions& positions);
  /// The same for many bodies, in parallel; all or none. A body must not be named twice (wrong_order).
  void set_positions(std::span<const PositionsUpdate> updates);

  /// Turns and moves a rigid body: a vertex that was added at p stands at R p + t from now on, whatever poses were set
  /// before. Each coordinate is ((R0 p.x + R1 p.y) + R2 p.z) + t with the row R0, R1, R2 of R, every operation rounded
  /// to double in this order; all answers are those of a body whose positions were set to these doubles. Vertices are
  /// computed only of bodies that others come near, or that are asked for; a pose costs the same for a body of any
  /// size. A body whose pose equals the old one has not moved.
  ///
  /// `rotation` must be orthonormal to 1e-9, determinant +1; it is used as it is. A vertex that no facet uses is not
  /// looked at. Errors: stale_body, foreign_body, fixed_body, wrong_motion (the body is not rigid), not_a_rotation,
  /// non_finite_position and position_out_of_range (the translation, or where a vertex would stand), out_of_memory.
  void set_pose(BodyId body, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);
  /// The same for many bodies, in parallel; all or none. A body must not be named twice (wrong_order).
  void set_poses(std::span<const PoseUpdate> updates);

  /// The layers that a body is on, and those that it is tested against; see BodyDefinition. Errors: stale_body,
  /// foreign_body.
  void set_layers(BodyId body, std::uint32_t layer, std::uint32_t mask);
  /// The group that a body is in; see BodyDefinition. Errors: stale_body, foreign_body.
  void set_group(BodyId body, std::uint32_t group);
  /// Are two bodies, in either order, left out whatever their layers: the two sides of a joint, say? They are tested
  /// again if they are excluded no more, and forgotten when one of them is removed. Errors: stale_body, foreign_body,
  /// bad_settings (one body twice).
  void set_excluded(BodyId a, BodyId b, bool excluded);
  /// A body that moves from now on, or one that stays where it is. One that was added as rigid is rigid or fixed, any
  /// other is moving or fixed. Errors: stale_body, foreign_body, bad_settings (a motion that is none), wrong_motion.
  void set_motion(BodyId body, Motion motion);

  /// Half the thickness of a body, metres, and whether it is held against itself; see BodyDefinition. Errors:
  /// stale_body, foreign_body, bad_settings (a margin that is negative, not finite or larger than kLargestCoordinate).
  void set_margin(BodyId body, double margin);
  void set_self_contact(BodyId body, bool wanted);

  /// One step: finds the contacts of the positions as they are now. Never throws for what positions can hold.
  /// Errors: out_of_memory, backend_failure. Bodies and positions are then as they were, but the next call starts
  /// afresh: it knows of no step before, so directions are not carried on, and all pairs that touch have begun to.
  const Report& detect();

  /// What meets between the positions of the last detect() and those set since, every vertex moving straight from the
  /// one to the other; a body that no detect() has seen stands where it is. Layers, masks, margins and self-contact
  /// count as in detect(); pairs of which neither body moved, and bodies with themselves that did not, are not looked
  /// at. It changes nothing: a later detect() takes its step as it would have.
  ///
  /// What is proved: nothing that meets is left out, whatever the doubles are; a time is never later than the true
  /// one; what misses by more than 1e-11 of its size and way is not reported. See Impact.
  ///
  ///     world.set_positions(body, target);
  ///     const double free = std::min(1.0, 0.999 * world.detect_motion(tact::Impacts::first).first_time());
  ///     world.set_positions(body, start + free * (target - start));
  ///     world.detect();
  ///
  /// Errors: bad_settings (`wanted` is none), out_of_memory, backend_failure.
  const MotionReport& detect_motion(Impacts wanted = Impacts::all);

  /// Queries to the surfaces where they are now: at the positions that were set last, whether or not a step has seen
  /// them. A query looks for bodies in a tree over their boxes; after many bodies moved the first few queries scan all
  /// boxes instead, then one of them updates the tree. The threads of the world share many queries of one call.
  ///
  /// Errors: non_finite_position, position_out_of_range, bad_settings (see queries.h; the message tells which of many
  /// queries), wrong_size (there are not as many answers as queries), out_of_memory. Nothing is answered then.
  RayHit cast_ray(const Ray& ray, RayHits wanted = RayHits::first) const;
  void cast_rays(std::span<const Ray> rays, std::span<RayHit> hits, RayHits wanted = RayHits::first) const;
  /// All facets that a ray meets, sorted by time, body and facet.
  std::vector<RayHit> cast_ray_all(const Ray& ray) const;
  ClosestPoint closest_point(const PointQuery& query) const;
  void closest_points(std::span<const PointQuery> queries, std::span<ClosestPoint> answers) const;
  /// The facets that share a point with a box, decided exactly; sorted by body and facet.
  std::vector<FacetOfBody> overlap_box(const BoxQuery& query) const;
  /// The closed bodies that a point is in, or on the surface of, decided exactly by how often each winds around it.
  /// `within` is not used.
  std::vector<BodyId> bodies_containing(const PointQuery& query) const;
  /// Many of these at once, an answer each: what it held is replaced.
  void overlap_boxes(std::span<const BoxQuery> queries, std::span<std::vector<FacetOfBody>> answers) const;
  void bodies_containing_each(std::span<const PointQuery> queries, std::span<std::vector<BodyId>> answers) const;

  /// Who is told of every call that changes the world from now on, a Recorder say; null: nobody. The observer outlives
  /// the world, also one that this world is moved to, or is taken away before. It sees the world whole: it is set
  /// before the first body is added. Errors: wrong_order (bodies were added, and `observer` is not null).
  void set_observer(WorldObserver* observer);

  /// Does `body` name a body of this world? Never throws.
  bool contains(BodyId body) const noexcept;
  std::size_t body_count() const noexcept;
  /// The bodies in the order of their index. Errors: out_of_memory.
  std::vector<BodyId> bodies() const;

  /// Errors of these: stale_body, foreign_body.
  const std::string& name(BodyId body) const;
  Surface surface(BodyId body) const;
  Motion motion(BodyId body) const;
  std::uint32_t layer(BodyId body) const;
  std::uint32_t mask(BodyId body) const;
  std::uint32_t group(BodyId body) const;
  bool excluded(BodyId a, BodyId b) const;  ///< and bad_settings: one body twice
  std::uint64_t external_id(BodyId body) const;
  double margin(BodyId body) const;
  bool self_contact(BodyId body) const;
  std::size_t vertex_count(BodyId body) const;
  std::size_t facet_count(BodyId body) const;

  /// The mesh of a body as it was given, at the positions that were set last: 3 x V metres and 3 x F indices of
  /// vertices, column by column. A vertex that no facet uses is not kept: its coordinates are NaN.
  /// Errors: stale_body, foreign_body, wrong_size (there is not as much room as there are numbers).
  void copy_positions(BodyId body, std::span<double> coordinates) const;
  void copy_facets(BodyId body, std::span<int> corners) const;
  /// The box of a body with its margin, metres; where it has no facet, lower is above upper.
  /// Errors: stale_body, foreign_body.
  Bounds bounds(BodyId body) const;

 private:
  friend class WorldTuning;
  struct Implementation;
  Implementation& implementation() const;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tact
