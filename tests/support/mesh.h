// A mesh as tests hold it, and what is done to whole meshes. All operations are single additions and multiplications a
// coordinate, so that the same call gives the same bits everywhere.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "engine/base/vec3.h"

namespace tact::tests {

using base::Vec3;

struct Mesh {
  Eigen::Matrix3Xd positions{3, 0};  // 3 x V, metres
  Eigen::Matrix3Xi facets{3, 0};     // 3 x F, counter-clockwise seen from outside

  int vertex_count() const { return static_cast<int>(positions.cols()); }
  int facet_count() const { return static_cast<int>(facets.cols()); }
  Vec3 position(int vertex) const { return {positions(0, vertex), positions(1, vertex), positions(2, vertex)}; }
  void set_position(int vertex, Vec3 p) { positions.col(vertex) << p.x, p.y, p.z; }
};

// Collects vertices and facets one by one.
class MeshBuilder {
 public:
  // The index of the new vertex.
  int vertex(Vec3 p);
  void facet(int i, int j, int k);
  // A planar or nearly planar quadrilateral as the facets (i, j, k) and (i, k, l).
  void quad(int i, int j, int k, int l);
  // A facet with three vertices of its own.
  void triangle(Vec3 p, Vec3 q, Vec3 r);
  int vertex_count() const { return static_cast<int>(vertices_.size()); }
  Mesh mesh() const;

 private:
  std::vector<Vec3> vertices_;
  std::vector<int> corners_;
};

// A rotation matrix, row by row.
struct Rotation {
  Vec3 row[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
};

// The rotation of a quaternion that need not be of unit length; not all four numbers may be 0.
Rotation rotation(double w, double x, double y, double z);

// function(p) for each position p.
template <class Function>
Mesh mapped(Mesh mesh, const Function& function) {
  for (int v = 0; v < mesh.vertex_count(); ++v) mesh.set_position(v, function(mesh.position(v)));
  return mesh;
}

Mesh translated(Mesh mesh, Vec3 by);
// Away from `center` by `factor`; about the origin, a power of two is exact.
Mesh scaled(Mesh mesh, double factor, Vec3 center = {});
Mesh stretched(Mesh mesh, Vec3 factors);
Mesh rotated(Mesh mesh, const Rotation& rotation);
// Every coordinate rounded to a multiple of `step`, a power of two: a shift by a larger power of two is then exact.
Mesh snapped(Mesh mesh, double step);
// Every facet with its corners in the opposite order.
Mesh turned_inside_out(Mesh mesh);

// One mesh with the vertices and facets of all, in their order.
Mesh merged(std::span<const Mesh> meshes);
// Facets that are connected by common vertices, a mesh each, ordered by their first facet; vertices keep their order.
// Vertices that no facet uses are left out.
std::vector<Mesh> components(const Mesh& mesh);

// A mesh whose vertex i and facet f are those that were numbered vertices[i] and facets[f].
Mesh permuted(const Mesh& mesh, std::span<const int> vertices, std::span<const int> facets);

// The mean of all vertices. Half the length of the diagonal of the box of all vertices.
Vec3 centroid(const Mesh& mesh);
double extent(const Mesh& mesh);
// The vertex that is farthest along a direction, the first of equals.
Vec3 highest(const Mesh& mesh, Vec3 direction);

// The positions between two of the same shape: (1 - t) * from + t * to.
Eigen::Matrix3Xd interpolated(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, double t);

// The sum of up to three vertices times their weights; -1 stands for none.
Vec3 weighted(const Mesh& mesh, const std::array<int, 3>& vertices, const std::array<double, 3>& weights);

// The vertices that a facet uses, each once, in their order.
std::vector<Vec3> used_points(const Mesh& mesh);

}  // namespace tact::tests
