#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curvefusion {

/// Throws Error(kResource) that tells what to install unless gnuplot can be run.
void RequireGnuplot();

/// A figure as gnuplot draws it.
struct Plot {
  std::string data;      ///< text of the data file: white space between columns
  std::string commands;  ///< `set` and `plot` commands; the data file is the variable `data`
  double width = 6;      ///< inches
  double height = 3.6;   ///< inches
};

/// Draws folder/NAME.png and folder/NAME.pdf. The script NAME.gp and the data NAME.dat stay beside
/// them: `gnuplot NAME.gp` in that folder draws both again. Line types 1 to 6 have colours that the
/// colour-blind tell apart. Throws Error(kResource) with gnuplot's message where it fails.
void DrawPlot(const std::filesystem::path& folder, const std::string& name, const Plot& plot);

/// Pictures side by side, with names above the columns and left of the rows.
struct PictureGrid {
  std::vector<std::string> columns;
  std::vector<std::string> rows;      ///< a backslash and an n part lines
  std::vector<std::string> pictures;  ///< PNG files relative to the folder, row by row; "" = none
  double cell_width = 1.1;            ///< inches
  double cell_height = 1.1;           ///< inches
};
void DrawPictureGrid(const std::filesystem::path& folder, const std::string& name,
                     const PictureGrid& grid);

}  // namespace curvefusion
