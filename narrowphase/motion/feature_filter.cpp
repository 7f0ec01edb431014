#include "narrowphase/motion/feature_filter.h"

#include <algorithm>
#include <cstddef>

#include "narrowphase/self/excluded_neighbors.h"

namespace tact::narrowphase {

namespace {

using Three = std::array<int, 3>;

// What a vertex or a facet is tested by.
struct Element {
  std::uint32_t layer, mask, label;
};

// -1: a plane. Edges and points have greater numbers than the facets that the lists are of.
Element element_of(const SurfaceFilter& filter, const FilterNumbers& numbers, int which) {
  const auto of_list = [&](std::span<const std::uint32_t> list, std::uint32_t otherwise) {
    const auto i = static_cast<std::size_t>(which);
    return which < 0 || i >= list.size() ? otherwise : list[i];
  };
  return {of_list(numbers.layers, filter.layer), of_list(numbers.masks, filter.mask), of_list(numbers.labels, 0)};
}

// Tells whether two vertices, or two facets, are tested against each other. Where none has layers of its own those of
// the bodies told, which a body with itself does not go by.
class Tests {
 public:
  Tests(const FilterNumbers& a, const FilterNumbers& b, std::span<const TwoLabels> excluded)
      : have_layers_(a.have_layers() || b.have_layers()), excluded_(excluded) {}
  bool operator()(const Element& x, const Element& y) const {
    if (have_layers_ && ((x.layer & y.mask) == 0 || (y.layer & x.mask) == 0)) return false;
    return !std::ranges::binary_search(excluded_, TwoLabels{x.label, y.label});
  }

 private:
  bool have_layers_;
  std::span<const TwoLabels> excluded_;
};

// Whether holds(element) for any facet, edge or point of the surface that has the vertices.
template <class Holds>
bool any_facet(const SurfaceFilter& filter, const Three& vertices, const Holds& holds) {
  if (filter.of_facets.are_uniform() || vertices[0] < 0) return holds(element_of(filter, filter.of_facets, -1));
  const ClusteredMesh& mesh = *filter.surface.mesh;
  const Features& features = *filter.surface.features;
  return std::ranges::any_of(features.facets_at(features.vertex_of_source(vertices[0])), [&](int facet) {
    const Corners& corners = features.corners(facet);
    const auto has = [&](int v) {
      return v < 0 || std::ranges::any_of(corners, [&](int corner) { return mesh.source_vertex(corner) == v; });
    };
    return has(vertices[1]) && has(vertices[2]) &&
           holds(element_of(filter, filter.of_facets, mesh.source_facet(facet)));
  });
}

}  // namespace

bool FeatureFilter::is_uniform() const {
  return a.of_vertices.are_uniform() && b.of_vertices.are_uniform() && !is_of_facets() && neighbors == nullptr;
}

bool FeatureFilter::allows_vertices(const Three& vertices_a, const Three& vertices_b) const {
  const bool by_lists = !a.of_vertices.are_uniform() || !b.of_vertices.are_uniform();
  if (!by_lists && neighbors == nullptr) return true;
  const Tests are_tested(a.of_vertices, b.of_vertices, excluded_of_vertices);
  for (std::size_t i = 0; i < 3 && (i == 0 || vertices_a[i] >= 0); ++i) {
    const Element of_a = element_of(a, a.of_vertices, vertices_a[i]);
    for (std::size_t k = 0; k < 3 && (k == 0 || vertices_b[k] >= 0); ++k) {
      if (by_lists && !are_tested(of_a, element_of(b, b.of_vertices, vertices_b[k]))) return false;
      if (neighbors != nullptr && neighbors->has(vertices_a[i], vertices_b[k])) return false;
    }
  }
  return true;
}

bool FeatureFilter::allows_facets(int facet_a, int facet_b) const {
  return !is_of_facets() || Tests(a.of_facets, b.of_facets, excluded_of_facets)(element_of(a, a.of_facets, facet_a),
                                                                                element_of(b, b.of_facets, facet_b));
}

bool FeatureFilter::allows_any_facets(const Three& vertices_a, const Three& vertices_b) const {
  const Tests are_tested(a.of_facets, b.of_facets, excluded_of_facets);
  return any_facet(a, vertices_a, [&](const Element& of_a) {
    return any_facet(b, vertices_b, [&](const Element& of_b) { return are_tested(of_a, of_b); });
  });
}

}  // namespace tact::narrowphase
