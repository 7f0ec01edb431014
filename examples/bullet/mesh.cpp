#include "mesh.h"

#include <array>
#include <map>
#include <vector>

namespace example {
namespace {

using Place = std::array<int, 3>;  // of a vertex in the grid of a box

Mesh as_mesh(const std::vector<Eigen::Vector3d>& positions, const std::vector<Eigen::Vector3i>& facets) {
  Mesh mesh{Eigen::Matrix3Xd(3, positions.size()), Eigen::Matrix3Xi(3, facets.size())};
  for (std::size_t i = 0; i < positions.size(); ++i) mesh.positions.col(static_cast<int>(i)) = positions[i];
  for (std::size_t i = 0; i < facets.size(); ++i) mesh.facets.col(static_cast<int>(i)) = facets[i];
  return mesh;
}

}  // namespace

Mesh box(const Eigen::Vector3d& size, int cuts) {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3i> facets;
  std::map<Place, int> numbers;
  const auto vertex = [&](const Place& place) {
    const auto [at, fresh] = numbers.try_emplace(place, static_cast<int>(positions.size()));
    const Eigen::Vector3d share(place[0], place[1], place[2]);
    if (fresh) positions.push_back(size.cwiseProduct(share / cuts - Eigen::Vector3d::Constant(0.5)));
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i < cuts; ++i) {
        for (int j = 0; j < cuts; ++j) {
          const auto corner = [&](int di, int dj) {
            Place place{};
            place[axis] = side * cuts;
            place[(axis + 1) % 3] = i + di;
            place[(axis + 2) % 3] = j + dj;
            return vertex(place);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (side == 1) {
            facets.insert(facets.end(), {{a, b, c}, {a, c, d}});
          } else {
            facets.insert(facets.end(), {{a, c, b}, {a, d, c}});
          }
        }
      }
    }
  }
  return as_mesh(positions, facets);
}

Mesh cloth(double side, int cuts) {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3i> facets;
  for (int j = 0; j <= cuts; ++j) {
    for (int i = 0; i <= cuts; ++i)
      positions.emplace_back(side * (1.0 * i / cuts - 0.5), side * (1.0 * j / cuts - 0.5), 0.0);
  }
  for (int j = 0; j < cuts; ++j) {
    for (int i = 0; i < cuts; ++i) {
      const int a = j * (cuts + 1) + i, b = a + 1, c = b + cuts + 1, d = a + cuts + 1;
      facets.insert(facets.end(), {{a, b, c}, {a, c, d}});
    }
  }
  return as_mesh(positions, facets);
}

}  // namespace example
