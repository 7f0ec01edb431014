#include "tests/support/generators/bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace tact::tests {
namespace {

// `count` points of the unit circle from (1, 0) counter-clockwise, by halving angles; `count` is a power of two, >= 4.
std::vector<Vec3> circle(int count) {
  std::vector<Vec3> points = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
  while (static_cast<int>(points.size()) < count) {
    std::vector<Vec3> finer;
    for (std::size_t i = 0; i < points.size(); ++i) {
      finer.push_back(points[i]);
      finer.push_back(normalized(points[i] + points[(i + 1) % points.size()]));
    }
    points = std::move(finer);
  }
  return points;
}

// A smooth wave of period 1 between -1 and 1, made of parabolas.
double wave(double t) {
  const double x = t - std::floor(t);
  return x < 0.5 ? 16.0 * x * (0.5 - x) : -16.0 * (x - 0.5) * (1.0 - x);
}

// 1 at 0, falls smoothly to 0 at 1 and stays there.
double bump(double distance_squared) {
  const double s = std::max(0.0, 1.0 - distance_squared);
  return s * s;
}

// Rings of `around` points about the z axis, closed by a point at each end; `profile` gives (radius, z) from below.
Mesh lathe(Vec3 first, const std::vector<std::pair<double, double>>& profile, Vec3 last, int around) {
  const std::vector<Vec3> unit = circle(around);
  MeshBuilder builder;
  const int bottom = builder.vertex(first);
  std::vector<int> rings;  // the first vertex of each
  for (const auto& [radius, z] : profile) {
    rings.push_back(bottom + 1 + static_cast<int>(rings.size()) * around);
    for (const Vec3& p : unit) builder.vertex({radius * p.x, radius * p.y, z});
  }
  const int top = builder.vertex(last);
  for (int i = 0; i < around; ++i) {
    const int j = (i + 1) % around;
    builder.facet(bottom, rings.front() + j, rings.front() + i);
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      builder.quad(rings[r] + i, rings[r] + j, rings[r + 1] + j, rings[r + 1] + i);
    }
    builder.facet(top, rings.back() + i, rings.back() + j);
  }
  return builder.mesh();
}

Mesh icosahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  MeshBuilder builder;
  for (const double s : {1.0, -1.0}) {
    for (const double t : {g, -g}) {
      builder.vertex(normalized(Vec3{0.0, s, t}));
      builder.vertex(normalized(Vec3{s, t, 0.0}));
      builder.vertex(normalized(Vec3{t, 0.0, s}));
    }
  }
  Mesh mesh = builder.mesh();
  // Three vertices are a facet if all others lie on one side of them.
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      for (int k = 0; k < 12; ++k) {
        if (i >= j || i >= k || j == k) continue;
        const Vec3 p = mesh.position(i);
        const Vec3 n = cross(mesh.position(j) - p, mesh.position(k) - p);
        bool outermost = true;
        for (int l = 0; l < 12; ++l) {
          if (l != i && l != j && l != k && dot(n, mesh.position(l) - p) > -0.1) outermost = false;
        }
        if (outermost) builder.facet(i, j, k);
      }
    }
  }
  return builder.mesh();
}

Mesh subdivided_on_sphere(const Mesh& mesh) {
  MeshBuilder builder;
  for (int v = 0; v < mesh.vertex_count(); ++v) builder.vertex(mesh.position(v));
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int i, int j) {
    const auto [place, is_new] = middles.try_emplace(std::minmax(i, j), 0);
    if (is_new) place->second = builder.vertex(normalized(mesh.position(i) + mesh.position(j)));
    return place->second;
  };
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const int i = mesh.facets(0, f), j = mesh.facets(1, f), k = mesh.facets(2, f);
    const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
    builder.facet(i, ij, ki);
    builder.facet(ij, j, jk);
    builder.facet(ki, jk, k);
    builder.facet(ij, jk, ki);
  }
  return builder.mesh();
}

}  // namespace

