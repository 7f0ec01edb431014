#include "tests/support/oracles/stencil_oracle.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <sstream>

#include "tests/support/generators/random.h"

namespace tact::tests {

namespace {

using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Numbers = std::array<Number, 12>;
using Point = std::array<Number, 3>;

Point way(const Numbers& x, std::size_t from, std::size_t to) {
  return {x[3 * to] - x[3 * from], x[3 * to + 1] - x[3 * from + 1], x[3 * to + 2] - x[3 * from + 2]};
}
Number dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
Point cross(const Point& p, const Point& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
Number length(const Point& p) { return sqrt(dot(p, p)); }

// Positive on the side where the stencil lies.
Number distance(solver::StencilKind kind, const Numbers& x) {
  switch (kind) {
    case solver::StencilKind::point_point: return length(way(x, 0, 1));
    case solver::StencilKind::point_edge: return length(cross(way(x, 1, 0), way(x, 1, 2))) / length(way(x, 1, 2));
    case solver::StencilKind::point_facet: {
      const Point normal = cross(way(x, 1, 2), way(x, 1, 3));
      return abs(dot(way(x, 1, 0), normal)) / length(normal);
    }
    case solver::StencilKind::edge_edge: break;
  }
  const Point normal = cross(way(x, 0, 1), way(x, 2, 3));
  return abs(dot(way(x, 0, 2), normal)) / length(normal);
}

Number barrier_of(const PlacedStencil& placed, const Numbers& x) {
  const Number d = distance(placed.stencil.kind, x), reach = placed.reach;
  Number value = d < reach ? Number(-(d - reach) * (d - reach) * log(d / reach)) : Number(0);
  if (placed.stencil.kind == solver::StencilKind::edge_edge && placed.threshold > 0.0) {
    const Point normal = cross(way(x, 0, 1), way(x, 2, 3));
    const Number part = dot(normal, normal) / placed.threshold;
    if (part < 1) value *= part * (2 - part);
  }
  return value;
}

using Function = std::function<Number(const Numbers&)>;

// Central differences: with steps of 1e-15 of a stencil 1e-6 thin, they are right to some 1e-15.
solver::Term differences(const Function& f, const Numbers& x, int size, const Number& step) {
  solver::Term term{.value = static_cast<double>(f(x))};
  const auto at = [&](int i, int by_i, int j, int by_j) {
    Numbers moved = x;
    moved[static_cast<std::size_t>(i)] += by_i * step;
    moved[static_cast<std::size_t>(j)] += by_j * step;
    return f(moved);
  };
  const Number middle = f(x);
  for (int i = 0; i < 3 * size; ++i) {
    const Number above = at(i, 1, i, 0), below = at(i, -1, i, 0);
    term.gradient[i] = static_cast<double>((above - below) / (2 * step));
    term.hessian(i, i) = static_cast<double>((above - 2 * middle + below) / (step * step));
    for (int j = 0; j < i; ++j)
      term.hessian(i, j) = term.hessian(j, i) = static_cast<double>(
          (at(i, 1, j, 1) - at(i, 1, j, -1) - at(i, -1, j, 1) + at(i, -1, j, -1)) / (4 * step * step));
  }
  return term;
}

std::string compared(const char* name, const solver::Term& found, const solver::Term& expected) {
  std::ostringstream text;
  const auto compare = [&](const char* part, double error, double norm) {
    if (!(error <= 1e-6 * norm)) text << name << ": " << part << " is wrong by " << error << " of " << norm << "\n";
  };
  compare("value", std::abs(found.value - expected.value), std::abs(expected.value));
  compare("gradient", (found.gradient - expected.gradient).norm(), expected.gradient.norm());
  compare("Hessian", (found.hessian - expected.hessian).norm(), expected.hessian.norm());
  return text.str();
}

Eigen::Vector3d vector(Vec3 p) { return {p.x, p.y, p.z}; }

}  // namespace

PlacedStencil random_stencil(std::uint64_t seed) {
  Random random(seed);
  PlacedStencil placed;
  solver::Stencil& stencil = placed.stencil;
  stencil.kind = static_cast<solver::StencilKind>(random.below(4));
  stencil.b_first = stencil.kind != solver::StencilKind::edge_edge && random.chance(0.5);
  // The thinnest have 1e-6 of their length between edges or in height; the nearest a gap of 1e-6 of it.
  const double thin = random.chance(0.5) ? std::pow(10.0, random.uniform(-6.0, 0.0)) : 1.0;
  const double near = std::pow(10.0, random.uniform(-6.0, 0.0));
  const Eigen::Vector3d u = vector(random.direction());
  const Eigen::Vector3d n = u.cross(vector(random.direction())).normalized();
  const Eigen::Vector3d v = (u + thin * random.uniform(0.5, 2.0) * n.cross(u)).normalized() * random.uniform(0.3, 3.0);
  const bool edges = stencil.kind == solver::StencilKind::edge_edge;
  const double s = random.uniform(0.05, 0.95), t = random.uniform(0.05, 0.95);
  Eigen::Matrix<double, 3, 4>& x = placed.x;
  x.setZero();
  if (edges) {
    x << -s * u, (1.0 - s) * u, near * n - t * v, near * n + (1.0 - t) * v;
  } else {
    x.col(0) = near * n;
    if (stencil.size() == 2) x.col(1).setZero();
    if (stencil.size() == 3) x.col(1) = -s * u, x.col(2) = (1.0 - s) * u;
    if (stencil.size() == 4)
      x.rightCols<3>() << -s * u - 0.3 * v, (1.0 - s) * u - 0.3 * v, 0.7 * v - (1.0 - s) * 0.2 * u;
  }
  const double scale = std::pow(10.0, random.uniform(-6.0, 6.0));
  const Eigen::Vector3d away =
      random.chance(0.5) ? Eigen::Vector3d(3.0 * vector(random.direction())) : Eigen::Vector3d::Zero();
  for (int k = 0; k < stencil.size(); ++k) {
    x.col(k) = scale * (x.col(k) + away);
    stencil.vertices[static_cast<std::size_t>(k)] = k;
  }
  // From a to b: from the first feature to the second, unless the first is b's.
  stencil.normal = (edges != stencil.b_first ? 1.0 : -1.0) * n;
  if (edges) stencil.normal = n;
  placed.reach = scale * near * random.uniform(1.1, 30.0);
  if (edges && random.chance(0.7))
    placed.threshold = random.uniform(0.5, 100.0) * (x.col(1) - x.col(0)).cross(x.col(3) - x.col(2)).squaredNorm();
  return placed;
}

std::string wrong_terms(const PlacedStencil& placed) {
  Numbers x;
  double size = 0.0;
  for (std::size_t i = 0; i < 12; ++i)
    x[i] = placed.x(static_cast<Eigen::Index>(i % 3), static_cast<Eigen::Index>(i / 3));
  for (int k = 1; k < placed.stencil.size(); ++k) size = std::max(size, (placed.x.col(k) - placed.x.col(0)).norm());
  const int count = placed.stencil.size();
  const Number step = Number(size) * Number("1e-15");
  const solver::Gap gap = solver::gap_of(placed.stencil, placed.x);
  std::string wrong =
      compared("gap", gap.distance,
               differences([&](const Numbers& at) { return distance(placed.stencil.kind, at); }, x, count, step));
  const solver::Term barrier = solver::barrier_term(placed.stencil, placed.x, placed.reach, placed.threshold);
  wrong += compared("barrier", barrier,
                    differences([&](const Numbers& at) { return barrier_of(placed, at); }, x, count, step));
  const solver::Matrix12d kept = solver::projected(barrier.hessian);
  const double least = Eigen::SelfAdjointEigenSolver<solver::Matrix12d>(kept).eigenvalues()[0];
  if (!(least >= -1e-12 * kept.norm()))
    wrong += "projected: an eigenvalue of " + std::to_string(least / kept.norm()) + "\n";
  return wrong;
}

}  // namespace tact::tests
