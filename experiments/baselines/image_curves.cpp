#include "experiments/baselines/image_curves.h"

#include <algorithm>
#include <array>
#include <optional>

namespace curvefusion {

namespace {

using Pixel = Eigen::Vector2i;

// The eight neighbours of a pixel, around it.
const std::array<Pixel, 8> kAround = {Pixel(0, -1), Pixel(1, -1), Pixel(1, 0),  Pixel(1, 1),
                                      Pixel(0, 1),  Pixel(-1, 1), Pixel(-1, 0), Pixel(-1, -1)};

// Points to either side over which a curve is smoothed and its direction taken: centre lines are
// stairs of whole pixels. As many as the program of Liu et al. 2017 takes directions over.
constexpr int kSmoothing = 3;

bool IsSet(const MaskImage& mask, const Pixel& p) {
  return mask.Contains(p.x(), p.y()) && mask(p.x(), p.y()) != 0;
}

std::array<bool, 8> Neighbours(const MaskImage& mask, const Pixel& p) {
  std::array<bool, 8> set{};
  for (size_t i = 0; i < 8; ++i) set[i] = IsSet(mask, p + kAround[i]);
  return set;
}

// How many branches leave a pixel: steps from not set to set around it.
int BranchCount(const std::array<bool, 8>& around) {
  int count = 0;
  for (size_t i = 0; i < 8; ++i) count += !around[i] && around[(i + 1) % 8];
  return count;
}

// Guo and Hall's conditions for a pixel to be taken away in one of the two subiterations; their P2
// is the pixel above and is around[0], the others follow clockwise.
bool IsTakenAway(const std::array<bool, 8>& around, bool is_first) {
  const auto& [p2, p3, p4, p5, p6, p7, p8, p9] = around;
  const int c =
      (!p2 && (p3 || p4)) + (!p4 && (p5 || p6)) + (!p6 && (p7 || p8)) + (!p8 && (p9 || p2));
  const int n1 = (p9 || p2) + (p3 || p4) + (p5 || p6) + (p7 || p8);
  const int n2 = (p2 || p3) + (p4 || p5) + (p6 || p7) + (p8 || p9);
  const int n = std::min(n1, n2);
  const bool is_kept = is_first ? (p6 || p7 || !p9) && p8 : (p2 || p3 || !p5) && p4;
  return c == 1 && n >= 2 && n <= 3 && !is_kept;
}

std::vector<Pixel> SetPixels(const MaskImage& mask) {
  std::vector<Pixel> pixels;
  for (int v = 0; v < mask.height(); ++v) {
    for (int u = 0; u < mask.width(); ++u) {
      if (mask(u, v) != 0) pixels.push_back({u, v});
    }
  }
  return pixels;
}

// Pixels of a mask one after the other, and how many of its two ends lie at a junction.
struct Chain {
  std::vector<Pixel> pixels;
  int ends_at_junctions = 0;
  bool is_closed = false;
};

class ChainTracer {
 public:
  explicit ChainTracer(const MaskImage& lines)
      : junctions_(lines.width(), lines.height(), 0), left_(lines) {
    for (const Pixel& p : SetPixels(lines)) {
      if (BranchCount(Neighbours(lines, p)) < 3) continue;
      junctions_(p.x(), p.y()) = 1;
      left_(p.x(), p.y()) = 0;
    }
  }

  std::vector<Chain> Chains() {
    std::vector<Chain> chains;
    const std::vector<Pixel> pixels = SetPixels(left_);
    for (const Pixel& p : pixels) {
      if (IsSet(left_, p) && LeftAround(p) <= 1) chains.push_back(ChainFrom(p));
    }
    for (const Pixel& p : pixels) {  // what is left runs in circles
      if (IsSet(left_, p)) chains.push_back(ChainFrom(p));
    }
    return chains;
  }

 private:
  int LeftAround(const Pixel& p) const {
    int count = 0;
    for (const Pixel& step : kAround)
      count += IsSet(left_, p + step) && !IsPastJunction(p, p + step);
    return count;
  }

  // Whether two neighbours lie at the same junction: a step from one to the other would pass it.
  bool IsPastJunction(const Pixel& p, const Pixel& q) const {
    return std::any_of(kAround.begin(), kAround.end(), [&](const Pixel& step) {
      const Pixel junction = p + step;
      return IsSet(junctions_, junction) && (junction - q).cwiseAbs().maxCoeff() <= 1;
    });
  }

  Chain ChainFrom(const Pixel& first) {
    Chain chain;
    for (Pixel p = first;;) {
      chain.pixels.push_back(p);
      left_(p.x(), p.y()) = 0;
      const auto next = Step(p, left_, [&](const Pixel& q) { return !IsPastJunction(p, q); });
      if (!next) break;
      p = *next;
    }
    chain.is_closed = chain.pixels.size() > 2 * kAround.size() &&
                      (chain.pixels.back() - first).cwiseAbs().maxCoeff() == 1;
    if (chain.is_closed) return chain;
    AddJunction(chain);
    std::reverse(chain.pixels.begin(), chain.pixels.end());
    AddJunction(chain);
    return chain;
  }

