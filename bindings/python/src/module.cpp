#include <pybind11/pybind11.h>
#include <tact/version.h>

#include "bindings.h"

PYBIND11_MODULE(_tact, module) {
  module.doc() = "Finds where many deformable triangle meshes touch.";
  module.attr("__version__") = TACT_VERSION;
  tact::python::define_errors(module);
  tact::python::define_types(module);
  tact::python::define_report(module);
  tact::python::define_motion(module);
  tact::python::define_solver(module);
  tact::python::define_rotations(module);
  tact::python::define_world(module);
}
