#include <pybind11/pybind11.h>
#include <tact/error.h>

#include <exception>

#include "bindings.h"
#include "shared_world.h"
#include "text.h"

namespace tact::python {

namespace {

// The interpreter keeps both for as long as it lives: they are not counted down, as nobody is left to do so at its end.
PyObject* g_error = nullptr;
PyObject* g_stale_report = nullptr;

void raise(const Error& error) {
  const py::object raised = py::reinterpret_borrow<py::object>(g_error)(sentence(error.what()));
  raised.attr("code") = py::cast(error.code());
  PyErr_SetObject(g_error, raised.ptr());
}

}  // namespace

void define_errors(py::module_& module) {
  py::enum_<ErrorCode>(module, "ErrorCode", "What was wrong with the data of a call.")
      .value("non_finite_position", ErrorCode::non_finite_position, "a coordinate is NaN or infinite")
      .value("position_out_of_range", ErrorCode::position_out_of_range,
             "a coordinate has a magnitude above LARGEST_COORDINATE")
      .value("facet_out_of_range", ErrorCode::facet_out_of_range, "a facet names a vertex that the body does not have")
      .value("wrong_size", ErrorCode::wrong_size, "a matrix or an array has the wrong size")
      .value("too_large", ErrorCode::too_large, "more than 2^29 - 1 vertices or facets, or 2^32 - 1 bodies")
      .value("stale_body", ErrorCode::stale_body, "the body was removed, or never added")
      .value("foreign_body", ErrorCode::foreign_body, "the body is of another world")
      .value("fixed_body", ErrorCode::fixed_body, "positions or a pose were set on a body whose motion is fixed")
      .value("bad_settings", ErrorCode::bad_settings, "a setting is out of range; the message names it")
      .value("wrong_order", ErrorCode::wrong_order, "a call came at the wrong time, or a batch names a body twice")
      .value("out_of_memory", ErrorCode::out_of_memory, "an allocation failed")
      .value("backend_failure", ErrorCode::backend_failure, "Embree reported an error; the message holds its code")
      .value("bad_recording", ErrorCode::bad_recording, "the bytes are no recording, or one that does not play")
      .value("wrong_motion", ErrorCode::wrong_motion,
             "positions were set on a rigid body, or a pose on a deformable one")
      .value("not_a_rotation", ErrorCode::not_a_rotation, "the matrix of a pose is not orthonormal to 1e-9, or mirrors")
      .value("invalid_argument", ErrorCode::invalid_argument, "an argument is out of range, such as a negative margin")
      .value("bad_state", ErrorCode::bad_state, "the bytes are no saved state of a world, or damaged");
  g_error = PyErr_NewExceptionWithDoc("tact.Error",
                                      "Data that a world cannot take; `code` is an ErrorCode. The world is as it was.",
                                      PyExc_RuntimeError, nullptr);
  g_stale_report = PyErr_NewExceptionWithDoc("tact.StaleReportError",
                                             "A report was used after its world's next detect(), set_settings() or "
                                             "restore().",
                                             PyExc_RuntimeError, nullptr);
  module.add_object("Error", py::reinterpret_borrow<py::object>(g_error));
  module.add_object("StaleReportError", py::reinterpret_borrow<py::object>(g_stale_report));
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error);
    } catch (const StaleReport& stale) {
      PyErr_SetString(g_stale_report, stale.what());
    }
  });
}

}  // namespace tact::python
