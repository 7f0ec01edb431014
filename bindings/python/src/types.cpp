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
  py::enum_<Surface>(module, "Surface", "What the facets of a body are.")
      .value("closed", Surface::closed,
             "a solid's surface, facets counter-clockwise seen from outside; taken as a sheet if it has a border")
      .value("sheet", Surface::sheet, "cloth: no inside, both sides count");
  py::enum_<Motion>(module, "Motion", "How a body moves.")
      .value("deformable", Motion::deformable, "World.set_positions() moves its vertices")
      .value("fixed", Motion::fixed, "nothing moves it; two fixed bodies are never tested against each other")
      .value("rigid", Motion::rigid, "World.set_pose() turns and moves it, and its shape stays");
  py::enum_<Accuracy>(module, "Accuracy", "What a report promises of its pairs.")
      .value("hulls", Accuracy::hulls,
             "overlap, direction and depth of the convex hulls; neither zones nor facet pairs")
      .value("paper", Accuracy::paper, "the paper's three criteria, then confirmation; may miss facet pairs")
      .value("exact", Accuracy::exact, "every facet pair that meets and no other");
  py::enum_<DirectionPolicy>(module, "DirectionPolicy", "Where the contact direction of a pair comes from.")
      .value("carried", DirectionPolicy::carried,
             "the direction of the last step, so that a body leaves the way it came in")
      .value("smallest", DirectionPolicy::smallest, "the smallest separation of the hulls, from scratch in every step");
  py::enum_<Containment>(module, "Containment",
                         "Which of two bodies lies wholly inside the other, so that no facets meet.")
      .value("none", Containment::none, "neither, or Accuracy.hulls")
      .value("a_in_b", Containment::a_in_b, "a lies inside b, a closed body")
      .value("b_in_a", Containment::b_in_a, "b lies inside a, a closed body");
  py::enum_<DirectionSource>(module, "DirectionSource", "How a contact direction was found.")
      .value("carried", DirectionSource::carried, "from the direction of the last step")
      .value("fresh", DirectionSource::fresh, "from the direction that last separated the hulls")
      .value("smallest", DirectionSource::smallest, "as the smallest separation of the hulls");
}

}  // namespace

void define_types(py::module_& module) {
  define_enums(module);
  module.attr("LARGEST_COORDINATE") = kLargestCoordinate;
  py::class_<BodyId>(module, "BodyId", "Names a body of one world. No id is given out twice.")
      .def_readonly("index", &BodyId::index, "the place of the body in its world; that of a removed body is used again")
      .def_readonly("generation", &BodyId::generation)
      .def(py::self == py::self)
      .def(py::self != py::self)
      .def(py::self < py::self)
      .def("__hash__", [](const BodyId& id) { return std::hash<BodyId>()(id); })
      .def("__repr__", text_of);
}

}  // namespace tact::python
