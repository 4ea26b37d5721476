#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace curvefusion {

/// How the headline figures change by something.
struct ChangeRow {
  std::string name;
  std::vector<std::optional<double>> changes;  ///< in the order of HeadlineFigures()
};

/// Draws folder/NAME.png and .pdf: a row of bars a change, a panel for each of the most telling
/// figures. Bars for the better are blue, for the worse orange.
void DrawChanges(const std::filesystem::path& folder, const std::string& name,
                 const std::vector<ChangeRow>& rows);

}  // namespace curvefusion
