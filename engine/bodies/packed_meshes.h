// Memory for the small meshes of a world, each kind of their data in one piece: a refresh of many reads and writes it
// from one end to the other, as the hardware foresees, where memory that each took for itself is scattered.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "engine/base/tuning.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact {

class PackedMeshes {
 public:
  // A world's meshes come and go: those that come have memory of their own, those that go leave holes.
  void add(const narrowphase::ClusteredMesh& mesh);
  void remove(const narrowphase::ClusteredMesh& mesh);
  // Whether so many small ones are out of place, or so much of the memory is holes, that packing all again pays. Of n
  // bodies that come one by one each is moved a few times at most.
  bool is_due(const base::Tuning& tuning) const;
  // Moves the small ones of all meshes of the world next to each other, in their order; until that is done they take
  // twice the memory. If it fails, nothing has changed.
  void pack(std::span<narrowphase::ClusteredMesh* const> meshes, int threads);
  // Is not due until meshes have come or gone: there is no memory for it.
  void put_off() { put_off_ = true; }

 private:
  std::size_t scattered_ = 0, packed_ = 0, holes_ = 0;  // small meshes
  bool put_off_ = false;
  std::unique_ptr<std::byte[]> memory_;
};

}  // namespace tact
