#include <pybind11/pybind11.h>
#include <tact/error.h>

#include <exception>

#include "bindings.h"
#include "shared_world.h"

namespace tact::python {

namespace {

// The interpreter keeps both for as long as it lives: they are not counted down, as nobody is left to do so at its end.
PyObject* g_error = nullptr;
PyObject* g_stale_report = nullptr;

void raise(const Error& error) {
  const py::object raised = py::reinterpret_borrow<py::object>(g_error)(error.what());
  raised.attr("code") = py::cast(error.code());
  PyErr_SetObject(g_error, raised.ptr());
}

}  // namespace

void define_errors(py::module_& module) {
  py::enum_<ErrorCode>(module, "ErrorCode", "What is wrong with the data of a call.")
      .value("non_finite_position", ErrorCode::non_finite_position, "a coordinate is NaN or infinite")
      .value("position_out_of_range", ErrorCode::position_out_of_range,
             "a coordinate is larger than LARGEST_COORDINATE")
      .value("facet_out_of_range", ErrorCode::facet_out_of_range, "a facet names a vertex that the body does not have")
      .value("wrong_size", ErrorCode::wrong_size, "the number of positions is not the body's number of vertices")
      .value("too_large", ErrorCode::too_large, "too many vertices, facets or bodies")
      .value("stale_body", ErrorCode::stale_body, "the body was removed, or never added")
      .value("foreign_body", ErrorCode::foreign_body, "the body is of another world")
      .value("fixed_body", ErrorCode::fixed_body, "positions were set on a body whose motion is fixed")
      .value("bad_settings", ErrorCode::bad_settings, "a setting has no meaning; the message says which")
      .value("wrong_order", ErrorCode::wrong_order, "the world is in use by another thread, or a body is named twice")
      .value("out_of_memory", ErrorCode::out_of_memory, "an allocation failed")
      .value("backend_failure", ErrorCode::backend_failure, "Embree reported an error")
      .value("bad_recording", ErrorCode::bad_recording, "bytes that are no recording, or one that does not play")
      .value("wrong_motion", ErrorCode::wrong_motion, "positions of a rigid body, or a pose of one that is not")
      .value("not_a_rotation", ErrorCode::not_a_rotation, "a matrix that is not orthonormal to 1e-9, or mirrors")
      .value("invalid_argument", ErrorCode::invalid_argument,
             "an argument has no meaning, such as an unknown enumeration value or a negative margin");
  g_error = PyErr_NewExceptionWithDoc("tact.Error",
                                      "Data that a world cannot take; `code` is an ErrorCode. The world is as it was.",
                                      PyExc_RuntimeError, nullptr);
  g_stale_report = PyErr_NewExceptionWithDoc(
      "tact.StaleReportError", "A report was asked for something after its world's next detect() or set_settings().",
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
