#include <tact/weld.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "engine/base/floating_point_mode.h"
#include "engine/base/hash.h"
#include "engine/bodies/checks.h"
#include "engine/bodies/columns.h"
#include "engine/first_at_position.h"
#include "engine/with_memory.h"

namespace tact {
namespace {

// Equal for equal positions, in any rounding mode.
std::uint64_t hash_of(const double* position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = position[axis] == 0.0 ? 0.0 : position[axis];
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * base::kGoldenStep;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace

std::vector<int> first_at_position(std::span<const double> positions) {
  const std::size_t count = positions.size() / 3;
  std::vector<int> first(count), slots(std::bit_ceil(2 * count + 1), -1);
  const std::size_t mask = slots.size() - 1;
  for (std::size_t v = 0; v < count; ++v) {
    const double* const position = positions.data() + 3 * v;
    std::size_t slot = hash_of(position) & mask;
    while (slots[slot] >= 0 &&
           !std::equal(position, position + 3, &positions[3 * static_cast<std::size_t>(slots[slot])]))
      slot = (slot + 1) & mask;
    if (slots[slot] < 0) slots[slot] = static_cast<int>(v);
    first[v] = slots[slot];
  }
  return first;
}

namespace {

bool has_repeated(const int* facet) { return facet[0] == facet[1] || facet[1] == facet[2] || facet[2] == facet[0]; }

WeldedArrays welded(std::span<const double> coordinates, std::span<const int> corners) {
  WeldedArrays mesh;
  mesh.vertex_of = first_at_position(coordinates);
  const std::size_t vertices = mesh.vertex_of.size();
  mesh.positions.reserve(coordinates.size());
  int kept = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto first = static_cast<std::size_t>(mesh.vertex_of[v]);
    const auto position = coordinates.subspan(3 * v, 3);
    if (first == v) mesh.positions.insert(mesh.positions.end(), position.begin(), position.end());
    mesh.vertex_of[v] = first == v ? kept++ : mesh.vertex_of[first];
  }
  mesh.merged_vertices = static_cast<int>(vertices) - kept;
  mesh.facets.reserve(corners.size());
  for (const int corner : corners) mesh.facets.push_back(mesh.vertex_of[static_cast<std::size_t>(corner)]);
  for (std::size_t i = 0; i < corners.size(); i += 3)
    mesh.collapsed_facets += has_repeated(mesh.facets.data() + i) && !has_repeated(corners.data() + i);
  return mesh;
}

}  // namespace

WeldedArrays weld_arrays(const Positions& positions, const Facets& facets) {
  const std::string name = "mesh to weld";
  const base::FloatingPointMode mode;  // in which a subnormal number is not 0
  return with_memory("welding ran out of memory", [&] {
    check_array(positions, name);
    check_array(facets, name);
    check_counts(positions.cols(), facets.cols(), 0, name);
    std::vector<double> position_copy;
    std::vector<int> facet_copy;
    make_copy_room(positions, position_copy);
    make_copy_room(facets, facet_copy);
    const std::span<const double> coordinates = packed(positions, std::span(position_copy));
    const std::span<const int> corners = packed(facets, std::span(facet_copy));
    check_positions(coordinates.data(), coordinates.size() / 3, name);
    check_corners(corners, facets, positions.cols(), name);
    return welded(coordinates, corners);
  });
}

}  // namespace tact
