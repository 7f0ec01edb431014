// A table by vertices that is empty but for a few of them.
#pragma once

#include <cstddef>
#include <vector>

namespace tact::narrowphase {

/// Places in a list of some vertices, by the caller's numbers. Memory is used again.
class VertexPlaces {
 public:
  /// Empties it, for vertices below `count`.
  void clear(int count) {
    for (const int vertex : set_) place_[vertex] = -1;
    set_.clear();
    if (place_.size() < static_cast<std::size_t>(count)) place_.resize(count, -1);
  }
  void set(int vertex, std::size_t place) {
    place_[vertex] = static_cast<int>(place);
    set_.push_back(vertex);
  }
  /// -1: none was set.
  int operator[](int vertex) const { return place_[vertex]; }

 private:
  std::vector<int> place_, set_;
};

}  // namespace tact::narrowphase
