#include "experiments/metrics/assignment.h"

#include <limits>

namespace curvefusion {
namespace {

// Pairs rows one by one. `row_price + column_price <= cost` holds everywhere, with equality on the
// pairs; column 0 and row 0 are a virtual start, so that rows and columns count from 1.
class HungarianMethod {
 public:
  explicit HungarianMethod(const Eigen::MatrixXd& cost)
      : cost_(cost),
        row_price_(cost.rows() + 1, 0.0),
        column_price_(cost.cols() + 1, 0.0),
        row_of_(cost.cols() + 1, 0) {
    for (int row = 1; row <= cost.rows(); ++row) PairRow(row);
  }

  std::vector<int> ColumnOfRows() const {
    std::vector<int> column_of(cost_.rows(), -1);
    for (size_t column = 1; column < row_of_.size(); ++column) {
      if (row_of_[column] > 0) column_of[row_of_[column] - 1] = static_cast<int>(column) - 1;
    }
    return column_of;
  }

 private:
  // Grows a tree of shortest paths from the row until it reaches a free column, then swaps the
  // pairs along the path.
  void PairRow(int row) {
    const int columns = static_cast<int>(cost_.cols());
    std::vector<double> slack(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<int> before(columns + 1, 0);
    std::vector<bool> reached(columns + 1, false);
    row_of_[0] = row;
    int column = 0;
    while (row_of_[column] != 0) {
      reached[column] = true;
      UpdateSlack(column, reached, slack, before);
      const int next = LeastSlack(reached, slack);
      RaisePrices(slack[next], reached, slack);
      column = next;
    }
    for (; column != 0; column = before[column]) row_of_[column] = row_of_[before[column]];
  }

  void UpdateSlack(int from, const std::vector<bool>& reached, std::vector<double>& slack,
                   std::vector<int>& before) const {
    const int row = row_of_[from];
    for (int column = 1; column <= cost_.cols(); ++column) {
      if (reached[column]) continue;
      const double reduced = cost_(row - 1, column - 1) - row_price_[row] - column_price_[column];
      if (reduced >= slack[column]) continue;
      slack[column] = reduced;
      before[column] = from;
    }
  }

  int LeastSlack(const std::vector<bool>& reached, const std::vector<double>& slack) const {
    int best = 0;
    for (int column = 1; column <= cost_.cols(); ++column) {
      if (!reached[column] && (best == 0 || slack[column] < slack[best])) best = column;
    }
    return best;
  }

  void RaisePrices(double delta, const std::vector<bool>& reached, std::vector<double>& slack) {
    for (int column = 0; column <= cost_.cols(); ++column) {
      if (reached[column]) {
        row_price_[row_of_[column]] += delta;
        column_price_[column] -= delta;
      } else {
        slack[column] -= delta;
      }
    }
  }

  const Eigen::MatrixXd& cost_;
  std::vector<double> row_price_;
  std::vector<double> column_price_;
  std::vector<int> row_of_;  // 0 = free
};

}  // namespace

std::vector<int> MinimumCostAssignment(const Eigen::MatrixXd& cost) {
  if (cost.rows() <= cost.cols()) return HungarianMethod(cost).ColumnOfRows();
  const Eigen::MatrixXd transposed = cost.transpose();
  const std::vector<int> row_of = HungarianMethod(transposed).ColumnOfRows();
  std::vector<int> column_of(cost.rows(), -1);
  for (size_t column = 0; column < row_of.size(); ++column) {
    column_of[row_of[column]] = static_cast<int>(column);
  }
  return column_of;
}

}  // namespace curvefusion
