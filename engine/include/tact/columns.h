// Matrices of three rows, or two: of Eigen, or arrays of the program. Eigen is needed only where its matrices are
// passed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

namespace Eigen {
template <typename Derived>
class DenseBase;
template <typename Derived>
class PlainObjectBase;
template <typename PlainObjectType, int Options, typename StrideType>
class Ref;
template <typename Scalar, int Rows, int Cols, int Options, int MaxRows, int MaxCols>
class Matrix;
}  // namespace Eigen

namespace tact {

// The type of an expression of Eigen, and whether it is a Ref, which may hold a copy.
template <class Derived>
std::type_identity<Derived> eigen_type(const Eigen::DenseBase<Derived>&);
template <class Type>
inline constexpr bool kIsEigenRef = false;
template <class Matrix, int kOptions, class Stride>
inline constexpr bool kIsEigenRef<Eigen::Ref<Matrix, kOptions, Stride>> = true;
inline constexpr int kEigenDynamic = -1;              // Eigen::Dynamic
inline constexpr unsigned kEigenDirectAccess = 0x40;  // Eigen::DirectAccessBit

// Whether every `Number` is a `Scalar` exactly.
template <class Number, class Scalar>
inline constexpr bool kFits = std::numeric_limits<Number>::digits <= std::numeric_limits<Scalar>::digits &&
                              (std::numeric_limits<Number>::is_integer || !std::numeric_limits<Scalar>::is_integer);

/// The types of numbers in arrays: float32 or float64 for coordinates, the others for indices.
enum class NumberKind : std::uint8_t { float32, float64, int32, uint32, uint16 };

/// Returns the kind of `Number`, one of those that `Scalar` admits.
template <class Number, class Scalar>
constexpr NumberKind number_kind() {
  if constexpr (std::is_same_v<Scalar, double>) {
    static_assert(std::is_same_v<Number, float> || std::is_same_v<Number, double>, "coordinates are float or double");
    return std::is_same_v<Number, float> ? NumberKind::float32 : NumberKind::float64;
  } else {
    static_assert(
        std::is_integral_v<Number> && (sizeof(Number) == 4 || (sizeof(Number) == 2 && std::is_unsigned_v<Number>)),
        "indices are of 32 bits, or unsigned of 16");
    if (sizeof(Number) == 2) return NumberKind::uint16;
    return std::is_unsigned_v<Number> ? NumberKind::uint32 : NumberKind::int32;
  }
}

/// A matrix of kRows rows, a column a vertex, a facet or an edge. It views a lasting matrix of Eigen that has whole
/// columns of `Scalar`. It holds a copy of any other: temporary, row-major or converted.
template <class Scalar, int kRows = 3>
class Columns {
  using Matrix = Eigen::Matrix<Scalar, kRows, kEigenDynamic, 0, kRows, kEigenDynamic>;

 public:
  /// Has no columns.
  static Columns none() { return {}; }
  /// Views `count` columns of kRows numbers each, `stride_bytes` apart, in an array that stays. Floats widen exactly.
  template <class Number>
  static Columns strided(const Number* first, std::size_t count, std::size_t stride_bytes = kRows * sizeof(Number)) {
    return of_kind(number_kind<Number, Scalar>(), first, count, stride_bytes);
  }
  /// Views an array of a kind that is known when the program runs.
  static Columns of_kind(NumberKind kind, const void* first, std::size_t count, std::size_t stride_bytes) {
    Columns columns;
    columns.data_ = first;
    columns.cols_ = static_cast<std::ptrdiff_t>(count);
    columns.stride_bytes_ = static_cast<std::ptrdiff_t>(stride_bytes);
    columns.kind_ = kind;
    return columns;
  }

