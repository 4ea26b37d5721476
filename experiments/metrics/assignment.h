#pragma once

#include <Eigen/Core>
#include <vector>

namespace curvefusion {

/// Pairs rows with columns one to one so that the sum of the pairs' costs is least; of the longer
/// side some stay without partner. Entry r is the column of row r, or -1. Costs must be finite. The
/// Hungarian method with shortest augmenting paths (Jonker and Volgenant 1987): O(n^2 m) for n rows
/// and m columns, n <= m.
std::vector<int> MinimumCostAssignment(const Eigen::MatrixXd& cost);

}  // namespace curvefusion
