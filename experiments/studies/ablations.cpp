#include "experiments/studies/ablations.h"

namespace curvefusion {

namespace {

// Steps up to the points of bundles, CurveFusion 4.1.
std::vector<Ablation> OfSegmentation() {
  return {
      {"poses held to surfaces",
       {"depth.hold_to_surfaces=false"},
       "What stands behind the wires shows how the camera moved better than trackers do."},
      {"fine wires magnified",
       {"depth.magnify_fine_wires=false"},
       "Scanners for close range show wires far thinner than those that lengths were chosen on."},
      {"volume stride", {"volume.stride=1"}, "Time: large surfaces are seen often enough."},
      {"volume grid",
       {"volume.voxel_size=0.005", "volume.truncation_voxels=8"},
       "Time and memory: the volume holds large surfaces only."},
      {"coarse rendering",
       {"segmentation.render_divisor=1"},
       "Time: the rendering shows large surfaces only."},
      {"front distance",
       {"segmentation.front_distance=0"},
       "Surfaces are noisier than their mean model; both profiles need it."},
      {"rendering required",
       {"segmentation.accept_where_nothing_rendered=true"},
       "Where nothing is rendered there is no surface to subtract; both profiles need it.",
       {"segmentation.front_distance"}},
      {"missing background",
       {"segmentation.min_measured_share=0"},
       "Cameras of short range, and programs that cut depth off, leave nothing behind the wires."},
      {"solidity",
       {"segmentation.solid_depth=0"},
       "Wires side by side look like a large surface to the volume."},
      {"openness",
       {"segmentation.openness_stride=0"},
       "Wire arrays look like a large surface where only few pixels pass between them."},
      {"colour gate",
       {"segmentation.gate_frames=0"},
       "Colours part wires side by side where depth is one sheet.",
       {"segmentation.max_colour_width"}},
      {"wire arrays",
       {"segmentation.max_array_spacing=0"},
       "Wires 8 to 13 mm apart look like a board to depth; colours show them as stripes.",
       {"registration.resolved_spacing"}},
      {"crowded frames",
       {"segmentation.max_frame_points=0"},
       "Time: where wires are many, every second frame shows them as well."},
      {"silhouette margin",
       {"segmentation.silhouette_margin_px=0"},
       "Block matching fattens the silhouettes of large surfaces."},
      {"neighbours", {"segmentation.min_neighbours=0"}, "Lone pixels are noise."},
      {"bundle grid",
       {"bundle.voxel_size=0.005", "ghosts.core_points=12"},
       "Finer points; the density of DBSCAN goes with the grid."},
      {"frames per point", {"bundle.min_frames=1"}, "Noise does not come back at the same place."},
      {"edge tolerance",
       {"ghosts.tolerance_px=0"},
       "Colour edges are blurred and shifted against depth."},
      {"far parts",
       {"ghosts.isolated_share=2"},
       "Parts of one object may be far apart, where the wires between have no depth."}};
}

// From bundles to one set of points.
std::vector<Ablation> OfRegistration() {
  return {{"trusted bundles",
           {"registration.min_inliers=0"},
           "A bundle that fits the curves badly keeps its pose."},
          {"frame registration", {"registration.rounds=0"}, "Frames drift within a bundle."},
          {"points near curves",
           {"registration.frame_reach=1"},
           "Where wires are dense, most points lie between them."},
          {"smooth drift",
           {"registration.drift_translation=0.1", "registration.drift_rotation=0.1"},
           "Cameras drift slowly; what single frames tell is noisier than that."},
          {"point to line",
           {"registration.point_to_line=false"},
           "Curves seen in part slide along each other instead of sticking."},
          {"fewer pairs",
           {"registration.max_points=2000", "registration.max_iterations=40"},
           "Time: registration needs few points and iterations."},
          {"axis depth",
           {"registration.axis_depth=0"},
           "A depth camera sees the near side of a wire, not its axis."},
          {"noise metric",
           {"registration.min_linearity=0"},
           "Depth noise larger than the wires blurs curves along the viewing rays."}};
}

// Steps from points to curves.
std::vector<Ablation> OfRidges() {
  return {{"kernel by thickness",
           {"ridge_projection.sigma_per_thickness=0"},
           "A thin kernel splits thick wires into parallel curves.",
           {"ridge_projection.max_sigma"}},
          {"ridge strength",
           {"ridge_projection.min_relative_strength=0", "ridge_projection.min_local_strength=0"},
           "Weak ridges lie beyond an end, beside a wire, or are outliers."},
          {"stretched kernel",
           {"ridge_projection.stretch=1"},
           "More points along a wire steady its curve."},
          {"ridge flatness", {"ridge_projection.max_flatness=10"}, "A sheet of noise is no ridge."},
          {"ridge contrast",
           {"ridge_projection.min_share=0"},
           "Between wires the sensor scatters points that make weak ridges."},
          {"ridge elongation",
           {"ridge_projection.max_elongation=100"},
           "False ridges lie between parallel wires."},
          {"links along ridges",
           {"curve_network.direction_penalty=0"},
           "Links across the ridge join parallel wires."},
          {"spurs", {"curve_network.min_spur=0"}, "Short dead ends are noise."},
          {"closed gaps",
           {"free_ends.max_gap=0", "free_ends.max_facing_gap=0", "free_ends.touch_distance=0"},
           "Wires are not seen everywhere; CurveFusion leaves gaps open.",
           {"free_ends"}},
          {"straight tips",
           {"free_ends.tip_length=0"},
           "At the very end of a wire its ridge turns sideways."},
          {"placed junctions",
           {"junction_refinement.reach=0.001"},
           "The kernel blurs junctions; they lie where the lines of their branches meet.",
           {"junction_refinement.inner_radius"}},
          {"forks",
           {"junction_refinement.fork_fit_length=0.001"},
           "Two wires at a small angle are one ridge for a long way."},
          {"merged junctions",
           {"junction_refinement.merge_distance=0", "junction_refinement.min_distance=0"},
           "The kernel tears a crossing into junctions of fewer branches."},
          {"fragments",
           {"ridge_skeleton.fragment_length=0", "ridge_skeleton.min_component=0"},
           "Short pieces are noise."},
          {"curve smoothing",
           {"ridge_skeleton.smoothing_length=0"},
           "Details shorter than the kernel are noise."}};
}

// What colour images tell of finished curves.
std::vector<Ablation> OfColours() {
  return {
      {"colour adjustment",
       {"colour_adjustment.enabled=false"},
       "Colour images show curves and poses to a tenth of a pixel.",
       {"colour_adjustment"}},
      {"colour start",
       {"depth.use=background"},
       "Cameras whose depth shows wires in wrong places: curves from colour alone, everywhere."},
      {"single edges",
       {"colour_adjustment.edges=false"},
       "A bar with a wire array on one side shows no strip of its own."},
      {"silhouettes",
       {"silhouettes.max_frames=0"},
       "Every image shows a wire as wire; depth shows false links between wires side by side and "
       "loses wires along the line of sight.",
       {"silhouettes"}},
      {"thin by proof",
       {"evidence.min_probability=0"},
       "Edges of surfaces, slats and what only some views show as thin are no wires."},
      {"gauges",
       {"radius.gauge_strips=0"},
       "Wires that are hardly measured are like those of their gauge."}};
}

}  // namespace

std::vector<Ablation> Ablations() {
  std::vector<Ablation> all;
  for (const auto& step : {OfSegmentation(), OfRegistration(), OfRidges(), OfColours()}) {
    all.insert(all.end(), step.begin(), step.end());
  }
  return all;
}

std::vector<FixedDeviation> FixedDeviations() {
  std::vector<FixedDeviation> fixed = {
      {"radius.search_px", "of the widths that are solved, which have no switch"}};
  for (const char* option :
       {"curve_network.max_link", "curve_network.min_loop", "registration.carried_voxel_size",
        "ridge_projection.kernel_sigma", "ridge_projection.spacing", "ridge_skeleton.step"}) {
    fixed.push_back({option,
                     "of the ridges of the density of all points, which the profile has "
                     "instead of fused L1 skeletons: it does not work without"});
  }
  return fixed;
}

}  // namespace curvefusion
