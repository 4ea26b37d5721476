#include "experiments/run_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "capture/camera_json.h"
#include "graph/graph_figures.h"
#include "kernel/angle.h"

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kBundle = 30;  // frames of a bundle in the paper; its times are given per bundle

// Counts are whole numbers nearly always; 12 reads better than 12.0.
Json NumberJson(double value) {
  const bool whole = std::abs(value) < 1e15 && value == std::floor(value);
  return whole ? Json(static_cast<int64_t>(value)) : Json(value);
}

Json StagesJson(const std::vector<StageReport>& stages) {
  Json result = Json::array();
  for (const StageReport& stage : stages) {
    Json counts = Json::object();
    for (const auto& [name, value] : stage.counts) counts[name] = NumberJson(value);
    result.push_back({{"name", stage.name},
                      {"seconds", stage.seconds},
                      {"peak_memory_bytes", stage.peak_memory},
                      {"counts", counts}});
    if (!stage.remark.empty()) result.back()["remark"] = stage.remark;
  }
  return result;
}

// The cameras the run began with.
Json CamerasJson(const RunRecord& record) {
  const Sequence& sequence = record.sequence;
  return {{"depth", CameraJson(sequence.depth_camera)},
          {"color", CameraJson(sequence.color_camera)},
          {"T_color_depth", RowsJson(sequence.T_color_depth)},
          {"color_from", record.colour_camera_fitted ? "fit" : "intrinsics"}};
}

Json SequenceJson(const Sequence& sequence) {
  return {{"folder", sequence.folder.string()},
          {"format", sequence.format},
          {"frames", sequence.frame_count()},
          {"frames_without_pose", sequence.frames_without_pose},
          {"frames_without_partner", sequence.frames_without_partner}};
}

// Where the poses came from.
Json PosesJson(const RunRecord& record) {
  if (!record.tracking) return {{"from", "sequence"}};
  Json lost = Json::array();
  for (const LostFrame& frame : record.tracking->lost) {
    lost.push_back({{"frame", frame.name}, {"why", frame.why}});
  }
  return {{"from", "tracking"}, {"keyframes", record.tracking->keyframes}, {"lost", lost}};
}

// What depth images were used for, and why; null for profiles that do not choose.
Json DepthJson(const DepthAccount& depth) {
  if (depth.use.empty()) return nullptr;
  return {{"use", depth.use}, {"why", depth.why}};
}

Json DiameterJson(double radius) {
  return radius > 0 ? Json(2 * radius / kMillimetre) : Json(nullptr);
}

Json ViewsJson(const ViewCount& views) { return {{"looked", views.looked}, {"seen", views.seen}}; }

// What single edges rest on, in the order of skeleton.json.
Json EdgesJson(const GraphFigures& figures, const Reconstruction& reconstruction) {
  const std::vector<EdgeId> ids = reconstruction.skeleton.Edges();
  std::map<EdgeId, EdgeRadius> measured;
  for (const EdgeRadius& radius : reconstruction.radii.edges) measured[radius.edge] = radius;
  std::map<EdgeId, ViewCount> views;
  for (const EdgeViews& edge : reconstruction.views.edges) {
    views[edge.edge] = TypicalViews(edge.points);
  }
  Json edges = Json::array();
  for (size_t i = 0; i < ids.size(); ++i) {
    const EdgeRadius& radius = measured[ids[i]];
    edges.push_back({{"length", figures.edge_length[i]},
                     {"diameter_mm", DiameterJson(figures.edge_radius[i])},
                     {"diameter_error_mm", DiameterJson(radius.error)},
                     {"strips", radius.count},
                     {"images", ViewsJson(views[ids[i]])}});
  }
  return edges;
}

Json JunctionsJson(const Reconstruction& reconstruction) {
  const SkeletonGraph& graph = reconstruction.skeleton;
  std::map<NodeId, ViewCount> views;
  for (const EdgeViews& edge : reconstruction.views.edges) {
    const auto& nodes = graph.edge(edge.edge).nodes;
    views[nodes[0]] = edge.points.front();
    views[nodes[1]] = edge.points.back();
  }
  Json junctions = Json::array();
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) < 3) continue;
    const Vec3& p = graph.position(node);
    junctions.push_back({{"position", {p.x(), p.y(), p.z()}},
                         {"degree", graph.Degree(node)},
                         {"images", ViewsJson(views[node])}});
  }
  return junctions;
}

Json SkeletonJson(const Reconstruction& reconstruction) {
  const GraphFigures figures = MeasureGraph(reconstruction.skeleton);
  return {{"nodes", figures.nodes},
          {"edges", figures.edges},
          {"junctions", figures.junctions},
          {"free_ends", figures.free_ends},
          {"components", figures.components},
          {"cycles", figures.cycles},
          {"length", figures.length},
          {"global_diameter_mm", DiameterJson(reconstruction.radii.global_radius)},
          {"images_looked_through", reconstruction.views.frames},
          {"per_edge", EdgesJson(figures, reconstruction)},
          {"per_junction", JunctionsJson(reconstruction)}};
}

