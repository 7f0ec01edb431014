#include "narrowphase/self/excluded_neighbors.h"

#include <cmath>

namespace tact::narrowphase {

namespace {

// The vertices around one, ring after ring; memory is used again.
class RingWalk {
 public:
  explicit RingWalk(const FeaturedMesh& surface)
      : features_(*surface.features), seen_from_(static_cast<std::size_t>(surface.mesh->vertex_count()), -1) {}

  // By the mesh's numbers, without the vertex itself.
  std::span<const int> walk(int vertex, int rings) {
    found_.assign(1, vertex);
    seen_from_[static_cast<std::size_t>(vertex)] = vertex;
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t end = found_.size();
      for (; begin < end; ++begin) {
        for (const int next : features_.neighbors(found_[begin])) {
          int& from = seen_from_[static_cast<std::size_t>(next)];
          if (from == vertex) continue;
          from = vertex;
          found_.push_back(next);
        }
      }
    }
    return std::span<const int>(found_).subspan(1);
  }

 private:
  const Features& features_;
  std::vector<int> seen_from_, found_;
};

}  // namespace

ExcludedNeighbors::ExcludedNeighbors(const FeaturedMesh& surface, int rings, double distance,
                                     std::span<const double> rest)
    : rings_(rings), distance_(distance), rest_(rest) {
  if (rings == 0) return;
  RingWalk walk(surface);
  const ClusteredMesh& mesh = *surface.mesh;
  for (int source = 0; source < mesh.source_vertex_count(); ++source) {
    begin_.push_back(near_.size());
    const int vertex = surface.features->vertex_of_source(source);
    if (vertex < 0) continue;
    for (const int one : walk.walk(vertex, rings)) near_.push_back(mesh.source_vertex(one));
    std::sort(near_.begin() + static_cast<std::ptrdiff_t>(begin_.back()), near_.end());
  }
  begin_.push_back(near_.size());
}

// Ways are divided by the distance before they are squared: no square of a small one vanishes.
bool ExcludedNeighbors::is_near_at_rest(int v, int w) const {
  const double *const from = &rest_[3 * static_cast<std::size_t>(v)], *const to =
                                                                          &rest_[3 * static_cast<std::size_t>(w)];
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = std::abs(to[axis] - from[axis]);
    if (way > distance_) return false;
    const double part = way / distance_;
    square += part * part;
  }
  return square <= 1.0;
}

}  // namespace tact::narrowphase
