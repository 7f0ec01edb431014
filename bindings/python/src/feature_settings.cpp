// Settings of single vertices and facets, what is left out below the body, and rest offsets, as methods of World.
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
  py::array_t<std::uint32_t> vertex_labels, facet_labels, vertex_layers, vertex_masks, facet_layers, facet_masks;
  py::array_t<double> margins;
};

template <class Number>
py::array_t<Number> copied(std::span<const Number> values) {
  return column_of<Number>(values, [](Number value) { return value; });
}

FeatureArraysOfBody feature_settings(SharedWorld& world, BodyId body) {
  const FeatureSettings settings = world.read().feature_settings(body);
  return {copied(settings.rest_offsets),  copied(settings.vertex_labels), copied(settings.facet_labels),
          copied(settings.vertex_layers), copied(settings.vertex_masks),  copied(settings.facet_layers),
          copied(settings.facet_masks),   copied(settings.margins)};
}

py::array_t<std::uint32_t> labels(SharedWorld& world, BodyId body, py::handle vertices) {
  const FacetsArgument given(vertices, "vertices");
  const Facets rows = given.columns();
  std::vector<FeatureLabels> found;
  for (std::ptrdiff_t i = 0; i < rows.cols(); ++i) found.push_back(world.read().labels(body, rows.column(i)));
  return rows_of<std::uint32_t>(std::span<const FeatureLabels>(found), 4,
                                [](const FeatureLabels& one, std::uint32_t* row) {
                                  std::ranges::copy(one.vertices, row);
                                  row[3] = one.facet;
                                });
}

// As the engine has it, with positions of its own.
struct SelfContactFilterOfBody {
  int rings;
  double rest_distance;
  py::array_t<double> rest_positions;
};

SelfContactFilterOfBody self_contact_filter(SharedWorld& world, BodyId body) {
  const SelfContactFilter filter = world.read().self_contact_filter(body);
  const std::span<const double> rest{filter.rest_positions.data(),
                                     3 * static_cast<std::size_t>(filter.rest_positions.cols())};
  return {filter.rings, filter.rest_distance, copied(rest).reshape({-1, 3})};
}

void set_self_contact_filter(SharedWorld& world, BodyId body, int rings, double rest_distance, py::handle rest) {
  std::optional<PositionsArgument> given;
  if (!rest.is_none()) given.emplace(rest, "rest_positions");
  world.use().set_self_contact_filter(
      body,
      {.rings = rings, .rest_distance = rest_distance, .rest_positions = given ? given->columns() : Positions::none()});
}

void define_pairs(py::module_& module, WorldClass& world) {
  py::enum_<LabelKind>(module, "LabelKind", "What has a label.")
      .value("facet", LabelKind::facet, "facets, and edges and vertices that only such facets have")
      .value("vertex", LabelKind::vertex, "vertices, and the edges and facets that have any of them");
  py::class_<SelfContactFilterOfBody>(
      module, "SelfContactFilter",
      "Which features of a body that is tested against itself are too near to each other to be tested.")
      .def_readonly("rings", &SelfContactFilterOfBody::rings,
                    "features with vertices at most so many edges apart are left out, 0 to 16; 0 leaves out those "
                    "with a common vertex alone")
      .def_readonly("rest_distance", &SelfContactFilterOfBody::rest_distance,
                    "features with vertices at most so far apart at rest are left out, metres, 0 to "
                    "LARGEST_COORDINATE; 0 leaves out none")
      .def_readonly("rest_positions", &SelfContactFilterOfBody::rest_positions,
                    "(V, 3): where vertices are at rest, metres; by default where they are when the filter is set");
  world
      .def("set_self_contact_filter", set_self_contact_filter, py::arg("body"), py::kw_only(), py::arg("rings") = 0,
           py::arg("rest_distance") = 0.0, py::arg("rest_positions") = py::none(),
           "sets which features of a body are too near to each other to be tested against each other. Positions at "
           "rest: (V, 3) metres, by default where vertices are now")
      .def("self_contact_filter", self_contact_filter, py::arg("body"),
           "which features of a body are too near to be tested, copied")
      .def(
          "set_excluded_labels",
          [](SharedWorld& w, BodyId a, std::uint32_t label_a, BodyId b, std::uint32_t label_b, bool excluded,
             LabelKind kind) {
            w.use().set_excluded_labels({a, label_a, b, label_b, kind}, excluded);
          },
          py::arg("a"), py::arg("label_a"), py::arg("b"), py::arg("label_b"), py::arg("excluded"), py::kw_only(),
          py::arg("kind") = LabelKind::facet,
          "sets whether features of two labels are excluded from tests: a collar and what it is sewn to, say")
      .def(
          "excluded_labels",
          [](SharedWorld& w, BodyId a, std::uint32_t label_a, BodyId b, std::uint32_t label_b, LabelKind kind) {
            return w.read().excluded_labels({a, label_a, b, label_b, kind});
          },
          py::arg("a"), py::arg("label_a"), py::arg("b"), py::arg("label_b"), py::kw_only(),
          py::arg("kind") = LabelKind::facet);
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
                    "(V,): the layers that each vertex is tested against; by default those of the body")
      .def_readonly("facet_layers", &FeatureArraysOfBody::facet_layers,
                    "(F,): the layers that each facet is on, a bit each; by default those of the body")
      .def_readonly("facet_masks", &FeatureArraysOfBody::facet_masks,
                    "(F,): the layers that each facet is tested against; by default those of the body")
      .def_readonly("margins", &FeatureArraysOfBody::margins,
                    "(V,): how far ahead of each vertex contact points are seen, metres, 0 to the margin of the body");
  define_pairs(module, world);
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
             py::handle vertex_layers, py::handle vertex_masks, py::handle facet_layers, py::handle facet_masks,
             py::handle margins) {
            const FeatureSettingsArgument given(rest_offsets, vertex_labels, facet_labels, vertex_layers, vertex_masks,
                                                facet_layers, facet_masks, margins);
            w.use().set_feature_settings(body, given.settings());
          },
          py::arg("body"), py::kw_only(), py::arg("rest_offsets") = py::list(), py::arg("vertex_labels") = py::list(),
          py::arg("facet_labels") = py::list(), py::arg("vertex_layers") = py::list(),
          py::arg("vertex_masks") = py::list(), py::arg("facet_layers") = py::list(),
          py::arg("facet_masks") = py::list(), py::arg("margins") = py::list(),
          "replaces the settings of single vertices and facets of a body. (V,), those of facets (F,); an empty array "
          "sets nothing")
      .def("feature_settings", feature_settings, py::arg("body"),
           "the settings of single vertices and facets of a body, copied")
      .def("labels", labels, py::arg("body"), py::arg("vertices"),
           "the labels of a feature of a body, whose vertices are named as in a point, a pair or an impact. (N, 3) "
           "gives (N, 4): those of the vertices, and that of the facet, or of the first facet that has the vertex or "
           "the edge");
}

}  // namespace tact::python
