#include <pybind11/pybind11.h>
#include <tact/version.h>

#include "bindings.h"
#include "file_bindings.h"

namespace {

namespace py = pybind11;

// Makes an object whose __init__() never ran refuse every call: pybind11 would give it memory that nobody has filled.
void refuse_unmade_objects(const py::module_& module) {
  for (const auto& [name, value] : py::cast<py::dict>(module.attr("__dict__"))) {
    if (!py::isinstance<py::type>(value)) continue;
    py::detail::type_info* info = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr()));
    if (info == nullptr) continue;
    info->operator_new = [](std::size_t) -> void* { throw py::type_error("__init__() of this object did not run"); };
  }
}

}  // namespace

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
  tact::python::define_weld(module);
  tact::python::define_check(module);
  tact::python::define_view(module);
  refuse_unmade_objects(module);
}