  template <class Given>
  requires requires(const Given& given) { eigen_type(given); }
  Columns(Given&& matrix) : rows_(matrix.rows()), cols_(matrix.cols()) {  // NOLINT: implicit
    using Type = typename decltype(eigen_type(matrix))::type;
    using Number = typename Type::Scalar;
    static_assert(Type::RowsAtCompileTime == kRows || Type::RowsAtCompileTime == kEigenDynamic,
                  "a vertex or a facet is a column of three rows: transpose a matrix that has them in rows");
    static_assert(kFits<Number, Scalar>, "cast<>() the matrix: its numbers need not fit");
    constexpr bool kIsTemporary = !std::is_lvalue_reference_v<Given> &&
                                  (std::is_base_of_v<Eigen::PlainObjectBase<Type>, Type> || kIsEigenRef<Type>);
    constexpr bool kHasWholeColumns = (Type::Flags & kEigenDirectAccess) != 0 && !Type::IsRowMajor &&
                                      Type::InnerStrideAtCompileTime == 1 && std::is_same_v<Number, Scalar>;
    if constexpr (kHasWholeColumns && !kIsTemporary) {
      data_ = matrix.data();
      stride_bytes_ = matrix.outerStride() * static_cast<std::ptrdiff_t>(sizeof(Scalar));
    } else if (rows_ == kRows) {
      if constexpr (std::is_same_v<Given, Matrix>) {
        hold(std::make_shared<const Matrix>(std::move(matrix)));
      } else {
        hold(std::make_shared<const Matrix>(matrix.template cast<Scalar>()));
      }
    }
  }

  std::ptrdiff_t rows() const { return rows_; }  ///< kRows, or a world refuses the matrix
  std::ptrdiff_t cols() const { return cols_; }
  NumberKind kind() const { return kind_; }
  const void* first() const { return data_; }                    ///< the first number
  std::ptrdiff_t stride_bytes() const { return stride_bytes_; }  ///< the distance of columns
  /// Returns the first number if all are `Scalar`s, else null.
  const Scalar* data() const { return kind_ == kOwnKind ? static_cast<const Scalar*>(data_) : nullptr; }
  std::ptrdiff_t stride() const { return stride_bytes_ / static_cast<std::ptrdiff_t>(sizeof(Scalar)); }

  /// Returns the numbers of column `i`. Indices of 2^31 and more wrap.
  std::array<Scalar, static_cast<std::size_t>(kRows)> column(std::ptrdiff_t i) const {
    const std::byte* const at = static_cast<const std::byte*>(data_) + i * stride_bytes_;
    switch (kind_) {
      case NumberKind::float32: return numbers<float>(at);
      case NumberKind::float64: return numbers<double>(at);
      case NumberKind::int32: return numbers<std::int32_t>(at);
      case NumberKind::uint32: return numbers<std::uint32_t>(at);
      case NumberKind::uint16: return numbers<std::uint16_t>(at);
    }
    return {};
  }

 private:
  // Copied byte by byte: nothing is known of the alignment.
  template <class Number>
  static std::array<Scalar, static_cast<std::size_t>(kRows)> numbers(const std::byte* at) {
    std::array<Number, static_cast<std::size_t>(kRows)> numbers;
    std::memcpy(numbers.data(), at, sizeof numbers);
    std::array<Scalar, static_cast<std::size_t>(kRows)> column;
    for (std::size_t row = 0; row < kRows; ++row) column[row] = static_cast<Scalar>(numbers[row]);
    return column;
  }

  static constexpr NumberKind kOwnKind = number_kind<Scalar, Scalar>();

  Columns() = default;
  template <class Held>
  void hold(std::shared_ptr<const Held> matrix) {
    data_ = matrix->data();
    held_ = std::move(matrix);
  }

  const void* data_ = nullptr;
  std::ptrdiff_t rows_ = kRows;
  std::ptrdiff_t cols_ = 0;
  std::ptrdiff_t stride_bytes_ = kRows * sizeof(Scalar);
  NumberKind kind_ = kOwnKind;
  std::shared_ptr<const void> held_;
};

using Positions = Columns<double>;  ///< 3 x V, metres
using Facets = Columns<int>;        ///< 3 x F, indices of vertices, counter-clockwise seen from outside
using Edges = Columns<int, 2>;      ///< 2 x E, indices of vertices

}  // namespace tact
