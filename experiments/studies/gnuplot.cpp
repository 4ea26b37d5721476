#include "experiments/studies/gnuplot.h"

#include <fmt/format.h>

#include <string>

#include "kernel/atomic_file.h"
#include "kernel/child_program.h"
#include "kernel/error.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr int kPngDpi = 200;
constexpr double kLineDpi = 72;  // what gnuplot's line widths and point sizes are made for
constexpr double kFontDpi = 96;  // and its font sizes in pixels

// One set of commands, drawn into a PNG and a PDF of the same look.
std::string Script(const std::string& name, const Plot& plot) {
  return fmt::format(
      R"(# Draws {0}.png and {0}.pdf from {0}.dat: gnuplot {0}.gp
data = '{0}.dat'
do for [format in 'png pdf'] {{
reset
if (format eq 'png') {{
  set terminal pngcairo size {1:.0f},{2:.0f} font 'DejaVu Sans,8' fontscale {3:.3f} linewidth {7:.3f} pointscale {7:.3f}
}} else {{
  set terminal pdfcairo size {4}in,{5}in font 'DejaVu Sans,8'
}}
set output '{0}.'.format
set encoding utf8
set linetype 1 linecolor rgb '#D55E00' linewidth 1.6 pointtype 7 pointsize 0.6
set linetype 2 linecolor rgb '#0072B2' linewidth 1.6 pointtype 5 pointsize 0.6
set linetype 3 linecolor rgb '#009E73' linewidth 1.6 pointtype 9 pointsize 0.7
set linetype 4 linecolor rgb '#CC79A7' linewidth 1.6 pointtype 13 pointsize 0.8
set linetype 5 linecolor rgb '#E69F00' linewidth 1.6 pointtype 11 pointsize 0.7
set linetype 6 linecolor rgb '#56B4E9' linewidth 1.6 pointtype 15 pointsize 0.7
set border 3 linecolor rgb '#444444' linewidth 0.8
set grid linecolor rgb '#DDDDDD' linewidth 0.6 dashtype 1
set tics nomirror out scale 0.6
set key noautotitle
{6}
unset output
}}
)",
      name, plot.width * kPngDpi, plot.height * kPngDpi, kPngDpi / kFontDpi, plot.width,
      plot.height, plot.commands, kPngDpi / kLineDpi);
}

}  // namespace

void RequireGnuplot() {
  if (RunProgram("gnuplot", {"--version"}, ".").succeeded) return;
  throw Error(
      ErrorKind::kResource,
      "gnuplot draws the figures and cannot be run; on Debian: apt-get install gnuplot-nox");
}

void DrawPlot(const fs::path& folder, const std::string& name, const Plot& plot) {
  WriteBytesAtomically(folder / (name + ".dat"), plot.data);
  WriteBytesAtomically(folder / (name + ".gp"), Script(name, plot));
  const ProgramResult drawn = RunProgram("gnuplot", {name + ".gp"}, folder);
  if (drawn.succeeded) return;
  throw Error(ErrorKind::kResource,
              (folder / (name + ".gp")).string() + ": gnuplot failed: " + drawn.messages);
}

void DrawPictureGrid(const fs::path& folder, const std::string& name, const PictureGrid& grid) {
  constexpr double kLeft = 0.35;  // inches for the rows' names
  constexpr double kTop = 0.25;   // and for the columns'
  const size_t columns = grid.columns.size();
  const double width = kLeft + grid.cell_width * static_cast<double>(columns);
  const double height = kTop + grid.cell_height * static_cast<double>(grid.rows.size());
  std::string commands = fmt::format(
      "set multiplot\nunset border\nunset tics\nunset grid\nset size ratio -1\n"
      "set lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n");
  const auto label = [&](const std::string& text, double x, double y, const char* how) {
    commands += fmt::format("set label \"{}\" at screen {:.5f},{:.5f} center noenhanced {}\n", text,
                            x / width, 1 - y / height, how);
  };
  for (size_t c = 0; c < columns; ++c) {
    label(grid.columns[c], kLeft + grid.cell_width * (static_cast<double>(c) + 0.5), kTop / 2, "");
  }
  for (size_t r = 0; r < grid.rows.size(); ++r) {
    label(grid.rows[r], kLeft / 2, kTop + grid.cell_height * (static_cast<double>(r) + 0.5),
          "rotate by 90");
  }
  for (size_t i = 0; i < grid.pictures.size(); ++i) {
    if (grid.pictures[i].empty()) continue;
    const double x = kLeft + grid.cell_width * static_cast<double>(i % columns);
    const double y = kTop + grid.cell_height * static_cast<double>(i / columns + 1);
    commands += fmt::format(
        "set origin {:.5f},{:.5f}\nset size {:.5f},{:.5f}\n"
        "plot '{}' binary filetype=png with rgbimage\nunset label\n",
        x / width, 1 - y / height, grid.cell_width / width, grid.cell_height / height,
        grid.pictures[i]);
  }
  DrawPlot(
      folder, name,
      {"# the pictures are files of their own\n", commands + "unset multiplot", width, height});
}

}  // namespace curvefusion
