#include "fusion/curve_graph/colour_candidates.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fusion/curve_graph/line_of_sight.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"
#include "kernel/thinned.h"

namespace curvefusion {

namespace {

// All chosen while looking at training scans chair 3, furnished 1, rack 2, tree 2, umbrella 1 and
// vine 1 (docs/lab_notebook.md).
constexpr size_t kReferenceStride = 3;  // lines of sight start in every so many-th image
// Steps along a line of sight, in the view that moves most. The coarse ones are derived: a strip
// within close reach between two of them is within first reach of one.
constexpr double kCoarsePx = 2 * (StripImage::kReachPx[StripImage::kFirstLook] -
                                  StripImage::kReachPx[StripImage::kCloseLook]);
constexpr double kFinePx = 0.5;
constexpr double kCoarseEvidence = 1;  // least log-likelihood ratio
constexpr double kFineEvidence = 3.5;
constexpr double kAmbiguous = 1.5;     // less of it between two places of one line of sight
constexpr double kMinBaseline = 0.02;  // metres
constexpr double kSamePlace = 0.015;   // metres; places nearer to each other are one wire
// Of places that other images have as well. Chosen on training scans by an Azure Kinect: within 4
// mm the number of images parts right places from wrong ones; not varied (docs/lab_notebook.md).
constexpr double kSupportReach = 0.004;  // metres across lines of sight
constexpr double kUncertainPx = 2;       // chosen: of parallax along them; strips err by 1.4
constexpr int kMinFirstLooks = 2;
constexpr int kMinFullLooks = 4;  // where all of them show a strip
constexpr int64_t kReports = 50;  // chosen: of progress
// Wires are followed along their strips from places found. Chosen, not varied; what following
// brings was measured on 27 training scans (docs/lab_notebook.md).
constexpr int kFollowPx = 5;            // to the next pixel, at most
constexpr int kDonePx = 2;              // around pixels that were looked at
constexpr double kFollowRange = 0.01;   // metres along the line of sight, to both sides
constexpr size_t kMaxFollowed = 20000;  // places

using View = StripViews::View;
using Ray = std::pair<size_t, Eigen::Vector2i>;  // number of a view, and a pixel

// A place of a line of sight where a wire may be.
struct Place {
  Vec3 position;
  double distance = 0;  // metres along the line of sight
  StripAgreement agreement;
};

// Where images are full of strips that all show one says nothing for a wire, but nothing against
// it.
bool AgreesRoughly(const StripAgreement& look) {
  if (look.evidence >= kCoarseEvidence) return look.looked >= kMinFirstLooks;
  return look.looked >= kMinFullLooks && look.seen == look.looked && look.evidence >= 0;
}

class CandidateSearch {
 public:
  CandidateSearch(const StripViews& views, const CandidateOptions& options)
      : views_(views), options_(options) {}

  ObservedPoints Find(const std::function<void(int64_t done, int64_t total)>& on_progress) const {
    std::vector<Ray> rays;
    for (size_t i = 0; i < views_.views().size(); i += kReferenceStride) {
      const StripImage& strips = views_.views()[i].strips;
      for (const Eigen::Vector2i& pixel : strips.unexplained())
        if (!strips.IsExplained(pixel.x(), pixel.y())) rays.emplace_back(i, pixel);
    }
    rays = ThinnedTo(rays, options_.max_rays);
    std::vector<std::optional<Place>> places(rays.size());
    const auto count = static_cast<int64_t>(rays.size());
    for (int64_t part = 0; part < kReports; ++part) {
      on_progress(part, kReports);
      ParallelFor(part * count / kReports, (part + 1) * count / kReports, 16,
                  [&](int64_t i) { places[i] = PlaceOn(rays[i].first, rays[i].second); });
    }
    std::vector<Found> found;
    for (size_t i = 0; i < rays.size(); ++i)
      if (places[i]) found.push_back({rays[i], *places[i]});
    if (options_.min_support > 0) found = Supported(found);
    if (options_.follow) Follow(found);
    ObservedPoints points;
    for (const auto& [ray, place] : found) {
      const Vec3& p = place.position;
      points.Add(p, (p - views_.views()[ray.first].center).normalized(),
                 static_cast<float>(place.agreement.seen));
    }
    return points;
  }

 private:
  struct Found {
    Ray ray;
    Place place;
  };

  // Where to look next, and how far away what lies beside it is.
  struct Next {
    Ray ray;
    double distance = 0;
  };

  // How far along its line of sight a place may be wrong, metres.
  double Uncertainty(const Found& one) const {
    const View& view = views_.views()[one.ray.first];
    const double step =
        Step(one.place.distance, BaselineOf(view, one.place.position), kUncertainPx);
    return std::clamp(step, kSupportReach, kSamePlace);
  }

