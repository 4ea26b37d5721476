#include "fusion/nets/net_sheets.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>

#include "capture/frame_stream.h"
#include "capture/image_mat.h"
#include "fusion/nets/smooth_depth.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// All chosen on training scans chair 5, grid 5, mixture 3, 5 and 7 (docs/nets.md).
constexpr int kFrames = 12;         // of the scan
constexpr int kPixels = 2;          // every so many-th of them, along rows and columns
constexpr int kBeside = 2;          // cells of nets to all sides in which there may be more of one
constexpr double kApart = 0.005;    // metres between the points that tell planes
constexpr int kTries = 300;         // planes through three points
constexpr double kOnPlane = 0.008;  // metres
constexpr double kOnSheet = 0.02;   // metres from its plane, so far as it bends
constexpr double kBlur = 0.008;     // metres, standard deviation
constexpr double kMinDensity = 0.15;  // of points, times what is usual

struct Plane {
  Vec3 center = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  // the last is the normal
  double Height(const Vec3& p) const { return axes.col(2).dot(p - center); }
};

std::set<VoxelKey> CellsAround(const Nets& nets) {
  std::set<VoxelKey> cells;
  for (const VoxelKey& cell : nets.cells)
    for (int z = -kBeside; z <= kBeside; ++z)
      for (int y = -kBeside; y <= kBeside; ++y)
        for (int x = -kBeside; x <= kBeside; ++x)
          cells.insert({cell.x + x, cell.y + y, cell.z + z});
  return cells;
}

std::vector<Vec3> PointsOnNets(const Sequence& sequence, const Nets& nets) {
  const std::set<VoxelKey> cells = CellsAround(nets);
  std::vector<Vec3> points;
  ForEachFrame(sequence, EvenlyThinned(AllFrames(sequence), kFrames), {.color = false},
               [&](const DecodedFrame& frame) {
                 const RigidTransform& T_world_camera = sequence.frames[frame.index].T_world_camera;
                 const SmoothDepth smooth(frame.depth);
                 for (int v = 0; v < frame.depth.height(); v += kPixels) {
                   for (int u = 0; u < frame.depth.width(); u += kPixels) {
                     const float z = smooth.At(u, v);
                     if (!(z > 0)) continue;
                     const Vec3 p = T_world_camera * sequence.depth_camera.Unproject(u, v, z);
                     if (cells.contains(VoxelOf(p, Nets::kCell))) points.push_back(p);
                   }
                 }
               });
  return points;
}

std::vector<Vec3> OneInEachCell(const std::vector<Vec3>& points) {
  std::set<VoxelKey> taken;
  std::vector<Vec3> some;
  for (const Vec3& p : points)
    if (taken.insert(VoxelOf(p, kApart)).second) some.push_back(p);
  return some;
}

std::vector<Vec3> Near(const std::vector<Vec3>& points, const Plane& plane, double reach) {
  std::vector<Vec3> near;
  for (const Vec3& p : points)
    if (std::abs(plane.Height(p)) < reach) near.push_back(p);
  return near;
}

// Through at least three points.
Plane FitPlane(const std::vector<Vec3>& points) {
  Plane plane;
  for (const Vec3& p : points) plane.center += p / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - plane.center) * (p - plane.center).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  plane.axes.col(0) = solver.eigenvectors().col(2);
  plane.axes.col(2) = solver.eigenvectors().col(0);
  plane.axes.col(1) = plane.axes.col(2).cross(plane.axes.col(0));
  return plane;
}

// The plane around which most points lie (RANSAC, Fischler and Bolles 1981).
Plane MostPopulated(const std::vector<Vec3>& points) {
  std::mt19937 random(1);
  std::vector<Vec3> most;
  for (int i = 0; i < kTries; ++i) {
    const Vec3& a = points[random() % points.size()];
    const Vec3 along = points[random() % points.size()] - a;
    const Vec3 normal = along.cross(points[random() % points.size()] - a);
    if (!(normal.norm() > 0)) continue;
    Plane plane;
    plane.center = a;
    plane.axes.col(2) = normal.normalized();
    std::vector<Vec3> near = Near(points, plane, kOnPlane);
    if (near.size() > most.size()) most = std::move(near);
  }
  if (most.size() < 3) return {};
  return FitPlane(Near(points, FitPlane(most), kOnSheet));
}

