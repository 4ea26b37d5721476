#include "graph/sparse_solver.h"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cassert>
#include <vector>

namespace curvefusion {

struct SparseSolver::Impl {
  Eigen::CholmodSimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors;
  std::vector<int> columns;  // where the entries of the analysed matrix are
  std::vector<int> rows;

  bool HasPatternOf(const Eigen::SparseMatrix<double>& matrix) const {
    return columns.size() == static_cast<size_t>(matrix.outerSize()) + 1 &&
           rows.size() == static_cast<size_t>(matrix.nonZeros()) &&
           std::equal(columns.begin(), columns.end(), matrix.outerIndexPtr()) &&
           std::equal(rows.begin(), rows.end(), matrix.innerIndexPtr());
  }

  void Analyse(const Eigen::SparseMatrix<double>& matrix) {
    factors.analyzePattern(matrix);
    columns.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1);
    rows.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
  }
};

SparseSolver::SparseSolver() : impl_(std::make_unique<Impl>()) {}
SparseSolver::~SparseSolver() = default;

void SparseSolver::Factorise(const Eigen::SparseMatrix<double>& lower) {
  if (!impl_->HasPatternOf(lower)) {
    impl_->Analyse(lower);
    ++analyses_;
  }
  impl_->factors.factorize(lower);
  assert(impl_->factors.info() == Eigen::Success);
}

Eigen::MatrixX3d SparseSolver::Solve(const Eigen::MatrixX3d& right_hand_sides) const {
  return impl_->factors.solve(right_hand_sides);
}

}  // namespace curvefusion
