// Calls into Python from threads that the interpreter may end.
#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

namespace tact::python {

namespace py = pybind11;

/// Calls work(), which takes the interpreter's lock or runs Python. An interpreter that ends meanwhile ends this thread
/// by unwinding its stack, which neither the engine nor destructors let pass: the thread waits here for the end of the
/// process, as Python itself has it from 3.14 on.
template <class Work>
auto waiting_at_exit(const Work& work) {
  try {
    return work();
  } catch (const abi::__forced_unwind&) {
    for (;;) pause();
  }
}

/// Calls a function of Python, with the lock held. @throws error_already_set with what it raised.
template <class... Arguments>
void call_python(const py::object& function, Arguments&&... arguments) {
  const py::tuple given = py::make_tuple(std::forward<Arguments>(arguments)...);
  PyObject* const result = waiting_at_exit([&] { return PyObject_CallObject(function.ptr(), given.ptr()); });
  if (result == nullptr) throw py::error_already_set();
  Py_DECREF(result);
}

}  // namespace tact::python
