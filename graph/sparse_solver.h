#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace curvefusion {

/// Solves symmetric positive definite systems by a sparse LDL^T factorisation (CHOLMOD). The
/// symbolic part is kept and used again as long as the matrices have their entries at the same
/// places.
class SparseSolver {
 public:
  SparseSolver();
  ~SparseSolver();

  /// Takes the lower triangle of a matrix. The matrix must be positive definite.
  void Factorise(const Eigen::SparseMatrix<double>& lower);

  /// The solution for one or more right-hand sides; Factorise must have been called.
  Eigen::MatrixX3d Solve(const Eigen::MatrixX3d& right_hand_sides) const;

  /// How often the symbolic part was made.
  int analyses() const { return analyses_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  int analyses_ = 0;
};

}  // namespace curvefusion
