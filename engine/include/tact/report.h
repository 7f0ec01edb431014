// What a step found. A report is valid until the world's next detect(), set_settings(), restore() or destruction; many
// threads may read it at once. A copied Contact or Patch still views the world's data. Bodies stand in the order of
// their keys.
#pragma once

#include <tact/body.h>
#include <tact/contact_point.h>
#include <tact/error.h>
#include <tact/facet_pair.h>
#include <tact/intersection_curve.h>
#include <tact/reach_pair.h>
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
  fresh,     ///< from the direction that last separated the hulls
  smallest,  ///< as the smallest separation of the hulls
};

/// Which of two bodies lies wholly inside the other, so that no facets meet.
enum class Containment {
  none,    ///< neither, or Accuracy::hulls
  a_in_b,  ///< a lies inside b, a closed body
  b_in_a,  ///< b lies inside a, a closed body
};

/// The smallest disk around an impact zone, seen along the contact direction.
struct ZoneDisk {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< metres
  double radius = -1.0;                              ///< metres; negative where no zone is computed or it is empty
};

/// A connected set of facet pairs and contact points: a place where two bodies touch or nearly do. Facet pairs with a
/// common facet are connected. So are points with a common vertex, unless their normals are opposite, and a point and a
/// facet pair with a common vertex.
struct Patch {
  /// The same in the next step if both share most of their vertices; made from both keys, the step of its beginning and
  /// its place.
  std::uint64_t id = 0;
  /// The middle of its points, or of the boxes that its facet pairs have in common; metres.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// Unit vector from a to b: the mean normal of its points, weighted by depth, or of its facets, by area.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// Metres: minus the smallest gap of its points, or how far b moves along `direction` to part its facet pairs.
  double depth = 0.0;
  /// The area of the convex hull of its points, seen along `direction`; square metres.
  double area = 0.0;
  std::span<const int> facet_pairs;  ///< indices into Contact::facet_pairs(), ascending
  std::span<const int> points;       ///< indices into Contact::points(), ascending
  /// At most four of `points`: the deepest, and those that span the most area; kept while they nearly do. -1 fills up.
  std::array<int, 4> spanning{-1, -1, -1, -1};
};

/// A change of a patch in this step. A patch without an event persists.
struct PatchEvent {
  /// What became of the patch.
  enum class Kind {
    began,   ///< it is new
    split,   ///< it is new, and was a part of the patch `other`, which persists
    merged,  ///< it became a part of the patch `other`
    ended,   ///< it is gone
  };
  BodyId a;                 ///< its key is not above that of b
  BodyId b;                 ///< the second body
  Kind kind = Kind::began;  ///< what became of the patch
  std::uint64_t patch = 0;  ///< its id
  std::uint64_t other = 0;  ///< the id of the other patch, or 0
  friend bool operator==(const PatchEvent&, const PatchEvent&) = default;
};

/// Two bodies whose convex hulls overlap or touch, decided exactly, or are nearer than the sum of the margins. Their
/// surfaces may be apart: see touching(). With self-contact a body that touches or nears itself has a contact
/// with a == b, with facet pairs, points, pairs within reach and patches alone.
struct Contact {
  BodyId a;  ///< its key is below that of b; equal to b for a body with itself
  BodyId b;  ///< the second body
  /// Unit vector from a to b: moving b by depth * direction separates the hulls.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// The overlap of the hulls along `direction`, metres; minus their distance where they are apart.
  double depth = 0.0;
  /// Which body lies wholly inside the other, decided exactly; the direction leads out of it.
  Containment containment = Containment::none;
  DirectionSource source = DirectionSource::fresh;  ///< how `direction` was found when a body last moved
  int iterations = 0;                               ///< shifted calls of GJK that it took
  bool limit_reached = false;  ///< whether GJK or the direction stopped at a limit, with the best direction found
  /// Whether a sheet crosses itself deeper than its crossing edges are long: vertices there have no point.
  bool point_limit_reached = false;
  double plane_a = 0.0;  ///< the contact plane direction * x = plane_a, the farthest that the hull of a reaches
  double plane_b = 0.0;  ///< the contact plane direction * x = plane_b, the nearest that the hull of b reaches
  ZoneDisk zone_a;       ///< around the part of a between the planes
  ZoneDisk zone_b;       ///< around the part of b between the planes
  std::int64_t kept_facets_a = 0;  ///< facets of a left after the criteria
  std::int64_t kept_facets_b = 0;  ///< facets of b left after the criteria

