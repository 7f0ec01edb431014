// The parts of the module that stand on the program's files.
#pragma once

#include <pybind11/pybind11.h>

namespace tact::python {

void define_check(pybind11::module_& module);
void define_view(pybind11::module_& module);

}  // namespace tact::python
