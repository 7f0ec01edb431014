// Reads what a program passes as a matrix of three rows.
#pragma once

#include <tact/columns.h>

#include <span>
#include <vector>

namespace tact {

// Whether the columns are doubles, or ints, one after the other, so that they are read where they are.
template <class Scalar>
bool is_packed(const Columns<Scalar>& columns);

// The columns one after the other, as `Scalar`s: where they are if they are packed, else in `copy`, which has room for
// them. An index beyond the ints becomes the largest int.
template <class Scalar>
std::span<const Scalar> packed(const Columns<Scalar>& columns, std::span<Scalar> copy);

// Makes room for the columns where they are not packed.
template <class Scalar>
void make_copy_room(const Columns<Scalar>& columns, std::vector<Scalar>& copy) {
  if (!is_packed(columns)) copy.resize(3 * columns.cols());
}

// The numbers of a column, as they were given.
long long index_at(const Facets& facets, std::ptrdiff_t facet, int corner);

}  // namespace tact
