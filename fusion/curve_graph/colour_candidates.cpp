#include "fusion/curve_graph/colour_candidates.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// All chosen while looking at training scans chair 3, furnished 1, rack 2, tree 2, umbrella 1 and
// vine 1 (docs/lab_notebook.md).
constexpr size_t kReferenceStride = 3;  // lines of sight start in every so many-th image
constexpr double kCoarsePx = 3;         // steps along a line of sight, in the view that moves most
constexpr double kFinePx = 0.5;         // likewise
constexpr double kCoarseEvidence = 1;   // least log-likelihood ratio
constexpr double kFineEvidence = 3.5;
constexpr double kAmbiguous = 1.5;     // less of it between two places of one line of sight
constexpr double kMinBaseline = 0.02;  // metres
constexpr double kSamePlace = 0.015;   // metres; places nearer to each other are one wire
constexpr int kMinFirstLooks = 2;
constexpr int kMinFullLooks = 4;  // where all of them show a strip
constexpr int kMinLooks = 8;
constexpr double kNearest = 0.05;  // metres before a camera
constexpr int64_t kReports = 50;   // chosen: of progress
// Lines of sight, evenly thinned: more tell the same again. Chosen on the four shared scans without
// depth, between numbers that 15 training scans do not tell apart (docs/lab_notebook.md).
constexpr size_t kMaxRays = 5000;

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
    rays = Thinned(std::move(rays));
    std::vector<std::optional<Place>> places(rays.size());
    const auto count = static_cast<int64_t>(rays.size());
    for (int64_t part = 0; part < kReports; ++part) {
      on_progress(part, kReports);
      ParallelFor(part * count / kReports, (part + 1) * count / kReports, 16,
                  [&](int64_t i) { places[i] = PlaceOn(rays[i].first, rays[i].second); });
    }
    ObservedPoints points;
    for (size_t i = 0; i < rays.size(); ++i) {
      if (!places[i]) continue;
      const Vec3& p = places[i]->position;
      points.Add(p, (p - views_.views()[rays[i].first].center).normalized(),
                 static_cast<float>(places[i]->agreement.seen));
    }
    return points;
  }

 private:
  static std::vector<Ray> Thinned(std::vector<Ray> rays) {
    if (rays.size() <= kMaxRays) return rays;
    std::vector<Ray> some(kMaxRays);
    for (size_t i = 0; i < kMaxRays; ++i) some[i] = rays[i * rays.size() / kMaxRays];
    return some;
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
  void AddPlaces(const StripViews::LineOfSight& sight, double baseline, double from, double to,
                 std::vector<Place>& places) const {
    const double step = Step(0.5 * (from + to), baseline, kFinePx);
    for (double at = from; at <= to; at += step) {
      if (sight.QuickLook(at).evidence < 0) continue;
      const StripAgreement agreement = sight.CloseLook(at);
      if (agreement.evidence < kFineEvidence || agreement.looked < kMinLooks) continue;
      places.push_back({sight.At(at), at, agreement});
    }
  }

  // All places of the line of sight of a pixel where a wire may be.
  std::vector<Place> PlacesOn(size_t number, const Eigen::Vector2i& pixel) const {
    const View& view = views_.views()[number];
    const RigidTransform T_world_color = view.T_color_world.inverse();
    const Vec3 in_camera = views_.color_camera().Unproject(pixel.x(), pixel.y(), 1);
    const Vec3 ray = (T_world_color.linear() * in_camera).normalized();
    const auto range = RangeWithin(view.center, ray);
    if (!range) return {};
    const StripViews::LineOfSight sight(views_, number, ray);
    const double baseline = Baseline(view, ray);
    std::vector<Place> places;
    double begin = -1;  // of a stretch that agrees roughly
    for (double at = range->first; at <= range->second;) {
      if (sight.IsHidden(at)) break;
      const double step = Step(at, baseline, kCoarsePx);
      const bool agrees = AgreesRoughly(sight.FirstLook(at));
      if (agrees && begin < 0) begin = at - step;
      if (!agrees && begin >= 0) {
        AddPlaces(sight, baseline, begin, at, places);
        begin = -1;
      }
      at += step;
    }
    if (begin >= 0) AddPlaces(sight, baseline, begin, range->second, places);
    return places;
  }

  // The place of the wire that a pixel shows, where it is the only one and depth does not
  // contradict.
  std::optional<Place> PlaceOn(size_t number, const Eigen::Vector2i& pixel) const {
    const View& view = views_.views()[number];
    const std::vector<Place> places = PlacesOn(number, pixel);
    if (places.empty()) return std::nullopt;
    const Place& best = *std::max_element(
        places.begin(), places.end(),
        [](const Place& a, const Place& b) { return a.agreement.Sum() < b.agreement.Sum(); });
    const double same_place = std::max(
        kSamePlace, Step(best.distance, BaselineOf(view, best.position), options_.same_place_px));
    const bool is_ambiguous = std::any_of(places.begin(), places.end(), [&](const Place& place) {
      return std::abs(place.distance - best.distance) > same_place &&
             place.agreement.Sum() > best.agreement.Sum() - kAmbiguous;
    });
    if (is_ambiguous) return std::nullopt;
    if (options_.places == CandidatePlaces::kFree && !views_.IsFree(best.position))
      return std::nullopt;
    return best;
  }

  // Where a line enters and leaves the bounds, metres from its start.
  std::optional<std::pair<double, double>> RangeWithin(const Vec3& start, const Vec3& ray) const {
    double from = kNearest, to = 1e9;
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
