#include "experiments/baselines/curve_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace curvefusion {

namespace {

// How far the match of the next pixel may lie from where the last ones lead, in pixels: as in the
// authors' program, which takes the nearest to the last match.
constexpr double kLongestStep_px = 5;

// Matches over which is told where they lead; chosen: as long as a crossing of wires, which are up
// to 20 pixels wide in images of 5 megapixels.
constexpr int kLeadingMatches = 20;

// A twig of centre lines is longer than what thinning leaves of so wide a wire. The authors'
// program takes off what is shorter than 100 pixels, which would be true ends of wires here.
constexpr int kLeastTwig_px = 20;

// Sine of the angle between a curve and the epipolar line, in either image, below which their
// intersection is not used: it magnifies an error of a pixel fourfold; chosen.
constexpr double kLeastSine = 0.25;

// So many pixels without a match that is used may lie within a candidate. The authors' program fits
// a spline over what is within 4 to 10 pixels of an epipolar tangent; 8 is that of its first
// example.
constexpr int kLongestGap = 2 * 8;

// Mean cosine between the image of a candidate and the curves beside it, in each image: the median
// over the authors' nine examples (0.5 to 0.9).
constexpr double kLeastCosine = 0.8;

// Points to either side over which candidates are smoothed and directions are taken; the authors'
// program takes directions over as many.
constexpr int kReach = 3;

// Image that is walked along and image of the matches, in the order of the authors' program: what
// has candidates already is left out later.
constexpr std::array<std::pair<int, int>, 6> kPairs = {
    {{1, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 1}, {0, 2}}};

// a u + b v + c = 0 with a^2 + b^2 = 1: its value is the distance of a pixel.
struct ImageLine {
  Vec2 normal;
  double offset = 0;

  double Distance(const Vec2& pixel) const { return normal.dot(pixel) + offset; }
};

// Where a plane through a camera's centre shows in its image.
ImageLine LineOf(const Vec3& normal_world, const CurveView& view) {
  const Vec3 n = view.T_world_camera.linear().transpose() * normal_world;
  const PinholeCamera& camera = view.camera;
  const Vec2 normal(n.x() / camera.fx, n.y() / camera.fy);
  const double scale = 1 / normal.norm();
  return {scale * normal, scale * (n.z() - normal.dot(Vec2(camera.cx, camera.cy)))};
}

Vec3 RayOf(const CurveView& view, const Vec2& pixel) {
  return view.T_world_camera.linear() * view.camera.Unproject(pixel.x(), pixel.y(), 1);
}

// Half way between two rays where they are nearest to each other; none where that is behind a
// camera.
std::optional<Vec3> PointOnRays(const CurveView& a, const Vec2& pixel_a, const CurveView& b,
                                const Vec2& pixel_b) {
  const Vec3 ray_a = RayOf(a, pixel_a), ray_b = RayOf(b, pixel_b);
  const Vec3 between = b.T_world_camera.translation() - a.T_world_camera.translation();
  const Vec3 across = ray_a.cross(ray_b);
  const double square = across.squaredNorm();
  if (square == 0) return std::nullopt;
  const double depth_a = between.cross(ray_b).dot(across) / square;
  const double depth_b = between.cross(ray_a).dot(across) / square;
  if (depth_a <= 0 || depth_b <= 0) return std::nullopt;
  return (a.T_world_camera.translation() + depth_a * ray_a + b.T_world_camera.translation() +
          depth_b * ray_b) /
         2;
}

// A place of the other image that a pixel may show, and the point in space where both images cross
// their epipolar lines steeply enough to tell it.
struct Match {
  Vec2 pixel;
  std::optional<Vec3> point;
};

std::vector<Match> MatchesOf(const CurveView& from, int number, const CurveView& to) {
  const Vec2& pixel = from.curves.point(number);
  const Vec3 plane = (to.T_world_camera.translation() - from.T_world_camera.translation())
                         .cross(RayOf(from, pixel));
  const ImageLine line = LineOf(plane, to);
  const bool is_steep =
      std::abs(LineOf(plane, from).normal.dot(from.curves.tangent(number))) >= kLeastSine;
  std::vector<Match> matches;
  for (size_t curve = 0; curve + 1 < to.curves.begins().size(); ++curve) {
    const int begin = to.curves.begins()[curve], end = to.curves.begins()[curve + 1];
    double last = line.Distance(to.curves.point(begin));
    for (int i = begin + 1; i < end; ++i) {
      const double next = line.Distance(to.curves.point(i));
      const double before = std::exchange(last, next);
      if ((before < 0) == (next < 0)) continue;
      const double share = before / (before - next);
      const Vec2 at =
          to.curves.point(i - 1) + share * (to.curves.point(i) - to.curves.point(i - 1));
      const auto point = PointOnRays(from, pixel, to, at);
      if (!point) continue;
      const bool is_told =
          is_steep && std::abs(line.normal.dot(to.curves.tangent(i))) >= kLeastSine;
      matches.push_back({at, is_told ? point : std::nullopt});
    }
  }
  return matches;
}

// Matches of one pixel after the other that continue each other.
struct Track {
  std::vector<int> pixels;
  std::vector<Match> matches;

