// Settings of single vertices and facets, and rest offsets, as methods of World.
#include <pybind11/stl.h>
#include <tact/world.h>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "shared_world.h"

namespace tact::python {

namespace {

struct FeatureArraysOfBody {
  py::array_t<double> rest_offsets;
  py::array_t<std::uint32_t> vertex_labels, facet_labels, vertex_layers, vertex_masks;
};

template <class Number>
py::array_t<Number> copied(std::span<const Number> values) {
  return column_of<Number>(values, [](Number value) { return value; });
}

FeatureArraysOfBody feature_settings(SharedWorld& world, BodyId body) {
  const FeatureSettings settings = world.read().feature_settings(body);
  return {copied(settings.rest_offsets), copied(settings.vertex_labels), copied(settings.facet_labels),
          copied(settings.vertex_layers), copied(settings.vertex_masks)};
}

py::array_t<std::uint32_t> labels(SharedWorld& world, BodyId body, py::handle vertices) {
  const FacetsArgument given(vertices);
  const Facets rows = given.columns();
  std::vector<FeatureLabels> found;
  for (std::ptrdiff_t i = 0; i < rows.cols(); ++i) found.push_back(world.read().labels(body, rows.column(i)));
  return rows_of<std::uint32_t>(std::span<const FeatureLabels>(found), 4,
                                [](const FeatureLabels& one, std::uint32_t* row) {
                                  std::ranges::copy(one.vertices, row);
                                  row[3] = one.facet;
                                });
}

}  // namespace

void define_feature_settings(py::module_& module, WorldClass& world) {
  py::class_<FeatureArraysOfBody>(module, "FeatureSettings",
                                  "Settings of single vertices and facets of a body. An empty array sets nothing.")
      .def_readonly("rest_offsets", &FeatureArraysOfBody::rest_offsets,
                    "(V,): what each vertex adds to the distance that surfaces keep, metres, 0 to the margin")
      .def_readonly("vertex_labels", &FeatureArraysOfBody::vertex_labels,
                    "(V,): the program's own numbers, one a vertex")
      .def_readonly("facet_labels", &FeatureArraysOfBody::facet_labels, "(F,): the program's own numbers, one a facet")
      .def_readonly("vertex_layers", &FeatureArraysOfBody::vertex_layers,
                    "(V,): the layers that each vertex is on, a bit each; by default those of the body")
      .def_readonly("vertex_masks", &FeatureArraysOfBody::vertex_masks,
                    "(V,): the layers that each vertex is tested against; by default those of the body");
  world
      .def(
          "set_rest_offset",
          [](SharedWorld& w, BodyId body, std::optional<double> rest_offset) {
            w.use().set_rest_offset(body, rest_offset);
          },
          py::arg("body"), py::arg("rest_offset"),
          "sets what a body adds to the distance that surfaces keep, metres; none takes the margin, whatever that "
          "becomes")
      .def(
          "rest_offset", [](SharedWorld& w, BodyId body) { return w.read().rest_offset(body); }, py::arg("body"),
          "the rest offset of a body, or its margin, metres")
      .def(
          "set_feature_settings",
          [](SharedWorld& w, BodyId body, py::handle rest_offsets, py::handle vertex_labels, py::handle facet_labels,
             py::handle vertex_layers, py::handle vertex_masks) {
            const FeatureSettingsArgument given(rest_offsets, vertex_labels, facet_labels, vertex_layers, vertex_masks);
            w.use().set_feature_settings(body, given.settings());
          },
          py::arg("body"), py::kw_only(), py::arg("rest_offsets") = py::list(), py::arg("vertex_labels") = py::list(),
          py::arg("facet_labels") = py::list(), py::arg("vertex_layers") = py::list(),
          py::arg("vertex_masks") = py::list(),
          "replaces the settings of single vertices and facets of a body. (V,), facet_labels (F,); an empty array sets "
          "nothing")
      .def("feature_settings", feature_settings, py::arg("body"),
           "the settings of single vertices and facets of a body, copied")
      .def("labels", labels, py::arg("body"), py::arg("vertices"),
           "the labels of a feature of a body, whose vertices are named as in a point, a pair or an impact. (N, 3) "
           "gives (N, 4): those of the vertices, and that of the facet, or of the first facet that has the vertex or "
           "the edge");
}

}  // namespace tact::python
