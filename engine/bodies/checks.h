// Validates a BodyDefinition. The message of each check says what is wrong.
#pragma once

#include <tact/body.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace tact {

[[nodiscard]] inline std::string quoted(const std::string& name) { return "body '" + name + "'"; }

// Errors: non_finite_position, position_out_of_range. `count` vertices, three coordinates each.
void check_positions(const double* positions, std::size_t count, const std::string& name);
// Errors: facet_out_of_range. `corners` of `given`, facets or edges, read as ints.
template <int kRows>
void check_corners(std::span<const int> corners, const Columns<int, kRows>& given, std::ptrdiff_t vertices,
                   const std::string& name);
// The same of points.
void check_points(std::span<const int> points, std::ptrdiff_t vertices, const std::string& name);
// Errors: wrong_size. Not of the shape 3 x N, or 2 x N, null, or of a kind of number that it cannot have.
void check_array(const Positions& positions, const std::string& name);
void check_array(const Facets& facets, const std::string& name);
void check_array(const Edges& edges, const std::string& name);
// Errors: invalid_argument.
void check_plane(const Eigen::Vector3d& normal, double offset, const std::string& name);
void check_margin(double margin, const std::string& name);
// Not 0 to the margin.
void check_rest_offset(std::optional<double> rest_offset, double margin, const std::string& name);
// Errors: too_large. `facets` counts edges and points, too.
void check_counts(std::ptrdiff_t vertices, std::ptrdiff_t facets, std::size_t bodies, const std::string& name);

}  // namespace tact
