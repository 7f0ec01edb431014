#include "arrays.h"

#include <cstdint>
#include <limits>

namespace tact::python {

namespace {

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

py::array array_from(py::handle given, const std::string& what, const char* numbers) {
  if (!py::isinstance<py::array>(given))
    throw py::type_error(what + " is a " + std::string(py::str(py::type::of(given).attr("__name__"))) +
                         ", not a numpy array of " + numbers);
  return py::reinterpret_borrow<py::array>(given);
}

void check_shape(const py::array& array, const std::string& what, const std::string& letter) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  std::string message = what + " has shape " + shape_text(array) + ", not (" + letter + ", 3)";
  if (array.ndim() == 2 && array.shape(0) == 3) message += ": pass its transpose, copied with numpy.ascontiguousarray";
  throw py::value_error(message);
}

// Rows that lie whole in memory, one after the other.
template <class Number>
void check_order(const py::array& array, const std::string& what) {
  constexpr py::ssize_t kSize = sizeof(Number);
  const bool whole_rows = array.shape(0) == 0 || array.strides(1) == kSize;
  const bool ordered = array.shape(0) < 2 || (array.strides(0) >= 3 * kSize && array.strides(0) % kSize == 0);
  if (!whole_rows || !ordered)
    throw py::value_error(what +
                          " does not hold its rows one after the other in memory: pass numpy.ascontiguousarray of it");
}

template <class Number>
Eigen::Index stride_of(const py::array& array) {
  return array.shape(0) < 2 ? 3 : array.strides(0) / static_cast<py::ssize_t>(sizeof(Number));
}

py::array checked_positions(py::handle given) {
  const std::string what = "positions";
  py::array array = array_from(given, what, "float64 or float32");
  const bool narrow = py::isinstance<py::array_t<float>>(array);
  if (!narrow && !py::isinstance<py::array_t<double>>(array))
    throw py::type_error(what + " holds " + std::string(py::str(array.dtype())) + ", not float64 or float32");
  check_shape(array, what, "V");
  if (narrow) return py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  check_order<double>(array, what);
  return array;
}

// Copies integers of another width, none of which may lose bits.
py::array narrowed(const py::array& array) {
  const auto wide = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!wide) throw py::error_already_set();
  py::array_t<int> result({wide.shape(0), py::ssize_t{3}});
  const std::int64_t* from = wide.data();
  int* to = result.mutable_data();
  for (py::ssize_t i = 0; i < wide.size(); ++i) {
    if (from[i] < std::numeric_limits<int>::min() || from[i] > std::numeric_limits<int>::max())
      throw py::value_error("facet " + std::to_string(i / 3) + " names vertex " + std::to_string(from[i]) +
                            ", which no body can have");
    to[i] = static_cast<int>(from[i]);
  }
  return result;
}

py::array checked_facets(py::handle given) {
  const std::string what = "facets";
  py::array array = array_from(given, what, "integers");
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u')
    throw py::type_error(what + " holds " + std::string(py::str(array.dtype())) + ", not integers");
  check_shape(array, what, "F");
  if (!py::isinstance<py::array_t<int>>(array)) return narrowed(array);
  check_order<int>(array, what);
  return array;
}

}  // namespace

PositionsArgument::PositionsArgument(py::handle given)
    : array_(checked_positions(given)),
      map_(static_cast<const double*>(array_.data()), 3, array_.shape(0),
           Eigen::OuterStride<>(stride_of<double>(array_))) {}

FacetsArgument::FacetsArgument(py::handle given)
    : array_(checked_facets(given)),
      map_(static_cast<const int*>(array_.data()), 3, array_.shape(0), Eigen::OuterStride<>(stride_of<int>(array_))) {}

py::array_t<double> vector_of(const Eigen::Vector3d& vector) {
  py::array_t<double> array(3);
  for (py::ssize_t i = 0; i < 3; ++i) array.mutable_at(i) = vector[i];
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace tact::python
