#include "report_parts.h"

#include <algorithm>

#include "arrays.h"

namespace tact::python {

py::array_t<int> facet_pair_array(std::span<const FacetPair> pairs) {
  return rows_of<int>(pairs, 2, [](const FacetPair& pair, int* row) {
    row[0] = pair.a;
    row[1] = pair.b;
  });
}

PatchArrays patch_arrays(const Patch& patch) {
  const auto column = [](std::span<const int> indices) {
    return column_of<int>(indices, [](int index) { return index; });
  };
  const auto spanning = static_cast<std::size_t>(std::ranges::count_if(patch.spanning, [](int i) { return i >= 0; }));
  return {patch.id,
          vector_of(patch.point),
          vector_of(patch.direction),
          patch.depth,
          patch.area,
          column(patch.facet_pairs),
          column(patch.points),
          column(std::span(patch.spanning).first(spanning))};
}

PointArrays point_arrays(std::span<const ContactPoint> points) {
  return {column_of<std::uint8_t>(points, [](const ContactPoint& point) { return point.kind; }),
          column_of<int>(points, [](const ContactPoint& point) { return point.patch; }),
          rows_of_three<int>(points, &ContactPoint::a_vertices),
          rows_of_three<int>(points, &ContactPoint::b_vertices),
          rows_of_three<double>(points, &ContactPoint::a_weights),
          rows_of_three<double>(points, &ContactPoint::b_weights),
          rows_of_three<double>(points, &ContactPoint::normal),
          column_of<double>(points, [](const ContactPoint& point) { return point.gap; }),
          column_of<std::uint64_t>(points, [](const ContactPoint& point) { return point.id; }),
          column_of<bool>(points, [](const ContactPoint& point) { return point.minimum; })};
}

CurveArrays curve_arrays(const IntersectionCurve& curve) {
  const auto points = curve.points;
  return {curve.closed,
          rows_of<double>(points, 3,
                          [](const CurvePoint& point, double* row) { Eigen::Vector3d::Map(row) = point.position; }),
          column_of<double>(points, [](const CurvePoint& point) { return point.fraction; }),
          rows_of<int>(points, 2,
                       [](const CurvePoint& point, int* row) { std::copy(point.edge.begin(), point.edge.end(), row); }),
          column_of<int>(points, [](const CurvePoint& point) { return point.facet; }),
          column_of<int>(points, [](const CurvePoint& point) { return point.facet_pair; }),
          column_of<bool>(points, [](const CurvePoint& point) { return point.edge_of_b; })};
}

ReachPairs reach_pairs(std::span<const ReachPair> pairs) {
  return {column_of<std::uint8_t>(pairs, [](const ReachPair& pair) { return pair.kind; }),
          rows_of_three<int>(pairs, &ReachPair::a_vertices),
          rows_of_three<int>(pairs, &ReachPair::b_vertices),
          rows_of_three<double>(pairs, &ReachPair::a_weights),
          rows_of_three<double>(pairs, &ReachPair::b_weights),
          rows_of_three<double>(pairs, &ReachPair::normal),
          column_of<double>(pairs, [](const ReachPair& pair) { return pair.distance; })};
}

}  // namespace tact::python
