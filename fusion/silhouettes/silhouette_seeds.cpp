#include "fusion/silhouettes/silhouette_seeds.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "fusion/silhouettes/silhouette_path.h"
#include "kernel/disjoint_sets.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Radians between the rays of two views. From one side alone what images show as wire is far deeper
// than a wire is thick: a cable seen within .28 rad went on behind itself for 90 mm.
constexpr double kMinParallax = 0.5;
constexpr double kMargin = 0.02;  // metres around the skeleton
constexpr double kRoot = 0.032;   // metres; side of the largest cells
constexpr double kLeaf = 0.002;   // metres; a wire is a few of them thick
constexpr double kMinShare = 0.97;
constexpr double kMinUnexplained = 0.06;  // of the views
constexpr double kBlurPx = 2.5;           // colour runs so far beyond a wire's outline
// Of the wire that images show about the skeleton, .06 are left over at most once all pieces have
// been found; before a box of the wires' colour it is .17.
constexpr double kMaxLeftOver = 0.12;
constexpr double kLink = 0.0045;  // metres
constexpr size_t kMinPlaces = 6;
constexpr double kMinLength = 0.02;  // metres

// The greatest angle between the rays of two views to a place, radians.
double Parallax(const WireSilhouettes& silhouettes, const Vec3& p) {
  std::vector<Vec3> rays;
  for (const WireSilhouettes::View& view : silhouettes.views())
    rays.push_back((p - view.T_color_world.inverse().translation()).normalized());
  double least_cosine = 1;
  for (const Vec3& a : rays)
    for (const Vec3& b : rays) least_cosine = std::min(least_cosine, a.dot(b));
  return std::acos(std::max(-1.0, least_cosine));
}

Eigen::AlignedBox3d BoxOf(const SkeletonGraph& skeleton) {
  Eigen::AlignedBox3d box;
  for (const EdgeId id : skeleton.Edges())
    for (const Vec3& p : skeleton.edge(id).points) box.extend(p);
  return box;
}

// An image with 1 where it shows no wire.
cv::Mat NoWire(const PosteriorImage& posterior) {
  cv::Mat mask(posterior.height(), posterior.width(), CV_8U);
  for (int v = 0; v < posterior.height(); ++v)
    for (int u = 0; u < posterior.width(); ++u)
      mask.at<uint8_t>(v, u) = WireSilhouettes::IsWire(posterior(u, v)) ? 0 : 1;
  return mask;
}

// Sets a mask to 1 where curves account for wire. Returns the box around them, pixels.
cv::Rect DrawCurves(const SkeletonGraph& skeleton, const WireSilhouettes::View& view,
                    const PinholeCamera& camera, cv::Mat& mask) {
  cv::Rect box;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    for (size_t i = 0; i < edge.points.size(); ++i) {
      const Vec3 p = view.T_color_world * edge.points[i];
      if (p.z() <= edge.radii[i]) continue;
      const Vec2 pixel = camera.Project(p);
      if (!camera.Contains(pixel)) continue;
      const double radius_px = camera.fx * edge.radii[i] / p.z() + kBlurPx;
      const cv::Point at(cvRound(pixel.x()), cvRound(pixel.y()));
      cv::circle(mask, at, cvCeil(radius_px), 1, cv::FILLED);
      box |= cv::Rect(at, cv::Size(1, 1)) & cv::Rect({}, mask.size());
    }
  }
  return box;
}

// The share of the wire around the skeleton that no curve accounts for, in the median image.
double ShareLeftOver(const WireSilhouettes& silhouettes, const SkeletonGraph& skeleton) {
  std::vector<double> shares(silhouettes.views().size());
  ParallelFor(0, static_cast<int64_t>(shares.size()), 1, [&](int64_t i) {
    const WireSilhouettes::View& view = silhouettes.views()[i];
    const cv::Mat no_wire = NoWire(*view.posterior);
    cv::Mat explained = no_wire.clone();
    const cv::Rect box = DrawCurves(skeleton, view, silhouettes.color_camera(), explained);
    if (box.empty()) return;
    const auto wire = [&](const cv::Mat& mask) { return box.area() - cv::countNonZero(mask(box)); };
    shares[i] = wire(explained) / std::max(1.0, static_cast<double>(wire(no_wire)));
  });
  return Median(std::move(shares));
}

