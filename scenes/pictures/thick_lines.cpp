#include "scenes/pictures/thick_lines.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

constexpr int kTubeSides = 6;

// Vertices and facets behind those of a body.
class Addition {
 public:
  explicit Addition(PictureBody& body) : body_(body), first_(static_cast<int>(body.positions.cols())) {}
  ~Addition() {
    const Eigen::Index vertices = body_.positions.cols(), facets = body_.facets.cols();
    body_.positions.conservativeResize(3, vertices + std::ssize(vertices_));
    body_.facets.conservativeResize(3, facets + std::ssize(facets_));
    for (std::size_t v = 0; v < vertices_.size(); ++v)
      body_.positions.col(vertices + static_cast<Eigen::Index>(v)) = vertices_[v];
    for (std::size_t f = 0; f < facets_.size(); ++f)
      body_.facets.col(facets + static_cast<Eigen::Index>(f)) = facets_[f];
  }
  Addition(const Addition&) = delete;
  Addition& operator=(const Addition&) = delete;

  int vertex(const Eigen::Vector3d& at) {
    vertices_.push_back(at);
    return first_ + static_cast<int>(vertices_.size()) - 1;
  }
  void facet(int a, int b, int c) { facets_.emplace_back(a, b, c); }

 private:
  PictureBody& body_;
  int first_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Eigen::Vector3i> facets_;
};

void add_tube(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, Addition& addition) {
  const Eigen::Vector3d along = to - from;
  if (!(along.norm() > 0.0)) return;
  const Eigen::Vector3d u = along.unitOrthogonal(), v = along.normalized().cross(u);
  std::array<int, 2 * kTubeSides> ring{};
  for (int k = 0; k < kTubeSides; ++k) {
    const double turn = 2.0 * EIGEN_PI * k / kTubeSides;
    const Eigen::Vector3d out = radius * (std::cos(turn) * u + std::sin(turn) * v);
    ring[2 * k] = addition.vertex(from + out);
    ring[2 * k + 1] = addition.vertex(to + out);
  }
  for (int k = 0; k < kTubeSides; ++k) {
    const int next = (k + 1) % kTubeSides;
    addition.facet(ring[2 * k], ring[2 * next], ring[2 * next + 1]);
    addition.facet(ring[2 * k], ring[2 * next + 1], ring[2 * k + 1]);
  }
}

void add_ball(const Eigen::Vector3d& middle, const Mesh& ball, Addition& addition) {
  std::vector<int> vertices;
  for (const Vec3& p : ball.positions) vertices.push_back(addition.vertex(middle + Eigen::Vector3d(p.x, p.y, p.z)));
  for (const auto& facet : ball.facets.colwise())
    addition.facet(vertices[facet[0]], vertices[facet[1]], vertices[facet[2]]);
}

}  // namespace

void add_thick_lines(const Eigen::Matrix2Xi& edges, std::span<const int> grains, double radius, PictureBody& body) {
  if (edges.cols() == 0 && grains.empty()) return;
  const Eigen::Matrix3Xd positions = body.positions;
  Addition addition(body);
  for (const auto& edge : edges.colwise()) add_tube(positions.col(edge[0]), positions.col(edge[1]), radius, addition);
  const Mesh ball = sphere(2, radius);
  for (const int v : grains) add_ball(positions.col(v), ball, addition);
}

}  // namespace tact::scenes
