#include "bench/workloads/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "bench/random.h"

namespace tact::bench {
namespace {

// The vertices of an icosahedron whose facets are divided. Those on edges are shared.
class Subdivision {
 public:
  explicit Subdivision(int frequency) : frequency_(frequency) {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    for (const double s : {-1.0, 1.0}) {
      for (const double t : {-g, g}) {
        corners_.push_back({s, t, 0.0});
        corners_.push_back({0.0, s, t});
        corners_.push_back({t, 0.0, s});
      }
    }
    points_ = corners_;
  }

  // Adds the facets between the corners a, b, c of the icosahedron.
  void divide(int a, int b, int c) {
    std::vector<std::vector<int>> rows;
    for (int row = 0; row <= frequency_; ++row) {
      rows.emplace_back();
      for (int k = 0; k <= row; ++k) rows.back().push_back(vertex({a, b, c}, {frequency_ - row, row - k, k}));
    }
    for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
      for (std::size_t k = 0; k <= row; ++k) {
        facets_.push_back({rows[row][k], rows[row + 1][k], rows[row + 1][k + 1]});
        if (k < row) facets_.push_back({rows[row][k], rows[row + 1][k + 1], rows[row][k + 1]});
      }
    }
  }

  const std::vector<Eigen::Vector3d>& corners() const { return corners_; }

  Shape on_unit_sphere() const {
    Shape shape;
    shape.positions.resize(3, static_cast<Eigen::Index>(points_.size()));
    shape.facets.resize(3, static_cast<Eigen::Index>(facets_.size()));
    for (std::size_t v = 0; v < points_.size(); ++v) {
      shape.positions.col(v) = points_[v] / std::sqrt(points_[v].squaredNorm());
    }
    for (std::size_t f = 0; f < facets_.size(); ++f) shape.facets.col(f) = facets_[f];
    return shape;
  }

 private:
  // The vertex at weights (of `frequency_` in all) of three corners: a corner, on an edge, or inside.
  int vertex(std::array<int, 3> corner, std::array<int, 3> weight) {
    std::array<std::pair<int, int>, 3> parts;  // corner, weight
    for (std::size_t k = 0; k < 3; ++k) parts[k] = {corner[k], weight[k]};
    std::sort(parts.begin(), parts.end(), [](auto p, auto q) { return p.first < q.first; });
    std::vector<std::pair<int, int>> key;
    for (const auto& part : parts) {
      if (part.second > 0) key.push_back(part);
    }
    if (key.size() == 1) return key.front().first;
    if (key.size() == 3) return add(key);
    const auto [at, is_new] = shared_.try_emplace(key, 0);
    if (is_new) at->second = add(key);
    return at->second;
  }

  int add(const std::vector<std::pair<int, int>>& key) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (const auto& [corner, weight] : key) p += weight * corners_[corner];
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  int frequency_;
  std::vector<Eigen::Vector3d> corners_, points_;
  std::vector<Eigen::Vector3i> facets_;
  std::map<std::vector<std::pair<int, int>>, int> shared_;
};

}  // namespace

Shape geodesic_sphere(int frequency) {
  Subdivision subdivision(frequency);
  const std::vector<Eigen::Vector3d>& p = subdivision.corners();
  const auto near = [&](int a, int b) {  // ends of an edge, whose length is 2
    return (p[a] - p[b]).squaredNorm() < 5.0;
  };
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      for (int c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const auto at = [&](int k) { return p[k]; };
        const bool outward = at(a).dot(Eigen::Vector3d((at(b) - at(a)).cross(at(c) - at(a)))) > 0.0;
        outward ? subdivision.divide(a, b, c) : subdivision.divide(a, c, b);
      }
    }
  }
  return subdivision.on_unit_sphere();
}

Shape square_sheet(int cells, double size) {
  Shape shape;
  const int side = cells + 1;
  shape.positions.resize(3, Eigen::Index{side} * side);
  shape.facets.resize(3, 2 * Eigen::Index{cells} * cells);
  for (int row = 0; row < side; ++row) {
    for (int k = 0; k < side; ++k) {
      shape.positions.col(Eigen::Index{row} * side + k) << size * (static_cast<double>(k) / cells - 0.5),
          size * (static_cast<double>(row) / cells - 0.5), 0.0;
    }
  }
  Eigen::Index next = 0;
  for (int row = 0; row < cells; ++row) {
    for (int k = 0; k < cells; ++k) {
      const int corner = row * side + k;
      shape.facets.col(next++) << corner, corner + 1, corner + side + 1;
      shape.facets.col(next++) << corner, corner + side + 1, corner + side;
    }
  }
  return shape;
}

Shape rod(int around, int bands) {
  Shape shape;
  const int rings = bands - 1;
  shape.positions.resize(3, 2 + Eigen::Index{rings} * around);
  shape.positions.col(0).setZero();
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < around; ++k) {
      const Eigen::Vector2d p = on_circle(static_cast<double>(k) / around);
      shape.positions.col(1 + Eigen::Index{ring} * around + k) << p.x(), p.y(), static_cast<double>(ring) / (rings - 1);
    }
  }
  shape.positions.col(1 + Eigen::Index{rings} * around) << 0.0, 0.0, 1.0;
  std::vector<Eigen::Vector3i> facets;
  const auto vertex = [&](int ring, int k) { return 1 + ring * around + k % around; };
  for (int k = 0; k < around; ++k) facets.push_back({0, vertex(0, k + 1), vertex(0, k)});
  for (int ring = 0; ring + 1 < rings; ++ring) {
    for (int k = 0; k < around; ++k) {
      facets.push_back({vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k + 1)});
      facets.push_back({vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring + 1, k)});
    }
  }
  for (int k = 0; k < around; ++k)
    facets.push_back({1 + rings * around, vertex(rings - 1, k), vertex(rings - 1, k + 1)});
  shape.facets.resize(3, static_cast<Eigen::Index>(facets.size()));
  for (std::size_t f = 0; f < facets.size(); ++f) shape.facets.col(f) = facets[f];
  return shape;
}

