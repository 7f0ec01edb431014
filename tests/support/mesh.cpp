#include "tests/support/mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tact::tests {
namespace {

std::vector<char> used_vertices(const Mesh& mesh) {
  std::vector<char> used(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (int f = 0; f < mesh.facet_count(); ++f) {
    for (int corner = 0; corner < 3; ++corner) used[mesh.facets(corner, f)] = 1;
  }
  return used;
}

// The representative of each vertex's component: its vertex with the lowest index.
class UnionFind {
 public:
  explicit UnionFind(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void join(int i, int j) {
    const int a = find(i);
    const int b = find(j);
    parent(std::max(a, b)) = std::min(a, b);
  }

 private:
  int& parent(int i) { return parent_[i]; }
  std::vector<int> parent_;
};

// The facets `chosen` of `mesh` with the vertices that they use.
Mesh submesh(const Mesh& mesh, const std::vector<int>& chosen) {
  std::vector<int> vertices;
  for (const int f : chosen) {
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(mesh.facets(corner, f));
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  MeshBuilder builder;
  for (const int v : vertices) builder.vertex(mesh.position(v));
  const auto renumbered = [&](int v) {
    return static_cast<int>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  for (const int f : chosen) {
    builder.facet(renumbered(mesh.facets(0, f)), renumbered(mesh.facets(1, f)), renumbered(mesh.facets(2, f)));
  }
  return builder.mesh();
}

}  // namespace

int MeshBuilder::vertex(Vec3 p) {
  vertices_.push_back(p);
  return static_cast<int>(vertices_.size()) - 1;
}

void MeshBuilder::facet(int i, int j, int k) { corners_.insert(corners_.end(), {i, j, k}); }

void MeshBuilder::quad(int i, int j, int k, int l) {
  facet(i, j, k);
  facet(i, k, l);
}

void MeshBuilder::triangle(Vec3 p, Vec3 q, Vec3 r) {
  const int i = vertex(p);
  const int j = vertex(q);
  facet(i, j, vertex(r));
}

Mesh MeshBuilder::mesh() const {
  Mesh mesh{Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(vertices_.size())),
            Eigen::Matrix3Xi(3, static_cast<Eigen::Index>(corners_.size() / 3))};
  for (int v = 0; v < mesh.vertex_count(); ++v) mesh.set_position(v, vertices_[v]);
  std::copy(corners_.begin(), corners_.end(), mesh.facets.data());
  return mesh;
}

Rotation rotation(double w, double x, double y, double z) {
  const double s = 2.0 / (w * w + x * x + y * y + z * z);
  return {{{1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
           {s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)},
           {s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)}}};
}

Mesh translated(Mesh mesh, Vec3 by) {
  return mapped(std::move(mesh), [&](Vec3 p) { return p + by; });
}

Mesh scaled(Mesh mesh, double factor, Vec3 center) {
  return mapped(std::move(mesh), [&](Vec3 p) { return center + factor * (p - center); });
}

Mesh stretched(Mesh mesh, Vec3 factors) {
  return mapped(std::move(mesh), [&](Vec3 p) { return Vec3{factors.x * p.x, factors.y * p.y, factors.z * p.z}; });
}

Mesh rotated(Mesh mesh, const Rotation& rotation) {
  return mapped(std::move(mesh), [&](Vec3 p) {
    return Vec3{dot(rotation.row[0], p), dot(rotation.row[1], p), dot(rotation.row[2], p)};
  });
}

Mesh snapped(Mesh mesh, double step) {
  const auto nearest = [&](double x) { return std::floor(x / step + 0.5) * step; };
  return mapped(std::move(mesh), [&](Vec3 p) { return Vec3{nearest(p.x), nearest(p.y), nearest(p.z)}; });
}

Mesh turned_inside_out(Mesh mesh) {
  mesh.facets.row(1).swap(mesh.facets.row(2));
  return mesh;
}

Mesh merged(std::span<const Mesh> meshes) {
  MeshBuilder builder;
  int first = 0;
  for (const Mesh& mesh : meshes) {
    for (int v = 0; v < mesh.vertex_count(); ++v) builder.vertex(mesh.position(v));
    for (int f = 0; f < mesh.facet_count(); ++f) {
      builder.facet(first + mesh.facets(0, f), first + mesh.facets(1, f), first + mesh.facets(2, f));
    }
    first += mesh.vertex_count();
  }
  return builder.mesh();
}

std::vector<Mesh> components(const Mesh& mesh) {
  UnionFind sets(mesh.vertex_count());
  for (int f = 0; f < mesh.facet_count(); ++f) {
    sets.join(mesh.facets(0, f), mesh.facets(1, f));
    sets.join(mesh.facets(0, f), mesh.facets(2, f));
  }
  std::vector<int> number(static_cast<std::size_t>(mesh.vertex_count()), -1);  // of a representative
  std::vector<std::vector<int>> facets;                                        // of each component
  for (int f = 0; f < mesh.facet_count(); ++f) {
    int& component = number[sets.find(mesh.facets(0, f))];
    if (component < 0) {
      component = static_cast<int>(facets.size());
      facets.emplace_back();
    }
    facets[component].push_back(f);
  }
  std::vector<Mesh> parts;
  for (const std::vector<int>& chosen : facets) parts.push_back(submesh(mesh, chosen));
  return parts;
}

Mesh permuted(const Mesh& mesh, std::span<const int> vertices, std::span<const int> facets) {
  std::vector<int> new_number(vertices.size());
  MeshBuilder builder;
  for (const int v : vertices) new_number[v] = builder.vertex(mesh.position(v));
  const auto corner = [&](int row, int f) { return new_number[mesh.facets(row, f)]; };
  for (const int f : facets) builder.facet(corner(0, f), corner(1, f), corner(2, f));
  return builder.mesh();
}

Vec3 centroid(const Mesh& mesh) {
  Vec3 sum;
  for (int v = 0; v < mesh.vertex_count(); ++v) sum = sum + mesh.position(v);
  return (1.0 / std::max(mesh.vertex_count(), 1)) * sum;
}

Vec3 highest(const Mesh& mesh, Vec3 direction) {
  Vec3 highest = mesh.position(0);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (dot(direction, mesh.position(v)) > dot(direction, highest)) highest = mesh.position(v);
  }
  return highest;
}

double extent(const Mesh& mesh) {
  if (mesh.vertex_count() == 0) return 0.0;
  return 0.5 * (mesh.positions.rowwise().maxCoeff() - mesh.positions.rowwise().minCoeff()).norm();
}

Eigen::Matrix3Xd interpolated(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to, double t) {
  return (1.0 - t) * from + t * to;
}

Vec3 weighted(const Mesh& mesh, const std::array<int, 3>& vertices, const std::array<double, 3>& weights) {
  Vec3 sum;
  for (std::size_t k = 0; k < 3; ++k) {
    if (vertices[k] >= 0) sum = sum + weights[k] * mesh.position(vertices[k]);
  }
  return sum;
}

std::vector<Vec3> used_points(const Mesh& mesh) {
  const std::vector<char> used = used_vertices(mesh);
  std::vector<Vec3> points;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (used[v] != 0) points.push_back(mesh.position(v));
  }
  return points;
}

}  // namespace tact::tests
