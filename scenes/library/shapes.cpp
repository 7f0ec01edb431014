#include "scenes/library/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace tact::scenes {
namespace {

using Corners = std::array<int, 3>;

Mesh mesh_of(std::vector<Vec3> positions, const std::vector<Corners>& facets) {
  Mesh mesh{std::move(positions), Eigen::Matrix3Xi(3, static_cast<Eigen::Index>(facets.size()))};
  for (std::size_t f = 0; f < facets.size(); ++f) {
    mesh.facets.col(f) << facets[f][0], facets[f][1], facets[f][2];
  }
  return mesh;
}

// Halves all edges of a mesh whose vertices lie on the unit sphere.
void refine(std::vector<Vec3>& positions, std::vector<Corners>& facets) {
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [place, fresh] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(positions.size()));
    if (fresh) {
      positions.push_back(normalized(positions[a] + positions[b]));
    }
    return place->second;
  };
  std::vector<Corners> finer;
  finer.reserve(4 * facets.size());
  for (const auto& [a, b, c] : facets) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  facets = std::move(finer);
}

// One face of a box: corner + i * right + j * up, turned so that right x up points out.
struct Face {
  Vec3 corner, right, up;
  int columns, rows;
};

class GridCollector {
 public:
  void add(const Face& face) {
    for (int j = 0; j < face.rows; ++j) {
      for (int i = 0; i < face.columns; ++i) {
        const int a = vertex(face, i, j), b = vertex(face, i + 1, j), c = vertex(face, i + 1, j + 1),
                  d = vertex(face, i, j + 1);
        if ((i + j) % 2 == 0) {
          facets_.insert(facets_.end(), {{a, b, c}, {a, c, d}});
        } else {
          facets_.insert(facets_.end(), {{a, b, d}, {b, c, d}});
        }
      }
    }
  }
  Mesh mesh() { return mesh_of(std::move(positions_), facets_); }

 private:
  int vertex(const Face& face, int i, int j) {
    const Vec3 p = face.corner + (static_cast<double>(i) / face.columns) * face.right +
                   (static_cast<double>(j) / face.rows) * face.up;
    // Faces share the vertices of their edges; coordinates differ there by rounding alone.
    const auto key = [](double x) { return static_cast<long long>(std::llround(x * 1e9)); };
    const auto [place, fresh] =
        vertices_.try_emplace({key(p.x), key(p.y), key(p.z)}, static_cast<int>(positions_.size()));
    if (fresh) positions_.push_back(p);
    return place->second;
  }

  std::map<std::array<long long, 3>, int> vertices_;
  std::vector<Vec3> positions_;
  std::vector<Corners> facets_;
};

}  // namespace

Mesh grid_sheet(int columns, int rows, double width, double depth) {
  GridCollector grid;
  grid.add({{-0.5 * width, -0.5 * depth, 0.0}, {width, 0.0, 0.0}, {0.0, depth, 0.0}, columns - 1, rows - 1});
  return grid.mesh();
}

Mesh sphere(int levels, double radius) {
  return shaped_sphere(levels, [radius](Vec3 p) { return radius * p; });
}

Mesh shaped_sphere(int levels, const std::function<Vec3(Vec3)>& shape) {
  const double g = std::numbers::phi;
  std::vector<Vec3> positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Vec3& p : positions) p = normalized(p);
  std::vector<Corners> facets = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) refine(positions, facets);
  std::transform(positions.begin(), positions.end(), positions.begin(), shape);
  return mesh_of(std::move(positions), facets);
}

Mesh box(Vec3 lower, Vec3 upper, double longest) {
  const Vec3 size = upper - lower;
  const Vec3 x{size.x, 0.0, 0.0}, y{0.0, size.y, 0.0}, z{0.0, 0.0, size.z};
  const auto cells = [longest](double length) { return std::max(1, static_cast<int>(std::ceil(length / longest))); };
  const int nx = cells(size.x), ny = cells(size.y), nz = cells(size.z);
  GridCollector grid;
  grid.add({lower, y, x, ny, nx});
  grid.add({lower + z, x, y, nx, ny});
  grid.add({lower, x, z, nx, nz});
  grid.add({lower + y, z, x, nz, nx});
  grid.add({lower, z, y, nz, ny});
  grid.add({lower + x, y, z, ny, nz});
  return grid.mesh();
}

