#include "engine/bodies/packed_meshes.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"

namespace tact {

namespace {

using narrowphase::ClusteredMesh;

// A large mesh is read from one end to the other as it is; a few fit into the cache.
constexpr int kMostFacets = 1024, kMostVertices = 4096;  // the caller's
constexpr std::size_t kMovedAtATime = 64;                // meshes, at some hundred nanoseconds each
constexpr std::size_t kLine = 64;                        // bytes: no two meshes share a line of the cache

bool is_small(const ClusteredMesh& mesh) {
  return mesh.facet_count() <= kMostFacets && mesh.source_vertex_count() <= kMostVertices;
}

std::size_t whole_lines(std::size_t bytes) { return (bytes + kLine - 1) / kLine * kLine; }

// Bytes, of one mesh or of all before it.
struct Sizes {
  std::size_t placement = 0, indices = 0, rest = 0;
};

Sizes sizes_of(const ClusteredMesh& mesh) {
  const narrowphase::MeshMemorySize size = narrowphase::memory_size(mesh.counts());
  return {whole_lines(size.placement * sizeof(double)), whole_lines(size.indices * sizeof(int)),
          whole_lines(size.rest)};
}

}  // namespace

void PackedMeshes::add(const ClusteredMesh& mesh) {
  if (!is_small(mesh)) return;
  ++scattered_;
  put_off_ = false;
}

void PackedMeshes::remove(const ClusteredMesh& mesh) {
  if (!is_small(mesh)) return;
  put_off_ = false;
  if (mesh.has_own_memory()) {
    --scattered_;
    return;
  }
  --packed_;
  ++holes_;
  if (packed_ > 0) return;
  memory_.reset();
  holes_ = 0;
}

bool PackedMeshes::is_due(const base::Tuning& tuning) const {
  return !put_off_ && std::max(scattered_ + packed_, holes_) >= tuning.fewest_packed &&
         2 * (scattered_ + holes_) > packed_;
}

void PackedMeshes::pack(std::span<ClusteredMesh* const> meshes, int threads) {
  std::vector<std::pair<ClusteredMesh*, Sizes>> small;  // and where they begin
  Sizes all;
  for (ClusteredMesh* const mesh : meshes) {
    if (!is_small(*mesh)) continue;
    small.emplace_back(mesh, all);
    const Sizes sizes = sizes_of(*mesh);
    all = {all.placement + sizes.placement, all.indices + sizes.indices, all.rest + sizes.rest};
  }
  constexpr std::size_t kPadding = narrowphase::kPadding * sizeof(double);
  const std::size_t size = kLine + 2 * all.placement + kPadding + all.indices + all.rest + kPadding;
  auto memory = std::make_unique<std::byte[]>(size);
  void* line = memory.get();
  std::size_t space = size;
  std::byte* const begin = static_cast<std::byte*>(std::align(kLine, size - kLine, line, space));
  base::parallel_for(small.size(), kMovedAtATime, threads, [&](std::size_t i) {
    const auto& [mesh, at] = small[i];
    std::byte* const placement = begin + at.placement;
    std::byte* const indices = begin + 2 * all.placement + kPadding + at.indices;
    std::byte* const rest = begin + 2 * all.placement + kPadding + all.indices + at.rest;
    mesh->move_to({{reinterpret_cast<double*>(placement), reinterpret_cast<double*>(placement + all.placement)},
                   reinterpret_cast<int*>(indices),
                   rest});
  });
  memory_ = std::move(memory);
  packed_ = small.size();
  scattered_ = holes_ = 0;
}

}  // namespace tact
