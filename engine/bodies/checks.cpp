#include "engine/bodies/checks.h"

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

template <class Scalar>
void check_columns(const Columns<Scalar>& m, const char* what, const std::string& name) {
  constexpr bool kCoordinates = std::is_same_v<Scalar, double>;
  const bool known = m.kind() <= NumberKind::uint16 && (m.kind() <= NumberKind::float64) == kCoordinates;
  if (!known || (m.first() == nullptr && m.cols() > 0)) {
    throw Error(ErrorCode::wrong_size, quoted(name) + ": the array of " + what +
                                           (known          ? " is null"
                                            : kCoordinates ? " holds no float32 or float64"
                                                           : " holds no int32, uint32 or uint16"));
  }
  if (m.rows() == 3) return;
  throw Error(ErrorCode::wrong_size, quoted(name) + ": the matrix of " + what + " is " + std::to_string(m.rows()) +
                                         " x " + std::to_string(m.cols()) + ", not 3 x N");
}

}  // namespace

void check_positions(const double* positions, std::size_t count, const std::string& name) {
  const PositionProblem problem = narrowphase::find_position_problem(positions, count, kLargestCoordinate);
  if (problem.kind == PositionProblem::none) return;
  refuse_coordinate(quoted(name) + ": vertex " + std::to_string(problem.source_vertex), problem.axis, problem.value);
}

void check_facets(std::span<const int> corners, const Facets& given, std::ptrdiff_t vertices, const std::string& name) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] >= 0 && corners[i] < vertices) continue;
    throw Error(ErrorCode::facet_out_of_range,
                quoted(name) + ": facet " + std::to_string(i / 3) + " names vertex " +
                    std::to_string(index_at(given, static_cast<std::ptrdiff_t>(i / 3), static_cast<int>(i % 3))) +
                    ", but there are " + std::to_string(vertices) + " vertices");
  }
}

void check_array(const Positions& positions, const std::string& name) { check_columns(positions, "positions", name); }
void check_array(const Facets& facets, const std::string& name) { check_columns(facets, "facets", name); }

void check_margin(double margin, const std::string& name) {
  if (margin >= 0.0 && margin <= kLargestCoordinate) return;
  throw Error(ErrorCode::invalid_argument, quoted(name) + ": margin is " + base::text_of(margin) + ", not 0 to 2^300");
}

void check_counts(std::ptrdiff_t vertices, std::ptrdiff_t facets, std::size_t bodies, const std::string& name) {
  if (bodies < std::numeric_limits<std::uint32_t>::max() && vertices <= kLargestCount && facets <= kLargestCount)
    return;
  throw Error(ErrorCode::too_large,
              quoted(name) + ": a body has up to 536870911 vertices and facets, a world up to 4294967295 bodies");
}

}  // namespace tact
