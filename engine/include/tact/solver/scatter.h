// The derivatives of a stencil in the vectors and matrices of a whole system, three rows a vertex.
#pragma once

#include <tact/solver/stencil.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace tact::solver {

/// Adds a stencil's gradient to that of the system. Vertices beyond the end of `gradient` do not move. A Map makes a
/// vector of a plain array.
inline void add_gradient(const Stencil& stencil, const Vector12d& of_stencil, Eigen::Ref<Eigen::VectorXd> gradient) {
  for (int k = 0; k < stencil.size(); ++k) {
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(stencil.vertices[static_cast<std::size_t>(k)]);
    if (row + 3 <= gradient.size()) gradient.segment<3>(row) += of_stencil.segment<3>(3 * k);
  }
}

/// Calls visit(row, column, value) for each entry of a stencil's Hessian between vertices below `moving`.
template <class Visit>
void for_each_entry(const Stencil& stencil, const Matrix12d& hessian, int moving, const Visit& visit) {
  for (int k = 0; k < stencil.size(); ++k)
    for (int l = 0; l < stencil.size(); ++l) {
      const int of_k = stencil.vertices[static_cast<std::size_t>(k)],
                of_l = stencil.vertices[static_cast<std::size_t>(l)];
      if (of_k >= moving || of_l >= moving) continue;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) visit(3 * of_k + i, 3 * of_l + j, hessian(3 * k + i, 3 * l + j));
    }
}

/// Appends a stencil's Hessian for SparseMatrix::setFromTriplets(), which adds up entries of one place.
inline void append_triplets(const Stencil& stencil, const Matrix12d& hessian, int moving,
                            std::vector<Eigen::Triplet<double>>& triplets) {
  for_each_entry(stencil, hessian, moving,
                 [&](int row, int column, double value) { triplets.emplace_back(row, column, value); });
}

/// Adds a stencil's Hessian to a square matrix of three rows a moving vertex. It is fast where the entries are there.
inline void add_hessian(const Stencil& stencil, const Matrix12d& hessian, Eigen::SparseMatrix<double>& matrix) {
  for_each_entry(stencil, hessian, static_cast<int>(matrix.rows() / 3),
                 [&](int row, int column, double value) { matrix.coeffRef(row, column) += value; });
}

}  // namespace tact::solver
