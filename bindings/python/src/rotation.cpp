#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <tact/rotation.h>

#include <string>

#include "arrays.h"
#include "bindings.h"

namespace tact::python {

namespace py = pybind11;

namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// Writes rotation(numbers) for each `width` numbers of an array, of one or of many; its last axes are `shape`.
template <class RotationOf>
py::array_t<double> rotations(py::handle argument, const std::string& what, const std::vector<py::ssize_t>& shape,
                              const RotationOf& rotation) {
  const py::array_t<double> given = numbers_argument(argument, what);
  const auto axes = static_cast<py::ssize_t>(shape.size());
  if ((given.ndim() != axes && given.ndim() != axes + 1) ||
      !std::equal(shape.begin(), shape.end(), given.shape() + given.ndim() - axes))
    throw py::value_error("the shape of " + what + " is " + std::string(py::str(given.attr("shape"))) + ", not " +
                          std::string(py::str(py::tuple(py::cast(shape)))) + ", or N of these");
  const bool many = given.ndim() > axes;
  const py::ssize_t count = many ? given.shape(0) : 1, width = many && count > 0 ? given.size() / count : given.size();
  py::array_t<double> result(many ? std::vector<py::ssize_t>{count, 3, 3} : std::vector<py::ssize_t>{3, 3});
  for (py::ssize_t i = 0; i < count; ++i)
    RowMajor::Map(result.mutable_data() + 9 * i) = rotation(given.data() + width * i);
  return result;
}

}  // namespace

void define_rotations(py::module_& module) {
  module.def(
      "nearest_rotation",
      [](py::handle matrix) {
        return rotations(matrix, "matrix", {3, 3},
                         [](const double* row) { return nearest_rotation(Eigen::Map<const RowMajor>(row)); });
      },
      py::arg("matrix"), "(3, 3) or (N, 3, 3): the rotation nearest to a matrix that is orthonormal to 1e-5");
  module.def(
      "rotation_of_quaternion",
      [](py::handle quaternion) {
        return rotations(quaternion, "quaternion", {4}, [](const double* q) {
          return rotation_of_quaternion({q[0], q[1], q[2], q[3]});
        });
      },
      py::arg("quaternion"), "(3, 3) or (N, 3, 3) of (4,) or (N, 4): the rotation of a quaternion x, y, z, w");
}

}  // namespace tact::python
