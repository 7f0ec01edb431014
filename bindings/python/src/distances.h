// Distances of bodies as arrays of numpy.
#pragma once

#include <pybind11/numpy.h>
#include <tact/body_queries.h>

#include <cstdint>
#include <vector>

namespace tact::python {

/// A row an answer. They are copies.
struct DistanceArrays {
  pybind11::array_t<std::int64_t> bodies;
  pybind11::array_t<double> distances;
  pybind11::array_t<int> facets;
  pybind11::array_t<double> a_barycentric, b_barycentric;
  pybind11::array_t<std::uint8_t> containments;
  std::vector<BodyDistance> all;
};

}  // namespace tact::python
