// A cloth over a ball, which `cloth.cpp` and `newton.cpp` solve. The cloth's vertices come first.
#pragma once

#include <tact/report_arrays.h>
#include <tact/solver.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

namespace cloth_scene {

using Eigen::Matrix3Xd, Eigen::Vector3d;

constexpr int kSide = 14;                       // vertices along a side of the cloth
constexpr double kRadius = 0.4, kSize = 1.56;   // of the ball, of a side of the cloth; metres
constexpr double kThickness = 0.008;            // the distance that surfaces keep, metres
constexpr double kFriction = 0.4, kDrag = 6.0;  // a number; 1/s
constexpr double kDensity = 0.3;                // of the cloth, kg/m2
constexpr double kSpring = 100.0;               // N/m
constexpr double kGravity = 9.81;
// Where both solvers leave the cloth, metres; each may be off by a hundredth of the radius.
constexpr double kMeanAtRest = 0.0700, kHemAtRest = -0.1137;

struct Spring {
  int a, b;
  double length;
};

struct Scene {
  int moving = kSide * kSide;
  Matrix3Xd x;  // all vertices: the cloth's, then the ball's
  std::vector<Spring> springs;
  std::vector<int> hem;
  tact::World world;
  tact::BodyId cloth;
  std::vector<int> first_rows;
  std::size_t crossings = 0;  // facets that ever crossed

  Scene(double margin, const tact::Outputs& outputs);
  void add_springs();
  double mass() const { return kDensity * kSize * kSize / moving; }  // of a vertex, kg
  const tact::Report& detect() {
    world.set_positions(cloth, x.leftCols(moving));
    const tact::Report& report = world.detect();
    crossings += tact::facet_pair_count(report);
    return report;
  }
  // Prints how the cloth lies and returns whether it rests over the ball, where it should.
  bool report(const Matrix3Xd& velocity) const;
};

// Vertices in rows, where place(column, row) says, and two facets a cell.
inline Eigen::Matrix3Xi grid(int columns, int rows, Eigen::Ref<Matrix3Xd> x, const auto& place) {
  Eigen::Matrix3Xi facets(3, 2 * (columns - 1) * (rows - 1));
  for (int v = 0; v < columns * rows; ++v) x.col(v) = place(v % columns, v / columns);
  for (int f = 0; f < facets.cols(); f += 2) {
    const int a = f / 2 + f / 2 / (columns - 1), c = a + columns;
    facets.col(f) << a, a + 1, c + 1;
    facets.col(f + 1) << a, c + 1, c;
  }
  return facets;
}

inline Scene::Scene(double margin, const tact::Outputs& outputs)
    : x(3, moving + 41 * 21), world({.outputs = outputs}), first_rows{0, moving} {
  const double spacing = kSize / (kSide - 1);
  const Eigen::Matrix3Xi sheet = grid(kSide, kSide, x.leftCols(moving), [&](int i, int j) {
    return Vector3d(i * spacing - kSize / 2, j * spacing - kSize / 2,
                    kRadius + 0.05 + 0.002 * std::sin(3.0 * i + 5.0 * j));
  });
  const Eigen::Matrix3Xi sphere = grid(41, 21, x.rightCols(41 * 21), [](int i, int j) {  // rolled up
    const double u = std::numbers::pi * (i % 40) / 20.0, v = std::numbers::pi * (j / 20.0 - 0.5);
    return Vector3d(kRadius * Vector3d(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)));
  });
  add_springs();
  cloth = world.add_body({.positions = x.leftCols(moving),
                          .facets = sheet,
                          .surface = tact::Surface::sheet,
                          .margin = margin,
                          .self_contact = true});
  world.add_body(
      {.positions = x.rightCols(41 * 21), .facets = sphere, .motion = tact::Motion::fixed, .margin = margin});
}

// To the neighbours, across diagonals, to the next but one against bending.
inline void Scene::add_springs() {
  for (int a = 0; a < moving; ++a) {
    for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}}) {
      const int i = a % kSide + di, j = a / kSide + dj, b = j * kSide + i;
      if (i >= 0 && i < kSide && j < kSide) springs.push_back({a, b, (x.col(b) - x.col(a)).norm()});
    }
    if (a % kSide % (kSide - 1) == 0 || a / kSide % (kSide - 1) == 0) hem.push_back(a);
  }
}

inline bool Scene::report(const Matrix3Xd& velocity) const {
  double of_hem = 0.0;
  for (const int v : hem) of_hem += x(2, v) / static_cast<double>(hem.size());
  const double mean = x.row(2).head(moving).mean(), top = x.row(2).head(moving).maxCoeff();
  const double speed = std::sqrt(velocity.leftCols(moving).colwise().squaredNorm().mean());
  std::printf("facets that ever crossed: %zu; top at %.4f m, mean height %.4f m, hem %.4f m, speed %.3f m/s\n",
              crossings, top, mean, of_hem, speed);
  return crossings == 0 && std::abs(top - kRadius) < 2.0 * kThickness && speed < 0.01 &&
         std::abs(mean - kMeanAtRest) < 0.01 * kRadius && std::abs(of_hem - kHemAtRest) < 0.01 * kRadius;
}

}  // namespace cloth_scene
