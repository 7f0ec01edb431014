// The nearest matrix without negative eigenvalues, for Newton's method.
#pragma once

#include <tact/solver/distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tact::solver {

/// Eigenvalues of a symmetric matrix, and its eigenvectors as columns.
struct Eigen12 {
  Vector12d values = Vector12d::Zero(), beside = values;  // `beside`: next to the diagonal, zero in the end
  Matrix12d vectors = Matrix12d::Zero();
};

/// Returns the tridiagonal form of a symmetric matrix and the basis that it has it in. (G. Golub, C. Van Loan, Matrix
/// Computations, algorithm 8.3.1.)
//
// In plain loops: Eigen's own solver costs each source that includes this 6 s of compilation, and is no faster.
inline Eigen12 tridiagonal(Matrix12d a) {
  Eigen12 result;
  for (int i = 0; i < 12; ++i) result.vectors(i, i) = 1.0;
  for (int k = 0; k < 10; ++k) {
    Vector12d v = Vector12d::Zero(), w = v;
    double square = 0.0;
    for (int i = k + 1; i < 12; ++i) v[i] = a(i, k), square += v[i] * v[i];
    const double length = -std::copysign(std::sqrt(square), v[k + 1]);
    result.beside[k] = length;
    if (square == v[k + 1] * v[k + 1]) {  // the reflection that changes nothing but a sign
      result.beside[k] = v[k + 1];
      continue;
    }
    const double beta = 1.0 / (square - v[k + 1] * length);
    v[k + 1] -= length;
    double both = 0.0;
    for (int j = k + 1; j < 12; ++j)
      for (int i = k + 1; i < 12; ++i) w[i] += beta * v[j] * a(i, j);
    for (int i = k + 1; i < 12; ++i) both += 0.5 * beta * w[i] * v[i];
    for (int i = k + 1; i < 12; ++i) w[i] -= both * v[i];
    for (int j = k + 1; j < 12; ++j)
      for (int i = k + 1; i < 12; ++i) a(i, j) -= v[i] * w[j] + w[i] * v[j];
    Vector12d along = Vector12d::Zero();
    for (int j = k + 1; j < 12; ++j)
      for (int i = 0; i < 12; ++i) along[i] += beta * v[j] * result.vectors(i, j);
    for (int j = k + 1; j < 12; ++j)
      for (int i = 0; i < 12; ++i) result.vectors(i, j) -= along[i] * v[j];
  }
  result.beside[10] = a(11, 10);
  for (int i = 0; i < 12; ++i) result.values[i] = a(i, i);
  return result;
}

/// Makes `beside` zero from `first` to `last` by a step of the implicit QR method with Wilkinson's shift, or smaller.
/// (Golub, Van Loan, algorithm 8.3.2.)
inline void step_of_qr(Eigen12& m, int first, int last) {
  auto& [d, e, vectors] = m;
  const double half = 0.5 * (d[last - 1] - d[last]), beside = e[last - 1];
  const double shift =
      d[last] - beside * beside / (half + std::copysign(std::sqrt(half * half + beside * beside), half));
  double x = d[first] - shift, z = e[first];
  for (int k = first; k < last; ++k) {
    const double length = std::sqrt(x * x + z * z), c = length > 0.0 ? x / length : 1.0,
                 s = length > 0.0 ? -z / length : 0.0;
    const double across = s * d[k] + c * e[k], below = s * e[k] + c * d[k + 1];
    d[k] = c * (c * d[k] - s * e[k]) - s * (c * e[k] - s * d[k + 1]);
    d[k + 1] = s * across + c * below;
    e[k] = c * across - s * below;
    if (k > first) e[k - 1] = c * e[k - 1] - s * z;
    x = e[k];
    if (k + 1 < last) z = -s * e[k + 1], e[k + 1] *= c;
    for (int i = 0; i < 12; ++i) {
      const double p = vectors(i, k), q = vectors(i, k + 1);
      vectors(i, k) = c * p - s * q;
      vectors(i, k + 1) = s * p + c * q;
    }
  }
}

/// Returns the eigenvalues and eigenvectors of a symmetric matrix, in no order.
inline Eigen12 eigen12(const Matrix12d& symmetric) {
  Eigen12 result = tridiagonal(symmetric);
  auto& [values, beside, vectors] = result;
  int last = 11;
  // Two steps or three an eigenvalue; the bound ends it for what is not finite.
  for (int step = 0; last > 0 && step < 360; ++step) {
    for (int i = 0; i < last; ++i) {
      const double least = std::numeric_limits<double>::epsilon() * (std::abs(values[i]) + std::abs(values[i + 1]));
      if (std::abs(beside[i]) <= least) beside[i] = 0.0;
    }
    while (last > 0 && beside[last - 1] == 0.0) --last;
    int first = last - 1;
    while (first > 0 && beside[first - 1] != 0.0) --first;
    if (last > 0) step_of_qr(result, first, last);
  }
  return result;
}

/// Returns the nearest positive semidefinite matrix: negative eigenvalues become 0.
inline Matrix12d projected(const Matrix12d& hessian) {
  double largest = 0.0;
  for (int i = 0; i < 144; ++i) largest = std::max(largest, std::abs(hessian.data()[i]));
  if (!(largest > 0.0)) return hessian;
  const Eigen12 eigen = eigen12(hessian / largest);  // whose squares neither overflow nor vanish
  if (eigen.values.minCoeff() >= 0.0) return hessian;
  Matrix12d result = Matrix12d::Zero();
  for (int k = 0; k < 12; ++k) {
    for (int j = 0; eigen.values[k] > 0.0 && j < 12; ++j) {
      const double scale = largest * eigen.values[k] * eigen.vectors(j, k);
      for (int i = 0; i < 12; ++i) result(i, j) += scale * eigen.vectors(i, k);
    }
  }
  return result;
}

/// Returns a term with its Hessian projected, so that Newton's method descends.
inline Term projected(Term term) {
  term.hessian = projected(term.hessian);
  return term;
}

}  // namespace tact::solver
