// Validates a BodyDefinition. The message of each check says what is wrong.
#pragma once

#include <tact/body.h>

#include <cstddef>
#include <span>
#include <string>

namespace tact {

[[nodiscard]] inline std::string quoted(const std::string& name) { return "body '" + name + "'"; }

// Errors: non_finite_position, position_out_of_range. `count` vertices, three coordinates each.
void check_positions(const double* positions, std::size_t count, const std::string& name);
// Errors: facet_out_of_range. `corners` of `given`, read as ints.
void check_facets(std::span<const int> corners, const Facets& given, std::ptrdiff_t vertices, const std::string& name);
// Errors: wrong_size. Not of the shape 3 x N, null, or of a kind of number that `what` cannot have.
void check_array(const Positions& positions, const std::string& name);
void check_array(const Facets& facets, const std::string& name);
// Errors: invalid_argument.
void check_margin(double margin, const std::string& name);
// Errors: too_large.
void check_counts(std::ptrdiff_t vertices, std::ptrdiff_t facets, std::size_t bodies, const std::string& name);

}  // namespace tact
