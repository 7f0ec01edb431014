// What a step found. A report and everything in it is valid until the world's next detect(), set_settings() or
// destruction, and may be read by many threads at once. To keep something for longer, copy it: a Contact's numbers, and
// what its facet_pairs() and patches() show by itself, as a copied Contact or Patch still points to the world's.
#pragma once

#include <tact/body.h>
#include <tact/contact_point.h>
#include <tact/error.h>
#include <tact/facet_pair.h>
#include <tact/statistics.h>
#include <tact/trace.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tact {

/// How a contact direction was found.
enum class DirectionSource {
  carried,   ///< from the direction of the last step
  fresh,     ///< from the direction that separated the hulls when they were last apart
  smallest,  ///< as the smallest separation of the hulls
};

/// Is one of two bodies wholly inside the other, a closed one, so that no facets meet?
enum class Containment {
  none,
  a_in_b,
  b_in_a,
};

/// The disk around an impact zone, in the plane through `center` across the contact direction.
struct ZoneDisk {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< metres
  /// Metres; negative: not asked for, or the zone has no point, or Accuracy::hulls. At Accuracy::paper zones are
  /// computed whether they are asked for or not.
  double radius = -1.0;
};

/// A place where two bodies touch, or come nearer than their margins: a connected set of facet pairs and contact
/// points. Facet pairs are neighbours if they share a facet; points, if they share a vertex of either body and their
/// normals are not opposite; a point and a facet pair, if a vertex of the point is a corner of the facet. A body in a
/// clamp has two.
struct Patch {
  /// The same in the next step, if most of the vertices that it shares with patches of that step are shared with this
  /// one, and the other way around. Never given out twice by a world. See Report::patch_events().
  std::uint64_t id = 0;
  /// The middle of its points, of those of facet pairs without points the centres of their common boxes; metres.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// Unit, from a to b. With points: the mean of their normals, each weighted by how much its gap is below the margins;
  /// as points keep their side from step to step, so does it. Without: the mean normal of the facets, weighted by area.
  /// The contact's direction if the mean is zero.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// With points: minus the smallest gap, so negative where the surfaces are apart. Without: moving b by
  /// depth * direction parts every facet pair of the patch. Metres.
  double depth = 0.0;
  /// Of the convex hull of its points, or of the centres as above, seen along `direction`; square metres.
  double area = 0.0;
  std::span<const int> facet_pairs;  ///< indices into Contact::facet_pairs(), ascending; the world's
  std::span<const int> points;       ///< indices into Contact::points(), ascending; the world's
  /// At most four of the points, for solvers of rigid bodies: the deepest first, then those that span the most area.
  /// Indices into Contact::points(); -1 fills up.
  std::array<int, 4> spanning{-1, -1, -1, -1};
};

/// What became of a patch in this step. One that is in Contact::patches() and in no event persists.
struct PatchEvent {
  enum class Kind {
    began,   ///< where there was none
    split,   ///< it is new, and came off the patch `other`, which persists
    merged,  ///< it is no more, and went into the patch `other`
    ended,   ///< it is no more
  };
  BodyId a;
  BodyId b;
  Kind kind = Kind::began;
  std::uint64_t patch = 0;
  std::uint64_t other = 0;
  friend bool operator==(const PatchEvent&, const PatchEvent&) = default;
};

/// Two bodies whose convex hulls overlap, touch, or are nearer than the sum of the bodies' margins. Whether they
/// overlap or touch is decided exactly, whichever body was added first. Their facets need not: where bodies are not
/// convex, a ball in a bowl say, ask touching() before they are pushed apart by `depth`, or ask for patches, which have
/// depths of their own, or for points.
///
/// A body with itself, where BodyDefinition::self_contact asks for it, has a contact with a == b if facets meet that
/// share no vertex, or if there are points. It has facet pairs, with facet a < facet b, points and patches; all else is
/// empty.
struct Contact {
  BodyId a;  ///< a.index <= b.index
  BodyId b;  ///< the second body, or the first again
  /// Unit, from a to b: moving b by depth * direction separates the hulls.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// Overlap of the hulls along `direction`, metres. Negative where they are apart: their distance, and `direction` is
  /// then that of the distance.
  double depth = 0.0;
  /// Decided exactly, by a vertex of each part of the inner body's mesh, where no facets meet; none at Accuracy::hulls.
  /// `direction` and `depth` then show the way out. A ball in a bowl is not contained, nor are linked rings: their
  /// hulls overlap, and if they do not touch() they need no push.
  Containment containment = Containment::none;
  /// Of the last step in which a body of the pair had moved, as all of the contact: nothing is done for pairs at rest.
  DirectionSource source = DirectionSource::fresh;
  int iterations = 0;          ///< shifted calls of GJK that it took
  bool limit_reached = false;  ///< GJK or the direction stopped at a limit: the direction is the best found
  /// Planes are as far from zero as the bodies, and rounded as coordinates there are; `depth` is not their difference.
  double plane_a = 0.0;            ///< contact plane of a: direction · x = plane_a, the farthest that a's hull reaches
  double plane_b = 0.0;            ///< contact plane of b: direction · x = plane_b, the nearest that b's hull reaches
  ZoneDisk zone_a;                 ///< around the part of a between the planes
  ZoneDisk zone_b;                 ///< around the part of b between the planes
  std::int64_t kept_facets_a = 0;  ///< facets left after the criteria
  std::int64_t kept_facets_b = 0;  ///< likewise

