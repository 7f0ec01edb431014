#include <tact/world.h>

#include <array>
#include <span>

#include "arrays.h"
#include "bindings.h"
#include "shared_world.h"

namespace tact::python {
namespace {

template <auto kMember>
py::array_t<int> pairs_of(const SurfaceCheck& check) {
  const std::span<const std::array<int, 2>> pairs = check.*kMember;
  return rows_of<int>(pairs, 2, [](const std::array<int, 2>& pair, int* row) { row[0] = pair[0], row[1] = pair[1]; });
}

template <auto kMember>
py::array_t<int> numbers_of(const SurfaceCheck& check) {
  const std::span<const int> numbers = check.*kMember;
  return column_of<int>(numbers, [](int number) { return number; });
}

py::array_t<int> crossings_of(const SurfaceCheck& check) {
  return rows_of<int>(std::span<const FacetPair>(check.crossings), 2,
                      [](const FacetPair& pair, int* row) { row[0] = pair.a, row[1] = pair.b; });
}

SurfaceCheck check_surface(SharedWorld& world, BodyId body, double sliver) {
  SurfaceCheck check;
  world.ask([&](const World& w) { check = w.check_surface(body, sliver); });
  return check;
}

}  // namespace

void define_surface_check(py::module_& module, WorldClass& world) {
  py::class_<SurfaceComponent>(module, "SurfaceComponent", "Facets that are joined by edges.")
      .def_readonly("facet", &SurfaceComponent::facet, "the first of its facets")
      .def_readonly("facet_count", &SurfaceComponent::facet_count, "how many there are")
      .def_readonly("closed", &SurfaceComponent::closed,
                    "each edge joins two facets, which run along it in opposite directions")
      .def_readonly("inside_out", &SurfaceComponent::inside_out,
                    "closed, and its facets are clockwise seen from outside");
  py::class_<SurfaceCheck>(module, "SurfaceCheck",
                           "A body's surface, by its vertices and facets as they were added. Edges have the smaller "
                           "vertex first, and all lists are sorted.")
      .def_readonly("components", &SurfaceCheck::components, "by their first facet")
      .def_property_readonly("border_edges", pairs_of<&SurfaceCheck::border_edges>, "edges of one facet")
      .def_property_readonly("branching_edges", pairs_of<&SurfaceCheck::branching_edges>,
                             "edges of three or more facets")
      .def_property_readonly("turned_facets", numbers_of<&SurfaceCheck::turned_facets>,
                             "facets turned against most of their component")
      .def_property_readonly("crossings", crossings_of, "facets that meet beyond what neighbours share")
      .def_property_readonly("repeated_facets", pairs_of<&SurfaceCheck::repeated_facets>,
                             "a facet, and the first with the same corners")
      .def_property_readonly("repeated_vertices", pairs_of<&SurfaceCheck::repeated_vertices>,
                             "a vertex, and the first at the same place")
      .def_property_readonly("slivers", numbers_of<&SurfaceCheck::slivers>,
                             "facets of hardly any height, or of no area")
      .def_property_readonly("unused_vertices", numbers_of<&SurfaceCheck::unused_vertices>,
                             "vertices of no facet, edge or point")
      .def("is_solid", &SurfaceCheck::is_solid,
           "whether it bounds a solid: there is a component, every one is closed, and none is inside out")
      .def("is_clean", &SurfaceCheck::is_clean,
           "whether every list of faults is empty; borders are none, nor are unused vertices");
  world.def("check_surface", check_surface, py::arg("body"), py::arg("sliver") = 1e-6,
            "checks what a body's surface is: borders, turned facets, crossings with itself and more. A facet is a "
            "sliver whose height is at most `sliver` times its longest side");
}

}  // namespace tact::python
