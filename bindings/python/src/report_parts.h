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

/// An intersection curve as arrays, a row a point. They are copies.
struct CurveArrays {
  bool closed;
  py::array_t<double> positions, fractions;
  py::array_t<int> edges, facets, facet_pairs;
  py::array_t<bool> edges_of_b;
};

/// Pairs within reach as arrays, a row a pair. They are copies.
struct ReachPairs {
  py::array_t<std::uint8_t> kinds;
  py::array_t<int> a_vertices, b_vertices;
  py::array_t<double> a_weights, b_weights, normals, distances;
};

/// Of shape (N, 2).
py::array_t<int> facet_pair_array(std::span<const FacetPair> pairs);
PatchArrays patch_arrays(const Patch& patch);
PointArrays point_arrays(std::span<const ContactPoint> points);
CurveArrays curve_arrays(const IntersectionCurve& curve);
ReachPairs reach_pairs(std::span<const ReachPair> pairs);

}  // namespace tact::python
