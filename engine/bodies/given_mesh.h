// The mesh that a caller gives: vertices, and the facets, edges and points that they make.
#pragma once

#include <tact/body.h>

#include <span>
#include <string>
#include <vector>

#include "narrowphase/mesh/clustered_mesh.h"

namespace tact {

struct MeshUpdate;

/// Where the caller has its arrays.
struct MeshArguments {
  const Positions& positions;
  const Facets& facets;
  const Edges& edges;
  std::span<const int> points;
};

MeshArguments arguments_of(const BodyDefinition& definition);
MeshArguments arguments_of(const MeshUpdate& update);

/// Read and checked: views of the caller's arrays where they are packed, which then stay, else copies.
class GivenMesh {
 public:
  /// Errors: non_finite_position, position_out_of_range, facet_out_of_range.
  GivenMesh(const MeshArguments& given, const std::string& name);

  std::span<const double> positions() const { return positions_; }
  std::size_t vertex_count() const { return positions_.size() / 3; }
  /// Of the surface.
  std::span<const int> surface() const { return surface_; }
  /// Those of the surface, and behind them edges and points as facets without area: see WithoutArea.
  std::span<const int> facets() const { return facets_; }
  narrowphase::WithoutArea last() const { return last_; }
  /// Has edges and points alone, and so no inside.
  bool is_bare() const { return surface_.empty() && !facets_.empty(); }

 private:
  std::vector<double> position_copy_;
  std::vector<int> facet_copy_, all_;
  std::span<const double> positions_;
  std::span<const int> surface_, facets_;
  narrowphase::WithoutArea last_;
};

/// Throws where arrays have another shape, or hold too much for a world of so many bodies: wrong_size, too_large.
void check_shape(const MeshArguments& given, std::size_t bodies, const std::string& name);

}  // namespace tact