Json MeshJson(const WatertightReport& figures, double seconds) {
  return {{"seconds", seconds},
          {"watertight", figures.IsWatertight()},
          {"vertices", figures.vertices},
          {"faces", figures.faces},
          {"components", figures.components},
          {"genus", figures.genus},
          {"volume", figures.volume},
          {"area", figures.area},
          {"boundary_edges", figures.boundary_edges},
          {"non_manifold_edges", figures.non_manifold_edges},
          {"non_manifold_vertices", figures.non_manifold_vertices},
          {"misoriented_edges", figures.misoriented_edges},
          {"degenerate_faces", figures.degenerate_faces},
          {"self_intersections", figures.self_intersections}};
}

Json HybridJson(const HybridRecord& hybrid) {
  Json json = MeshJson(hybrid.figures, hybrid.seconds);
  json["solid_parts"] = hybrid.parts;
  json["seen_area"] = hybrid.seen_area;
  json["room_area_left_out"] = hybrid.room_area;
  return json;
}

Json PixelsJson(double value) { return value > 0 ? Json(value) : Json(nullptr); }

Json FunnelJson(const Funnel& funnel) {
  const PointFunnel& points = funnel.points;
  const CurveFunnel& curves = funnel.curves;
  return {{"frames", points.frames},
          {"chroma", points.chroma},
          {"depth_pixels", points.depth_pixels},
          {"thin_pixels", points.thin_pixels},
          {"thin_pixels_after_colour_gate", points.gated_pixels},
          {"candidate_points", points.merged_points},
          {"dropped_points",
           {{"too_few_frames", points.too_few_frames},
            {"small_clusters", points.small_clusters},
            {"colour_unverified", points.unverified},
            {"isolated", points.isolated}}},
          {"points", points.points},
          {"contracted_length", curves.contracted},
          {"dropped_length",
           {{"surface_edge", curves.unproven.surface},
            {"thick", curves.unproven.thick},
            {"looked_past_by_depth", curves.unproven.looked_past},
            {"unproven", curves.unproven.unproven},
            {"looked_past", curves.looked_past}}},
          {"length", curves.curves}};
}

Json TrustJson(const Trust& trust) {
  return {{"wire_share", trust.length > 0 ? trust.wire_length / trust.length : 0},
          {"measured_diameter_share", trust.measured_share},
          {"depth_share", trust.depth_share},
          {"colour_share", trust.colour_share},
          {"adjusted_to_colour", trust.adjusted},
          {"from_colour_alone", trust.from_colour},
          {"residual_before_px", PixelsJson(trust.residual_before_px)},
          {"residual_px", PixelsJson(trust.residual_px)},
          {"pose_shift_mm", trust.pose_shift / kMillimetre},
          {"max_pose_shift_mm", trust.max_pose_shift / kMillimetre},
          {"pose_turn_degrees", trust.pose_turn / kDegree},
          {"view_angle_degrees", trust.view_angle / kDegree},
          {"doubts", Doubts(trust)}};
}

}  // namespace

// Each once: the reconstruction passes on what the sequence warned of.
std::vector<std::string> AllWarnings(const RunRecord& record) {
  std::vector<std::string> warnings;
  const auto append = [&](const std::vector<std::string>& more) {
    for (const std::string& warning : more) {
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) {
        warnings.push_back(warning);
      }
    }
  };
  append(record.sequence.warnings);
  append(record.reconstruction.warnings);
  append(Doubts(record.reconstruction.trust));
  if (record.mesh) append(record.mesh->warnings);
  if (record.hybrid) append(record.hybrid->warnings);
  return warnings;
}

Json ReportData(const RunRecord& record) {
  const Reconstruction& reconstruction = record.reconstruction;
  const int frames = record.sequence.frame_count();
  Json data = {
      {"format", "curvefusion-report"},
      {"version", 1},
      {"profile", ProfileName(record.config.profile)},
      {"sequence", SequenceJson(record.sequence)},
      {"cameras", CamerasJson(record)},
      {"poses", PosesJson(record)},
      {"depth", DepthJson(reconstruction.depth)},
      {"seconds", record.seconds},
      {"seconds_per_30_frames",
       frames > 0 ? Json(record.seconds * kBundle / frames) : Json(nullptr)},
      {"peak_memory_bytes", record.peak_memory},
      {"stages", StagesJson(reconstruction.stages)},
      {"points", reconstruction.points.size()},
      {"funnel", FunnelJson(reconstruction.funnel)},
      {"trust", reconstruction.trust.is_judged() ? TrustJson(reconstruction.trust) : Json(nullptr)},
      {"skeleton", SkeletonJson(reconstruction)},
      {"mesh", record.mesh ? MeshJson(record.mesh->figures, record.mesh->seconds) : Json(nullptr)},
      {"warnings", AllWarnings(record)}};
  if (record.hybrid) data["hybrid"] = HybridJson(*record.hybrid);
  return data;
}

std::string ReportJson(const RunRecord& record) {
  // Names of files need not be UTF-8.
  return ReportData(record).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace curvefusion
