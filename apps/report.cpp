#include "apps/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/run_account.h"

namespace curvefusion {

namespace {

std::string Counted(int count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

// "5.0 mm", "4.5 to 7.0 mm" or "unknown".
std::string DiameterText(const GraphFigures& figures) {
  std::vector<double> known;
  for (const double radius : figures.edge_radius) {
    if (radius > 0) known.push_back(2 * radius / kMillimetre);
  }
  if (known.empty()) return "unknown";
  const auto [least, most] = std::minmax_element(known.begin(), known.end());
  const std::string from = fmt::format("{:.1f}", *least);
  const std::string to = fmt::format("{:.1f}", *most);
  return from == to ? from + " mm" : fmt::format("{} to {} mm", from, to);
}

std::string TrustText(const Trust& trust) { return trust.is_judged() ? TrustLines(trust) : ""; }

constexpr const char* kNothingThinHints =
    "  Thin parts show where they are 2 to 12 mm thick, 0.5 to 0.7 m away, some centimetres in\n"
    "  front of other things, and not black to the infrared camera. `curvefusion check` tells\n"
    "  whether poses and depth unit fit; --save-stages keeps what every step found.\n";
constexpr const char* kNothingWithoutDepthHints =
    "  Without depth, wires show that stand out from all that is around them, in 40 sharp images\n"
    "  or more from 40 degrees around, with poses in metres that are exact to some pixels.\n"
    "  --save-stages keeps what every step found.\n";
constexpr const char* kKeepUncertainHint =
    "  Curves that may be wires are grey in the picture and the page: if they are wires, keep "
    "them\n"
    "  with --set evidence.min_probability=0.\n";

std::string NothingThinText(const Reconstruction& reconstruction) {
  return fmt::format(
      "Found nothing thin: {}.\n{}{}", WhyNothing(reconstruction),
      reconstruction.sequence.has_depth ? kNothingThinHints : kNothingWithoutDepthHints,
      reconstruction.uncertain.graph.empty() ? "" : kKeepUncertainHint);
}

}  // namespace

std::string FiguresLine(const GraphFigures& figures) {
  return fmt::format("{}, {:.2f} m, diameter {}, {}, {}", Counted(figures.edges, "curve"),
                     figures.length, DiameterText(figures), Counted(figures.junctions, "junction"),
                     Counted(figures.free_ends, "free end"));
}

std::string Summary(const RunRecord& record, const std::filesystem::path& folder,
                    const std::filesystem::path& page, const std::filesystem::path& report) {
  const SkeletonGraph& skeleton = record.reconstruction.skeleton;
  std::string text = skeleton.empty()
                         ? NothingThinText(record.reconstruction)
                         : fmt::format("Found {}\n{}", FiguresLine(MeasureGraph(skeleton)),
                                       TrustText(record.reconstruction.trust));
  text += UncertainLine(record.reconstruction.uncertain.lengths);
  const auto add_file = [&](const char* what, const std::filesystem::path& file) {
    text += fmt::format("  {:<9} {}\n", what, file.string());
  };
  const bool has_uncertain = !record.reconstruction.uncertain.graph.empty();
  const bool replaces = !skeleton.empty() || report.filename() == "report.json";
  add_file("page", page);
  if (replaces && (!skeleton.empty() || has_uncertain)) add_file("picture", folder / "preview.png");
  if (!skeleton.empty()) {
    add_file("mesh", folder / "mesh.ply");
    if (record.hybrid) {
      add_file("hybrid", folder / "hybrid.ply");
      add_file("to print", folder / "hybrid.stl");
    }
    add_file("skeleton", folder / "skeleton.json");
  }
  if (replaces && has_uncertain) add_file("uncertain", folder / "uncertain.json");
  add_file("report", report);
  if (!replaces) {
    text += fmt::format("  the result of an earlier run stays in {}\n", folder.string());
  }
  for (const std::string& warning : AllWarnings(record)) text += "  warning: " + warning + "\n";
  return text;
}

}  // namespace curvefusion
