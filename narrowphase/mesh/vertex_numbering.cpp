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
      : facets_(facets), order_(order), sources_(static_cast<std::size_t>(source_vertex_count)) {
    made_.source_vertices.reserve(sources_.size());
    for (auto& corner : made_.corner) corner.resize(order.size());
  }

  VertexNumbering run() {
    int cluster = 0;
    for (std::size_t begin = 0; begin < order_.size(); begin += kClusterSize, ++cluster) {
      const auto facets = order_.subspan(begin, std::min<std::size_t>(kClusterSize, order_.size() - begin));
      add(cluster, facets);
      write_corners(begin, facets);
    }
    made_.ranges.insert(made_.ranges.end(), {vertices(), borrowed()});
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      if (sources_[s].number == kNoNumber) made_.unused_sources.push_back(static_cast<int>(s));
    }
    return std::move(made_);
  }

 private:
  int vertices() const { return static_cast<int>(made_.source_vertices.size()); }
  int borrowed() const { return static_cast<int>(made_.borrowed.size()); }
  const int* corners_of(int facet) const { return &facets_[3 * static_cast<std::size_t>(facet)]; }

  void add(int cluster, std::span<const int> cluster_facets) {
    made_.ranges.insert(made_.ranges.end(), {vertices(), borrowed()});
    find_sources(cluster, cluster_facets);
    std::uint8_t place = 0;
    for (const int source : owned_here_) {
      sources_[source].number = vertices();
      sources_[source].place = place++;
      made_.source_vertices.push_back(source);
    }
    for (const int source : borrowed_here_) {
      sources_[source].place = place++;
      made_.borrowed.push_back(sources_[source].number);
      made_.borrowed_sources.push_back(source);
    }
  }

  void write_corners(std::size_t first, std::span<const int> cluster_facets) {
    std::uint8_t* const to[] = {&made_.corner[0][first], &made_.corner[1][first], &made_.corner[2][first]};
    for (std::size_t i = 0; i < cluster_facets.size(); ++i) {
      const int* const corners = corners_of(cluster_facets[i]);
      for (std::size_t k = 0; k < 3; ++k) to[k][i] = sources_[corners[k]].place;
    }
  }

  // In the caller's order: neighbours in memory are read one after the other.
  void find_sources(int cluster, std::span<const int> cluster_facets) {
    owned_here_.clear();
    borrowed_here_.clear();
    for (const int facet : cluster_facets) {
      for (const int source : std::span(corners_of(facet), 3)) {
        Source& vertex = sources_[source];
        if (vertex.last_user == cluster) continue;
        vertex.last_user = cluster;
        (vertex.number == kNoNumber ? owned_here_ : borrowed_here_).push_back(source);
      }
    }
    std::ranges::sort(owned_here_);
    std::ranges::sort(borrowed_here_);
  }

  struct Source {
    int number = kNoNumber, last_user = kNoNumber;
    std::uint8_t place = 0;  // in its last user, whose borrowed vertices come last
  };
  std::span<const int> facets_, order_;
  VertexNumbering made_;
  std::vector<Source> sources_;
  std::vector<int> owned_here_, borrowed_here_;  // source vertices
};

}  // namespace

VertexNumbering number_vertices(std::span<const int> facets, std::span<const int> order, int source_vertex_count) {
  return Numberer(facets, order, source_vertex_count).run();
}

}  // namespace tact::narrowphase
