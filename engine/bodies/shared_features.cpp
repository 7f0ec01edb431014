// The features of bodies. They depend on facets alone: bodies that are added from one mesh have one set of them.
#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/bodies/bodies.h"
#include "narrowphase/mesh/same_topology.h"

namespace tact {

namespace {

constexpr std::size_t kFewHolders = 64;  // that need not be looked over

}  // namespace

// A body whose features are those of a body without: another one that has them or gets its own now, or that body.
std::uint32_t Bodies::holder_of_features(std::uint32_t slot, std::uint64_t hash) {
  std::uint32_t& holder = feature_holders_.try_emplace(hash, slot).first->second;
  if (holder == slot) return slot;
  const bool has_any =
      used(holder) && (in_slot(holder).features != nullptr || std::ranges::binary_search(without_features_, holder));
  if (!has_any || !same_topology(in_slot(holder).mesh, in_slot(slot).mesh)) holder = slot;
  return holder;
}

void Bodies::make_features(std::span<const std::uint32_t> slots, int threads) {
  without_features_.clear();
  std::ranges::copy_if(slots, std::back_inserter(without_features_),
                       [&](std::uint32_t slot) { return in_slot(slot).features == nullptr; });
  if (without_features_.empty()) return;
  std::ranges::sort(without_features_);
  without_features_.erase(std::unique(without_features_.begin(), without_features_.end()), without_features_.end());
  const std::size_t count = without_features_.size();
  std::vector<std::uint64_t> hashes(count);
  base::parallel_for(count, 1, threads,
                     [&](std::size_t i) { hashes[i] = topology_hash(in_slot(without_features_[i]).mesh); });
  std::vector<std::uint32_t> holders(count);
  for (std::size_t i = 0; i < count; ++i) holders[i] = holder_of_features(without_features_[i], hashes[i]);
  base::parallel_for(count, 1, threads, [&](std::size_t i) {
    if (holders[i] != without_features_[i]) return;
    Body& body = *slots_[holders[i]].body;
    body.features = std::make_shared<const narrowphase::Features>(body.mesh);
  });
  for (std::size_t i = 0; i < count; ++i) slots_[without_features_[i]].body->features = in_slot(holders[i]).features;
  if (feature_holders_.size() <= 2 * count_ + kFewHolders) return;
  // Of each slot what it holds now stays.
  std::erase_if(feature_holders_, [&](const auto& one) {
    return !used(one.second) || in_slot(one.second).features == nullptr ||
           topology_hash(in_slot(one.second).mesh) != one.first;
  });
}

}  // namespace tact
