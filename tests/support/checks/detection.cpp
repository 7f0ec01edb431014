#include "tests/support/checks/detection.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>

namespace tact::tests {
namespace {

std::vector<FacetPair> missing_from(std::span<const FacetPair> part, std::span<const FacetPair> whole) {
  std::vector<FacetPair> missing;
  std::set_difference(part.begin(), part.end(), whole.begin(), whole.end(), std::back_inserter(missing));
  return missing;
}

void describe(::testing::AssertionResult& result, const char* what, const std::vector<FacetPair>& pairs) {
  constexpr std::size_t kShown = 5;
  result << "\n  " << pairs.size() << " " << what;
  for (std::size_t i = 0; i < std::min(pairs.size(), kShown); ++i) {
    result << (i == 0 ? ": " : ", ") << "(" << pairs[i].a << ", " << pairs[i].b << ")";
  }
}

}  // namespace

std::vector<MeetingBodies> meeting_bodies(const Report& report, std::span<const BodyId> ids) {
  std::map<BodyId, int> number;
  for (std::size_t i = 0; i < ids.size(); ++i) number[ids[i]] = static_cast<int>(i);
  std::vector<MeetingBodies> result;
  for (const Contact& contact : report.contacts()) {
    if (contact.facet_pairs().empty()) continue;
    MeetingBodies pair{number.at(contact.a), number.at(contact.b), {}};
    for (const FacetPair f : contact.facet_pairs()) {
      pair.facet_pairs.push_back(pair.a < pair.b ? f : FacetPair{f.b, f.a});
    }
    if (pair.a > pair.b) {
      std::swap(pair.a, pair.b);
      std::sort(pair.facet_pairs.begin(), pair.facet_pairs.end());
    }
    result.push_back(std::move(pair));
  }
  std::sort(result.begin(), result.end(),
            [](const MeetingBodies& p, const MeetingBodies& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  return result;
}

std::vector<MeetingBodies> meeting_bodies_by_engine(std::span<const Mesh> bodies, const Settings& settings) {
  World world(settings);
  const std::vector<BodyId> ids = add_bodies(world, bodies);
  return meeting_bodies(world.detect(), ids);
}

std::vector<FacetPair> facet_pairs_by_engine(const Mesh& a, const Mesh& b, const Settings& settings) {
  const std::vector<MeetingBodies> meeting = meeting_bodies_by_engine(std::array{a, b}, settings);
  return meeting.empty() ? std::vector<FacetPair>{} : meeting.front().facet_pairs;
}

::testing::AssertionResult same_facet_pairs(std::span<const FacetPair> expected, std::span<const FacetPair> found) {
  if (std::ranges::equal(expected, found)) return ::testing::AssertionSuccess();
  ::testing::AssertionResult result = ::testing::AssertionFailure();
  result << expected.size() << " facet pairs expected, " << found.size() << " found";
  if (!std::ranges::is_sorted(found)) return result << ", not sorted";
  describe(result, "missing", missing_from(expected, found));
  describe(result, "too many", missing_from(found, expected));
  return result;
}

::testing::AssertionResult same_meeting_bodies(std::span<const MeetingBodies> expected,
                                               std::span<const MeetingBodies> found) {
  std::map<std::pair<int, int>, std::array<std::span<const FacetPair>, 2>> both;
  for (const MeetingBodies& pair : expected) both[{pair.a, pair.b}][0] = pair.facet_pairs;
  for (const MeetingBodies& pair : found) both[{pair.a, pair.b}][1] = pair.facet_pairs;
  for (const auto& [bodies, facet_pairs] : both) {
    ::testing::AssertionResult result = same_facet_pairs(facet_pairs[0], facet_pairs[1]);
    if (!result) return result << "\n  between bodies " << bodies.first << " and " << bodies.second;
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult engine_agrees_with_oracle(std::span<const Mesh> bodies, const Settings& settings) {
  return same_meeting_bodies(meeting_bodies_by_oracle(bodies), meeting_bodies_by_engine(bodies, settings));
}

::testing::AssertionResult engine_agrees_with_oracle(const Mesh& a, const Mesh& b, const Settings& settings) {
  return same_facet_pairs(facet_pairs_by_oracle(a, b), facet_pairs_by_engine(a, b, settings));
}

}  // namespace tact::tests