// Distances in pixels to the nearest wire, and to the nearest wire that no curve accounts for.
struct ViewDistances {
  cv::Mat to_wire;
  cv::Mat to_unexplained;
};

ViewDistances MeasureDistances(const WireSilhouettes::View& view, const PinholeCamera& camera,
                               const SkeletonGraph& skeleton) {
  ViewDistances distances;
  cv::Mat mask = NoWire(*view.posterior);
  cv::distanceTransform(mask, distances.to_wire, cv::DIST_L2, 3, CV_32F);
  DrawCurves(skeleton, view, camera, mask);
  cv::distanceTransform(mask, distances.to_unexplained, cv::DIST_L2, 3, CV_32F);
  return distances;
}

// Divides cells that may hold what is looked for down to the smallest.
class CellSearch {
 public:
  CellSearch(const WireSilhouettes& silhouettes, const SkeletonGraph& skeleton)
      : silhouettes_(silhouettes), distances_(silhouettes.views().size()) {
    ParallelFor(0, static_cast<int64_t>(distances_.size()), 1, [&](int64_t i) {
      distances_[i] =
          MeasureDistances(silhouettes.views()[i], silhouettes.color_camera(), skeleton);
    });
  }

  void Search(const Vec3& centre, double side, std::vector<Vec3>& places) const {
    if (!MayHold(centre, side)) return;
    if (side <= kLeaf) {
      places.push_back(centre);
      return;
    }
    for (int corner = 0; corner < 8; ++corner)
      Search(centre +
                 0.25 * side * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1),
             0.5 * side, places);
  }

 private:
  bool MayHold(const Vec3& centre, double side) const {
    const double reach = side <= kLeaf ? 0 : 0.87 * side;  // half the diagonal
    const int count = static_cast<int>(distances_.size());
    const double max_missed = (1 - kMinShare) * count;
    int looked = 0, missed = 0, unexplained = 0;
    for (int i = 0; i < count; ++i) {
      const Vec3 p = silhouettes_.views()[i].T_color_world * centre;
      if (p.z() <= reach) continue;
      const Vec2 pixel = silhouettes_.color_camera().Project(p);
      if (!silhouettes_.color_camera().Contains(pixel)) continue;
      const double reach_px = silhouettes_.color_camera().fx * reach / (p.z() - reach) + 0.7;
      const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
      ++looked;
      missed += distances_[i].to_wire.at<float>(at.y(), at.x()) > reach_px ? 1 : 0;
      unexplained += distances_[i].to_unexplained.at<float>(at.y(), at.x()) <= reach_px ? 1 : 0;
      if (missed > max_missed) return false;
    }
    return 2 * looked >= count && unexplained >= kMinUnexplained * count;
  }

  const WireSilhouettes& silhouettes_;
  std::vector<ViewDistances> distances_;
};

std::vector<Vec3> UnexplainedPlaces(const WireSilhouettes& silhouettes,
                                    const SkeletonGraph& skeleton) {
  Eigen::AlignedBox3d box = BoxOf(skeleton);
  box.min().array() -= kMargin;
  box.max().array() += kMargin;
  const Eigen::Vector3i counts = (box.sizes() / kRoot).array().ceil().cast<int>();
  const CellSearch search(silhouettes, skeleton);
  std::vector<std::vector<Vec3>> layers(counts.z());
  ParallelFor(0, counts.z(), 1, [&](int64_t z) {
    for (int y = 0; y < counts.y(); ++y)
      for (int x = 0; x < counts.x(); ++x)
        search.Search(box.min() + kRoot * Vec3(x + 0.5, y + 0.5, static_cast<double>(z) + 0.5),
                      kRoot, layers[z]);
  });
  std::vector<Vec3> places;
  for (const auto& layer : layers) places.insert(places.end(), layer.begin(), layer.end());
  return places;
}

