// Collects the vertices and polygons of a mesh file and checks each as it comes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/files/mesh_file.h"
#include "scenes/files/source.h"

namespace tact::scenes {

class MeshBuilder {
 public:
  // Failures and warnings are those of `source`, which must outlive the builder.
  MeshBuilder(Source& source, Split split) : source_(source), split_(split) {}

  // Fails if a coordinate is not finite or larger than kLargestCoordinate in size.
  void add_vertex(const std::array<double, 3>& position);
  // Adds a polygon, whose vertices may come later. Fails if it has fewer than three corners.
  void add_polygon(const std::vector<int>& corners);
  // `index` as a corner of the next polygon; fails unless it is that of one of `vertices` vertices.
  int corner(std::int64_t index, std::int64_t vertices) const;

  int vertex_count() const { return static_cast<int>(positions_.size() / 3); }
  int facet_count() const { return static_cast<int>(facets_.size() / 3); }
  // The mesh, its polygons split. Fails if one of them is not simple.
  MeshFile mesh();

 private:
  // A polygon of more than three corners, which stands in facets_ as a fan from its first one.
  struct Polygon {
    std::size_t facet;
    std::size_t corners;
    std::int64_t place;
  };

  std::array<double, 3> position_of(int vertex) const;
  // The facets in fans, if some of facets_ are none any more.
  std::vector<int> split_polygons();

  Source& source_;
  Split split_;
  std::vector<double> positions_;
  std::vector<int> facets_;
  std::vector<Polygon> polygons_;
};

// "1 vertex", "2 vertices".
std::string vertices_text(std::int64_t count);

}  // namespace tact::scenes
