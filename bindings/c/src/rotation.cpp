#include <tact/rotation.h>

#include "handles.h"

namespace {

void put_row_by_row(const Eigen::Matrix3d& from, double* rotation) {
  for (int i = 0; i < 9; ++i) rotation[i] = from(i / 3, i % 3);
}

}  // namespace

using tact::c::check_not_null, tact::c::guarded;

extern "C" {

tact_error tact_nearest_rotation(const double* matrix, double* rotation) {
  return guarded([&] {
    check_not_null(matrix, rotation);
    put_row_by_row(tact::nearest_rotation(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix)),
                   rotation);
  });
}

tact_error tact_rotation_of_quaternion(const double* quaternion, double* rotation) {
  return guarded([&] {
    check_not_null(quaternion, rotation);
    put_row_by_row(tact::rotation_of_quaternion({quaternion[0], quaternion[1], quaternion[2], quaternion[3]}),
                   rotation);
  });
}
}
