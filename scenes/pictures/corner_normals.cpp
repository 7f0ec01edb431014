#include "scenes/pictures/corner_normals.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/base/parallel.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kFacetsAtATime = 4096;

// The corners (3f + k) around each vertex, in rising order.
struct VertexCorners {
  std::vector<int> first;  // of vertex v: corners[first[v]] to corners[first[v + 1]]
  std::vector<int> corners;
};

VertexCorners corners_around(const Eigen::Matrix3Xi& facets, Eigen::Index vertices) {
  VertexCorners result;
  result.first.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const int vertex : facets.reshaped()) ++result.first[static_cast<std::size_t>(vertex) + 1];
  for (std::size_t v = 1; v < result.first.size(); ++v) result.first[v] += result.first[v - 1];
  std::vector<int> next(result.first.begin(), result.first.end() - 1);
  result.corners.resize(facets.size());
  int corner = 0;
  for (const int vertex : facets.reshaped()) {
    result.corners[next[vertex]++] = corner++;
  }
  return result;
}

}  // namespace

Eigen::Matrix3Xf corner_normals(const Eigen::Matrix3Xf& positions, const Eigen::Matrix3Xi& facets, double crease,
                                int threads) {
  const auto facet_count = static_cast<std::size_t>(facets.cols());
  Eigen::Matrix3Xf normals(3, facets.cols());
  Eigen::VectorXf angles(facets.size());
  base::parallel_for(facet_count, kFacetsAtATime, threads, [&](std::size_t facet) {
    const auto f = static_cast<Eigen::Index>(facet);
    const auto at = [&](int corner) -> Eigen::Vector3f { return positions.col(facets(corner, f)); };
    normals.col(f) = (at(1) - at(0)).cross(at(2) - at(0)).stableNormalized();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f to_next = at((k + 1) % 3) - at(k);
      const Eigen::Vector3f to_last = at((k + 2) % 3) - at(k);
      angles[3 * f + k] = std::atan2(to_next.cross(to_last).norm(), to_next.dot(to_last));
    }
  });

  const VertexCorners around = corners_around(facets, positions.cols());
  const auto least_cosine = static_cast<float>(std::cos(crease * std::numbers::pi / 180.0));
  Eigen::Matrix3Xf result(3, facets.size());
  base::parallel_for(facet_count, kFacetsAtATime, threads, [&](std::size_t facet) {
    const auto f = static_cast<Eigen::Index>(facet);
    for (int k = 0; k < 3; ++k) {
      const auto vertex = static_cast<std::size_t>(facets(k, f));
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int i = around.first[vertex]; i < around.first[vertex + 1]; ++i) {
        const int corner = around.corners[i];
        const auto normal = normals.col(corner / 3);
        if (normal.dot(normals.col(f)) >= least_cosine) sum += angles[corner] * normal;
      }
      result.col(3 * f + k) = sum.stableNormalized();
    }
  });
  return result;
}

}  // namespace tact::scenes
