// The meshes of bodies as a program sees them: copied when they are first looked at.
#pragma once

#include <tact/world.h>

#include <array>
#include <unordered_map>
#include <vector>

#include "engine/base/vec3.h"

namespace tact {

/// Places that a report names may be of a mesh that has changed since: Errors: wrong_order.
class MeshCopy {
 public:
  MeshCopy(const World& world, BodyId body);

  base::Vec3 vertex(int v) const;
  base::Vec3 place(const std::array<int, 3>& vertices, const std::array<double, 3>& weights) const;
  /// Facets, then edges, then points, as queries count them; -1 fills up.
  std::array<int, 3> corners(int facet) const;
  std::array<base::Vec3, 3> facet(int f) const;
  int facet_count() const { return static_cast<int>(facets_.size() / 3); }
  const std::vector<int>& ends() const { return ends_; }
  const std::vector<int>& points() const { return points_; }

 private:
  friend class MeshCopies;
  void copy_features(const World& world, BodyId body);

  std::vector<double> coordinates_;
  std::vector<int> facets_, ends_, points_;
  bool has_features_ = false;
};

class MeshCopies {
 public:
  /// The world outlives this.
  explicit MeshCopies(const World& world) : world_(world) {}
  /// The positions of a body. Errors: stale_body.
  const MeshCopy& positions(BodyId body) { return copy_of(body); }
  /// Its facets, edges and points as well.
  const MeshCopy& mesh(BodyId body);

 private:
  MeshCopy& copy_of(BodyId body);

  const World& world_;
  std::unordered_map<BodyId, MeshCopy> copies_;
};

}  // namespace tact
