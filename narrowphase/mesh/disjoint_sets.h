// Sets of numbers that are joined, and never parted again: of each number one of the same set that is not greater, the
// number itself where it is the least (union-find; Galler and Fischer, 1964).
#pragma once

#include <algorithm>
#include <vector>

namespace tact::narrowphase {

/// The least number of the set that has `one`.
inline int least_of_set(const std::vector<int>& parent, int one) {
  while (parent[one] != one) one = parent[one];
  return one;
}

/// Joins the sets of two numbers. The ways to the least numbers are halved.
inline void join_sets(std::vector<int>& parent, int one, int other) {
  const auto least = [&](int v) {
    for (; parent[v] != v; v = parent[v]) parent[v] = parent[parent[v]];
    return v;
  };
  if (parent[one] == parent[other]) return;
  const auto [first, second] = std::minmax({least(one), least(other)});
  parent[second] = first;
}

}  // namespace tact::narrowphase