Mesh box(Vec3 lower, Vec3 upper) {
  MeshBuilder builder;
  for (int i = 0; i < 8; ++i) {
    builder.vertex(
        {(i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y, (i & 4) != 0 ? upper.z : lower.z});
  }
  builder.quad(0, 2, 3, 1);
  builder.quad(4, 5, 7, 6);
  builder.quad(0, 1, 5, 4);
  builder.quad(2, 6, 7, 3);
  builder.quad(0, 4, 6, 2);
  builder.quad(1, 3, 7, 5);
  return builder.mesh();
}

Mesh centered_box(Vec3 half_edges) { return box(-half_edges, half_edges); }

Mesh cube(double edge, Vec3 center) { return translated(centered_box({edge / 2, edge / 2, edge / 2}), center); }

Mesh gridded_box(Vec3 lower, Vec3 upper, int cells) {
  MeshBuilder builder;
  std::map<std::array<int, 3>, int> vertices;
  const auto vertex = [&](std::array<int, 3> cell) {
    const auto [place, is_new] = vertices.try_emplace(cell, 0);
    if (is_new) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const int i = cell[axis];
        p[axis] = i == cells ? upper[axis] : lower[axis] + (upper[axis] - lower[axis]) * i / cells;
      }
      place->second = builder.vertex(p);
    }
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, cells}) {
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> cell{};
            cell[axis] = side;
            cell[u] = i + di;
            cell[v] = j + dj;
            return vertex(cell);
          };
          const int p = corner(0, 0), q = corner(1, 0), r = corner(1, 1), s = corner(0, 1);
          if (side == 0) {
            builder.quad(p, s, r, q);
          } else {
            builder.quad(p, q, r, s);
          }
        }
      }
    }
  }
  return builder.mesh();
}

Mesh icosphere(int subdivisions, double radius) {
  Mesh mesh = icosahedron();
  for (int i = 0; i < subdivisions; ++i) mesh = subdivided_on_sphere(mesh);
  return scaled(std::move(mesh), radius);
}

Mesh blob(int subdivisions, double radius, double roughness, std::uint64_t seed) {
  Random random(seed);
  std::array<Vec3, 9> places;
  std::array<double, 9> heights;
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = random.direction();
    heights[i] = random.uniform(-roughness, roughness);
  }
  return mapped(icosphere(subdivisions), [&](Vec3 p) {
    double r = 1.0;
    for (std::size_t i = 0; i < places.size(); ++i) r += heights[i] * bump(norm_squared(p - places[i]) / 0.8);
    return radius * std::max(r, 0.2) * p;
  });
}

Mesh torus(int around, int across, double major_radius, double minor_radius) {
  const std::vector<Vec3> large = circle(around), small = circle(across);
  MeshBuilder builder;
  for (const Vec3& p : large) {
    for (const Vec3& q : small) {
      const double r = major_radius + minor_radius * q.x;
      builder.vertex({r * p.x, r * p.y, minor_radius * q.y});
    }
  }
  for (int i = 0; i < around; ++i) {
    const int here = i * across, next = (i + 1) % around * across;
    for (int j = 0; j < across; ++j) {
      const int k = (j + 1) % across;
      builder.quad(here + j, next + j, next + k, here + k);
    }
  }
  return builder.mesh();
}

Mesh organ(std::uint64_t seed) {
  constexpr int kAround = 16, kRings = 16;
  Random random(seed);
  std::vector<std::pair<double, double>> profile;
  for (int ring = 1; ring <= kRings; ++ring) {
    const double z = -1.0 + 2.0 * ring / (kRings + 1);
    profile.emplace_back(std::sqrt(1.0 - z * z), z);
  }
  std::array<Vec3, 5> dents;
  for (Vec3& dent : dents) dent = random.direction();
  return mapped(lathe({0.0, 0.0, -1.0}, profile, {0.0, 0.0, 1.0}, kAround), [&](Vec3 p) {
    double r = 1.0;
    for (const Vec3& dent : dents) r -= 0.3 * bump(norm_squared(p - dent) / 0.5);
    const Vec3 q{0.32 * r * p.x, 0.2 * r * p.y, 0.5 * r * p.z};
    return Vec3{q.x + 1.2 * q.z * q.z, q.y + 0.2 * q.z, q.z};  // bent: concave on one side
  });
}

Mesh tool() {
  const std::vector<std::pair<double, double>> profile = {{0.05, -1.0}, {0.05, -0.7}, {0.05, -0.4},
                                                          {0.05, -0.2}, {0.04, -0.1}, {0.02, -0.02}};
  return lathe({0.0, 0.0, -1.0}, profile, {0.0, 0.0, 0.0}, 8);
}

Mesh random_hull(int points, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(random.in_ball());
  MeshBuilder builder;
  std::map<int, int> number;
  const auto vertex = [&](int i) {
    const auto [place, is_new] = number.try_emplace(i, 0);
    if (is_new) place->second = builder.vertex(cloud[i]);
    return place->second;
  };
  for (int i = 0; i < points; ++i) {
    for (int j = i + 1; j < points; ++j) {
      for (int k = j + 1; k < points; ++k) {
        const Vec3 p = cloud[i];
        const Vec3 n = cross(cloud[j] - p, cloud[k] - p);
        int above = 0, below = 0;
        for (int l = 0; l < points; ++l) {
          if (l == i || l == j || l == k) continue;
          ++(dot(n, cloud[l] - p) > 0.0 ? above : below);
        }
        if (above != 0 && below != 0) continue;
        const int u = vertex(i), v = vertex(j), w = vertex(k);
        if (above == 0) builder.facet(u, v, w);
        if (below == 0) builder.facet(u, w, v);
      }
    }
  }
  return builder.mesh();
}