Mesh shaped_globe(int around, int rings, const std::function<Vec3(Vec3)>& shape) {
  std::vector<Vec3> positions = {{0.0, 0.0, -1.0}};
  for (int j = 1; j <= rings; ++j) {
    const double latitude = std::numbers::pi * (static_cast<double>(j) / (rings + 1) - 0.5);
    for (int i = 0; i < around; ++i) {
      const double u = 2.0 * std::numbers::pi * (i + 0.5 * (j % 2)) / around;
      positions.push_back({std::cos(latitude) * std::cos(u), std::cos(latitude) * std::sin(u), std::sin(latitude)});
    }
  }
  const int top = static_cast<int>(positions.size());
  positions.push_back({0.0, 0.0, 1.0});
  std::vector<Corners> facets;
  const auto vertex = [&](int j, int i) { return 1 + (j - 1) * around + i % around; };
  for (int i = 0; i < around; ++i) facets.push_back({0, vertex(1, i + 1), vertex(1, i)});
  for (int j = 1; j < rings; ++j) {
    for (int i = 0; i < around; ++i) {
      const int a = vertex(j, i), b = vertex(j, i + 1), c = vertex(j + 1, i + 1), d = vertex(j + 1, i);
      // Odd rings are turned by half a segment.
      if (j % 2 == 1) {
        facets.insert(facets.end(), {{a, b, c}, {a, c, d}});
      } else {
        facets.insert(facets.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  for (int i = 0; i < around; ++i) facets.push_back({top, vertex(rings, i), vertex(rings, i + 1)});
  std::transform(positions.begin(), positions.end(), positions.begin(), shape);
  return mesh_of(std::move(positions), facets);
}

Mesh cells(const std::vector<std::array<int, 3>>& filled, Vec3 cell_size) {
  const std::set<std::array<int, 3>> all(filled.begin(), filled.end());
  const Vec3 x{cell_size.x, 0.0, 0.0}, y{0.0, cell_size.y, 0.0}, z{0.0, 0.0, cell_size.z};
  GridCollector grid;
  for (const auto& at : all) {
    const Vec3 corner{at[0] * cell_size.x, at[1] * cell_size.y, at[2] * cell_size.z};
    const auto open = [&](int di, int dj, int dk) { return !all.contains({at[0] + di, at[1] + dj, at[2] + dk}); };
    if (open(0, 0, -1)) grid.add({corner, y, x, 1, 1});
    if (open(0, 0, 1)) grid.add({corner + z, x, y, 1, 1});
    if (open(0, -1, 0)) grid.add({corner, x, z, 1, 1});
    if (open(0, 1, 0)) grid.add({corner + y, z, x, 1, 1});
    if (open(-1, 0, 0)) grid.add({corner, z, y, 1, 1});
    if (open(1, 0, 0)) grid.add({corner + x, y, z, 1, 1});
  }
  return grid.mesh();
}

Mesh torus(int around, int across, double ring, double tube) {
  std::vector<Vec3> positions;
  std::vector<Corners> facets;
  const auto vertex = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    const double u = 2.0 * std::numbers::pi * i / around;
    for (int j = 0; j < across; ++j) {
      const double v = 2.0 * std::numbers::pi * (j + 0.5 * (i % 2)) / across;
      const double r = ring + tube * std::cos(v);
      positions.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
    }
  }
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      // Every second row is turned by half a segment: around must be even.
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      if (i % 2 == 0) {
        facets.insert(facets.end(), {{a, b, d}, {b, c, d}});
      } else {
        facets.insert(facets.end(), {{a, b, c}, {a, c, d}});
      }
    }
  }
  return mesh_of(std::move(positions), facets);
}

Mesh moved(Mesh mesh, Vec3 by) {
  for (Vec3& p : mesh.positions) p = p + by;
  return mesh;
}

Mesh scaled(Mesh mesh, double factor) {
  for (Vec3& p : mesh.positions) p = factor * p;
  return mesh;
}

Vec3 rotated(Vec3 p, Vec3 axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * p + s * cross(axis, p) + ((1.0 - c) * dot(axis, p)) * axis;
}

Mesh rotated(Mesh mesh, Vec3 axis, double angle) {
  for (Vec3& p : mesh.positions) p = rotated(p, axis, angle);
  return mesh;
}

Mesh rotated(Mesh mesh, Random& random) {
  const double z = random.between(-1.0, 1.0);
  const double longitude = random.between(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  const Vec3 axis{r * std::cos(longitude), r * std::sin(longitude), z};
  return rotated(std::move(mesh), axis, random.between(0.0, 2.0 * std::numbers::pi));
}

}  // namespace tact::scenes
