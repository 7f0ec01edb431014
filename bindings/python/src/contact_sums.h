// The sums of a step as arrays of numpy.
#pragma once

#include <pybind11/numpy.h>
#include <tact/contact_sums.h>

#include <cstdint>
#include <memory>

namespace tact::python {

/// A row a sum. They are copies.
struct SumArrays {
  pybind11::array_t<std::uint8_t> kinds;
  pybind11::array_t<std::int64_t> bodies;
  pybind11::array_t<std::uint64_t> patches;
  pybind11::array_t<int> points;
  pybind11::array_t<double> areas, deepest_gaps, mean_gaps, centers, normals, forces, torques;
  pybind11::array_t<std::int64_t> first_vertices, vertices;
  std::shared_ptr<const ContactSums> all;
};

}  // namespace tact::python
