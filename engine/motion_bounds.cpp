#include "engine/motion_bounds.h"

#include <algorithm>
#include <array>
#include <utility>

#include "narrowphase/numeric/double_double.h"

namespace tact {

using base::Box;
using narrowphase::FeatureImpact;
using narrowphase::MovingVertex;
using narrowphase::Vec3;

namespace {

// Of the distance of two features: the rest of a half of it is for rounding, and so that it does not vanish.
constexpr double kShareOfDistance = 0.45;

// The vertices of a feature in the mesh's numbers; of an edge or a vertex the last one fills up.
struct Vertices {
  std::array<int, 3> vertex{};
  std::size_t count = 0;

  Vertices(const Bodies& bodies, std::uint32_t slot, const std::array<int, 3>& sources) {
    for (const int source : sources) {
      if (source >= 0) vertex[count++] = bodies.in_slot(slot).features->vertex_of_source(source);
    }
    for (std::size_t k = std::max<std::size_t>(count, 1); k < 3; ++k) vertex[k] = vertex[k - 1];
  }
  std::span<const int> all() const { return std::span(vertex).first(count); }
};

// Where they stay.
MovingVertex begin_of(const narrowphase::MovingMesh& mesh, int vertex) {
  const Vec3 at = mesh.begin_of(vertex);
  return {{at, at}};
}

double distance_at_begin(const narrowphase::MovingMesh& a, const Vertices& of_a, const narrowphase::MovingMesh& b,
                         const Vertices& of_b, narrowphase::MeetingSearch& search) {
  const auto at_a = [&](std::size_t i) { return begin_of(a, of_a.vertex[i]); };
  const auto at_b = [&](std::size_t i) { return begin_of(b, of_b.vertex[i]); };
  if (of_a.count == 1)
    return search.distance_at_begin(narrowphase::facet_seen_from(at_a(0), {at_b(0), at_b(1), at_b(2)}));
  if (of_b.count == 1)
    return search.distance_at_begin(narrowphase::facet_seen_from(at_b(0), {at_a(0), at_a(1), at_a(2)}));
  return search.distance_at_begin(narrowphase::edge_seen_from({at_a(0), at_a(1)}, {at_b(0), at_b(1)}));
}

}  // namespace

void MotionBounds::begin(std::size_t slots) {
  ends_.resize(slots);
  for (End& end : ends_) end.is_bounded = end.lowered = end.changed = false;
}

narrowphase::MovingMesh MotionBounds::moving(const Bodies& bodies, std::uint32_t slot) const {
  narrowphase::MovingMesh mesh = bodies.moving(slot);
  if (is_bounded(slot)) mesh.end = mesh.mesh->placements().in(ends_[slot].placement.data());
  return mesh;
}

bool MotionBounds::lower(const Bodies& bodies, std::uint32_t a, std::uint32_t b, const FeatureImpact& impact) {
  const Vertices of_a(bodies, a, impact.a), of_b(bodies, b, impact.b);
  const auto above = [&](const narrowphase::HalfSpace& plane, std::uint32_t slot, const Vertices& of) {
    return std::max(narrowphase::height_over(plane, bodies.moving(slot).begin_of(of.vertex[0])), 0.0);
  };
  const double distance = bodies.plane(a) != nullptr ? above(*bodies.plane(a), b, of_b)
                          : bodies.plane(b) != nullptr
                              ? above(*bodies.plane(b), a, of_a)
                              : distance_at_begin(bodies.moving(a), of_a, bodies.moving(b), of_b, search_);
  const bool first = lower(bodies, a, of_a.all(), distance);
  return lower(bodies, b, of_b.all(), distance) || first;
}

bool MotionBounds::lower(const Bodies& bodies, std::uint32_t slot, std::span<const int> vertices, double distance) {
  if (!bodies.on_its_way(slot)) return false;
  const narrowphase::MovingMesh whole = bodies.moving(slot);
  End& end = ends_[slot];
  const auto count = static_cast<std::size_t>(whole.mesh->vertex_count());
  bool any = false;
  for (const int v : vertices) {
    const MovingVertex vertex = whole.vertex(v);
    const double way = narrowphase::length_of(vertex.at[1] - vertex.at[0]);
    const double bound = kShareOfDistance * distance / way;
    if (!(way > 0.0) || !(bound < 1.0)) continue;
    if (!std::exchange(end.is_bounded, true)) {
      end.bound.assign(count, 1.0);
      end.of_vertex.assign(count, 0);
      const std::size_t size = whole.mesh->placements().size();
      end.placement.resize(size);
      std::copy_n(whole.end.points.x, size - narrowphase::kPadding, end.placement.begin());
    }
    double& so_far = end.bound[static_cast<std::size_t>(v)];
    if (!(bound < so_far)) continue;
    so_far = bound;
    end.of_vertex[static_cast<std::size_t>(v)] = 1;
    end.lowered = any = true;
  }
  return any;
}

void MotionBounds::place(const Bodies& bodies) {
  for (std::uint32_t slot = 0; slot < ends_.size(); ++slot) {
    End& end = ends_[slot];
    end.changed = std::exchange(end.lowered, false);
    if (!end.changed) continue;
    const narrowphase::MovingMesh whole = bodies.moving(slot);
    const auto count = static_cast<std::size_t>(whole.mesh->vertex_count());
    for (std::size_t v = 0; v < count; ++v) {
      if (end.of_vertex[v] == 0) continue;
      const MovingVertex way = whole.vertex(static_cast<int>(v));
      const Vec3 at = way.at[0] + end.bound[v] * (way.at[1] - way.at[0]);
      for (std::size_t axis = 0; axis < 3; ++axis) end.placement[axis * count + v] = at[static_cast<int>(axis)];
    }
    place_boxes(*whole.mesh, end);
    std::ranges::fill(end.of_vertex, 0);
  }
}

// The boxes of clusters that have a vertex which was lowered, and of all groups.
void MotionBounds::place_boxes(const narrowphase::ClusteredMesh& mesh, End& end) const {
  const narrowphase::Placement placement = mesh.placements().in(end.placement.data());
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  const auto clusters = static_cast<std::size_t>(mesh.cluster_count()),
             groups = static_cast<std::size_t>(mesh.group_count());
  double* const cluster_boxes = end.placement.data() + 3 * count;
  end.of_cluster.assign(clusters, 0);
  for (std::size_t c = 0; c < clusters; ++c) {
    const narrowphase::ClusterFacets facets = mesh.facets_of(static_cast<int>(c), placement.points);
    Box box;
    const auto take = [&](int v) {
      if (end.of_vertex[static_cast<std::size_t>(v)] != 0) end.of_cluster[c] = 1;
      box = extended(box, {placement.points.x[v], placement.points.y[v], placement.points.z[v]});
    };
    for (int i = 0; i < facets.owned_count; ++i) take(facets.owned_begin + i);
    for (int i = 0; i < facets.borrowed_count; ++i) take(facets.borrowed[i]);
    if (end.of_cluster[c] != 0) narrowphase::set_box(cluster_boxes, clusters, c, box);
  }
  if (groups < 2) return;
  double* const group_boxes = cluster_boxes + 6 * clusters;
  for (std::size_t g = 0; g < groups; ++g) {
    const int first = mesh.cluster_begin(static_cast<int>(g)), last = mesh.cluster_end(static_cast<int>(g));
    Box box;
    for (int c = first; c < last; ++c) box = merged(box, placement.cluster_boxes[static_cast<std::size_t>(c)]);
    narrowphase::set_box(group_boxes, groups, g, box);
  }
}

void MotionBounds::copy(const Bodies& bodies, std::uint32_t slot, std::vector<double>& bounds) const {
  const narrowphase::ClusteredMesh& mesh = bodies.in_slot(slot).mesh;
  bounds.assign(static_cast<std::size_t>(mesh.source_vertex_count()), 1.0);
  if (!is_bounded(slot)) return;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    bounds[static_cast<std::size_t>(mesh.source_vertex(v))] = ends_[slot].bound[static_cast<std::size_t>(v)];
}

}  // namespace tact
