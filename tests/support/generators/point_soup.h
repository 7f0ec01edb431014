// Points without facets.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "narrowphase/kernels/kernels.h"
#include "narrowphase/mesh/box_arrays.h"

namespace tact::tests {

// Points as a mesh stores them: coordinates in separate arrays, with room to read past the end.
struct PointSoup {
  std::array<std::vector<double>, 3> coordinate;
  int count = 0;

  void add(double x, double y, double z) {
    coordinate[0].push_back(x);
    coordinate[1].push_back(y);
    coordinate[2].push_back(z);
    ++count;
  }
  narrowphase::PointArrays arrays() {
    for (auto& values : coordinate) {
      values.resize(count);
      values.resize(static_cast<std::size_t>(count) + narrowphase::kPadding, 1e30);  // must not be counted
    }
    return {coordinate[0].data(), coordinate[1].data(), coordinate[2].data()};
  }
};

// The six sums and differences of two coordinates, of doubles as they round and of integers as they are.
template <class Number>
std::array<Number, 6> along_diagonals(Number x, Number y, Number z) {
  return {y + z, z + x, x + y, y - z, z - x, x - y};
}

}  // namespace tact::tests
