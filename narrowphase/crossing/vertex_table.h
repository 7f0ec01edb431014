// Values of a few vertices of a mesh.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tact::narrowphase {

/// By the caller's numbers; in the order in which they were added. Buffers are reused.
template <class T>
class VertexTable {
 public:
  /// Empties it, for vertices below `count`.
  void clear(int count) {
    for (const int vertex : vertices_) place_[vertex] = -1;
    vertices_.clear();
    values_.clear();
    if (place_.size() < static_cast<std::size_t>(count)) place_.resize(count, -1);
  }
  /// Of a vertex that has none. Valid until the next one is added.
  const T* add(int vertex, const T& value) {
    place_[vertex] = static_cast<int>(values_.size());
    vertices_.push_back(vertex);
    values_.push_back(value);
    return &values_.back();
  }
  /// Null: none was added.
  const T* find(int vertex) const { return place_[vertex] < 0 ? nullptr : &values_[place_[vertex]]; }
  std::span<const int> vertices() const { return vertices_; }
  std::span<const T> values() const { return values_; }

 private:
  std::vector<int> place_, vertices_;
  std::vector<T> values_;
};

}  // namespace tact::narrowphase
