#include "tests/support/hashes/answer_hash.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace tact::tests {
namespace {

template <class Enum>
std::uint64_t number_of(Enum value) {
  return static_cast<std::uint64_t>(value);
}

}  // namespace

void AnswerHash::add(const Eigen::Vector3d& v) {
  for (int axis = 0; axis < 3; ++axis) add(v[axis]);
}

// Its sign is a feature: rounding must not change on which side of zero it is. Whether it is zero, rounding may.
void AnswerHash::add_signed(double number) {
  features_.add(number < 0.0 ? 1 : 0);
  add(number);
}

void AnswerHash::add_vertices(std::span<const int> vertices) {
  for (const int v : vertices) features_.add(static_cast<std::uint32_t>(v));
}

void AnswerHash::add(std::span<const double> numbers) {
  features_.add(numbers.size());
  for (const double number : numbers) add(number);
}

void AnswerHash::add(const Report& report) {
  features_.add(report.candidate_pairs().size());
  for (const CandidatePair& pair : report.candidate_pairs()) {
    add(pair.a);
    add(pair.b);
    features_.add(pair.hulls_overlap ? 1 : 0);
  }
  features_.add(report.contacts().size());
  for (const Contact& contact : report.contacts()) add(contact);
  for (const auto& events : {report.began(), report.ended()}) {
    features_.add(events.size());
    for (const ContactEvent& event : events) {
      add(event.a);
      add(event.b);
    }
  }
  add(report.patch_events());
}

std::uint64_t AnswerHash::name_of(std::uint64_t patch) const {
  if (patch_numbers_ == nullptr || patch == 0) return patch;
  return patch_numbers_->try_emplace(patch, patch_numbers_->size() + 1).first->second;
}

void AnswerHash::add(std::span<const PatchEvent> events) {
  std::vector<PatchEvent> sorted(events.begin(), events.end());
  if (patch_numbers_ != nullptr)
    std::ranges::stable_sort(sorted, {}, [&](const PatchEvent& event) {
      return std::tuple(event.a, event.b, event.kind, name_of(event.patch), name_of(event.other));
    });
  features_.add(sorted.size());
  for (const PatchEvent& event : sorted) {
    add(event.a);
    add(event.b);
    features_.add(number_of(event.kind));
    features_.add(name_of(event.patch));
    features_.add(name_of(event.other));
  }
}

void AnswerHash::add(const Contact& contact) {
  add(contact.a);
  add(contact.b);
  features_.add(number_of(contact.containment));
  features_.add(contact.facet_pairs().empty() ? 0 : 1);
  add(contact.direction);
  add_signed(contact.depth);
  add(contact.plane_a);
  add(contact.plane_b);
  for (const ZoneDisk& zone : {contact.zone_a, contact.zone_b}) {
    add(zone.center);
    add_signed(zone.radius);
  }
  features_.add(contact.facet_pairs().size());
  for (const FacetPair& pair : contact.facet_pairs()) add_vertices(std::array{pair.a, pair.b});
  features_.add(contact.points().size());
  for (const ContactPoint& point : contact.points()) add(point);
  features_.add(contact.patches().size());
  for (const Patch& patch : contact.patches()) add(patch);
  if (!contact.curves().empty()) add_curves(contact);
}

// With them, which points are minima.
void AnswerHash::add_curves(const Contact& contact) {
  for (const ContactPoint& point : contact.points()) features_.add(point.minimum ? 1 : 0);
  features_.add(contact.curves().size());
  for (const IntersectionCurve& curve : contact.curves()) {
    features_.add(2 * curve.points.size() + (curve.closed ? 1 : 0));
    for (const CurvePoint& point : curve.points) {
      add_vertices(point.edge);
      add_vertices(std::array{point.facet, point.facet_pair});
      features_.add(point.edge_of_b ? 1 : 0);
      add(point.fraction);
      add(point.position);
    }
  }
}

void AnswerHash::add(const ContactPoint& point) {
  features_.add(number_of(point.kind));
  if (!leaves_out_ids_) features_.add(point.id);
  add_vertices(std::array{point.patch});
  add_vertices(point.a_vertices);
  add_vertices(point.b_vertices);
  for (std::size_t k = 0; k < 3; ++k) {
    add(point.a_weights[k]);
    add(point.b_weights[k]);
  }
  add(point.normal);
  add_signed(point.gap);
}

// The points that span most are chosen by areas, of which many are equal but for rounding.
void AnswerHash::add(const Patch& patch) {
  features_.add(name_of(patch.id));
  features_.add(patch.facet_pairs.size());
  add_vertices(patch.facet_pairs);
  features_.add(patch.points.size());
  add_vertices(patch.points);
  add(patch.point);
  add(patch.direction);
  add(patch.depth);
  add(patch.area);
  for (const int point : patch.spanning) numbers_.add(static_cast<std::uint32_t>(point));
}

void AnswerHash::add(const MotionReport& report) {
  add(report.first_time());
  features_.add(report.impacts().size());
  for (const Impact& impact : report.impacts()) {
    add(impact.a);
    add(impact.b);
    features_.add(number_of(impact.kind));
    add_vertices(impact.a_vertices);
    add_vertices(impact.b_vertices);
    if (!impact.stops) features_.add(std::uint64_t{0});
    add(impact.time);
  }
  features_.add(report.pairs().size());
  for (const ImpactPair& pair : report.pairs()) {
    add(pair.a);
    add(pair.b);
    features_.add(pair.impacts.size());
    add(pair.first_time);
  }
}

void AnswerHash::add(const RayHit& hit) {
  add(hit.body);
  add_vertices(std::array{hit.facet});
  add(hit.fraction);
  for (const double weight : hit.barycentric) add(weight);
}

void AnswerHash::add(const ClosestPoint& closest) {
  add(closest.body);
  add_vertices(std::array{closest.facet});
  add(closest.distance);
  for (const double weight : closest.barycentric) add(weight);
}

void AnswerHash::add(std::span<const RayHit> hits) {
  features_.add(hits.size());
  for (const RayHit& hit : hits) add(hit);
}

void AnswerHash::add(std::span<const ClosestPoint> closest) {
  features_.add(closest.size());
  for (const ClosestPoint& one : closest) add(one);
}

void AnswerHash::add(std::span<const FacetOfBody> facets) {
  features_.add(facets.size());
  for (const FacetOfBody& one : facets) {
    add(one.body);
    add_vertices(std::array{one.facet});
  }
}

void AnswerHash::add(std::span<const BodyId> bodies) {
  features_.add(bodies.size());
  for (const BodyId body : bodies) add(body);
}

}  // namespace tact::tests
