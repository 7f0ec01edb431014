// What a program passes as a matrix of three rows.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

namespace tact {

// What stands behind a matrix of Eigen, or a class derived from one; and is it a Ref, which may hold what it shows?
template <class Derived>
std::type_identity<Derived> eigen_type(const Eigen::DenseBase<Derived>&);
template <class Type>
inline constexpr bool kIsEigenRef = false;
template <class Matrix, int kOptions, class Stride>
inline constexpr bool kIsEigenRef<Eigen::Ref<Matrix, kOptions, Stride>> = true;

// Can every `Number` be written as a `Scalar`?
template <class Number, class Scalar>
inline constexpr bool kFits = std::numeric_limits<Number>::digits <= std::numeric_limits<Scalar>::digits &&
                              (std::numeric_limits<Number>::is_integer || !std::numeric_limits<Scalar>::is_integer);

// A 3 x N matrix: a column a vertex, or a facet. Made from any matrix or expression of Eigen. One whose columns lie
// whole in memory (a Matrix3X, a Map, the top rows of a larger one) is looked at where it is, and must stay there as
// long as this is used. Anything else, an expression, a temporary matrix or Ref, one that is row-major or of other
// numbers, is held by this and its copies. (A temporary block or Map is a view too: what it shows must stay.)
template <class Scalar>
class Columns {
  using Matrix = Eigen::Matrix<Scalar, 3, Eigen::Dynamic>;

 public:
  template <class Given>
  requires requires(const Given& given) { eigen_type(given); }
  Columns(Given&& matrix) : rows_(matrix.rows()), cols_(matrix.cols()) {  // NOLINT: implicit
    using Type = typename decltype(eigen_type(matrix))::type;
    using Number = typename Type::Scalar;
    static_assert(Type::RowsAtCompileTime == 3 || Type::RowsAtCompileTime == Eigen::Dynamic,
                  "a vertex or a facet is a column of three rows: transpose a matrix that has them in rows");
    static_assert(kFits<Number, Scalar>, "cast<>() the matrix: its numbers need not fit");
    constexpr bool kIsTemporary = !std::is_lvalue_reference_v<Given> &&
                                  (std::is_base_of_v<Eigen::PlainObjectBase<Type>, Type> || kIsEigenRef<Type>);
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
  Eigen::Index stride() const { return stride_; }  // from a column to the next

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
