#include "engine/bodies/columns.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <limits>

namespace tact {

static_assert(kEigenDynamic == Eigen::Dynamic && kEigenDirectAccess == Eigen::DirectAccessBit);

namespace {

// Copied byte by byte: nothing is known of the alignment.
template <class Number>
Number number_at(const std::byte* first, std::ptrdiff_t i) {
  Number number;
  std::memcpy(&number, first + i * static_cast<std::ptrdiff_t>(sizeof(Number)), sizeof(Number));
  return number;
}

template <class Number, class Scalar>
Scalar converted(Number number) {
  if constexpr (std::is_same_v<Number, std::uint32_t>) {
    return static_cast<Scalar>(std::min<std::uint32_t>(number, std::numeric_limits<int>::max()));
  } else {
    return static_cast<Scalar>(number);
  }
}

template <class Number, class Scalar, int kRows>
void copy_columns(const Columns<Scalar, kRows>& columns, Scalar* to) {
  const auto* column = static_cast<const std::byte*>(columns.first());
  for (std::ptrdiff_t i = 0; i < columns.cols(); ++i, column += columns.stride_bytes(), to += kRows) {
    for (int row = 0; row < kRows; ++row) to[row] = converted<Number, Scalar>(number_at<Number>(column, row));
  }
}

}  // namespace

template <class Scalar, int kRows>
bool is_packed(const Columns<Scalar, kRows>& columns) {
  const bool aligned = reinterpret_cast<std::uintptr_t>(columns.first()) % alignof(Scalar) == 0;
  return columns.data() != nullptr && aligned &&
         (columns.stride_bytes() == kRows * static_cast<std::ptrdiff_t>(sizeof(Scalar)) || columns.cols() <= 1);
}

template <class Scalar, int kRows>
std::span<const Scalar> packed(const Columns<Scalar, kRows>& columns, std::span<Scalar> copy) {
  const auto size = static_cast<std::size_t>(kRows * columns.cols());
  if (size == 0) return {};
  if (is_packed(columns)) return {columns.data(), size};
  switch (columns.kind()) {
    case NumberKind::float32: copy_columns<float>(columns, copy.data()); break;
    case NumberKind::float64: copy_columns<double>(columns, copy.data()); break;
    case NumberKind::int32: copy_columns<std::int32_t>(columns, copy.data()); break;
    case NumberKind::uint32: copy_columns<std::uint32_t>(columns, copy.data()); break;
    case NumberKind::uint16: copy_columns<std::uint16_t>(columns, copy.data()); break;
  }
  return copy.first(size);
}

template <int kRows>
long long index_at(const Columns<int, kRows>& columns, std::ptrdiff_t column, int row) {
  const auto* at = static_cast<const std::byte*>(columns.first()) + column * columns.stride_bytes();
  switch (columns.kind()) {
    case NumberKind::uint16: return number_at<std::uint16_t>(at, row);
    case NumberKind::uint32: return number_at<std::uint32_t>(at, row);
    default: return number_at<std::int32_t>(at, row);
  }
}

template bool is_packed(const Positions&);
template bool is_packed(const Facets&);
template bool is_packed(const Edges&);
template std::span<const double> packed(const Positions&, std::span<double>);
template std::span<const int> packed(const Facets&, std::span<int>);
template std::span<const int> packed(const Edges&, std::span<int>);
template long long index_at(const Facets&, std::ptrdiff_t, int);
template long long index_at(const Edges&, std::ptrdiff_t, int);

}  // namespace tact
