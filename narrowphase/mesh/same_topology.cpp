#include "narrowphase/mesh/same_topology.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <span>

#include "engine/base/hash.h"

namespace tact::narrowphase {

namespace {

std::array<int, 7> counts_of(const ClusteredMesh& mesh) {
  const MeshCounts& counts = mesh.counts();
  return {counts.source_vertices, counts.vertices,   counts.facets,     counts.borrowed,
          counts.unused,          mesh.edge_count(), mesh.point_count()};
}

// See MeshArrays: it begins with the unused vertices.
std::span<const std::byte> rest_of(const ClusteredMesh& mesh) {
  return {reinterpret_cast<const std::byte*>(mesh.unused_source_vertices().data()), memory_size(mesh.counts()).rest};
}

}  // namespace

bool same_topology(const ClusteredMesh& a, const ClusteredMesh& b) {
  const auto same = [](std::span<const std::byte> x, std::span<const std::byte> y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size()) == 0);
  };
  return counts_of(a) == counts_of(b) && same(std::as_bytes(a.refit_indices()), std::as_bytes(b.refit_indices())) &&
         same(rest_of(a), rest_of(b));
}

std::uint64_t topology_hash(const ClusteredMesh& mesh) {
  base::Hash hash;
  for (const int count : counts_of(mesh)) hash.add(static_cast<std::uint64_t>(count));
  hash.add(std::as_bytes(mesh.refit_indices()));
  hash.add(rest_of(mesh));
  return hash.value();
}

}  // namespace tact::narrowphase
