// The parts of the module, in the order in which they are defined.
#pragma once

#include <pybind11/pybind11.h>

namespace tact::python {

void define_errors(pybind11::module_& module);
void define_types(pybind11::module_& module);
void define_report(pybind11::module_& module);
void define_motion(pybind11::module_& module);
void define_world(pybind11::module_& module);

}  // namespace tact::python
