#include "tests/fusion/silhouettes/silhouette_scan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace curvefusion {

namespace {

constexpr int kRows = 4;
constexpr int kColumns = 6;
constexpr double kDistance = 0.6;  // metres
constexpr double kDepthScale = 1000;

RigidTransform Pose(int row, int column, double spread) {
  const double about_y = 1.4 * spread * (column / (kColumns - 1.0) - 0.5);
  const double about_x = 0.7 * spread * (row / (kRows - 1.0) - 0.5);
  RigidTransform T = RigidTransform::Identity();
  T.linear() =
      (Eigen::AngleAxisd(about_y, Vec3::UnitY()) * Eigen::AngleAxisd(about_x, Vec3::UnitX()))
          .matrix();
  T.translation() = T.linear() * Vec3(0, 0, -kDistance);
  return T;
}

PosteriorImage Render(const std::vector<Polyline>& wires,
                      const std::vector<std::vector<Vec3>>& plates, const PinholeCamera& camera,
                      const RigidTransform& T_camera_world) {
  cv::Mat image = cv::Mat::zeros(camera.height, camera.width, CV_8U);
  constexpr int kShift = 4;  // sixteenths of a pixel
  const auto fixed = [](double value) { return cvRound(value * (1 << kShift)); };
  for (const Polyline& wire : wires) {
    for (const Vec3& point : Resample(wire, 0.0005)) {
      const Vec3 p = T_camera_world * point;
      const Vec2 pixel = camera.Project(p);
      cv::circle(image, {fixed(pixel.x()), fixed(pixel.y())},
                 fixed(camera.fx * kTestRadius / p.z()), 255, cv::FILLED, cv::LINE_8, kShift);
    }
  }
  for (const std::vector<Vec3>& plate : plates) {
    std::vector<cv::Point> corners;
    for (const Vec3& corner : plate) {
      const Vec2 pixel = camera.Project(T_camera_world * corner);
      corners.emplace_back(cvRound(pixel.x()), cvRound(pixel.y()));
    }
    cv::fillConvexPoly(image, corners, 255);
  }
  PosteriorImage posterior(camera.width, camera.height);
  std::copy(image.begin<uint8_t>(), image.end<uint8_t>(), posterior.data());
  return posterior;
}

void WriteColor(const PosteriorImage& posterior, const std::filesystem::path& path) {
  cv::Mat image(posterior.height(), posterior.width(), CV_8UC3);
  for (int v = 0; v < posterior.height(); ++v) {
    for (int u = 0; u < posterior.width(); ++u) {
      const uint8_t grey = posterior(u, v) > 0 ? 60 : 170;
      image.at<cv::Vec3b>(v, u) = {grey, grey, grey};
    }
  }
  cv::imwrite(path.string(), image);
}

}  // namespace

SilhouetteScan::SilhouetteScan(const std::vector<Polyline>& wires,
                               const std::vector<std::vector<Vec3>>& plates, double depth,
                               double spread) {
  static int count = 0;
  folder_ = std::filesystem::temp_directory_path() /
            fmt::format("curvefusion_silhouettes_{}_{}", getpid(), ++count);
  std::filesystem::create_directories(folder_);
  const std::filesystem::path depth_path = folder_ / "depth.png";
  sequence_.depth_camera = sequence_.color_camera = {320, 240, 480, 480, 159.5, 119.5};
  sequence_.depth_scale = kDepthScale;
  cv::imwrite(depth_path.string(),
              cv::Mat(240, 320, CV_16U, cv::Scalar(std::lround(depth * kDepthScale))));
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      SequenceFrame frame;
      frame.T_world_camera = Pose(row, column, spread);
      frame.depth_path = depth_path;
      posteriors_.push_back(
          Render(wires, plates, sequence_.color_camera, frame.T_world_camera.inverse()));
      frame.color_path = folder_ / fmt::format("{}_{}.png", row, column);
      WriteColor(posteriors_.back(), frame.color_path);
      sequence_.frames.push_back(frame);
    }
  }
  frames_.resize(sequence_.frames.size());
  std::iota(frames_.begin(), frames_.end(), 0);
}

SilhouetteScan::~SilhouetteScan() { std::filesystem::remove_all(folder_); }

WireSilhouettes SilhouetteScan::Silhouettes() const {
  return {sequence_, frames_, posteriors_, static_cast<int>(frames_.size())};
}

SharesOfCurve SilhouetteScan::Shares() const {
  return [silhouettes = std::make_shared<WireSilhouettes>(Silhouettes())](const Polyline& points) {
    return silhouettes->SharesAlong(points);
  };
}

StripViews SilhouetteScan::Strips(const SkeletonGraph& known,
                                  const Eigen::AlignedBox3d& around) const {
  Eigen::AlignedBox3d box = around;
  for (const EdgeId id : known.Edges())
    for (const Vec3& p : known.edge(id).points) box.extend(p);
  StripViews views(sequence_, frames_, posteriors_, box);
  views.ExplainAll(known);
  return views;
}

Polyline TestLine(const Vec3& a, const Vec3& b) { return Resample({a, b}, 0.002); }

EdgeId AddTestEdge(SkeletonGraph& graph, NodeId a, NodeId b, Polyline points) {
  std::vector<double> radii(points.size(), kTestRadius);
  return graph.AddEdge({{a, b}, std::move(points), std::move(radii), {}});
}

EdgeId AddTestEdge(SkeletonGraph& graph, Polyline points) {
  const NodeId a = graph.AddNode(points.front());
  const NodeId b = graph.AddNode(points.back());
  return AddTestEdge(graph, a, b, std::move(points));
}

}  // namespace curvefusion
