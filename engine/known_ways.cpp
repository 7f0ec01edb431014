#include "engine/known_ways.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"

namespace tact {

namespace {

constexpr std::size_t kBodiesAtATime = 8;

constexpr std::size_t kBounds = 6;  // of a box: the lower ones of all clusters come first

// Coordinates of vertices along an axis: where they begin and are now.
struct Run {
  int axis, first;  // the first of those that a cluster owns; -1: they are borrowed
  const double *begin, *now;
  std::size_t count;
};

// Calls visit(run) for the vertices of opened clusters.
template <class Visit>
void for_each_run(const narrowphase::MovingMesh& way, const std::vector<char>& is_opened, const Visit& visit) {
  const narrowphase::PointArrays &begin = way.begin.points, &now = way.end.points;
  const double *const from[3] = {begin.x, begin.y, begin.z}, *const at[3] = {now.x, now.y, now.z};
  double borrowed[2][3 * narrowphase::kClusterSize];
  for (std::size_t c = 0; c < is_opened.size(); ++c) {
    if (is_opened[c] == 0) continue;
    const narrowphase::ClusterFacets facets = way.mesh->facets_of(static_cast<int>(c));
    const auto borrowed_count = static_cast<std::size_t>(facets.borrowed_count);
    for (int axis = 0; axis < 3; ++axis) {
      const int first = facets.owned_begin;
      visit(Run{axis, first, from[axis] + first, at[axis] + first, static_cast<std::size_t>(facets.owned_count)});
      for (std::size_t i = 0; i < borrowed_count; ++i) {
        borrowed[0][i] = from[axis][facets.borrowed[i]];
        borrowed[1][i] = at[axis][facets.borrowed[i]];
      }
      visit(Run{axis, -1, borrowed[0], borrowed[1], borrowed_count});
    }
  }
}

// How many of some coordinates are not a part of the way from `begin` to `end`, but for an error. As a number, so that
// the loop takes several at a time.
std::int64_t count_of_others(const Run& run, const double* end, double part, double error) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < run.count; ++i) {
    const double beyond = run.now[i] - (run.begin[i] + part * (end[i] - run.begin[i]));
    count += static_cast<std::int64_t>(!(std::abs(beyond) <= error));
  }
  return count;
}

std::pair<std::uint32_t, std::uint32_t> slots_of(const auto& pair) { return {pair.a, pair.b}; }

}  // namespace

void KnownWays::begin(const Bodies& bodies, const std::optional<double>& distance, double largest) {
  for (const std::uint32_t slot : slots_) ends_[slot].is_used = false;
  slots_.clear();
  pairs_.clear();
  candidates_.clear();
  farthest_.reset();
  distance_ = distance;
  largest_ = largest;
  if (ends_.size() < bodies.boxes().size()) ends_.resize(bodies.boxes().size());
}

KnownWays::End& KnownWays::end_of(const Bodies& bodies, std::uint32_t slot) {
  End& end = ends_[slot];
  if (std::exchange(end.is_used, true)) return end;
  slots_.push_back(slot);
  end.moves = bodies.on_its_way(slot);
  end.is_opened.assign(end.moves ? static_cast<std::size_t>(bodies.in_slot(slot).mesh.cluster_count()) : 0, 0);
  return end;
}

void KnownWays::add_pair(const Bodies& bodies, std::uint32_t a, std::uint32_t b, double until,
                         const std::span<const narrowphase::ClusterPair>* opened) {
  pairs_.push_back({a, b, until, pairs_.empty() ? 0 : pairs_.back().end, candidates_.size()});
  std::vector<char>* const is_opened[2] = {&end_of(bodies, a).is_opened, &end_of(bodies, b).is_opened};
  for (std::size_t side = 0; side < 2; ++side) {
    if (is_opened[side]->empty()) continue;
    if (opened == nullptr) {
      std::ranges::fill(*is_opened[side], 1);
      continue;
    }
    for (const narrowphase::ClusterPair& pair : *opened) (*is_opened[side])[side == 0 ? pair.a : pair.b] = 1;
  }
}

