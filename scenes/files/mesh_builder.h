// Collects the vertices and polygons of a mesh file and checks each as it comes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/files/mesh_file.h"
#include "scenes/files/source.h"

namespace tact::scenes {

class MeshBuilder {
 public:
  // Failures are those of `source`, which must outlive the builder.
  explicit MeshBuilder(const Source& source) : source_(source) {}

  // Fails if a coordinate is not finite or larger than kLargestCoordinate in size.
  void add_vertex(const std::array<double, 3>& position);
  // Adds a polygon as a fan of facets from its first corner. Fails if it has fewer than three corners.
  void add_polygon(const std::vector<int>& corners);
  // `index` as a corner of the next polygon; fails unless it is that of one of `vertices` vertices.
  int corner(std::int64_t index, std::int64_t vertices) const;

  int vertex_count() const { return static_cast<int>(positions_.size() / 3); }
  int facet_count() const { return static_cast<int>(facets_.size() / 3); }
  MeshFile mesh() const;

 private:
  const Source& source_;
  std::vector<double> positions_;
  std::vector<int> facets_;
};

// "1 vertex", "2 vertices".
std::string vertices_text(std::int64_t count);

}  // namespace tact::scenes
