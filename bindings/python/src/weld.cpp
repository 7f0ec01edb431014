#include <tact/weld.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "arrays.h"
#include "bindings.h"

namespace tact::python {

namespace {

struct NumpyMesh {
  py::array_t<double> positions;
  py::array_t<int> facets;
  py::array_t<int> vertex_of;
  int merged_vertices;
  int collapsed_facets;
};

template <class Number>
py::array_t<Number> rows_from(const std::vector<Number>& columns) {
  py::array_t<Number> array({static_cast<py::ssize_t>(columns.size() / 3), py::ssize_t{3}});
  std::ranges::copy(columns, array.mutable_data());
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

NumpyMesh weld_numpy(py::handle positions, py::handle facets) {
  const PositionsArgument vertices(positions);
  const FacetsArgument corners(facets);
  const WeldedArrays mesh = weld_arrays(vertices.columns(), corners.columns());
  return {rows_from(mesh.positions), rows_from(mesh.facets),
          column_of<int>(std::span<const int>(mesh.vertex_of), [](int vertex) { return vertex; }), mesh.merged_vertices,
          mesh.collapsed_facets};
}

}  // namespace

void define_weld(py::module_& module) {
  py::class_<NumpyMesh>(module, "WeldedMesh", "A mesh in which no two vertices have equal positions.")
      .def_readonly("positions", &NumpyMesh::positions, "(V, 3): of each place the first vertex that was given. Metres")
      .def_readonly("facets", &NumpyMesh::facets, "(F, 3): all that were given, in their order")
      .def_readonly("vertex_of", &NumpyMesh::vertex_of, "for each vertex that was given, its vertex in this mesh")
      .def_readonly("merged_vertices", &NumpyMesh::merged_vertices,
                    "how many vertices became one with an earlier vertex")
      .def_readonly("collapsed_facets", &NumpyMesh::collapsed_facets,
                    "how many facets have a vertex twice that had three")
      .def("__repr__", [](const NumpyMesh& mesh) {
        return "<tact.WeldedMesh of " + std::to_string(mesh.positions.shape(0)) + " vertices, " +
               std::to_string(mesh.merged_vertices) + " merged>";
      });
  module.def("weld", &weld_numpy, py::arg("positions"), py::arg("facets"),
             "a mesh without the vertices that repeat an earlier position; 0 and -0 are equal");
}

}  // namespace tact::python