std::vector<std::vector<Vec3>> Clusters(const std::vector<Vec3>& places) {
  DisjointSets sets(static_cast<int>(places.size()));
  const PointGrid grid(places, kLink);
  for (size_t i = 0; i < places.size(); ++i)
    grid.ForEachWithin(places[i], kLink,
                       [&](int j, const Vec3&) { sets.Unite(static_cast<int>(i), j); });
  std::vector<std::vector<Vec3>> by_root(places.size());
  for (size_t i = 0; i < places.size(); ++i)
    by_root[sets.Root(static_cast<int>(i))].push_back(places[i]);
  std::erase_if(by_root, [](const auto& cluster) { return cluster.size() < kMinPlaces; });
  return by_root;
}

// The straight line through a cluster, from end to end.
Polyline LineThrough(const std::vector<Vec3>& cluster) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : cluster) mean += p / static_cast<double>(cluster.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vec3& p : cluster) scatter += (p - mean) * (p - mean).transpose();
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(2);
  double low = 0, high = 0;
  for (const Vec3& p : cluster) {
    low = std::min(low, axis.dot(p - mean));
    high = std::max(high, axis.dot(p - mean));
  }
  return {mean + low * axis, mean + high * axis};
}

// Whether most places some radii beside a curve are no wire.
bool IsThin(const WireSilhouettes& silhouettes, const Polyline& curve, double radius) {
  constexpr int kDirections = 8;
  int beside = 0, free = 0;
  const std::vector<Vec3> tangents = Tangents(curve);
  for (size_t i = 0; i < curve.size(); ++i) {
    const Vec3 u = tangents[i].unitOrthogonal();
    const Vec3 v = tangents[i].cross(u);
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2 * std::numbers::pi * k / kDirections;
      ++beside;
      free += silhouettes.Share(
                  curve[i] + 3 * radius * (std::cos(angle) * u + std::sin(angle) * v)) < kMinShare
                  ? 1
                  : 0;
    }
  }
  return 4 * free >= 3 * beside;
}

// Whether most of a curve is farther from all others than wires that touch, and a little more: a
// curve may lie beside its wire.
bool IsApart(const SkeletonGraph& skeleton, const Polyline& curve, double radius) {
  int near = 0;
  const std::vector<EdgeId> edges = skeleton.Edges();
  for (const Vec3& p : curve) {
    near += std::any_of(edges.begin(), edges.end(), [&](EdgeId id) {
      return Project(skeleton.edge(id).points, p).distance < 2.5 * radius;
    });
  }
  return 3 * near <= static_cast<int>(curve.size());
}

}  // namespace

std::vector<FoundPiece> AddUnexplainedWires(const WireSilhouettes& silhouettes,
                                            SkeletonGraph& skeleton) {
  std::vector<double> radii;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    radii.insert(radii.end(), edge.radii.begin(), edge.radii.end());
  }
  if (radii.empty() || Parallax(silhouettes, BoxOf(skeleton).center()) < kMinParallax) return {};
  const double radius = Median(std::move(radii));
  std::vector<FoundPiece> pieces;
  std::vector<EdgeId> edges;
  for (const std::vector<Vec3>& cluster : Clusters(UnexplainedPlaces(silhouettes, skeleton))) {
    const Polyline line = LineThrough(cluster);
    if (Length(line) < kMinLength) continue;
    const std::optional<Polyline> curve = PathThroughSilhouettes(silhouettes, line, kMinShare);
    if (!curve || !IsThin(silhouettes, *curve, radius) || !IsApart(skeleton, *curve, radius))
      continue;
    const NodeId front = skeleton.AddNode(curve->front());
    const NodeId back = skeleton.AddNode(curve->back());
    edges.push_back(
        skeleton.AddEdge({{front, back}, *curve, std::vector<double>(curve->size(), radius), {}}));
    pieces.push_back({{front, back}, Length(*curve)});
  }
  if (pieces.empty() || ShareLeftOver(silhouettes, skeleton) <= kMaxLeftOver) return pieces;
  // Much else has the wires' colours, so that a place may look like wire in all images by chance.
  for (const EdgeId edge : edges) skeleton.RemoveEdge(edge);
  skeleton.RemoveIsolatedNodes();
  return {};
}

}  // namespace curvefusion
