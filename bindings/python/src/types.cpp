#include <pybind11/operators.h>
#include <pybind11/pybind11.h>
#include <tact/tact.h>

#include <string>

#include "bindings.h"

namespace tact::python {

namespace py = pybind11;

namespace {

std::string text_of(const BodyId& id) {
  return "tact.BodyId(index=" + std::to_string(id.index) + ", generation=" + std::to_string(id.generation) + ")";
}

void define_enums(py::module_& module) {
  py::enum_<Surface>(module, "Surface", "What a mesh is the surface of.")
      .value("closed", Surface::closed, "a solid's surface, facets counter-clockwise seen from outside")
      .value("sheet", Surface::sheet, "cloth: no inside, both sides count");
  py::enum_<Motion>(module, "Motion", "Whether a body's positions can be set.")
      .value("deformable", Motion::deformable, "they can")
      .value("fixed", Motion::fixed, "they cannot; two fixed bodies are never tested against each other")
      .value("rigid", Motion::rigid, "it keeps its shape: set_pose() turns and moves it");
  py::enum_<Accuracy>(module, "Accuracy", "What a report promises of its pairs.")
      .value("hulls", Accuracy::hulls, "direction and depth of the convex hulls; no facets")
      .value("paper", Accuracy::paper, "the three criteria of the paper; may miss facet pairs")
      .value("exact", Accuracy::exact, "every facet pair that meets and no other");
  py::enum_<DirectionPolicy>(module, "DirectionPolicy", "Where the contact direction of a pair comes from.")
      .value("carried", DirectionPolicy::carried, "from the pair's direction of the last step")
      .value("smallest", DirectionPolicy::smallest, "the smallest separation of the hulls, anew in every step");
  py::enum_<Containment>(module, "Containment", "Is one of two bodies wholly inside the other?")
      .value("none", Containment::none)
      .value("a_in_b", Containment::a_in_b)
      .value("b_in_a", Containment::b_in_a);
  py::enum_<DirectionSource>(module, "DirectionSource", "How a contact direction was found.")
      .value("carried", DirectionSource::carried, "from the direction of the last step")
      .value("fresh", DirectionSource::fresh, "from the direction that separated the hulls before")
      .value("smallest", DirectionSource::smallest, "as the smallest separation of the hulls");
}

}  // namespace

void define_types(py::module_& module) {
  define_enums(module);
  module.attr("LARGEST_COORDINATE") = kLargestCoordinate;
  py::class_<BodyId>(module, "BodyId", "Names a body of one world. It is never given out twice.")
      .def_readonly("index", &BodyId::index, "bodies of a report are ordered by it")
      .def_readonly("generation", &BodyId::generation)
      .def(py::self == py::self)
      .def(py::self != py::self)
      .def(py::self < py::self)
      .def("__hash__", [](const BodyId& id) { return std::hash<BodyId>()(id); })
      .def("__repr__", text_of);
}

}  // namespace tact::python
