#include "scenes/files/mesh_builder.h"

#include <fmt/format.h>
#include <tact/body.h>

#include <cmath>
#include <limits>

#include "scenes/files/polygon.h"

namespace tact::scenes {
namespace {

constexpr std::size_t kMost = std::numeric_limits<int>::max();

Eigen::Matrix3Xi columns_of(const std::vector<int>& facets) {
  return Eigen::Map<const Eigen::Matrix3Xi>(facets.data(), 3, static_cast<Eigen::Index>(facets.size() / 3));
}

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
  if (corners.size() > 3 && split_ == Split::by_shape)
    polygons_.push_back({facets_.size() / 3, corners.size(), source_.place()});
  for (std::size_t i = 2; i < corners.size(); ++i)
    facets_.insert(facets_.end(), {corners[0], corners[i - 1], corners[i]});
}

std::array<double, 3> MeshBuilder::position_of(int vertex) const {
  const auto at = 3 * static_cast<std::size_t>(vertex);
  return {positions_[at], positions_[at + 1], positions_[at + 2]};
}

std::vector<int> MeshBuilder::split_polygons() {
  std::vector<int> fans, corners;
  std::vector<std::array<double, 3>> positions;
  for (const Polygon& polygon : polygons_) {
    const std::size_t begin = 3 * polygon.facet;
    corners = {facets_[begin], facets_[begin + 1]};
    for (std::size_t i = 2; i < polygon.corners; ++i) corners.push_back(facets_[begin + 3 * i - 4]);
    positions.clear();
    for (const int corner : corners) positions.push_back(position_of(corner));
    const PolygonSplit split = split_polygon(positions);
    if (split.kind == PolygonSplit::fan) continue;
    if (split.kind == PolygonSplit::not_simple) {
      source_.set_item("facet", static_cast<std::int64_t>(polygon.facet));
      source_.fail_at(polygon.place,
                      fmt::format("the polygon of {} corners crosses or touches itself, seen along its normal: it has "
                                  "more than one surface",
                                  polygon.corners));
    }
    if (fans.empty()) fans = facets_;
    for (std::size_t i = 0; i < split.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) facets_[begin + 3 * i + k] = corners[split.triangles[i][k]];
    }
  }
  return fans;
}

MeshFile MeshBuilder::mesh() {
  const std::vector<int> fans = split_polygons();
  return {.positions = Eigen::Map<const Eigen::Matrix3Xd>(positions_.data(), 3,
                                                          static_cast<Eigen::Index>(positions_.size() / 3)),
          .facets = columns_of(facets_),
          .fans = columns_of(fans),
          .warnings = source_.warnings()};
}

std::string vertices_text(std::int64_t count) {
  return fmt::format("{} {}", count, count == 1 ? "vertex" : "vertices");
}

}  // namespace tact::scenes
