// What a program passes as a matrix of three rows.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <type_traits>
#include <utility>

namespace tact {

// A 3 x N matrix: a column a vertex, or a facet. Made from any matrix or expression of Eigen. One whose columns lie
// whole in memory (a Matrix3X, a Map, a Ref, the top rows of a larger one) is looked at where it is, and must stay
// there as long as this is used. Anything else, an expression, a temporary matrix, one that is row-major or of narrower
// numbers, is held by this and its copies.
template <class Scalar>
class Columns {
  using Matrix = Eigen::Matrix<Scalar, 3, Eigen::Dynamic>;

 public:
  template <class Given>
  requires std::is_base_of_v<Eigen::DenseBase<std::remove_cvref_t<Given>>, std::remove_cvref_t<Given>> Columns(
      Given&& matrix)
      : rows_(matrix.rows()), cols_(matrix.cols()) {  // NOLINT: implicit
    using Type = std::remove_cvref_t<Given>;
    using Number = typename Type::Scalar;
    static_assert(Type::RowsAtCompileTime == 3 || Type::RowsAtCompileTime == Eigen::Dynamic,
                  "a vertex or a facet is a column: transpose() a matrix that has them as rows");
    static_assert(
        requires(Number number) { Scalar{number}; }, "cast<>() the matrix: its numbers do not all fit");
    constexpr bool kIsTemporary =
        !std::is_lvalue_reference_v<Given> && std::is_base_of_v<Eigen::PlainObjectBase<Type>, Type>;
    constexpr bool kHasWholeColumns = (Type::Flags & Eigen::DirectAccessBit) != 0 && !Type::IsRowMajor &&
                                      Type::InnerStrideAtCompileTime == 1 && std::is_same_v<Number, Scalar>;
    if constexpr (kHasWholeColumns && !kIsTemporary) {
      data_ = matrix.data();
      stride_ = matrix.outerStride();
    } else if (rows_ == 3) {
      if constexpr (std::is_same_v<Given, Matrix>) {
        held_ = std::make_shared<const Matrix>(std::move(matrix));
      } else {
        held_ = std::make_shared<const Matrix>(matrix.template cast<Scalar>());
      }
      data_ = held_->data();
    }
  }

  const Scalar* data() const { return data_; }
  Eigen::Index rows() const { return rows_; }  // 3, or what was given is refused
  Eigen::Index cols() const { return cols_; }
  Eigen::Index stride() const { return stride_; }  // from a column to the next, at least 3

 private:
  const Scalar* data_ = nullptr;
  Eigen::Index rows_ = 3;
  Eigen::Index cols_ = 0;
  Eigen::Index stride_ = 3;
  std::shared_ptr<const Matrix> held_;
};

using Positions = Columns<double>;  // 3 x V, metres
using Facets = Columns<int>;        // 3 x F, indices of vertices, counter-clockwise seen from outside

}  // namespace tact
