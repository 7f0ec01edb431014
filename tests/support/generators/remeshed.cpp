#include "tests/support/generators/remeshed.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace tact::tests {
namespace {

using Facet = std::array<int, 3>;

std::vector<Facet> facets_of(const Mesh& mesh) {
  std::vector<Facet> facets;
  for (int f = 0; f < mesh.facet_count(); ++f)
    facets.push_back({mesh.facets(0, f), mesh.facets(1, f), mesh.facets(2, f)});
  return facets;
}

Mesh mesh_of(const std::vector<Vec3>& vertices, const std::vector<Facet>& facets) {
  Mesh mesh;
  mesh.positions.resize(3, static_cast<Eigen::Index>(vertices.size()));
  mesh.facets.resize(3, static_cast<Eigen::Index>(facets.size()));
  for (std::size_t v = 0; v < vertices.size(); ++v) mesh.set_position(static_cast<int>(v), vertices[v]);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (int k = 0; k < 3; ++k) mesh.facets(k, static_cast<Eigen::Index>(f)) = facets[f][static_cast<std::size_t>(k)];
  }
  return mesh;
}

std::vector<Vec3> vertices_of(const Mesh& mesh) {
  std::vector<Vec3> vertices;
  for (int v = 0; v < mesh.vertex_count(); ++v) vertices.push_back(mesh.position(v));
  return vertices;
}

Vec3 middle(const std::vector<Vec3>& vertices, const Facet& facet) {
  Vec3 sum;
  for (const int v : facet) sum = sum + vertices[static_cast<std::size_t>(v)];
  return (1.0 / 3.0) * sum;
}

}  // namespace

Remeshed unchanged(const Mesh& mesh) {
  Remeshed same{mesh, std::vector<int>(static_cast<std::size_t>(mesh.vertex_count()))};
  std::iota(same.vertex_map.begin(), same.vertex_map.end(), 0);
  return same;
}

Remeshed renumbered(const Remeshed& from, Random& random, bool turns) {
  const std::vector<int> vertices = random.permutation(from.mesh.vertex_count()),
                         facets = random.permutation(from.mesh.facet_count());
  Remeshed to{permuted(from.mesh, vertices, facets), {}};
  for (const int v : vertices) to.vertex_map.push_back(from.vertex_map[static_cast<std::size_t>(v)]);
  for (int f = 0; turns && f < to.mesh.facet_count(); ++f) {
    const Eigen::Vector3i corners = to.mesh.facets.col(f);
    const int by = random.below(3);
    for (int k = 0; k < 3; ++k) to.mesh.facets(k, f) = corners[(k + by) % 3];
  }
  return to;
}

Remeshed cut(const Remeshed& from, Vec3 normal, double offset) {
  std::vector<Facet> facets = facets_of(from.mesh);
  std::vector<Vec3> vertices = vertices_of(from.mesh);
  std::vector<int> map = from.vertex_map;
  std::vector<char> is_here(vertices.size(), 0);
  std::vector<char> beyond;
  for (const Facet& facet : facets) {
    beyond.push_back(dot(normal, middle(vertices, facet)) > offset ? 1 : 0);
    for (const int v : facet) is_here[static_cast<std::size_t>(v)] |= beyond.back() == 0 ? 1 : 0;
  }
  std::map<int, int> doubles;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (int& v : facets[f]) {
      if (beyond[f] == 0 || is_here[static_cast<std::size_t>(v)] == 0) continue;
      const auto [at, fresh] = doubles.try_emplace(v, static_cast<int>(vertices.size()));
      if (fresh) {
        map.push_back(map[static_cast<std::size_t>(v)]);
        vertices.push_back(vertices[static_cast<std::size_t>(v)]);
      }
      v = at->second;
    }
  }
  return {mesh_of(vertices, facets), map};
}

Remeshed torn(const Remeshed& from, Random& random, double probability) {
  std::vector<Facet> facets;
  for (const Facet& facet : facets_of(from.mesh)) {
    if (!random.chance(probability)) facets.push_back(facet);
  }
  std::vector<int> now(static_cast<std::size_t>(from.mesh.vertex_count()), -1), map;
  for (const Facet& facet : facets) {
    for (const int v : facet) now[static_cast<std::size_t>(v)] = 0;
  }
  std::vector<Vec3> vertices;
  for (std::size_t v = 0; v < now.size(); ++v) {
    if (now[v] < 0) continue;
    now[v] = static_cast<int>(vertices.size());
    vertices.push_back(from.mesh.position(static_cast<int>(v)));
    map.push_back(from.vertex_map[v]);
  }
  for (Facet& facet : facets) {
    for (int& v : facet) v = now[static_cast<std::size_t>(v)];
  }
  return {mesh_of(vertices, facets), map};
}

Remeshed refined(const Remeshed& from, Random& random, double probability) {
  std::vector<Facet> facets = facets_of(from.mesh);
  std::vector<Vec3> vertices = vertices_of(from.mesh);
  std::vector<int> map = from.vertex_map;
  const std::size_t count = facets.size();
  for (std::size_t f = 0; f < count; ++f) {
    if (!random.chance(probability)) continue;
    const auto [i, j, k] = facets[f];
    const int fresh = static_cast<int>(vertices.size());
    vertices.push_back(middle(vertices, facets[f]));
    map.push_back(-1);
    facets[f] = {i, j, fresh};
    facets.push_back({j, k, fresh});
    facets.push_back({k, i, fresh});
  }
  return {mesh_of(vertices, facets), map};
}

Remeshed remeshed(const Mesh& mesh, Random& random) {
  Remeshed made = unchanged(mesh);
  for (int i = random.below(3); i >= 0; --i) {
    switch (random.below(5)) {
      case 0: {
        const Vec3 normal = random.direction();
        made = cut(made, normal, random.uniform(-0.3, 0.3) + dot(normal, centroid(mesh)));
        break;
      }
      case 1: made = torn(made, random, 0.2 * random.uniform()); break;
      case 2: made = refined(made, random, 0.2 * random.uniform()); break;
      case 3: made = renumbered(made, random, random.chance(0.5)); break;
      default:
        for (int& was : made.vertex_map) {
          if (random.chance(0.1)) was = random.chance(0.5) ? -1 : random.below(std::max(1, mesh.vertex_count()));
          if (was >= mesh.vertex_count()) was = -1;
        }
    }
  }
  return made;
}

}  // namespace tact::tests
