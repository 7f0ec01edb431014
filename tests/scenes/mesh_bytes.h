// What the tests of the mesh readers share: readable meshes, messages of refusals, bytes of numbers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/files/mesh_file.h"

namespace tact::tests {

using Corners = std::array<int, 3>;
using Point = std::array<double, 3>;

inline std::vector<Corners> facets_of(const scenes::MeshFile& mesh) {
  std::vector<Corners> facets;
  for (const auto& f : mesh.facets.colwise()) facets.push_back({f[0], f[1], f[2]});
  return facets;
}

inline std::vector<Point> positions_of(const scenes::MeshFile& mesh) {
  std::vector<Point> positions;
  for (const auto& p : mesh.positions.colwise()) positions.push_back({p[0], p[1], p[2]});
  return positions;
}

// What the reader of `format` says against `bytes` in a file "m"; "accepted" if it says nothing.
inline std::string refusal(scenes::MeshFormat format, std::string_view bytes) {
  try {
    scenes::parse_mesh(format, bytes, "m");
  } catch (const scenes::FileError& error) {
    return error.what();
  }
  return "accepted";
}

// The bytes of `value` in the given order.
template <class Number>
std::string bytes_of(Number value, std::endian order = std::endian::little) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return {raw.begin(), raw.end()};
}

}  // namespace tact::tests
