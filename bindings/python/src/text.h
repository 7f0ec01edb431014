// Text of the engine, which holds names as bytes, as Python has it.
#pragma once

#include <pybind11/pybind11.h>

#include <string_view>

namespace tact::python {

namespace py = pybind11;

/// `on_error`: what is done with bytes that are no UTF-8, as codecs know it.
inline py::str decoded(std::string_view text, const char* on_error) {
  const auto decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), on_error);
  if (decoded == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}
/// A name, which os.fsencode() turns into the same bytes again.
inline py::str name_of(std::string_view name) { return decoded(name, "surrogateescape"); }
/// A sentence, which can be printed.
inline py::str sentence(std::string_view text) { return decoded(text, "backslashreplace"); }

}  // namespace tact::python
