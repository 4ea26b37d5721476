#include "fusion/best/best_options.h"

#include <string>
#include <vector>

namespace curvefusion {

BestOptions DefaultBestOptions() {
  BestOptions options;
  options.volume.voxel_size = 0.01;
  options.depth.hold_to_surfaces = true;
  options.depth.magnify_fine_wires = true;
  options.volume_stride = 2;
  options.segmentation.render_divisor = 2;
  options.segmentation.opening.solid_depth = 0.03;
  options.segmentation.openness_stride = 5;
  options.segmentation.gate.frames = 10;
  options.segmentation.max_array_spacing = 0.013;
  options.segmentation.max_frame_points = 19000;
  // CurveFusion 4, assumption (i): thin structures lie 2 cm or more before other surfaces. Depth
  // with no rendering behind it is no wire in four of five pixels, on simulated scans.
  options.segmentation.difference.front_distance = 0.02;
  options.segmentation.difference.accept_where_nothing_rendered = false;
  options.segmentation.difference.silhouette_margin_px = 6;
  options.segmentation.difference.min_neighbours = 8;
  options.segmentation.min_measured_share = 0.5;
  options.segmentation.bundle.min_frames = 3;
  options.segmentation.edge_tolerance_px = 2;
  options.segmentation.ghosts.isolated_share = 0.75;
  options.registration.max_points = 700;
  options.registration.max_iterations = 12;
  options.axis_depth = 0.8;
  options.resolved_spacing = 0.014;
  options.colour_adjustment.enabled = true;
  return options;
}

const std::vector<std::string>& DepthRoleNames() {
  static const std::vector<std::string> names = {"auto", "wires", "background", "none"};
  return names;
}

const std::string& DepthRoleName(DepthRole role) {
  return DepthRoleNames()[static_cast<size_t>(role)];
}

void VisitOptions(DepthOptions& options, OptionVisitor& visitor) {
  int role = static_cast<int>(options.use);
  visitor.VisitChoice(
      {"use", "", 0, static_cast<double>(DepthRoleNames().size() - 1),
       "Deviation: what depth images are used for: wires; background only, curves then come from "
       "colour images wherever these show any; none, scale then is that of the poses. auto: wires, "
       "but background where depth shows them in wrong places, and none where there is no depth."},
      DepthRoleNames(), role);
  options.use = static_cast<DepthRole>(role);
  visitor.Visit({"hold_to_surfaces", "", 0, 1,
                 "Deviation: before all else, poses are corrected to fit the surfaces that depth "
                 "shows behind the wires, where depth images then agree better."},
                options.hold_to_surfaces);
  visitor.Visit({"magnify_fine_wires", "", 0, 1,
                 "Deviation: where depth shows wires thinner than 2.5 mm, or nothing, in fine "
                 "pixels, all is done once more in a larger world, in which these wires have 5 mm; "
                 "lengths in these settings then are of that world."},
                options.magnify_fine_wires);
}

void VisitOptions(BestOptions& options, OptionVisitor& visitor) {
  visitor.BeginSection("depth");
  VisitOptions(options.depth, visitor);
  visitor.BeginSection("volume");
  VisitOptions(options.volume, visitor);
  visitor.Visit(
      {"stride", "frames", 1, 100,
       "Deviation: only every so many-th frame is integrated; large surfaces are seen often "
       "enough."},
      options.volume_stride);
  VisitOptions(options.segmentation, visitor);
  visitor.BeginSection("registration");
  VisitOptions(options.carried, visitor);
  VisitOptions(options.frames, visitor);
  VisitOptions(options.registration, visitor);
  visitor.Visit({"axis_depth", "radii", 0, 1.5,
                 "Deviation: points are moved along their viewing rays by so many radii, from the "
                 "side that was seen to the axis."},
                options.axis_depth);
  visitor.Visit(
      {"min_linearity", "", 0, 1,
       "Deviation: where the points of one bundle look less curve-like than this from near, all "
       "are contracted in a space compressed along the viewing rays, along which depth noise is "
       "largest."},
      options.min_linearity);
  visitor.Visit(
      {"resolved_spacing", "m", 0, 0.1,
       "Deviation: where the wires of an array are closer than this, points are magnified so much "
       "before contraction that they are as far apart; 0 = never."},
      options.resolved_spacing);
  VisitOptions(options.ridge, visitor);
  visitor.BeginSection("radius");
  VisitOptions(options.radius, visitor);
  visitor.BeginSection("colour_adjustment");
  VisitOptions(options.colour_adjustment, visitor);
  visitor.BeginSection("silhouettes");
  VisitOptions(options.silhouettes, visitor);
  visitor.BeginSection("evidence");
  VisitOptions(options.evidence, visitor);
}

}  // namespace curvefusion
