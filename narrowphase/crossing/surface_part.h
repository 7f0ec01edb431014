// A part of a surface: some of its facets and vertices, in an order that does not depend on how facets are grouped.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "narrowphase/contact_points/scaled_mesh.h"
#include "narrowphase/numeric/predicates.h"

namespace tact::narrowphase {

/// By the caller's numbers; facets are sorted, each once.
struct PartOfSurface {
  std::vector<int> facets, vertices;
};

/// Lengths are scaled. Buffers are reused.
class SurfacePart {
 public:
  /// Takes facets, with their corners, and more vertices. The surface must not move until the next call.
  void begin(const ScaledMesh& surface, const PartOfSurface& part);
  /// Takes those facets of the surface that meet `other` moved by `shift` and are connected to the part by common
  /// vertices. False if there are none.
  bool grow(const SurfacePart& other, Vec3 shift);

  const ScaledMesh& surface() const { return *surface_; }
  /// By the caller's numbers, sorted.
  std::span<const int> facets() const { return facets_; }
  std::span<const int> vertices() const { return vertices_; }
  /// The facet at a place of facets(), by the mesh's number.
  int facet(std::size_t i) const { return surface_->mesh.facet_of_source(facets_[i]); }
  /// Where the vertices are, in their order.
  std::span<const Vec3> points();

 private:
  void add_corners();
  void find_met(const Triangle& triangle);
  bool touches(int source_facet) const;

  std::optional<ScaledMesh> surface_;
  std::vector<int> facets_, vertices_, met_;
  std::vector<Vec3> points_;
  PredicateCounts counts_;
};

}  // namespace tact::narrowphase
