// Parts of a contact as arrays of numpy, for the reports of all modules. They are copies.
#pragma once

#include <pybind11/numpy.h>
#include <tact/report.h>

#include <cstdint>
#include <span>

namespace tact::python {

namespace py = pybind11;

/// A patch.
struct PatchArrays {
  std::uint64_t id;
  py::array_t<double> point, direction;
  double depth, area;
  py::array_t<int> facet_pairs, points, spanning;
};

/// Contact points, a row a point.
struct PointArrays {
  py::array_t<std::uint8_t> kinds;
  py::array_t<int> patches, a_vertices, b_vertices;
  py::array_t<double> a_weights, b_weights, normals, gaps;
  py::array_t<std::uint64_t> ids;
  py::array_t<bool> minima;
};

/// Of shape (N, 2).
py::array_t<int> facet_pair_array(std::span<const FacetPair> pairs);
PatchArrays patch_arrays(const Patch& patch);
PointArrays point_arrays(std::span<const ContactPoint> points);

}  // namespace tact::python
