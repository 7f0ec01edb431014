#include "narrowphase/mesh/vertex_numbering.h"

#include <algorithm>
#include <cstddef>

#include "narrowphase/mesh/facet_order.h"

namespace tact::narrowphase {

namespace {

constexpr int kNoNumber = -1;

class Numberer {
 public:
  Numberer(std::span<const int> facets, std::span<const int> order, int source_vertex_count)
      : facets_(facets),
        order_(order),
        number_(static_cast<std::size_t>(source_vertex_count), kNoNumber),
        last_user_(number_.size(), kNoNumber),
        place_(number_.size(), 0) {
    for (auto& corner : made_.corner) corner.reserve(order.size());
  }

  VertexNumbering run() {
    int cluster = 0;
    for (std::size_t begin = 0; begin < order_.size(); begin += kClusterSize, ++cluster)
      add(cluster, order_.subspan(begin, std::min<std::size_t>(kClusterSize, order_.size() - begin)));
    made_.ranges.insert(made_.ranges.end(), {vertices(), borrowed()});
    for (std::size_t s = 0; s < number_.size(); ++s) {
      if (number_[s] == kNoNumber) made_.unused_sources.push_back(static_cast<int>(s));
    }
    return std::move(made_);
  }

 private:
  int vertices() const { return static_cast<int>(made_.source_vertices.size()); }
  int borrowed() const { return static_cast<int>(made_.borrowed.size()); }
  std::size_t source_of(int facet, std::size_t k) const {
    return static_cast<std::size_t>(facets_[3 * static_cast<std::size_t>(facet) + k]);
  }

  void add(int cluster, std::span<const int> cluster_facets) {
    const int first = vertices(), first_borrowed = borrowed();
    made_.ranges.insert(made_.ranges.end(), {first, first_borrowed});
    find_sources(cluster, cluster_facets);
    for (const int source : owned_here_) {
      number_[source] = vertices();
      made_.source_vertices.push_back(source);
    }
    for (const int source : borrowed_here_) {
      place_[source] = borrowed() - first_borrowed;
      made_.borrowed.push_back(number_[source]);
      made_.borrowed_sources.push_back(source);
    }
    const int owned = vertices() - first;
    for (const int facet : cluster_facets) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t s = source_of(facet, k);
        const int local = number_[s] < first ? owned + place_[s] : number_[s] - first;
        made_.corner[k].push_back(static_cast<std::uint8_t>(local));
      }
    }
  }

  // In the caller's order: neighbours in memory are read one after the other.
  void find_sources(int cluster, std::span<const int> cluster_facets) {
    owned_here_.clear();
    borrowed_here_.clear();
    for (const int facet : cluster_facets) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t s = source_of(facet, k);
        if (last_user_[s] == cluster) continue;
        last_user_[s] = cluster;
        (number_[s] == kNoNumber ? owned_here_ : borrowed_here_).push_back(static_cast<int>(s));
      }
    }
    std::ranges::sort(owned_here_);
    std::ranges::sort(borrowed_here_);
  }

  std::span<const int> facets_, order_;
  VertexNumbering made_;
  std::vector<int> number_, last_user_,
      place_;  // of source vertices; the place is among those that the last user borrows
  std::vector<int> owned_here_, borrowed_here_;  // source vertices
};

}  // namespace

VertexNumbering number_vertices(std::span<const int> facets, std::span<const int> order, int source_vertex_count) {
  return Numberer(facets, order, source_vertex_count).run();
}

}  // namespace tact::narrowphase
