// Bodies that all ranks make alike: blobs that wander about, and numbers that are drawn by what they are for.
#pragma once

#include <tact/body.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/hash.h"
#include "tests/mpi/sums.h"
#include "tests/support/generators/bodies.h"
#include "tests/support/mesh.h"

namespace tact::tests {

// Numbers that all ranks draw alike: from 0 to count - 1, and from 0 to 1.
inline int drawn(std::uint64_t seed, std::uint64_t a, std::uint64_t b, int count) {
  return static_cast<int>(word_of(seed, a, {b}) % static_cast<std::uint64_t>(count));
}
inline double fraction(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  return static_cast<double>(word_of(seed, a, {b}) >> 11) * 0x1p-53;
}

// Keys in another order than places.
inline Key key_of(int i) { return base::mixed(static_cast<std::uint64_t>(i) + 1) >> 1; }

// A blob that wanders about its place in a block of bodies.
inline Mesh blob_at(int i, int step, int across) {
  const auto n = static_cast<std::uint64_t>(i), t = static_cast<std::uint64_t>(step);
  const Vec3 place{1.55 * (i % across), 1.55 * ((i / across) % across), 1.5 * (i / (across * across)) + 0.9};
  Vec3 by{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint64_t seed = n * 3 + static_cast<std::uint64_t>(axis);
    const double from = fraction(seed, t / 8, 1), to = fraction(seed, t / 8 + 1, 1);
    by[axis] = 0.5 * (from + (to - from) * static_cast<double>(t % 8) / 8.0);
  }
  static const std::vector<Mesh> kShapes = [] {
    std::vector<Mesh> shapes;
    for (std::uint64_t seed = 0; seed < 7; ++seed) shapes.push_back(blob(1, 0.8, 0.3, seed));
    return shapes;
  }();
  return translated(scaled(kShapes[n % 7], 1.0 + 0.1 * fraction(n, t / 4, 2)), place + by);
}

inline int across_of(int bodies) {
  int across = 2;
  while (across * across * across < bodies) ++across;
  return across;
}

// Holds a copy of the mesh.
inline BodyDefinition definition_of(Mesh mesh, Key key, double margin) {
  return {.positions = std::move(mesh.positions), .facets = std::move(mesh.facets), .key = key, .margin = margin};
}

// A blob, or its vertices as a rope or as grains.
inline BodyDefinition some_body(int i, int step, int across) {
  BodyDefinition definition = definition_of(blob_at(i, step, across), key_of(i), 0.05);
  static const std::vector<std::array<int, 2>> kChain = [] {
    std::vector<std::array<int, 2>> edges;
    for (int v = 0; v + 1 < 42; ++v) edges.push_back({v, v + 1});
    return edges;
  }();
  static const std::array<int, 5> kGrains{0, 7, 11, 23, 41};
  if (i % 8 == 3) definition.edges = Edges::strided(kChain.front().data(), kChain.size());
  if (i % 8 == 5) definition.points = kGrains;
  if (i % 8 == 3 || i % 8 == 5) definition.facets = Facets::none();
  definition.self_contact = i % 9 == 0;
  return definition;
}

}  // namespace tact::tests
