// What detect_motion() found, as arrays of numpy.
#pragma once

#include <pybind11/numpy.h>
#include <tact/motion.h>

#include <span>
#include <vector>

namespace tact::python {

/// A row an impact. They are copies.
struct MotionArrays {
  double first_time;
  pybind11::array_t<std::int64_t> bodies;
  pybind11::array_t<std::uint8_t> kinds;
  pybind11::array_t<double> times;
  pybind11::array_t<int> a_vertices, b_vertices;
  pybind11::array_t<bool> stops;
  pybind11::dict bounds;
  pybind11::dict stats;
  std::vector<Impact> impacts;
};

/// Bounds are those of `bounded`.
MotionArrays motion_arrays(const MotionReport& report, std::span<const BodyId> bounded);

}  // namespace tact::python