  // To a neighbour beside a pixel rather than to one across a corner.
  template <class Condition>
  static std::optional<Pixel> Step(const Pixel& p, const MaskImage& mask,
                                   const Condition& is_allowed) {
    for (const size_t first : {0, 1}) {
      for (size_t i = first; i < kAround.size(); i += 2) {
        const Pixel next = p + kAround[i];
        if (IsSet(mask, next) && is_allowed(next)) return next;
      }
    }
    return std::nullopt;
  }

  void AddJunction(Chain& chain) const {
    const auto junction = Step(chain.pixels.back(), junctions_, [](const Pixel&) { return true; });
    if (!junction) return;
    chain.pixels.push_back(*junction);
    ++chain.ends_at_junctions;
  }

  MaskImage junctions_;
  MaskImage left_;  // pixels of no chain yet
};

// Without the junction at its end.
void TakeOff(const Chain& twig, MaskImage& lines) {
  std::vector<Pixel> away = twig.pixels;
  std::erase_if(away, [&](const Pixel& p) { return BranchCount(Neighbours(lines, p)) >= 3; });
  for (const Pixel& p : away) lines(p.x(), p.y()) = 0;
}

std::vector<Chain> ChainsWithoutTwigs(MaskImage& lines, int least_pixels) {
  while (true) {
    std::vector<Chain> chains = ChainTracer(lines).Chains();
    const auto is_twig = [&](const Chain& chain) {
      return chain.ends_at_junctions == 1 && static_cast<int>(chain.pixels.size()) < least_pixels;
    };
    if (std::none_of(chains.begin(), chains.end(), is_twig)) return chains;
    const size_t before = SetPixels(lines).size();
    for (const Chain& chain : chains) {
      if (is_twig(chain)) TakeOff(chain, lines);
    }
    if (SetPixels(lines).size() == before) return chains;
    lines = Thinned(lines);  // junctions that are none any more
  }
}

// The mean over points to either side: as many at an end as there are.
ImageCurve Smoothed(const Chain& chain) {
  const int count = static_cast<int>(chain.pixels.size());
  const auto at = [&](int i) -> Vec2 { return chain.pixels[(i + count) % count].cast<double>(); };
  ImageCurve curve;
  for (int i = 0; i < count; ++i) {
    const int reach = chain.is_closed ? kSmoothing : std::min({kSmoothing, i, count - 1 - i});
    Vec2 sum = Vec2::Zero();
    for (int k = -reach; k <= reach; ++k) sum += at(i + k);
    curve.points.push_back(sum / (2 * reach + 1));
  }
  if (chain.is_closed) curve.points.push_back(curve.points.front());
  const int last = static_cast<int>(curve.points.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const Vec2 along =
        curve.points[std::min(i + kSmoothing, last)] - curve.points[std::max(i - kSmoothing, 0)];
    curve.tangents.push_back(along.norm() > 0 ? along.normalized() : Vec2::Zero());
  }
  return curve;
}

std::vector<Vec3> PointsOf(const std::vector<ImageCurve>& curves) {
  std::vector<Vec3> points;
  for (const ImageCurve& curve : curves) {
    for (const Vec2& p : curve.points) points.push_back({p.x(), p.y(), 0});
  }
  return points;
}

}  // namespace

MaskImage Thinned(const MaskImage& silhouette) {
  MaskImage mask = silhouette;
  std::vector<Pixel> pixels = SetPixels(mask);
  bool is_changed = true;
  while (is_changed) {
    is_changed = false;
    for (const bool is_first : {true, false}) {
      std::vector<Pixel> away;
      for (const Pixel& p : pixels) {
        if (IsSet(mask, p) && IsTakenAway(Neighbours(mask, p), is_first)) away.push_back(p);
      }
      for (const Pixel& p : away) mask(p.x(), p.y()) = 0;
      is_changed = is_changed || !away.empty();
    }
  }
  return mask;
}

std::vector<ImageCurve> SplitAtJunctions(MaskImage centre_lines, int least_pixels) {
  std::vector<ImageCurve> curves;
  for (const Chain& chain : ChainsWithoutTwigs(centre_lines, least_pixels)) {
    if (chain.pixels.size() > 1) curves.push_back(Smoothed(chain));
  }
  return curves;
}

ImageCurves::ImageCurves(const std::vector<ImageCurve>& curves) : index_(PointsOf(curves)) {
  for (const ImageCurve& curve : curves) {
    begins_.push_back(size());
    points_.insert(points_.end(), curve.points.begin(), curve.points.end());
    tangents_.insert(tangents_.end(), curve.tangents.begin(), curve.tangents.end());
  }
  begins_.push_back(size());
}

int ImageCurves::Nearest(const Vec2& pixel) const {
  return index_.Nearest({pixel.x(), pixel.y(), 0});
}

void ImageCurves::Within(const Vec2& pixel, double distance, std::vector<int>& found) const {
  index_.WithinRadius({pixel.x(), pixel.y(), 0}, distance, found);
}

}  // namespace curvefusion