  // Places of which other images have some as well.
  std::vector<Found> Supported(const std::vector<Found>& found) const {
    std::vector<Vec3> positions;
    for (const Found& one : found) positions.push_back(one.place.position);
    const PointGrid grid(positions, kSamePlace);
    const size_t references = (views_.views().size() + kReferenceStride - 1) / kReferenceStride;
    const double least = options_.min_support * static_cast<double>(references);
    std::vector<char> is_supported(found.size());
    ParallelFor(0, static_cast<int64_t>(found.size()), 16, [&](int64_t i) {
      const Vec3& p = positions[i];
      const Vec3 sight = (p - views_.views()[found[i].ray.first].center).normalized();
      const double uncertainty = Uncertainty(found[i]);
      std::vector<char> has_place(references, 0);
      grid.ForEachWithin(p, std::hypot(kSupportReach, uncertainty), [&](int j, const Vec3& other) {
        const double along = (other - p).dot(sight);
        const double across = (other - p - along * sight).norm();
        if (std::abs(along) <= uncertainty && across <= kSupportReach)
          has_place[found[j].ray.first / kReferenceStride] = 1;
      });
      is_supported[i] = static_cast<double>(std::ranges::count(has_place, 1)) >= least;
    });
    std::vector<Found> supported;
    for (size_t i = 0; i < found.size(); ++i)
      if (is_supported[i]) supported.push_back(found[i]);
    return supported;
  }

  // Pixels of strips that were not looked at, for each view that lines of sight start in.
  std::vector<MaskImage> OpenPixels() const {
    std::vector<MaskImage> open(views_.views().size());
    for (size_t i = 0; i < views_.views().size(); i += kReferenceStride) {
      open[i] = MaskImage(views_.color_camera().width, views_.color_camera().height, 0);
      const StripImage& strips = views_.views()[i].strips;
      for (const Eigen::Vector2i& pixel : strips.unexplained())
        if (!strips.IsExplained(pixel.x(), pixel.y())) open[i](pixel.x(), pixel.y()) = 1;
    }
    return open;
  }

  static void Close(const Eigen::Vector2i& pixel, MaskImage& open) {
    for (int v = pixel.y() - kDonePx; v <= pixel.y() + kDonePx; ++v)
      for (int u = pixel.x() - kDonePx; u <= pixel.x() + kDonePx; ++u)
        if (open.Contains(u, v)) open(u, v) = 0;
  }

  // Goes on from places to pixels of strips beside theirs, as long as places are found there.
  void Follow(std::vector<Found>& found) const {
    std::vector<MaskImage> open = OpenPixels();
    for (const Found& one : found) Close(one.ray.second, open[one.ray.first]);
    for (size_t first = 0; first < found.size() && found.size() < kMaxFollowed;) {
      std::vector<Next> next;
      for (; first < found.size(); ++first)
        AddBeside(found[first], open[found[first].ray.first], next);
      std::vector<std::optional<Place>> places(next.size());
      ParallelFor(0, static_cast<int64_t>(next.size()), 16,
                  [&](int64_t i) { places[i] = PlaceBeside(next[i]); });
      for (size_t i = 0; i < next.size(); ++i)
        if (places[i]) found.push_back({next[i].ray, *places[i]});
    }
  }

  static void AddBeside(const Found& found, MaskImage& open, std::vector<Next>& next) {
    const auto& [view, pixel] = found.ray;
    for (int v = pixel.y() - kFollowPx; v <= pixel.y() + kFollowPx; ++v) {
      for (int u = pixel.x() - kFollowPx; u <= pixel.x() + kFollowPx; ++u) {
        if (!open.Contains(u, v) || !open(u, v)) continue;
        next.push_back({{view, {u, v}}, found.place.distance});
        Close({u, v}, open);
      }
    }
  }

  // The place of a pixel that is about as far away as one beside it.
  std::optional<Place> PlaceBeside(const Next& next) const {
    const View& view = views_.views()[next.ray.first];
    const Vec3 ray = DirectionOf(next.ray);
    const LineOfSight sight(views_, next.ray.first, ray);
    if (sight.IsHidden(next.distance)) return std::nullopt;
    std::vector<Place> places;
    AddPlaces(sight, Baseline(view, ray), next.distance - kFollowRange,
              next.distance + kFollowRange, places);
    return BestOf(places);
  }

  Vec3 DirectionOf(const Ray& ray) const {
    const RigidTransform T_world_color = views_.views()[ray.first].T_color_world.inverse();
    const Vec3 in_camera = views_.color_camera().Unproject(ray.second.x(), ray.second.y(), 1);
    return (T_world_color.linear() * in_camera).normalized();
  }

  // That with the most evidence, where depth does not contradict.
  std::optional<Place> BestOf(const std::vector<Place>& places) const {
    if (places.empty()) return std::nullopt;
    const Place& best = *std::max_element(
        places.begin(), places.end(),
        [](const Place& a, const Place& b) { return a.agreement.Sum() < b.agreement.Sum(); });
    if (options_.places == CandidatePlaces::kFree && !views_.IsFree(best.position))
      return std::nullopt;
    return best;
  }