  /// The facets that meet, sorted; empty at Accuracy::hulls.
  std::span<const FacetPair> facet_pairs() const { return facet_pairs_; }
  /// Whether facets meet or, with Outputs::points, a point's gap is below the sum of margins. Points alone decide at
  /// Accuracy::hulls, which computes no facet pairs.
  bool touching() const { return touching_; }
  /// Where surfaces are nearest to each other, if Outputs::points is set; sorted by kind, then by features.
  std::span<const ContactPoint> points() const { return points_; }
  /// Filled if Outputs::patches is set; ordered by their first facet pair, those without by their first point.
  std::span<const Patch> patches() const { return patches_; }

 private:
  friend class ReportWriter;
  std::span<const FacetPair> facet_pairs_;
  std::span<const Patch> patches_;
  std::span<const ContactPoint> points_;
  bool touching_ = false;
};

/// Two bodies whose boxes overlap.
struct CandidatePair {
  BodyId a;  ///< a.index < b.index
  BodyId b;
  bool hulls_overlap = false;
  friend bool operator==(const CandidatePair&, const CandidatePair&) = default;
};

/// Two bodies, or one twice, that began to touch, or ceased to, in this step: their facets meet, or they have points.
/// One of Report::contacts() that touches, and is in no event, persists.
struct ContactEvent {
  BodyId a;
  BodyId b;
  friend bool operator==(const ContactEvent&, const ContactEvent&) = default;
};

/// What World::detect() found. Shown by reference; everything in it is sorted, and the same for any number of threads.
class TACT_API Report {
 public:
  Report() = default;
  Report(const Report&) = delete;  // what it shows is the world's: take a reference
  Report& operator=(const Report&) = delete;

  /// Pairs whose hulls overlap or are nearer than their margins, and bodies that touch themselves, sorted by (a, b).
  std::span<const Contact> contacts() const { return contacts_; }
  /// That of two bodies, in either order, or null if their hulls are apart. Takes the logarithm of how many there are.
  const Contact* find_contact(BodyId a, BodyId b) const noexcept;
  /// Pairs whose boxes overlap, sorted by (a, b).
  std::span<const CandidatePair> candidate_pairs() const { return candidate_pairs_; }
  /// Pairs that touch now, by facets or by points, and did not in the last step, sorted by (a, b); bodies with
  /// themselves among them. Of a step that starts afresh (see World::detect), all that touch.
  std::span<const ContactEvent> began() const { return began_; }
  /// Pairs that touched in the last step and do not now, or of which a body was removed, sorted by (a, b). Ask
  /// World::contains() before the ids are used: those of removed bodies are stale.
  std::span<const ContactEvent> ended() const { return ended_; }
  /// What became of patches, if Outputs::patches is set: sorted by (a, b), what ended before what began.
  std::span<const PatchEvent> patch_events() const { return patch_events_; }
  const StepStats& stats() const { return stats_; }
  /// Filled if Outputs::trace is set; sorted by thread and time, an event before those within it.
  std::span<const TraceEvent> trace() const { return trace_; }

  /// A number made from every bit of the answers: candidate pairs; bodies of contacts by index, directions, depths,
  /// planes, zones, facet pairs, points. Not from patches, nor from what was done to find them: sources, iterations,
  /// kept facets, statistics. The same calls give the same hash, for any number of threads.
  std::uint64_t hash() const;

 private:
  friend class ReportWriter;
  Report(Report&&) = default;
  Report& operator=(Report&&) = default;
  std::vector<Contact> contacts_;
  std::vector<CandidatePair> candidate_pairs_;
  std::vector<ContactEvent> began_;
  std::vector<ContactEvent> ended_;
  std::vector<PatchEvent> patch_events_;
  StepStats stats_;
  std::vector<TraceEvent> trace_;
};

}  // namespace tact
