#include "engine/bodies/checks.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <type_traits>

#include "engine/base/text.h"
#include "engine/bodies/columns.h"
#include "engine/check_coordinate.h"
#include "narrowphase/mesh/position_problem.h"

namespace tact {

namespace {

using narrowphase::PositionProblem;

constexpr std::ptrdiff_t kLargestCount = std::numeric_limits<int>::max() / 4;

constexpr double kLargestLengthError = 1e-9;  // of a normal; that of a rotation is the same

std::size_t size_of(NumberKind kind) {
  if (kind == NumberKind::float64) return sizeof(double);
  return kind == NumberKind::uint16 ? sizeof(std::uint16_t) : sizeof(float);
}

template <class Scalar, int kRows>
void check_columns(const Columns<Scalar, kRows>& m, const char* what, const std::string& name) {
  constexpr bool kCoordinates = std::is_same_v<Scalar, double>;
  const bool known = m.kind() <= NumberKind::uint16 && (m.kind() <= NumberKind::float64) == kCoordinates;
  if (m.rows() != kRows)
    throw Error(ErrorCode::wrong_size, quoted(name) + ": the matrix of " + what + " is " + std::to_string(m.rows()) +
                                           " x " + std::to_string(m.cols()) + ", not " + std::to_string(kRows) +
                                           " x N");
  if (!known || (m.first() == nullptr && m.cols() > 0)) {
    throw Error(ErrorCode::wrong_size, quoted(name) + ": the array of " + what +
                                           (known          ? " is null"
                                            : kCoordinates ? " holds no float32 or float64"
                                                           : " holds no int32, uint32 or uint16"));
  }
  const auto column_bytes = static_cast<std::ptrdiff_t>(kRows * size_of(m.kind()));
  if (m.cols() > 1 && m.stride_bytes() != 0 && std::abs(m.stride_bytes()) < column_bytes)
    throw Error(ErrorCode::wrong_size, quoted(name) + ": the columns of " + what + " are " +
                                           std::to_string(m.stride_bytes()) + " bytes apart, but each is of " +
                                           std::to_string(column_bytes));
}

[[noreturn]] void refuse_corner(const std::string& name, const char* what, std::size_t which, long long vertex,
                                std::ptrdiff_t vertices) {
  throw Error(ErrorCode::facet_out_of_range, quoted(name) + ": " + what + " " + std::to_string(which) +
                                                 " names vertex " + std::to_string(vertex) + ", but there are " +
                                                 std::to_string(vertices) + " vertices");
}

}  // namespace

void check_positions(const double* positions, std::size_t count, const std::string& name) {
  const PositionProblem problem = narrowphase::find_position_problem(positions, count, kLargestCoordinate);
  if (problem.kind == PositionProblem::none) return;
  refuse_coordinate(quoted(name) + ": vertex " + std::to_string(problem.source_vertex), problem.axis, problem.value);
}

template <int kRows>
void check_corners(std::span<const int> corners, const Columns<int, kRows>& given, std::ptrdiff_t vertices,
                   const std::string& name) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] >= 0 && corners[i] < vertices) continue;
    refuse_corner(name, kRows == 3 ? "facet" : "edge", i / kRows,
                  index_at(given, static_cast<std::ptrdiff_t>(i / kRows), static_cast<int>(i % kRows)), vertices);
  }
}
template void check_corners(std::span<const int>, const Facets&, std::ptrdiff_t, const std::string&);
template void check_corners(std::span<const int>, const Edges&, std::ptrdiff_t, const std::string&);

void check_points(std::span<const int> points, std::ptrdiff_t vertices, const std::string& name) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] < 0 || points[i] >= vertices) refuse_corner(name, "point", i, points[i], vertices);
  }
}

void check_array(const Positions& positions, const std::string& name) { check_columns(positions, "positions", name); }
void check_array(const Facets& facets, const std::string& name) { check_columns(facets, "facets", name); }

void check_array(const Edges& edges, const std::string& name) { check_columns(edges, "edges", name); }

void check_plane(const Eigen::Vector3d& normal, double offset, const std::string& name) {
  const double square = (normal.x() * normal.x() + normal.y() * normal.y()) + normal.z() * normal.z();
  if (!(std::abs(square - 1.0) <= 2.0 * kLargestLengthError))
    throw Error(ErrorCode::invalid_argument, quoted(name) + ": the normal of the plane is " +
                                                 base::text_of(std::sqrt(square)) + " long, not 1 to 1e-9");
  if (!(std::abs(offset) <= kLargestCoordinate))
    throw Error(ErrorCode::invalid_argument,
                quoted(name) + ": the offset of the plane is " + base::text_of(offset) + ", not -2^300 to 2^300");
}

void check_margin(double margin, const std::string& name) {
  if (margin >= 0.0 && margin <= kLargestCoordinate) return;
  throw Error(ErrorCode::invalid_argument, quoted(name) + ": margin is " + base::text_of(margin) + ", not 0 to 2^300");
}

void check_rest_offset(std::optional<double> rest_offset, double margin, const std::string& name) {
  if (!rest_offset || (*rest_offset >= 0.0 && *rest_offset <= margin)) return;
  throw Error(ErrorCode::invalid_argument, quoted(name) + ": rest offset is " + base::text_of(*rest_offset) +
                                               ", not 0 to the margin, which is " + base::text_of(margin));
}

void check_counts(std::ptrdiff_t vertices, std::ptrdiff_t facets, std::size_t bodies, const std::string& name) {
  if (bodies < std::numeric_limits<std::uint32_t>::max() && vertices <= kLargestCount && facets <= kLargestCount)
    return;
  throw Error(ErrorCode::too_large,
              quoted(name) +
                  ": a body has up to 536870911 vertices, and as many facets, edges and points, a world up to "
                  "4294967295 bodies");
}

}  // namespace tact
