#include "engine/patch_stage.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/base/hash.h"
#include "engine/base/parallel.h"
#include "engine/eigen_vectors.h"

namespace tact {

namespace {

constexpr std::size_t kPatchedPairsAtATime = 4;  // some microseconds each where there are patches

// Of a patch that begins in this step. Two patches of a line of history have one id with a chance of 2^-64: there is
// one number for each pair of keys, step and place, and a hash of these. 0 is the id of no patch.
std::uint64_t new_id(BodyId a, BodyId b, const Bodies& bodies, int place) {
  base::WordChain id;
  for (const std::uint64_t word : {bodies.keys().of(a.index), bodies.keys().of(b.index), bodies.steps()}) id.add(word);
  id.add(static_cast<std::uint64_t>(place));
  return std::max<std::uint64_t>(id.value(), 1);
}

// Those of this step become those of the last.
PatchSet& begin(PatchMemory& memory) {
  std::swap(memory.now, memory.last);
  memory.now.clear();
  return memory.now;
}

}  // namespace

void PatchStage::find(std::span<const MovedPair> moved, const Bodies& bodies, const Settings& settings) {
  finders_.resize(settings.threads);
  base::parallel_for(moved.size(), kPatchedPairsAtATime, settings.threads, [&](std::size_t i, int thread) {
    PairRecord& record = *moved[i].record;
    const bool any = in_contact(record) && (!record.facet_pairs.empty() || !record.points.empty());
    if (record.patches == nullptr) {
      if (!any) return;
      record.patches = std::make_unique<PatchMemory>();
    }
    PatchSet& set = begin(*record.patches);
    if (!any) return;
    finders_[thread].find({.a = bodies.in_slot(record.a.index),
                           .b = bodies.in_slot(record.b.index),
                           .direction = from_eigen(record.contact.direction),
                           .reach = bodies.reach(record.a.index, record.b.index),
                           .facet_pairs = record.facet_pairs,
                           .points = record.points,
                           .last = &record.patches->last},
                          set);
  });
}

void PatchStage::find(std::span<SelfRecord* const> selves, const Bodies& bodies, const Settings& settings) {
  finders_.resize(settings.threads);
  base::parallel_for(selves.size(), 1, settings.threads, [&](std::size_t i, int thread) {
    SelfRecord& record = *selves[i];
    PatchSet& set = begin(record.patches);
    if (!in_contact(record)) return;
    const std::uint32_t slot = record.body.index;
    finders_[thread].find({.a = bodies.in_slot(slot),
                           .b = bodies.in_slot(slot),
                           .direction = {0, 0, 1},
                           .reach = bodies.reach(slot, slot),
                           .facet_pairs = record.facet_pairs,
                           .points = record.points,
                           .last = &record.patches.last},
                          set);
  });
}

void PatchStage::count_shared(const PatchMemory& memory) {
  matches_.clear();
  auto now = memory.now.vertices.begin();
  auto last = memory.last.vertices.begin();
  while (now != memory.now.vertices.end() && last != memory.last.vertices.end()) {
    if (now->vertex != last->vertex) {
      ++(now->vertex < last->vertex ? now : last);
      continue;
    }
    for (auto one = last; one != memory.last.vertices.end() && one->vertex == now->vertex; ++one)
      matches_.push_back({1, now->patch, one->patch});
    ++now;
  }
  const auto pair_of = [](const Match& match) { return std::pair(match.now, match.last); };
  std::ranges::sort(matches_, {}, pair_of);
  std::size_t count = 0;
  for (const Match& match : matches_) {
    if (count > 0 && pair_of(matches_[count - 1]) == pair_of(match)) {
      ++matches_[count - 1].shared;
    } else {
      matches_[count++] = match;
    }
  }
  matches_.resize(count);
  std::ranges::sort(matches_, {}, [](const Match& match) { return std::tuple(-match.shared, match.now, match.last); });
}

void PatchStage::name(BodyId a, BodyId b, const Bodies& bodies, PatchMemory& memory, std::vector<PatchEvent>& events) {
  std::vector<Patch>&now = memory.now.patches, &last = memory.last.patches;
  if (now.empty() && last.empty()) return;
  count_shared(memory);
  now_is_.assign(now.size(), {}), last_is_.assign(last.size(), {});
  const auto in = [](auto& list, int i) -> auto& { return list[i]; };
  for (const Match& match : matches_) {
    Partner &of_now = in(now_is_, match.now), &of_last = in(last_is_, match.last);
    if (of_now.most < 0) of_now.most = match.last;
    if (of_last.most < 0) of_last.most = match.now;
    if (of_now.is >= 0 || of_last.is >= 0) continue;
    of_now.is = match.last;
    of_last.is = match.now;
    in(now, match.now).id = in(last, match.last).id;
  }
  for (int i = 0; i < static_cast<int>(last.size()); ++i) {
    const auto [is, into] = in(last_is_, i);
    if (is >= 0) continue;
    if (into < 0) {
      events.push_back({a, b, PatchEvent::Kind::ended, in(last, i).id, 0});
    } else if (in(now_is_, into).is >= 0) {
      events.push_back({a, b, PatchEvent::Kind::merged, in(last, i).id, in(now, into).id});
    }
  }
  for (int i = 0; i < static_cast<int>(now.size()); ++i) {
    const auto [is, from] = in(now_is_, i);
    if (is >= 0) continue;
    in(now, i).id = new_id(a, b, bodies, i);
    events.push_back({a, b, from >= 0 ? PatchEvent::Kind::split : PatchEvent::Kind::began, in(now, i).id,
                      from >= 0 ? in(last, from).id : 0});
  }
}

void PatchStage::name(std::span<const MovedPair> moved, const Bodies& bodies, std::vector<PatchEvent>& events) {
  for (const MovedPair& pair : moved) {
    if (pair.record->patches != nullptr) name(pair.record->a, pair.record->b, bodies, *pair.record->patches, events);
  }
}

void PatchStage::name(std::span<SelfRecord* const> selves, const Bodies& bodies, std::vector<PatchEvent>& events) {
  for (SelfRecord* const one : selves) name(one->body, one->body, bodies, one->patches, events);
}

}  // namespace tact
