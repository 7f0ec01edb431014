// Arrays of numpy as the engine takes them, and the engine's lists as arrays of numpy.
#pragma once

#include <pybind11/numpy.h>
#include <tact/columns.h>

#include <Eigen/Core>
#include <span>
#include <string>

namespace tact::python {

namespace py = pybind11;

/// Vertices given as an array of shape (V, 3): float64 rows are read where they are, float32 rows are widened exactly.
/// @throws TypeError if it is no array of these numbers, ValueError if its shape or its order is another.
class PositionsArgument {
 public:
  explicit PositionsArgument(py::handle given);
  /// Valid as long as this.
  Positions columns() const { return Positions(map_); }
  using Map = Eigen::Map<const Eigen::Matrix3Xd, 0, Eigen::OuterStride<>>;
  const Map& matrix() const { return map_; }

 private:
  py::array array_;
  Map map_;
};

/// Facets given as an array of shape (F, 3) of any integers: int32 rows are read where they are, others are copied.
/// @throws TypeError, ValueError as above; ValueError also names a facet whose number does not fit in 32 bits.
class FacetsArgument {
 public:
  explicit FacetsArgument(py::handle given);
  /// Valid as long as this.
  Facets columns() const { return Facets(map_); }

 private:
  using Map = Eigen::Map<const Eigen::Matrix3Xi, 0, Eigen::OuterStride<>>;
  py::array array_;
  Map map_;
};

/// An array of its own with a row for each of `items`; row(item, numbers) writes the `width` numbers of a row. It
/// cannot be written to.
template <class Number, class Item, class Row>
py::array_t<Number> rows_of(std::span<const Item> items, py::ssize_t width, const Row& row) {
  py::array_t<Number> array({static_cast<py::ssize_t>(items.size()), width});
  Number* numbers = array.mutable_data();
  for (const Item& item : items) {
    row(item, numbers);
    numbers += width;
  }
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The same with one number for each of `items`, of shape (N,).
template <class Number, class Item, class Value>
py::array_t<Number> column_of(std::span<const Item> items, const Value& value) {
  py::array_t<Number> array(static_cast<py::ssize_t>(items.size()));
  Number* numbers = array.mutable_data();
  for (const Item& item : items) *numbers++ = static_cast<Number>(value(item));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Rows of the three numbers that a member of each of `items` holds, of shape (N, 3).
template <class Number, class Item, class Member>
py::array_t<Number> rows_of_three(std::span<const Item> items, Member member) {
  return rows_of<Number>(items, 3, [&](const Item& item, Number* row) {
    for (std::size_t k = 0; k < 3; ++k) row[k] = (item.*member)[k];
  });
}

/// Three coordinates as an array of shape (3,).
py::array_t<double> vector_of(const Eigen::Vector3d& vector);

}  // namespace tact::python