Shape ring(double tube_radius, int around, int across) {
  Shape shape;
  shape.positions.resize(3, Eigen::Index{around} * across);
  shape.facets.resize(3, 2 * Eigen::Index{around} * across);
  const auto vertex = [&](int i, int j) { return i % around * across + j % across; };
  for (int i = 0; i < around; ++i) {
    const Eigen::Vector2d spoke = on_circle(static_cast<double>(i) / around);
    for (int j = 0; j < across; ++j) {
      const Eigen::Vector2d tube = tube_radius * on_circle(static_cast<double>(j) / across);
      shape.positions.col(vertex(i, j)) << (1.0 + tube.x()) * spoke.x(), (1.0 + tube.x()) * spoke.y(), tube.y();
      shape.facets.col(2 * vertex(i, j)) << vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1);
      shape.facets.col(2 * vertex(i, j) + 1) << vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1);
    }
  }
  return shape;
}

Shape tube(int around, int bands) {
  Shape shape;
  shape.positions.resize(3, Eigen::Index{bands + 1} * around);
  shape.facets.resize(3, 2 * Eigen::Index{bands} * around);
  const auto vertex = [&](int row, int k) { return row * around + k % around; };
  for (int row = 0; row <= bands; ++row) {
    for (int k = 0; k < around; ++k) {
      const Eigen::Vector2d p = on_circle(static_cast<double>(k) / around);
      shape.positions.col(vertex(row, k)) << p.x(), p.y(), static_cast<double>(row) / bands;
    }
  }
  Eigen::Index next = 0;
  for (int row = 0; row < bands; ++row) {
    for (int k = 0; k < around; ++k) {
      shape.facets.col(next++) << vertex(row, k), vertex(row, k + 1), vertex(row + 1, k + 1);
      shape.facets.col(next++) << vertex(row, k), vertex(row + 1, k + 1), vertex(row + 1, k);
    }
  }
  return shape;
}

Shape capsule(double length, double edge) {
  constexpr double kCap = 1.5;  // of the outline, which is cut evenly
  const double outline = 2.0 * kCap + length;
  const int bands = std::max(6, static_cast<int>(outline / edge));
  Shape shape = rod(std::max(6, static_cast<int>(6.3 / edge)), bands);
  const double end = 0.5 * outline / bands;  // the first ring is not a point
  for (Eigen::Index v = 0; v < shape.positions.cols(); ++v) {
    const Eigen::Vector2d out = shape.positions.col(v).head<2>();
    const bool is_pole = out.squaredNorm() == 0.0;
    const double along =
        is_pole ? outline * shape.positions(2, v) : end + (outline - 2.0 * end) * shape.positions(2, v);
    const double middle = std::clamp(along - kCap, 0.0, length), beyond = along - kCap - middle;
    const Eigen::Vector2d section = on_circle(0.125 + 0.25 * beyond / kCap);
    shape.positions.col(v) << section.x() * out.x(), section.x() * out.y(), middle + section.y();
  }
  return shape;
}

Shape brick(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  Shape shape;
  shape.positions.resize(3, 8);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      shape.positions(axis, corner) = (corner >> axis & 1) != 0 ? upper[axis] : lower[axis];
    }
  }
  shape.facets.resize(3, 12);
  shape.facets << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
      2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,              //
      3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
  return shape;
}

Eigen::Vector2d on_circle(double turn) {
  const double sides = 4.0 * (turn - std::floor(turn));
  const int side = static_cast<int>(sides);
  const double t = 2.0 * (sides - side) - 1.0;
  const Eigen::Vector2d p = side == 0   ? Eigen::Vector2d(1.0, t)
                            : side == 1 ? Eigen::Vector2d(-t, 1.0)
                            : side == 2 ? Eigen::Vector2d(-1.0, -t)
                                        : Eigen::Vector2d(t, -1.0);
  return p / std::sqrt(p.squaredNorm());
}

Shape shuffled(const Shape& shape, std::uint64_t seed) {
  Random random(seed);
  const std::vector<int> place = random.permutation(static_cast<int>(shape.positions.cols()));
  const std::vector<int> facet_place = random.permutation(static_cast<int>(shape.facets.cols()));
  Shape result = shape;
  for (std::size_t v = 0; v < place.size(); ++v) {
    result.positions.col(place[v]) = shape.positions.col(v);
  }
  for (std::size_t f = 0; f < facet_place.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int vertex = shape.facets(k, static_cast<Eigen::Index>(f));
      result.facets(k, facet_place[f]) = place[vertex];
    }
  }
  return result;
}

double bump(double cosine) {
  const double half = 0.5 * (1.0 + cosine), square = half * half, fourth = square * square;
  return fourth * fourth * square;
}

double wave(double phase) {
  const double t = phase - std::floor(phase);
  return t < 0.5 ? 16.0 * t * (0.5 - t) : -16.0 * (t - 0.5) * (1.0 - t);
}

}  // namespace tact::bench
