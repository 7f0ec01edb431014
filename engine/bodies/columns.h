// Reads what a program passes as a matrix.
#pragma once

#include <tact/columns.h>

#include <span>
#include <vector>

namespace tact {

// Whether the columns are doubles, or ints, one after the other, so that they are read where they are.
template <class Scalar, int kRows>
bool is_packed(const Columns<Scalar, kRows>& columns);

// The columns one after the other, as `Scalar`s: where they are if they are packed, else in `copy`, which has room for
// them. An index beyond the ints becomes the largest int.
template <class Scalar, int kRows>
std::span<const Scalar> packed(const Columns<Scalar, kRows>& columns, std::span<Scalar> copy);

// Makes room for the columns where they are not packed.
template <class Scalar, int kRows>
void make_copy_room(const Columns<Scalar, kRows>& columns, std::vector<Scalar>& copy) {
  if (!is_packed(columns)) copy.resize(kRows * columns.cols());
}

// A view of columns that stand one after the other.
template <class Columns, class Number>
Columns columns_of(const std::vector<Number>& numbers) {
  return Columns::strided(numbers.data(), numbers.size() / static_cast<std::size_t>(Columns::none().rows()));
}

// A number of a column, as it was given.
template <int kRows>
long long index_at(const Columns<int, kRows>& columns, std::ptrdiff_t column, int row);

}  // namespace tact
