// What draws in Python, as a drawer of C++.
#pragma once

#include <pybind11/numpy.h>
#include <tact/debug_draw.h>

#include <string>
#include <string_view>
#include <utility>

#include "arrays.h"
#include "interpreter.h"
#include "text.h"

namespace tact::python {

// An object of Python with the methods line, triangle and text.
class PythonDrawer : public DebugDrawer {
 public:
  explicit PythonDrawer(py::object object) : object_(std::move(object)) {}
  void line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const DebugColor& color) override {
    call_python(object_.attr("line"), vector_of(from), vector_of(to), color_of(color));
  }
  void triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                const DebugColor& color) override {
    call_python(object_.attr("triangle"), vector_of(p), vector_of(q), vector_of(r), color_of(color));
  }
  void text(const Eigen::Vector3d& at, std::string_view words, const DebugColor& color) override {
    call_python(object_.attr("text"), vector_of(at), sentence(words), color_of(color));
  }

 private:
  static py::tuple color_of(const DebugColor& c) { return py::make_tuple(c.red, c.green, c.blue, c.alpha); }
  py::object object_;
};

}  // namespace tact::python
