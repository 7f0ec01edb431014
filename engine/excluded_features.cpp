#include "engine/excluded_features.h"

#include <limits>
#include <vector>

#include "engine/base/parallel.h"

namespace tact {

namespace {

using narrowphase::FeatureFilter, narrowphase::FeatureRules;

// The caller's numbers of the vertices of a source facet; none of a plane.
std::array<int, 3> vertices_of(const Body& body, int facet) {
  if (body.plane != nullptr) return {-1, -1, -1};
  return source_vertices(body.mesh, body.mesh.corners(body.mesh.facet_of_source(facet)));
}

// Curves name facet pairs by their places; where these are left out no way leads on.
void renumber(CurveSet& curves, const std::vector<int>& place_now) {
  for (CurvePoint& point : curves.points) {
    if (point.facet_pair >= 0) point.facet_pair = place_now[static_cast<std::size_t>(point.facet_pair)];
  }
}

// Of what is found of one pair, some 100 ns each.
constexpr std::size_t kFoundAtATime = 512;

void leave_out(std::vector<FacetPair>& pairs, const Body& a, const Body& b, const FeatureFilter& filter,
               CurveSet* curves, int threads) {
  if (filter.is_uniform()) return;
  std::vector<int> place_now(pairs.size(), -1);
  base::parallel_for(pairs.size(), kFoundAtATime, threads, [&](std::size_t i) {
    const auto facet_of = [](const Body& body, int facet) { return body.plane != nullptr ? -1 : facet; };
    if (filter.allows_facets(facet_of(a, pairs[i].a), facet_of(b, pairs[i].b)) &&
        filter.allows_vertices(vertices_of(a, pairs[i].a), vertices_of(b, pairs[i].b)))
      place_now[i] = 0;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (place_now[i] < 0) continue;
    place_now[i] = static_cast<int>(kept);
    pairs[kept++] = pairs[i];
  }
  if (kept == pairs.size()) return;
  pairs.resize(kept);
  if (curves != nullptr) renumber(*curves, place_now);
}

// The others stay in their order.
template <class Found, class IsLeftOut>
void leave_out(std::vector<Found>& found, int threads, const IsLeftOut& is_left_out) {
  std::vector<char> left_out(found.size());
  base::parallel_for(found.size(), kFoundAtATime, threads,
                     [&](std::size_t i) { left_out[i] = is_left_out(found[i]) ? 1 : 0; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (left_out[i] == 0) found[kept++] = found[i];
  }
  found.erase(found.begin() + static_cast<std::ptrdiff_t>(kept), found.end());
}

// What touches or has crossed is seen whatever the margins are.
template <class Record>
void leave_out(Record& record, BodyId id_a, BodyId id_b, const Bodies& bodies, int threads) {
  const FeatureRules rules = bodies.contact_rules(id_a.index, id_b.index);
  if (rules.are_uniform()) return;
  const Body &a = bodies.in_slot(id_a.index), &b = bodies.in_slot(id_b.index);
  leave_out(record.facet_pairs, a, b, rules.filter, record.curves.get(), threads);
  leave_out(record.bare_pairs, a, b, rules.filter, nullptr, threads);
  const auto is_left_out = [&](const auto& found, double gap) {
    return (!rules.reach.is_uniform() && gap >= rules.reach.of(found.a_vertices, found.b_vertices)) ||
           !rules.filter.allows(found.a_vertices, found.b_vertices);
  };
  leave_out(record.points, threads, [&](const ContactPoint& point) {
    return is_left_out(point, point.gap > 0.0 ? point.gap : -std::numeric_limits<double>::infinity());
  });
  leave_out(record.within_reach, threads, [&](const ReachPair& pair) { return is_left_out(pair, pair.distance); });
}

// Calls leave_out_of(i, threads): a thread for each of many, all for each of few.
template <class LeaveOut>
void for_each_pair(std::size_t count, std::size_t grain, int threads, const LeaveOut& leave_out_of) {
  if (count >= static_cast<std::size_t>(threads)) {
    base::parallel_for(count, grain, threads, [&](std::size_t i) { leave_out_of(i, 1); });
  } else {
    for (std::size_t i = 0; i < count; ++i) leave_out_of(i, threads);
  }
}

}  // namespace

void leave_out_excluded(std::span<const MovedPair> moved, std::span<SelfRecord* const> selves, const Bodies& bodies,
                        int threads) {
  if (!bodies.any_feature_filter()) return;
  constexpr std::size_t kAtATime = 16;  // pairs, some microseconds each
  for_each_pair(moved.size(), kAtATime, threads, [&](std::size_t i, int of_pair) {
    PairRecord& record = *moved[i].record;
    leave_out(record, record.a, record.b, bodies, of_pair);
  });
  for_each_pair(selves.size(), 1, threads, [&](std::size_t i, int of_pair) {
    leave_out(*selves[i], selves[i]->body, selves[i]->body, bodies, of_pair);
  });
}

}  // namespace tact
