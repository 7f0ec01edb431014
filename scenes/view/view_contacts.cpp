#include "scenes/view/view_contacts.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <vector>

#include "engine/facet_outcomes.h"

namespace tact::scenes {
namespace {

constexpr double kNormalSteps = 32767.0;  // of a component of a point's normal, for 16 bits

void put_vector(const Eigen::Vector3d& v, ViewBytes& out) {
  for (int k = 0; k < 3; ++k) out.add_double(v[k]);
}

// For the picture alone, of which the thousands of contacts of a large pile are most.
void put_rough_vector(const Eigen::Vector3d& v, ViewBytes& out) {
  for (int k = 0; k < 3; ++k) out.add_float(static_cast<float>(v[k]));
}

void put_disk(const ZoneDisk& disk, ViewBytes& out) {
  out.add_double(disk.radius);
  if (disk.radius >= 0.0) put_rough_vector(disk.center, out);
}

// Sorted pairs: how far `a` is from the last one's, then `b` from the last one's.
void put_facet_pairs(std::span<const FacetPair> pairs, ViewBytes& out) {
  out.add_count(pairs.size());
  FacetPair last{0, 0};
  for (const FacetPair& pair : pairs) {
    out.add_count(static_cast<std::uint64_t>(pair.a - last.a));
    out.add_signed(pair.b - last.b);
    last = pair;
  }
}

// Runs of facets with one outcome: eight times the length, and the outcome.
void put_outcomes(const std::vector<FacetOutcome>& outcomes, ViewBytes& out) {
  out.add_count(outcomes.size());
  for (std::size_t i = 0; i < outcomes.size();) {
    const std::size_t begin = i;
    while (i < outcomes.size() && outcomes[i] == outcomes[begin]) ++i;
    out.add_count(8 * (i - begin) + static_cast<std::size_t>(outcomes[begin]));
  }
}

void put_patches(std::span<const Patch> patches, ViewBytes& out) {
  out.add_count(patches.size());
  for (const Patch& patch : patches) {
    put_rough_vector(patch.point, out);
    put_rough_vector(patch.direction, out);
    out.add_double(patch.depth);
    out.add_count(patch.facet_pairs.size());
    int last = 0;
    for (const int index : patch.facet_pairs) {
      out.add_count(static_cast<std::uint64_t>(index - last));
      last = index;
    }
  }
}

// How many vertices a place has: of a vertex, an edge or a facet. Then how far they are from the last point's, which
// has near ones, and all weights but the last in parts of 255, as positions are as rough.
void put_place(const std::array<int, 3>& vertices, const std::array<double, 3>& weights, std::array<int, 3>& last,
               ViewBytes& out) {
  const auto count = static_cast<std::size_t>(std::ranges::count_if(vertices, [](int v) { return v >= 0; }));
  out.add_count(count);
  for (std::size_t k = 0; k < count; ++k) {
    out.add_signed(vertices[k] - last[k]);
    last[k] = vertices[k];
  }
  for (std::size_t k = 0; k + 1 < count; ++k) out.add_byte(static_cast<std::uint8_t>(std::lrint(255.0 * weights[k])));
}

void put_point(const ContactPoint& point, std::array<int, 3>& last_a, std::array<int, 3>& last_b, ViewBytes& out) {
  out.add_byte(static_cast<std::uint8_t>(static_cast<int>(point.kind) | (point.minimum ? 8 : 0)));
  out.add_count(static_cast<std::uint64_t>(point.patch));
  put_place(point.a_vertices, point.a_weights, last_a, out);
  put_place(point.b_vertices, point.b_weights, last_b, out);
  for (int k = 0; k < 3; ++k) out.add_short(static_cast<std::int16_t>(std::lrint(kNormalSteps * point.normal[k])));
  out.add_float(static_cast<float>(point.gap));
  out.add_raw(point.id);
}

void put_points(const Contact& contact, PointsInView which, ViewBytes& out) {
  std::vector<int> chosen;
  if (which == PointsInView::spanning) {
    for (const Patch& patch : contact.patches())
      std::ranges::copy_if(patch.spanning, std::back_inserter(chosen), [](int point) { return point >= 0; });
    std::ranges::sort(chosen);
  } else {
    chosen.resize(contact.points().size());
    std::iota(chosen.begin(), chosen.end(), 0);
  }
  out.add_count(contact.points().size());
  out.add_count(chosen.size());
  std::array<int, 3> last_a{}, last_b{};
  for (const int point : chosen) put_point(contact.points()[point], last_a, last_b, out);
}

// Twice the number of points, and 1 more for a closed curve.
void put_curves(std::span<const IntersectionCurve> curves, ViewBytes& out) {
  out.add_count(curves.size());
  for (const IntersectionCurve& curve : curves) {
    out.add_count(2 * curve.points.size() + (curve.closed ? 1 : 0));
    for (const CurvePoint& point : curve.points) put_rough_vector(point.position, out);
  }
}

void put_contact(const Contact& contact, const std::optional<FacetOutcomes>& outcomes, const PlaceInView& place,
                 PointsInView points, ViewBytes& out) {
  out.add_count(place(contact.a));
  out.add_count(place(contact.b));
  out.add_byte(static_cast<std::uint8_t>(static_cast<int>(contact.source) | (contact.limit_reached ? 4 : 0) |
                                         (outcomes ? 8 : 0)));
  put_vector(contact.direction, out);
  out.add_double(contact.depth);
  out.add_double(contact.plane_a);
  out.add_double(contact.plane_b);
  put_disk(contact.zone_a, out);
  put_disk(contact.zone_b, out);
  out.add_count(static_cast<std::uint64_t>(contact.iterations));
  out.add_count(static_cast<std::uint64_t>(contact.kept_facets_a));
  out.add_count(static_cast<std::uint64_t>(contact.kept_facets_b));
  put_facet_pairs(contact.facet_pairs(), out);
  if (outcomes) {
    put_outcomes(outcomes->a, out);
    put_outcomes(outcomes->b, out);
  }
  put_patches(contact.patches(), out);
  put_points(contact, points, out);
  put_curves(contact.curves(), out);
}

}  // namespace

void write_contacts(const Report& report, const PlaceInView& place, PointsInView points, ViewBytes& out) {
  out.add_count(report.candidate_pairs().size());
  for (const CandidatePair& pair : report.candidate_pairs()) {
    out.add_count(2 * place(pair.a) + (pair.hulls_overlap ? 1 : 0));
    out.add_count(place(pair.b));
  }
  out.add_count(report.contacts().size());
  FacetOutcomeFinder finder(report);
  for (const Contact& contact : report.contacts()) put_contact(contact, finder.find(contact), place, points, out);
}

}  // namespace tact::scenes
