// What the vertices of a body are called for good, once its facets have changed: ids of points are made of it. A body
// whose facets never changed has no such names; its vertices are called by their numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tact {

class LastingNames {
  friend struct StateFields;

 public:
  /// The vertices of a vertex, an edge or a facet.
  using Feature = std::array<std::uint64_t, 3>;

  LastingNames() = default;
  /// Names of a body that had `last`, or none. `was` tells of each vertex which one it was, or -1; `keeps` of each that
  /// was which one has its name now, or -1. All others get a name that no vertex of the body ever had.
  LastingNames(const LastingNames* last, std::span<const int> was, std::span<const int> keeps);

  /// The names of a feature, -1 as kNoVertex: those of an edge ascend, those of a facet stand in the order in which
  /// they stood when the facet was first seen. `names` may be null.
  static Feature of(const LastingNames* names, const std::array<int, 3>& vertices) {
    if (names != nullptr) return names->of(vertices);
    return {number_of(vertices[0]), number_of(vertices[1]), number_of(vertices[2])};
  }
  /// The corners of facets that are still there stand in another order than `order` says. To be called once.
  void keep_orders(std::vector<Feature> orders);

  std::size_t vertex_count() const { return of_vertex_.size(); }

 private:
  static constexpr std::uint64_t kNoVertex = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint64_t kFirstNew = kNoVertex + 1;  // the first names are numbers, of 32 bits
  static constexpr std::uint64_t number_of(int vertex) { return static_cast<std::uint32_t>(vertex); }
  static std::uint64_t name_in(const LastingNames* names, int vertex) {
    return names == nullptr ? number_of(vertex) : names->of_vertex_[static_cast<std::size_t>(vertex)];
  }
  Feature of(const std::array<int, 3>& vertices) const;

  std::vector<std::uint64_t> of_vertex_;
  std::uint64_t next_ = kFirstNew;
  std::vector<Feature> orders_;  // of facets whose corners stand in another one; ascending by their sorted names
};

}  // namespace tact
