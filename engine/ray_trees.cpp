#include "engine/ray_trees.h"

#include <cstdint>

#include "engine/base/parallel.h"

namespace tact {

void RayTrees::begin(const Bodies& bodies, std::size_t rays, int threads) {
  std::vector<int> clusters(bodies.boxes().size());
  for (std::uint32_t slot = 0; slot < clusters.size(); ++slot)
    clusters[slot] = bodies.boxes()[slot].empty() ? 0 : bodies.in_slot(slot).mesh.cluster_count();
  const auto begin_one = [&](Trees& trees) {
    trees.made = false;
    trees.batch.begin(clusters, rays);
  };
  if (trees_.empty()) trees_.resize(1);
  begin_one(trees_.front());
  const auto copies = static_cast<std::size_t>(threads);
  const std::size_t nodes = trees_.front().batch.node_count();
  own_ = nodes > 0 && nodes <= kMostOwnNodes && rays >= kRaysOfOwnNode * copies * nodes;
  if (!own_) return make(bodies, threads, trees_.front());
  if (trees_.size() < copies) trees_.resize(copies);
  for (std::size_t k = 1; k < copies; ++k) begin_one(trees_[k]);
}

const narrowphase::SegmentBatch& RayTrees::of_thread(const Bodies& bodies, int thread) {
  Trees& trees = trees_[own_ ? static_cast<std::size_t>(thread) : 0];
  if (!trees.made) make(bodies, 1, trees);
  return trees.batch;
}

void RayTrees::make(const Bodies& bodies, int threads, Trees& trees) {
  // A tree takes some microseconds. A node takes one, or ten where other threads have read what was there before.
  constexpr std::size_t kTreesAtATime = 16, kNodesAtATime = 4;
  narrowphase::SegmentBatch& batch = trees.batch;
  base::parallel_for(batch.meshes().size(), kTreesAtATime, threads, [&](std::size_t k) {
    const std::size_t slot = batch.meshes()[k];
    batch.make_tree(bodies.placed(static_cast<std::uint32_t>(slot)).mesh, slot);
  });
  base::parallel_for(batch.node_count(), kNodesAtATime, threads, [&](std::size_t i) { batch.make_node(i); });
  trees.made = true;
}

}  // namespace tact
