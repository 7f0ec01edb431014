#include "engine/bodies/encloses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/hash.h"

namespace tact {

namespace {

// Of the places of vertices; of 0 and -0 the same.
std::vector<std::uint64_t> hashes_of(std::span<const double> positions) {
  std::vector<std::uint64_t> hashes;
  hashes.reserve(positions.size() / 3);
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    base::Hash hash;
    for (std::size_t axis = 0; axis < 3; ++axis) hash.add(positions[i + axis] + 0.0);
    hashes.push_back(hash.value());
  }
  return hashes;
}

std::uint64_t signed_by(bool forward, std::uint64_t word) { return forward ? word : 0 - word; }

// Of the edge from p to q; that of the edge back is its negative.
std::uint64_t hash_of_edge(std::uint64_t p, std::uint64_t q) {
  const auto [low, high] = std::minmax(p, q);
  return signed_by(p < q, base::mixed(base::mixed(low) + base::kGoldenStep + high));
}

// Of a facet; that of the one turned the other way is its negative.
std::uint64_t hash_of_facet(std::array<std::uint64_t, 3> corners) {
  bool forward = true;
  for (const std::size_t k : std::array<std::size_t, 3>{0, 1, 0}) {
    if (corners[k] <= corners[k + 1]) continue;
    std::swap(corners[k], corners[k + 1]);
    forward = !forward;
  }
  base::Hash hash;
  for (const std::uint64_t corner : corners) hash.add(corner);
  return signed_by(forward, base::mixed(hash.value()));
}

// Six times the volume of the tetrahedra between the first vertex and the facets: with signs, and without.
struct VolumeSum {
  double sum = 0.0, sizes = 0.0;
};

// In the caller's order, so that no grouping decides.
VolumeSum volume_of(const narrowphase::ClusteredMesh& mesh) {
  VolumeSum volume;
  if (mesh.facet_count() == 0) return volume;
  const base::Vec3 from = mesh.triangle(mesh.facet_of_source(0))[0];
  for (int source = 0; source < mesh.facet_count(); ++source) {
    const narrowphase::Triangle t = mesh.triangle(mesh.facet_of_source(source));
    const double part = dot(t[0] - from, cross(t[1] - from, t[2] - from));
    volume.sum += part;
    volume.sizes += std::abs(part);
  }
  return volume;
}

}  // namespace

bool encloses(std::span<const double> positions, std::span<const int> facets) {
  const std::vector<std::uint64_t> places = hashes_of(positions);
  std::uint64_t edges = 0, sides = 0;
  bool any = false;
  for (std::size_t i = 0; i + 2 < facets.size(); i += 3) {
    const std::array corners{places[facets[i]], places[facets[i + 1]], places[facets[i + 2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    any = true;
    for (std::size_t k = 0; k < 3; ++k) edges += hash_of_edge(corners[k], corners[(k + 1) % 3]);
    sides += hash_of_facet(corners);
  }
  return !any || (edges == 0 && sides != 0);
}

bool is_outward(const narrowphase::ClusteredMesh& mesh) { return volume_of(mesh).sum > 0.0; }

bool is_inside_out(const narrowphase::ClusteredMesh& mesh) {
  const VolumeSum volume = volume_of(mesh);
  return volume.sum < -0x1p-40 * volume.sizes;
}

}  // namespace tact
