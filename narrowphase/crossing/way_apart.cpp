#include "narrowphase/crossing/way_apart.h"

#include <algorithm>

namespace tact::narrowphase {

namespace {

// Facets join in so many rounds at most: each makes the parts wider by a facet or more.
constexpr int kMostRounds = 32;
// Where parts have more facets than this, facets are small beside the bodies, and no more join.
constexpr std::size_t kMostFacets = 1000;
// So much farther than the way surfaces that are parted by it do not meet, whatever is rounded. Lengths are near 1.
constexpr double kBeyondDepth = 1e-9;

}  // namespace

WayApart::Way WayApart::part_hulls(Vec3 came, Vec3 preferred) {
  const MinkowskiDifference m(hull_a_.mesh(a_.points()), hull_b_.mesh(b_.points()));
  if (came != Vec3{}) {
    const ContactDirection found = contact_direction(m, came, {}, {}, faces_);
    return {found.n, std::max(0.0, found.height) / m.scale()};
  }
  const GjkSimplex hulls = gjk(m, {}, {}, {}).simplex;
  const SmallestSeparation found = smallest_separation(m, {.preferred = preferred, .hulls = hulls}, smallest_);
  return {found.direction, std::max(0.0, found.height) / m.scale()};
}

WayApart::Way WayApart::find(const WayApartInput& input) {
  a_.begin(input.a, input.part_a);
  b_.begin(input.b, input.part_b);
  if (input.depth <= kHardlyDeep) return {input.direction, input.depth};
  for (int round = 0; round < kMostRounds; ++round) {
    const Way way = part_hulls(input.came, input.direction);
    if (way.length > input.depth) break;
    if (a_.facets().size() + b_.facets().size() > kMostFacets) return way;
    const Vec3 shift = (way.length + kBeyondDepth) * way.direction;
    const bool grown_a = a_.grow(b_, shift), grown_b = b_.grow(a_, -shift);
    if (!grown_a && !grown_b) return way;
  }
  return {input.direction, input.depth};
}

void WayApart::append_points(const WayApartInput& input, std::vector<FeaturePoint>& found) {
  last_touch_.append_points(a_, b_, find(input).direction, found);
}

}  // namespace tact::narrowphase
