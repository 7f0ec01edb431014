// The parts of the module, in the order in which they are defined.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

namespace tact::python {

void define_errors(pybind11::module_& module);
void define_types(pybind11::module_& module);
void define_report(pybind11::module_& module);
void define_motion(pybind11::module_& module);
void define_solver(pybind11::module_& module);
void define_rotations(pybind11::module_& module);
class SharedWorld;
using WorldClass = pybind11::class_<SharedWorld, std::shared_ptr<SharedWorld>>;
void define_contact_sums(pybind11::module_& module, WorldClass& world);
void define_feature_settings(pybind11::module_& module, WorldClass& world);
void define_queries(pybind11::module_& module, WorldClass& world);
void define_body_queries(pybind11::module_& module, WorldClass& world);
void define_surface_check(pybind11::module_& module, WorldClass& world);
void define_recording(pybind11::module_& module, WorldClass& world);
void define_debug_draw(pybind11::module_& module, WorldClass& world);
void define_world(pybind11::module_& module);
void define_weld(pybind11::module_& module);

}  // namespace tact::python