  // The greatest distance of another camera from a line of sight, metres; not zero.
  double Baseline(const View& view, const Vec3& ray) const {
    double most = kMinBaseline;
    for (const View& other : views_.views())
      most = std::max(most, ray.cross(other.center - view.center).norm());
    return most;
  }

  double BaselineOf(const View& view, const Vec3& p) const {
    return Baseline(view, (p - view.center).normalized());
  }

  // Metres along a line of sight by which a place moves so many pixels in the view where it moves
  // most.
  double Step(double distance, double baseline, double pixels) const {
    return pixels * distance * distance / (views_.color_camera().fx * baseline);
  }

  // Adds the places of a stretch of a line of sight that agree.
  void AddPlaces(const LineOfSight& sight, double baseline, double from, double to,
                 std::vector<Place>& places) const {
    const double step = Step(0.5 * (from + to), baseline, kFinePx);
    std::vector<double> distances;
    for (double at = from; at <= to; at += step) distances.push_back(at);
    const std::vector<StripAgreement> quick = sight.QuickLooks(distances);
    size_t kept = 0;
    for (size_t i = 0; i < distances.size(); ++i)
      if (quick[i].evidence >= 0) distances[kept++] = distances[i];
    distances.resize(kept);
    const std::vector<StripAgreement> close = sight.CloseLooks(distances);
    for (size_t i = 0; i < kept; ++i) {
      if (close[i].evidence < kFineEvidence || close[i].looked < StripAgreement::kMinLooks)
        continue;
      places.push_back({sight.At(distances[i]), distances[i], close[i]});
    }
  }

  // All places of the line of sight of a pixel where a wire may be.
  std::vector<Place> PlacesOn(size_t number, const Eigen::Vector2i& pixel) const {
    const View& view = views_.views()[number];
    const Vec3 ray = DirectionOf({number, pixel});
    const auto range = RangeWithin(view.center, ray);
    if (!range) return {};
    const LineOfSight sight(views_, number, ray);
    const double baseline = Baseline(view, ray);
    std::vector<double> distances;
    for (double at = range->first; at <= range->second && !sight.IsHidden(at);
         at += Step(at, baseline, kCoarsePx))
      distances.push_back(at);
    const std::vector<StripAgreement> looks = sight.FirstLooks(distances);
    std::vector<Place> places;
    double begin = -1;  // of a stretch that agrees roughly
    for (size_t i = 0; i < distances.size(); ++i) {
      const bool agrees = AgreesRoughly(looks[i]);
      if (agrees && begin < 0) begin = distances[i] - Step(distances[i], baseline, kCoarsePx);
      if (!agrees && begin >= 0) {
        AddPlaces(sight, baseline, begin, distances[i], places);
        begin = -1;
      }
    }
    if (begin >= 0) AddPlaces(sight, baseline, begin, range->second, places);
    return places;
  }

  // The place of the wire that a pixel shows, where it is the only one and depth does not
  // contradict.
  std::optional<Place> PlaceOn(size_t number, const Eigen::Vector2i& pixel) const {
    const View& view = views_.views()[number];
    const std::vector<Place> places = PlacesOn(number, pixel);
    const std::optional<Place> best = BestOf(places);
    if (!best) return std::nullopt;
    const double same_place = std::max(
        kSamePlace, Step(best->distance, BaselineOf(view, best->position), options_.same_place_px));
    const bool is_ambiguous = std::any_of(places.begin(), places.end(), [&](const Place& place) {
      return std::abs(place.distance - best->distance) > same_place &&
             place.agreement.Sum() > best->agreement.Sum() - kAmbiguous;
    });
    return is_ambiguous ? std::nullopt : best;
  }

  // Where a line enters and leaves the bounds, metres from its start.
  std::optional<std::pair<double, double>> RangeWithin(const Vec3& start, const Vec3& ray) const {
    double from = PinholeCamera::kNearest, to = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(ray[axis]) < 1e-9) continue;
      double a = (views_.bounds().min()[axis] - start[axis]) / ray[axis];
      double b = (views_.bounds().max()[axis] - start[axis]) / ray[axis];
      if (a > b) std::swap(a, b);
      from = std::max(from, a);
      to = std::min(to, b);
    }
    if (from >= to) return std::nullopt;
    return std::pair(from, to);
  }

  const StripViews& views_;
  CandidateOptions options_;
};

}  // namespace

ObservedPoints FindColourCandidates(
    const StripViews& views, const CandidateOptions& options,
    const std::function<void(int64_t done, int64_t total)>& on_progress) {
  if (views.views().empty()) return {};
  return CandidateSearch(views, options).Find(on_progress);
}

}  // namespace curvefusion