void KnownWays::finish(const Bodies& bodies, int threads) {
  std::ranges::sort(pairs_, {}, slots_of<Pair>);
  base::parallel_for(slots_.size(), kBodiesAtATime, threads, [&](std::size_t i) { keep_end(bodies, slots_[i]); });
}

void KnownWays::keep_end(const Bodies& bodies, std::uint32_t slot) {
  End& end = ends_[slot];
  end.boxes.clear();
  end.opened.clear();
  if (!end.moves || bodies.is_rigid(slot)) return;
  const narrowphase::MovingMesh way = bodies.moving(slot);
  const double* const boxes = way.end.cluster_boxes.lower(0);
  end.boxes.assign(boxes, boxes + kBounds * end.is_opened.size());
  for_each_run(way, end.is_opened,
               [&](const Run& run) { end.opened.insert(end.opened.end(), run.now, run.now + run.count); });
}

void KnownWays::look(const Bodies& bodies, const std::optional<double>& distance, int threads) {
  if (distance != distance_) forget();
  if (pairs_.empty()) return;
  if (!farthest_) farthest_ = find_farthest(bodies);
  part_ = 1.0;
  if (const auto [slot, axis, vertex, begin, way] = *farthest_; way != 0.0)
    part_ = (bodies.moving(slot).vertex(vertex).at[1][axis] - begin) / way;
  base::parallel_for(slots_.size(), kBodiesAtATime, threads,
                     [&](std::size_t i) { ends_[slots_[i]].goes_a_part = goes_a_part(bodies, slots_[i]); });
}

std::optional<KnownWays::Candidates> KnownWays::find(std::uint32_t a, std::uint32_t b) const {
  const auto found = std::ranges::lower_bound(pairs_, std::pair(a, b), {}, slots_of<Pair>);
  if (found == pairs_.end() || found->a != a || found->b != b) return {};
  if (!(part_ >= 0.0 && part_ <= 1.0 && (part_ < found->until || found->until == 1.0))) return {};
  if (!ends_[a].goes_a_part || !ends_[b].goes_a_part) return {};
  return Candidates(candidates_).subspan(found->begin, found->end - found->begin);
}

KnownWays::Farthest KnownWays::find_farthest(const Bodies& bodies) const {
  Farthest farthest;
  for (const std::uint32_t slot : slots_) {
    const End& end = ends_[slot];
    if (end.opened.empty()) continue;
    const double* next = end.opened.data();
    for_each_run(bodies.moving(slot), end.is_opened, [&](const Run& run) {
      for (std::size_t i = 0; i < run.count && run.first >= 0; ++i) {
        const double way = next[i] - run.begin[i];
        if (std::abs(way) > std::abs(farthest.way))
          farthest = {slot, run.axis, run.first + static_cast<int>(i), run.begin[i], way};
      }
      next += run.count;
    });
  }
  return farthest;
}

// However the caller rounds its positions, as a sum of the beginning and a product, or of two products. The part is
// wrong by less than a rounding of the largest coordinate divided by the longest way.
bool KnownWays::goes_a_part(const Bodies& bodies, std::uint32_t slot) const {
  const End& end = ends_[slot];
  if (bodies.on_its_way(slot) != end.moves) return false;
  if (!end.moves) return true;
  if (end.boxes.empty()) return false;
  const double wrong = narrowphase::ImpactFinder::kWrong * largest_;
  const narrowphase::MovingMesh way = bodies.moving(slot);
  const double *const begin = way.begin.cluster_boxes.lower(0), *const now = way.end.cluster_boxes.lower(0);
  const std::size_t lower = kBounds / 2 * end.is_opened.size();
  std::int64_t others = 0;
  for (std::size_t i = 0; i < end.boxes.size(); ++i) {
    const double outside = begin[i] + part_ * (end.boxes[i] - begin[i]) - now[i];
    others += static_cast<std::int64_t>(!((i < lower ? outside : -outside) <= wrong));
  }
  const double* next = end.opened.data();
  for_each_run(way, end.is_opened, [&](const Run& run) {
    others += count_of_others(run, next, part_, wrong);
    next += run.count;
  });
  return others == 0;
}

}  // namespace tact
