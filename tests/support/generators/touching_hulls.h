// Pairs of hulls that touch exactly, or would but for a unit in the last place: in a vertex, in two edges, in an edge
// and a face, in two faces; solid, flat, straight and as thin as needles; of any size.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/vec3.h"

namespace tact::tests {

struct TouchingHulls {
  std::string kind;
  std::vector<base::Vec3> a, b;
  std::vector<base::Vec3> b_before;  // where B was, a step ago
};

TouchingHulls touching_hulls(std::uint64_t seed);

}  // namespace tact::tests