  void Add(int pixel, const Match& match) {
    pixels.push_back(pixel);
    matches.push_back(match);
  }

  // Where the next one is expected.
  Vec2 Ahead() const {
    const int last = static_cast<int>(matches.size()) - 1;
    const int steps = std::min(kLeadingMatches, last);
    const Vec2& at = matches[last].pixel;
    if (steps == 0) return at;
    return at + (at - matches[last - steps].pixel) / steps;
  }
};

// Lengthens tracks by the matches of the next pixel, nearest first; a match left over begins a
// track, and a track left over is finished.
void Continue(int pixel, const std::vector<Match>& matches, std::vector<Track>& tracks,
              std::vector<Track>& finished) {
  std::vector<std::tuple<double, size_t, size_t>> steps;
  for (size_t t = 0; t < tracks.size(); ++t) {
    const Vec2 ahead = tracks[t].Ahead();
    for (size_t m = 0; m < matches.size(); ++m) {
      const double distance = (matches[m].pixel - ahead).norm();
      if (distance < kLongestStep_px) steps.push_back({distance, t, m});
    }
  }
  std::sort(steps.begin(), steps.end());
  std::vector<char> is_continued(tracks.size(), 0), is_used(matches.size(), 0);
  for (const auto& [distance, t, m] : steps) {
    if (is_continued[t] || is_used[m]) continue;
    is_continued[t] = is_used[m] = 1;
    tracks[t].Add(pixel, matches[m]);
  }
  std::vector<Track> next;
  for (size_t t = 0; t < tracks.size(); ++t) {
    (is_continued[t] ? next : finished).push_back(std::move(tracks[t]));
  }
  for (size_t m = 0; m < matches.size(); ++m) {
    if (is_used[m]) continue;
    next.emplace_back().Add(pixel, matches[m]);
  }
  tracks = std::move(next);
}

// Along every curve of one image, without the pixels that are taken.
std::vector<Track> FindTracks(const CurveView& from, const CurveView& to,
                              const std::vector<char>& is_taken) {
  std::vector<Track> finished;
  for (size_t curve = 0; curve + 1 < from.curves.begins().size(); ++curve) {
    std::vector<Track> tracks;
    for (int i = from.curves.begins()[curve]; i < from.curves.begins()[curve + 1]; ++i) {
      Continue(i, is_taken[i] ? std::vector<Match>() : MatchesOf(from, i, to), tracks, finished);
    }
    finished.insert(finished.end(), tracks.begin(), tracks.end());
  }
  return finished;
}

Polyline Smoothed(const Polyline& points) {
  const int count = static_cast<int>(points.size());
  Polyline smooth;
  for (int i = 0; i < count; ++i) {
    const int reach = std::min({kReach, i, count - 1 - i});
    Vec3 sum = Vec3::Zero();
    for (int k = i - reach; k <= i + reach; ++k) sum += points[k];
    smooth.push_back(sum / (2 * reach + 1));
  }
  return smooth;
}

// The points of a track: several candidates where too many in between are not told.
void AddCandidates(const Track& track, int view, std::vector<CurveCandidate>& candidates) {
  CurveCandidate candidate{view, {}, {}, 0};
  const auto finish = [&] {
    if (static_cast<int>(candidate.points.size()) > kLeastCurvePixels) {
      candidate.points = Smoothed(candidate.points);
      candidates.push_back(candidate);
    }
    candidate = {view, {}, {}, 0};
  };
  for (size_t i = 0; i < track.pixels.size(); ++i) {
    if (!track.matches[i].point) continue;
    if (!candidate.pixels.empty() && track.pixels[i] - candidate.pixels.back() > kLongestGap) {
      finish();
    }
    candidate.pixels.push_back(track.pixels[i]);
    candidate.points.push_back(*track.matches[i].point);
  }
  finish();
}

// How the image of a candidate lies beside the curves of an image: means over its points.
struct Support {
  double distance_px = std::numeric_limits<double>::infinity();
  double root_mean_square_px = std::numeric_limits<double>::infinity();
  double cosine = 0;
};

Support SupportIn(const CurveView& view, const Polyline& points) {
  const RigidTransform T_camera_world = view.T_world_camera.inverse();
  std::vector<Vec2> image;
  for (const Vec3& p : points) {
    const Vec3 p_camera = T_camera_world * p;
    if (p_camera.z() <= 0 || !view.camera.Contains(view.camera.Project(p_camera))) return {};
    image.push_back(view.camera.Project(p_camera));
  }
  const int last = static_cast<int>(image.size()) - 1;
  Support mean{0, 0, 0};
  for (int i = 0; i <= last; ++i) {
    const int nearest = view.curves.Nearest(image[i]);
    const Vec2 beside = view.curves.point(nearest) - image[i];
    const Vec2 along = image[std::min(i + kReach, last)] - image[std::max(i - kReach, 0)];
    mean.distance_px += beside.norm() / (last + 1);
    mean.root_mean_square_px += beside.squaredNorm() / (last + 1);
    if (along.norm() == 0) continue;
    mean.cosine += std::abs(along.normalized().dot(view.curves.tangent(nearest))) / (last + 1);
  }
  mean.root_mean_square_px = std::sqrt(mean.root_mean_square_px);
  return mean;
}

bool HasSupport(const std::vector<CurveView>& views, SupportRule rule, CurveCandidate& candidate) {
  const double root_of_count = std::sqrt(static_cast<double>(candidate.points.size()));
  candidate.distance_px = 0;
  for (const CurveView& view : views) {
    const Support support = SupportIn(view, candidate.points);
    const double distance_px = rule == SupportRule::kMeanDistance
                                   ? support.distance_px
                                   : support.root_mean_square_px / root_of_count;
    if (!(distance_px <= kSupportDistance_px) || support.cosine < kLeastCosine) return false;
    candidate.distance_px += support.root_mean_square_px / static_cast<double>(views.size());
  }
  return true;
}

// The pixels of all images that a candidate explains.
void Take(const CurveCandidate& candidate, const std::vector<CurveView>& views,
          std::vector<std::vector<char>>& is_taken) {
  const auto [first, last] = std::minmax_element(candidate.pixels.begin(), candidate.pixels.end());
  std::fill(is_taken[candidate.view].begin() + *first, is_taken[candidate.view].begin() + *last + 1,
            1);
  std::vector<int> found;
  for (size_t v = 0; v < views.size(); ++v) {
    for (const Vec3& p : candidate.points) {
      const Vec2 pixel = views[v].camera.Project(views[v].T_world_camera.inverse() * p);
      views[v].curves.Within(pixel, kSupportDistance_px, found);
      for (const int i : found) is_taken[v][i] = 1;
    }
  }
}

// Whether the nearest other candidate is farther away than a candidate is long.
std::vector<CurveCandidate> WithoutIsolated(const std::vector<CurveCandidate>& candidates) {
  std::vector<Vec3> points;
  std::vector<size_t> owners;
  for (size_t c = 0; c < candidates.size(); ++c) {
    points.insert(points.end(), candidates[c].points.begin(), candidates[c].points.end());
    owners.resize(points.size(), c);
  }
  const PointIndex index(points);
  std::vector<CurveCandidate> kept;
  for (size_t c = 0; c < candidates.size(); ++c) {
    const Polyline& curve = candidates[c].points;
    const double length = Length(curve);
    const auto is_near_another = [&](const Vec3& p) {
      const auto nearest = index.NearestK(p, static_cast<int>(curve.size()) + 1);
      return std::any_of(nearest.begin(), nearest.end(),
                         [&](int i) { return owners[i] != c && (points[i] - p).norm() <= length; });
    };
    if (candidates.size() == 1 || std::any_of(curve.begin(), curve.end(), is_near_another)) {
      kept.push_back(candidates[c]);
    }
  }
  return kept;
}

}  // namespace