Mesh spike(Vec3 tip, double radius) {
  const Vec3 axis = std::abs(tip.x) <= std::abs(tip.y) ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 u = radius * normalized(cross(tip, axis));
  const Vec3 v = radius * normalized(cross(tip, u));
  MeshBuilder builder;
  builder.vertex(u);
  builder.vertex(-0.5 * u + 0.75 * v);
  builder.vertex(-0.5 * u - 0.75 * v);
  builder.vertex(tip);
  builder.facet(0, 2, 1);
  builder.facet(0, 1, 3);
  builder.facet(1, 2, 3);
  builder.facet(2, 0, 3);
  return builder.mesh();
}

Mesh sheet(int cells_x, int cells_y, double size_x, double size_y) {
  MeshBuilder builder;
  for (int j = 0; j <= cells_y; ++j) {
    for (int i = 0; i <= cells_x; ++i) {
      builder.vertex({size_x * i / cells_x - 0.5 * size_x, size_y * j / cells_y - 0.5 * size_y, 0.0});
    }
  }
  const int row = cells_x + 1;
  for (int j = 0; j < cells_y; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      const int first = j * row + i;
      builder.quad(first, first + 1, first + row + 1, first + row);
    }
  }
  return builder.mesh();
}

Mesh wrinkled_sheet(int cells, double size, double height, std::uint64_t seed) {
  Random random(seed);
  struct Fold {
    double x, y, phase, height;
  };
  std::array<Fold, 4> folds;
  for (Fold& fold : folds) {
    fold.x = random.uniform(-2.0, 2.0) / size;
    fold.y = random.uniform(-2.0, 2.0) / size;
    fold.phase = random.uniform();
    fold.height = 0.25 * height * random.uniform(0.2, 1.0);
  }
  return mapped(sheet(cells, cells, size, size), [&](Vec3 p) {
    for (const Fold& fold : folds) p.z += fold.height * wave(fold.x * p.x + fold.y * p.y + fold.phase);
    return p;
  });
}

Mesh pleated(Mesh mesh, int waves, double height, double overhang) {
  return mapped(std::move(mesh), [&](Vec3 p) {
    const double along = waves * p.x;
    return Vec3{p.x + overhang * wave(2.0 * along), p.y, p.z + height * wave(along + 0.25)};
  });
}

Mesh soup(int facets, double extent, std::uint64_t seed) {
  Random random(seed);
  MeshBuilder builder;
  for (int f = 0; f < facets; ++f) {
    const Vec3 middle = random.in_cube(0.8 * extent);
    const Vec3 p = middle + random.in_cube(0.2 * extent);
    const Vec3 q = middle + random.in_cube(0.2 * extent);
    builder.triangle(p, q, middle + random.in_cube(0.2 * extent));
  }
  return builder.mesh();
}

Mesh lattice_soup(int facets, int reach, std::uint64_t seed) {
  Random random(seed);
  MeshBuilder builder;
  const int vertices = std::max(4, facets);
  const auto coordinate = [&] { return static_cast<double>(random.below(2 * reach + 1) - reach); };
  for (int v = 0; v < vertices; ++v) {
    const double x = coordinate(), y = coordinate();
    builder.vertex({x, y, coordinate()});
  }
  const int used = vertices - vertices / 8;
  for (int f = 0; f < facets; ++f) {
    const int i = random.below(used), j = random.below(used);
    builder.facet(i, j, random.below(used));
  }
  return builder.mesh();
}

Mesh needles(int facets, double aspect, std::uint64_t seed) {
  Random random(seed);
  MeshBuilder builder;
  for (int f = 0; f < facets; ++f) {
    const Vec3 p = random.in_ball(), q = random.in_ball();
    const Vec3 foot = p + random.uniform() * (q - p);
    builder.triangle(p, q, foot + aspect * random.direction());
  }
  return builder.mesh();
}

Mesh jittered(Mesh mesh, double amount, std::uint64_t seed) {
  Random random(seed);
  return mapped(std::move(mesh), [&](Vec3 p) { return p + random.in_cube(amount); });
}

Mesh crumpled(Mesh mesh, std::uint64_t seed) {
  Random random(seed);
  return mapped(std::move(mesh), [&](Vec3) { return random.in_ball(); });
}

Mesh scrambled(const Mesh& mesh, std::uint64_t seed) {
  const std::vector<int> places = Random(seed).permutation(mesh.vertex_count());
  Mesh other = mesh;
  for (int v = 0; v < mesh.vertex_count(); ++v) other.positions.col(v) = mesh.positions.col(places[v]);
  return other;
}

}  // namespace tact::tests
