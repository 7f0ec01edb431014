#include "scenes/files/mesh_builder.h"

#include <fmt/format.h>
#include <tact/body.h>

#include <cmath>
#include <limits>

namespace tact::scenes {
namespace {

constexpr std::size_t kMost = std::numeric_limits<int>::max();

}  // namespace

void MeshBuilder::add_vertex(const std::array<double, 3>& position) {
  if (positions_.size() / 3 >= kMost) source_.fail("more vertices than 32-bit indices can number");
  for (int axis = 0; axis < 3; ++axis) {
    const double value = position[axis];
    if (!std::isfinite(value)) source_.fail(fmt::format("{} is {}, not a finite number", "xyz"[axis], value));
    if (std::abs(value) > kLargestCoordinate) {
      source_.fail(fmt::format("{} is {}, larger in size than the largest coordinate, 2^300", "xyz"[axis], value));
    }
    positions_.push_back(value);
  }
}

int MeshBuilder::corner(std::int64_t index, std::int64_t vertices) const {
  if (index < 0 || index >= vertices) {
    source_.fail(fmt::format("names vertex {}, counted from 0, but the file has {}", index, vertices_text(vertices)));
  }
  return static_cast<int>(index);
}

void MeshBuilder::add_polygon(const std::vector<int>& corners) {
  if (corners.size() < 3) {
    source_.fail(fmt::format("has {} of the 3 corners that a polygon needs", corners.size()));
  }
  if (facets_.size() / 3 + corners.size() - 2 > kMost) source_.fail("more facets than 32-bit indices can number");
  for (std::size_t i = 2; i < corners.size(); ++i)
    facets_.insert(facets_.end(), {corners[0], corners[i - 1], corners[i]});
}

MeshFile MeshBuilder::mesh() const {
  return {Eigen::Map<const Eigen::Matrix3Xd>(positions_.data(), 3, static_cast<Eigen::Index>(positions_.size() / 3)),
          Eigen::Map<const Eigen::Matrix3Xi>(facets_.data(), 3, static_cast<Eigen::Index>(facets_.size() / 3))};
}

std::string vertices_text(std::int64_t count) {
  return fmt::format("{} {}", count, count == 1 ? "vertex" : "vertices");
}

}  // namespace tact::scenes