CurveView FindImageCurves(const SilhouetteMap& map) {
  const Image<float>& probability = map.probability;
  MaskImage silhouette(probability.width(), probability.height(), 0);
  std::transform(probability.data(), probability.data() + probability.size(), silhouette.data(),
                 [](float p) { return p > 0.5f ? 1 : 0; });
  return {map.camera, map.T_world_camera,
          ImageCurves(SplitAtJunctions(Thinned(silhouette), kLeastTwig_px))};
}

std::vector<CurveCandidate> SupportedCandidates(const std::vector<CurveView>& views,
                                                SupportRule rule, const Progress& progress) {
  std::vector<CurveCandidate> supported;
  std::vector<std::vector<char>> is_taken;
  is_taken.reserve(views.size());
  for (const CurveView& view : views) is_taken.emplace_back(view.curves.size(), 0);
  for (size_t pair = 0; pair < kPairs.size(); ++pair) {
    const auto& [from, to] = kPairs[pair];
    progress("candidates", static_cast<int64_t>(pair), kPairs.size());
    std::vector<CurveCandidate> candidates;
    for (const Track& track : FindTracks(views[from], views[to], is_taken[from])) {
      AddCandidates(track, from, candidates);
    }
    for (CurveCandidate& candidate : candidates) {
      if (!HasSupport(views, rule, candidate)) continue;
      Take(candidate, views, is_taken);
      supported.push_back(candidate);
    }
  }
  return WithoutIsolated(supported);
}

}  // namespace curvefusion
