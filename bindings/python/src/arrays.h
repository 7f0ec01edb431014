// Arrays of numpy as the engine takes them, and the engine's lists as arrays of numpy.
//
// What is given may be whatever numpy makes an array of: arrays of any strides and byte order, lists, structured
// arrays, buffers. It is taken where it means one thing: each number is exactly one of the engine's, and it is clear
// which three are a row. Where rows lie whole in memory they are read where they are, others are copied.
#pragma once

#include <pybind11/numpy.h>
#include <tact/body.h>
#include <tact/columns.h>
#include <tact/world.h>

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tact::python {

namespace py = pybind11;

/// Vertices given as an array of shape (V, 3), or as a structured array with fields x, y and z, of real numbers.
/// @throws TypeError if it holds no such numbers, ValueError if its shape is another or a float64 cannot hold one.
class PositionsArgument {
 public:
  /// `what`: what the caller calls it.
  explicit PositionsArgument(py::handle given, const std::string& what = "positions");
  /// Valid as long as this.
  Positions columns() const;

 private:
  py::array array_;
};

/// Facets given as an array of shape (F, 3), or as a structured array with three fields, of integers.
/// @throws TypeError, ValueError as above; ValueError also names a facet with a number that does not fit in 32 bits.
class FacetsArgument {
 public:
  /// `what`: what the caller calls it.
  explicit FacetsArgument(py::handle given, const std::string& what = "facets");
  /// Valid as long as this.
  Facets columns() const;

 private:
  py::array array_;
};

/// Edges given as an array of shape (E, 2), or as a structured array with two fields, of integers.
/// @throws TypeError, ValueError as above.
class EdgesArgument {
 public:
  explicit EdgesArgument(py::handle given);
  /// Valid as long as this.
  Edges columns() const;

 private:
  py::array array_;
};

/// A new mesh of a body, given as arrays: (V, 3), (F, 3), (V,), and edges (E, 2), points (P,), facet_map (F,).
/// @throws TypeError, ValueError as above.
class MeshArguments {
 public:
  MeshArguments(py::handle positions, py::handle facets, py::handle vertex_map, py::handle edges, py::handle points,
                py::handle facet_map);
  /// Valid as long as this.
  MeshUpdate update() const;

 private:
  PositionsArgument positions_;
  FacetsArgument facets_;
  EdgesArgument edges_;
  py::array_t<int> points_, vertex_map_, facet_map_;
};

/// Settings of single vertices and facets, given as arrays of shape (V,) or (F,); all but distances are 0 to 2^32 - 1.
/// @throws TypeError, ValueError as above.
class FeatureSettingsArgument {
 public:
  FeatureSettingsArgument(py::handle rest_offsets, py::handle vertex_labels, py::handle facet_labels,
                          py::handle vertex_layers, py::handle vertex_masks, py::handle facet_layers,
                          py::handle facet_masks, py::handle margins);
  /// Valid as long as this.
  FeatureSettings settings() const;

 private:
  py::array_t<double> rest_offsets_, margins_;
  py::array_t<std::uint32_t> vertex_labels_, facet_labels_, vertex_layers_, vertex_masks_, facet_layers_, facet_masks_;
};

/// Integers given as an array of shape (N,), each of 32 bits. @throws TypeError, ValueError as above.
py::array_t<int> indices_argument(py::handle given, const std::string& what);
/// The same, each of 64 bits and at least 0.
py::array_t<std::uint64_t> ids_argument(py::handle given, const std::string& what);
/// Real numbers of a known shape, row by row. @throws TypeError, ValueError as above.
py::array_t<double> numbers_argument(py::handle given, const std::string& what, const std::vector<py::ssize_t>& shape);
/// The same of any shape.
py::array_t<double> numbers_argument(py::handle given, const std::string& what);
/// Real numbers of shape (N,). @throws TypeError, ValueError as above.
py::array_t<double> row_argument(py::handle given, const std::string& what);
/// Three coordinates, as a row or a column. @throws TypeError, ValueError as above.
Eigen::Vector3d vector_argument(py::handle given, const std::string& what);
/// The name of the type of something, for messages.
std::string type_name(py::handle of);

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

/// Makes the values of an enumeration equal to the numbers that arrays have for them.
template <class Enumeration>
void compare_with_numbers(py::enum_<Enumeration>& of) {
  const auto are_equal = [](const py::object& value, const py::object& other) -> py::object {
    if (!PyIndex_Check(other.ptr())) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::bool_(py::int_(value).equal(py::int_(other)));
  };
  of.attr("__eq__") = py::cpp_function(are_equal, py::name("__eq__"), py::is_method(of));
  of.attr("__ne__") = py::cpp_function(
      [are_equal](const py::object& value, const py::object& other) -> py::object {
        const py::object equal = are_equal(value, other);
        return equal.ptr() == Py_NotImplemented ? equal : py::bool_(!py::cast<bool>(equal));
      },
      py::name("__ne__"), py::is_method(of));
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