  /// Returns the facets that meet, sorted; empty at Accuracy::hulls.
  std::span<const FacetPair> facet_pairs() const { return facet_pairs_; }
  /// Whether facets meet, or a point's gap is below the sum of the rest offsets.
  bool touching() const { return touching_; }
  /// Returns the points, if Outputs::points is set; sorted by kind, then by features.
  std::span<const ContactPoint> points() const { return points_; }
  /// Returns every vertex and facet, and every two edges, nearer than the sum of the margins, if Outputs::within_reach
  /// is set; sorted by kind, then by features. Planes have none: they have points.
  std::span<const ReachPair> within_reach() const { return within_reach_; }
  /// Returns the patches, if Outputs::patches is set; sorted by first facet pair, then by first point.
  std::span<const Patch> patches() const { return patches_; }
  /// Returns the curves in which the surfaces cross, if Outputs::curves is set; sorted by their first facet pair.
  std::span<const IntersectionCurve> curves() const { return curves_; }
  /// Returns a number made from every bit of the contact, its facet pairs, points, pairs within reach and patches, but
  /// for counts of work. Bodies enter it by their keys alone.
  TACT_API std::uint64_t hash() const;

 private:
  friend class ReportWriter;
  friend class Report;
  friend class KeptReport;
  friend struct StateFields;
  std::span<const FacetPair> facet_pairs_;
  std::span<const Patch> patches_;
  std::span<const ContactPoint> points_;
  std::span<const IntersectionCurve> curves_;
  std::span<const ReachPair> within_reach_;
  std::uint64_t key_a_ = 0, key_b_ = 0;
  bool touching_ = false;
};

/// Two bodies whose boxes overlap.
struct CandidatePair {
  BodyId a;                    ///< its key is below that of b
  BodyId b;                    ///< the second body
  bool hulls_overlap = false;  ///< whether their hulls overlap or touch
  friend bool operator==(const CandidatePair&, const CandidatePair&) = default;
};

/// Two bodies, or one with itself, that began or ceased to touch in this step: see Contact::touching().
struct ContactEvent {
  BodyId a;  ///< its key is not above that of b
  BodyId b;  ///< the second body
  friend bool operator==(const ContactEvent&, const ContactEvent&) = default;
};

/// What World::detect() found. All of it is sorted, and the same for any number of threads.
class TACT_API Report {
 public:
  Report() = default;
  Report(const Report&) = delete;  // views the world's data
  Report& operator=(const Report&) = delete;

  /// Returns the contacts, sorted by (a, b).
  std::span<const Contact> contacts() const { return contacts_; }
  /// Returns the contact of two bodies, in either order, if they have one. Else null. It takes the logarithm of the
  /// number of contacts.
  const Contact* find_contact(BodyId a, BodyId b) const noexcept;
  /// Returns the pairs whose boxes overlap, sorted by (a, b).
  std::span<const CandidatePair> candidate_pairs() const { return candidate_pairs_; }
  /// Returns the contacts that touch now and did not in the last step, sorted by (a, b).
  std::span<const ContactEvent> began() const { return began_; }
  /// Returns the contacts that touched in the last step and do not now, sorted by (a, b); ids of removed bodies are
  /// stale.
  std::span<const ContactEvent> ended() const { return ended_; }
  /// Returns the changes of patches, if Outputs::patches is set; sorted by (a, b), ends before beginnings.
  std::span<const PatchEvent> patch_events() const { return patch_events_; }
  /// Returns counts and times of the step.
  const StepStats& stats() const { return stats_; }
  /// Returns what each thread did, if Outputs::trace is set; sorted by thread and time, outer events first.
  std::span<const TraceEvent> trace() const { return trace_; }

  /// Returns a number made from every bit of candidate pairs, contacts, facet pairs, points and pairs within reach;
  /// bodies enter it by their keys. Equal calls give equal numbers.
  std::uint64_t hash() const;

 private:
  friend class ReportWriter;
  friend class KeptReport;
  friend class FacetOutcomeFinder;
  Report(Report&&) = default;
  Report& operator=(Report&&) = default;
  std::uint64_t key(BodyId body) const noexcept { return body.index < keys_.size() ? keys_[body.index] : body.index; }
  std::vector<Contact> contacts_;
  std::vector<CandidatePair> candidate_pairs_;
  std::vector<ContactEvent> began_;
  std::vector<ContactEvent> ended_;
  std::vector<PatchEvent> patch_events_;
  std::vector<std::uint64_t> keys_;  // of the bodies, by index; empty where they are the indices
  StepStats stats_;
  std::vector<TraceEvent> trace_;
  const struct ReportSources* sources_ = nullptr;
};

}  // namespace tact
