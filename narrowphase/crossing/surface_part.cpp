#include "narrowphase/crossing/surface_part.h"

#include <algorithm>

#include "narrowphase/mesh/cluster_search.h"
#include "narrowphase/triangles/triangle_triangle.h"

namespace tact::narrowphase {

namespace {

void sort_once_each(std::vector<int>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

void SurfacePart::begin(const ScaledMesh& surface, const PartOfSurface& part) {
  surface_.emplace(surface);
  facets_ = part.facets;
  vertices_ = part.vertices;
  add_corners();
}

void SurfacePart::add_corners() {
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    for (const int v : surface_->features.corners(facet(i))) vertices_.push_back(surface_->mesh.source_vertex(v));
  }
  sort_once_each(vertices_);
}

std::span<const Vec3> SurfacePart::points() {
  points_.clear();
  for (const int source : vertices_) points_.push_back(surface_->position(surface_->features.vertex_of_source(source)));
  return points_;
}

// Appends to met_, by the caller's numbers.
void SurfacePart::find_met(const Triangle& triangle) {
  const ClusteredMesh& mesh = surface_->mesh;
  const Box box = box_of(triangle);
  const double back = 1.0 / surface_->scale;
  for_each_cluster_in(mesh, {back * box.lower, back * box.upper}, [&](int cluster) {
    for (int f = mesh.facet_begin(cluster); f < mesh.facet_end(cluster); ++f) {
      const Triangle t = surface_->triangle(f);
      if (overlaps(box_of(t), box) && triangle_triangle_meet(t, triangle, counts_))
        met_.push_back(mesh.source_facet(f));
    }
  });
}

bool SurfacePart::touches(int source_facet) const {
  const Corners& corners = surface_->features.corners(surface_->mesh.facet_of_source(source_facet));
  return std::ranges::any_of(
      corners, [&](int v) { return std::ranges::binary_search(vertices_, surface_->mesh.source_vertex(v)); });
}

bool SurfacePart::grow(const SurfacePart& other, Vec3 shift) {
  met_.clear();
  for (std::size_t i = 0; i < other.facets_.size(); ++i) {
    Triangle t = other.surface_->triangle(other.facet(i));
    for (Vec3& corner : t) corner = corner + shift;
    find_met(t);
  }
  sort_once_each(met_);
  std::erase_if(met_, [&](int source) { return std::ranges::binary_search(facets_, source); });
  const std::size_t before = facets_.size();
  for (std::size_t last = before + 1; last != facets_.size();) {
    last = facets_.size();
    std::erase_if(met_, [&](int source) {
      if (!touches(source)) return false;
      facets_.push_back(source);
      return true;
    });
    add_corners();
  }
  std::ranges::sort(facets_);
  return facets_.size() != before;
}

}  // namespace tact::narrowphase
