#include <pybind11/stl.h>
#include <tact/debug_draw.h>

#include "bindings.h"
#include "contact_sums.h"
#include "distances.h"
#include "drawer.h"
#include "shared_world.h"

namespace tact::python {
namespace {

void define_options(py::module_& module) {
  py::class_<DebugColor>(module, "DebugColor", "A colour; an alpha of 1 covers what is behind.")
      .def(py::init([](float red, float green, float blue, float alpha) {
             return DebugColor{red, green, blue, alpha};
           }),
           py::arg("red") = 0.0f, py::arg("green") = 0.0f, py::arg("blue") = 0.0f, py::arg("alpha") = 1.0f)
      .def_readwrite("red", &DebugColor::red)
      .def_readwrite("green", &DebugColor::green)
      .def_readwrite("blue", &DebugColor::blue)
      .def_readwrite("alpha", &DebugColor::alpha);
  using Options = DebugDrawOptions;
  py::class_<Options>(module, "DebugDrawOptions", "What is drawn, and in which colour.")
      .def(py::init([](const py::kwargs& given) {
        py::object options = py::cast(Options{});
        for (const auto& [name, value] : given) options.attr(name) = value;  // AttributeError for what is none
        return py::cast<Options>(options);
      }))
      .def_readwrite("surfaces", &Options::surfaces)
      .def_readwrite("boxes", &Options::boxes)
      .def_readwrite("candidate_pairs", &Options::candidate_pairs)
      .def_readwrite("directions", &Options::directions)
      .def_readwrite("planes", &Options::planes)
      .def_readwrite("zones", &Options::zones)
      .def_readwrite("kept_facets", &Options::kept_facets)
      .def_readwrite("facet_pairs", &Options::facet_pairs)
      .def_readwrite("patches", &Options::patches)
      .def_readwrite("points", &Options::points)
      .def_readwrite("curves", &Options::curves)
      .def_readwrite("within_reach", &Options::within_reach)
      .def_readwrite("names", &Options::names)
      .def_readwrite("surface", &Options::surface)
      .def_readwrite("box", &Options::box)
      .def_readwrite("moved_box", &Options::moved_box)
      .def_readwrite("candidate", &Options::candidate)
      .def_readwrite("direction", &Options::direction)
      .def_readwrite("plane", &Options::plane)
      .def_readwrite("zone", &Options::zone)
      .def_readwrite("kept", &Options::kept)
      .def_readwrite("meeting", &Options::meeting)
      .def_readwrite("patch", &Options::patch)
      .def_readwrite("point", &Options::point)
      .def_readwrite("curve", &Options::curve)
      .def_readwrite("reach", &Options::reach)
      .def_readwrite("distance", &Options::distance)
      .def_readwrite("sum", &Options::sum)
      .def_readwrite("force", &Options::force)
      .def_readwrite("word", &Options::word);
}

}  // namespace

void define_debug_draw(py::module_& module, WorldClass& world) {
  define_options(module);
  const auto to_draw = py::arg("drawer");
  const auto by = py::arg("options") = DebugDrawOptions{};
  world.def(
      "debug_draw",
      [](SharedWorld& shared, const OfReport<Report>& report, py::object drawer, const DebugDrawOptions& options) {
        PythonDrawer to(std::move(drawer));
        const SharedWorld::Reading reading(shared);  // the drawer may read the world
        const auto drawn = report.held();
        debug_draw(shared.read(), *drawn, to, options);
      },
      py::arg("report"), to_draw, by,
      "draws a report of this world with drawer.line(p, q, color), drawer.triangle(p, q, r, color) and "
      "drawer.text(p, words, color). The drawer can read the world and not change it");
  world.def(
      "debug_draw_distances",
      [](SharedWorld& shared, const DistanceArrays& distances, py::object given, const DebugDrawOptions& chosen) {
        PythonDrawer to(std::move(given));
        const SharedWorld::Reading reading(shared);
        debug_draw_distances(shared.read(), distances.all, to, chosen);
      },
      py::arg("distances"), to_draw, by,
      "draws distances of bodies of this world: a line between the two places, and its length");
  world.def(
      "debug_draw_sums",
      [](SharedWorld& shared, const SumArrays& sums, py::object given, const DebugDrawOptions& chosen) {
        PythonDrawer to(std::move(given));
        const SharedWorld::Reading reading(shared);
        debug_draw_sums(shared.read(), *sums.all, to, chosen);
      },
      py::arg("sums"), to_draw, by,
      "draws each patch of sums as a circle of its area across its normal, and forces as arrows, the largest half as "
      "long as all bodies");
}

}  // namespace tact::python
