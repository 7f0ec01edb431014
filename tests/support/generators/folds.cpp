#include "tests/support/generators/folds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/random.h"

namespace tact::tests {

namespace {

constexpr double kPi = std::numbers::pi;

// A sheet of squares of which place(x, y) says where a point of [0, 1]² comes to lie.
template <class Place>
Mesh placed_sheet(int cells_x, int cells_y, const Place& place) {
  return mapped(sheet(cells_x, cells_y, 1.0, 1.0), [&](Vec3 p) { return place(p.x + 0.5, p.y + 0.5); });
}

}  // namespace

Mesh rolled_sheet(int cells_x, int cells_y, double turns, double radius, double gap) {
  return placed_sheet(cells_x, cells_y, [&](double x, double y) {
    const double turn = turns * x, r = radius + gap * turn;
    return Vec3{r * std::cos(2 * kPi * turn), y, r * std::sin(2 * kPi * turn)};
  });
}

Mesh fan_fold(int cells_x, int cells_y, int folds, double angle) {
  return placed_sheet(cells_x, cells_y, [&](double x, double y) {
    const double along = folds * x, whole = std::floor(along), part = along - whole;
    const double up = static_cast<int>(whole) % 2 == 0 ? part : 1.0 - part;
    return Vec3{std::cos(angle) * along / folds, y, std::sin(angle) * up / folds};
  });
}

Mesh winding_stairs(int cells_around, int cells_across, double turns, double rise) {
  return placed_sheet(cells_around, cells_across, [&](double x, double y) {
    const double turn = turns * x, r = 2.0 - y;
    return Vec3{r * std::cos(2 * kPi * turn), r * std::sin(2 * kPi * turn), rise * turn};
  });
}

Mesh double_disk(int cells_around, int cells_across, double height) {
  MeshBuilder builder;
  const int middle = builder.vertex({0.0, 0.0, 0.0});
  const auto at = [&](int i, int ring) { return 1 + (ring - 1) * cells_around + i % cells_around; };
  for (int ring = 1; ring <= cells_across; ++ring) {
    for (int i = 0; i < cells_around; ++i) {
      const double turn = 2.0 * i / cells_around, r = static_cast<double>(ring) / cells_across;
      builder.vertex({r * std::cos(2 * kPi * turn), r * std::sin(2 * kPi * turn), height * r * std::cos(kPi * turn)});
    }
  }
  for (int i = 0; i < cells_around; ++i) {
    builder.facet(middle, at(i, 1), at(i + 1, 1));
    for (int ring = 1; ring < cells_across; ++ring)
      builder.quad(at(i, ring), at(i, ring + 1), at(i + 1, ring + 1), at(i + 1, ring));
  }
  return builder.mesh();
}

Mesh overhanging_wave(int cells_x, int cells_y, int waves, double overhang) {
  return placed_sheet(cells_x, cells_y, [&](double x, double y) {
    const double turn = 2 * kPi * waves * x;
    return Vec3{x + overhang * std::sin(2 * turn) / (4 * kPi * waves), y, std::cos(turn) / (2 * waves)};
  });
}

Mesh comb(int cells, int width, double shear, double height, std::uint64_t seed) {
  Random random(seed);
  const int side = cells + 1, end = cells / 2;
  MeshBuilder builder;
  for (int k = 0; k <= end; ++k) {
    for (int i = 0; i < side; ++i)
      builder.vertex({static_cast<double>(i) / cells, static_cast<double>(k) / cells, 0.0});
  }
  for (int k = 0; k < end; ++k) {
    for (int i = 0; i < cells; ++i) {
      const int v = k * side + i;
      builder.quad(v, v + 1, v + 1 + side, v + side);
    }
  }
  for (int begin = 0; begin < cells; begin += width) {
    const int across = std::min(width, cells - begin);
    const double way = random.uniform(-shear, shear), rise = random.uniform(0.0, height);
    int last = end * side + begin;  // the first vertex of the row below
    for (int k = end + 1; k < side; ++k) {
      const double up = static_cast<double>(k - end) / (cells - end);
      const int row = builder.vertex_count();
      for (int i = begin; i <= begin + across; ++i)
        builder.vertex({static_cast<double>(i) / cells + way * up * up, static_cast<double>(k) / cells, rise * up});
      for (int i = 0; i < across; ++i) builder.quad(last + i, last + i + 1, row + i + 1, row + i);
      last = row;
    }
  }
  return builder.mesh();
}

Mesh broken(const Mesh& mesh, std::uint64_t seed) {
  Random random(seed);
  MeshBuilder builder;
  for (int v = 0; v < mesh.vertex_count(); ++v) builder.vertex(mesh.position(v));
  for (int f = 0; f < mesh.facet_count(); ++f) {
    const int i = mesh.facets(0, f), j = mesh.facets(1, f), k = mesh.facets(2, f);
    builder.facet(i, j, k);
    if (random.chance(0.02)) builder.facet(i, j, k);
    if (random.chance(0.02)) builder.facet(k, j, i);
    if (random.chance(0.02)) builder.facet(i, j, j);
    if (random.chance(0.02)) builder.facet(i, j, random.below(mesh.vertex_count()));
    if (random.chance(0.02)) {
      const Vec3 p = mesh.position(i), q = mesh.position(j);
      builder.facet(i, builder.vertex(0.5 * (p + q)), j);
    }
  }
  return builder.mesh();
}

std::vector<NamedMesh> folded_meshes(int cells, std::uint64_t seed) {
  Random random(seed);
  const int half = cells / 2;
  std::vector<NamedMesh> all = {
      {"flat", sheet(cells, half, 1.0, 0.5)},
      {"wrinkled", wrinkled_sheet(cells, 1.0, random.uniform(0.01, 0.3), random.bits())},
      {"rolled",
       rolled_sheet(cells, half, random.uniform(0.5, 3.0), random.uniform(0.05, 1.0), random.uniform(0.02, 0.1))},
      {"rolled into itself", rolled_sheet(cells, half, random.uniform(1.1, 2.5), 0.4, random.uniform(-0.1, 0.001))},
      {"fan", fan_fold(cells, half, 1 + random.below(5), random.uniform(0.1, 1.5))},
      {"closed fan", fan_fold(cells, half, 1 + random.below(5), 0.5 * kPi)},
      {"stairs",
       winding_stairs(2 * cells, std::max(2, cells / 5), random.uniform(0.4, 2.2), random.uniform(0.001, 0.3))},
      {"stairs that cross", winding_stairs(2 * cells, std::max(2, cells / 5), random.uniform(1.05, 2.2), 0.0)},
      {"double disk", double_disk(2 * cells, half, random.uniform(0.0, 0.3))},
      {"wave", overhanging_wave(2 * cells, half, 1 + random.below(2), random.uniform(0.0, 6.0))},
      {"comb",
       comb(cells, 1 + random.below(cells), random.uniform(0.0, 0.3), random.chance(0.5) ? 0.0 : 0.1, random.bits())},
      {"torus", torus(32, 8, 1.0, random.uniform(0.1, 0.9))},
      {"torus through its middle", torus(32, 8, 1.0, random.uniform(1.0, 1.3))},
      {"blob", blob(2, 1.0, random.uniform(0.05, 0.4), random.bits())}};
  for (NamedMesh& one : all) {
    one.mesh = rotated(one.mesh, random.rotation());
    if (random.chance(0.3)) one.mesh = jittered(one.mesh, random.uniform(0.0, 0.4 / cells), random.bits());
  }
  return all;
}

}  // namespace tact::tests