// Parts of what is known that are smaller than a net is are not.
void DropSmallParts(NetSheet& sheet) {
  cv::Mat labels, figures, centers;
  cv::connectedComponentsWithStats(MatOf(sheet.known), labels, figures, centers);
  for (int v = 0; v < sheet.known.height(); ++v) {
    for (int u = 0; u < sheet.known.width(); ++u) {
      const int pixels = figures.at<int>(labels.at<int>(v, u), cv::CC_STAT_AREA);
      if (pixels * NetSheet::kStep * NetSheet::kStep < Nets::kMinArea) sheet.known(u, v) = 0;
    }
  }
}

NetSheet SheetOf(const Plane& plane, const std::vector<Vec3>& points) {
  Eigen::AlignedBox2d box;
  for (const Vec3& p : points)
    box.extend(Vec2((plane.axes.transpose() * (p - plane.center)).head<2>()));
  NetSheet sheet;
  sheet.axes = plane.axes;
  sheet.origin = plane.center + plane.axes.leftCols<2>() * box.min();
  const int width = static_cast<int>(box.sizes().x() / NetSheet::kStep) + 2;
  const int height = static_cast<int>(box.sizes().y() / NetSheet::kStep) + 2;
  sheet.heights = Image<float>(width, height, 0);
  sheet.known = MaskImage(width, height, 0);
  Image<float> count(width, height, 0);
  for (const Vec3& p : points) {
    const Vec3 q = plane.axes.transpose() * (p - sheet.origin);
    const int u = static_cast<int>(std::lround(q.x() / NetSheet::kStep));
    const int v = static_cast<int>(std::lround(q.y() / NetSheet::kStep));
    count(u, v) += 1;
    sheet.heights(u, v) += static_cast<float>(q.z());
  }
  const double blur = kBlur / NetSheet::kStep;
  cv::GaussianBlur(MatOf(sheet.heights), MatOf(sheet.heights), {}, blur);
  cv::GaussianBlur(MatOf(count), MatOf(count), {}, blur);
  std::vector<double> densities;
  for (size_t i = 0; i < count.size(); ++i)
    if (count.data()[i] > 0) densities.push_back(count.data()[i]);
  const double usual = Median(std::move(densities));
  for (size_t i = 0; i < count.size(); ++i) {
    sheet.known.data()[i] = count.data()[i] > kMinDensity * usual;
    if (count.data()[i] > 0) sheet.heights.data()[i] /= count.data()[i];
  }
  DropSmallParts(sheet);
  return sheet;
}

}  // namespace

bool NetSheet::IsKnown(double x, double y) const {
  const int u = static_cast<int>(std::lround(x / kStep));
  const int v = static_cast<int>(std::lround(y / kStep));
  return known.Contains(u, v) && known(u, v);
}

double NetSheet::HeightAt(double x, double y) const {
  const double u = std::clamp<double>(x / kStep, 0, heights.width() - 1);
  const double v = std::clamp<double>(y / kStep, 0, heights.height() - 1);
  const int u0 = std::min(static_cast<int>(u), heights.width() - 2);
  const int v0 = std::min(static_cast<int>(v), heights.height() - 2);
  const double a = u - u0, b = v - v0;
  return (1 - b) * ((1 - a) * heights(u0, v0) + a * heights(u0 + 1, v0)) +
         b * ((1 - a) * heights(u0, v0 + 1) + a * heights(u0 + 1, v0 + 1));
}

double NetSheet::Above(const Vec3& p) const {
  const Vec3 q = axes.transpose() * (p - origin);
  return q.z() - HeightAt(q.x(), q.y());
}

std::vector<NetSheet> SheetsOf(const Sequence& sequence, const Nets& nets) {
  std::vector<NetSheet> sheets;
  if (nets.empty()) return sheets;
  std::vector<Vec3> points = PointsOnNets(sequence, nets);
  const auto is_enough = [](const std::vector<Vec3>& some) {
    return static_cast<double>(some.size()) * kApart * kApart >= Nets::kMinArea;
  };
  for (std::vector<Vec3> some = OneInEachCell(points); is_enough(some);
       some = OneInEachCell(points)) {
    const Plane plane = MostPopulated(some);
    const std::vector<Vec3> near = Near(points, plane, kOnSheet);
    if (!is_enough(OneInEachCell(near))) break;
    sheets.push_back(SheetOf(plane, near));
    std::erase_if(points, [&](const Vec3& p) { return std::abs(plane.Height(p)) < kOnSheet; });
  }
  return sheets;
}

}  // namespace curvefusion
