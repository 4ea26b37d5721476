#include "fusion/nets/line_tracing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "capture/image_mat.h"
#include "kernel/camera.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kTurns = 16;  // directions in half a turn; chosen
// Chosen on training scans chair 5, grid 5, mixture 3 and 5 (docs/nets.md). Scores: 1 = as clear as
// can be.
constexpr std::array<double, 2> kAcross = {0.001, 0.002};  // metres, standard deviation of lines
constexpr double kAlong = 0.0035;                          // likewise
constexpr float kStart = 0.4F;                             // score, where a line is found
constexpr float kGoOn = 0.2F;                              // score, where it is followed
constexpr double kSameLine = 0.0018;                       // metres
constexpr int kSameTurns = 3;                              // and so many directions: 34 degrees
constexpr double kMinLength = 0.012;                       // metres
constexpr double kReturned = 3;                            // pixels
constexpr double kSameCosine = 0.8;  // of the angle between lines that are one
constexpr size_t kMinRing = 12;      // pixels
constexpr std::array<double, 5> kBends = {-0.15, -0.075, 0, 0.075, 0.15};  // radians a pixel
constexpr std::array<double, 5> kAside = {-0.5, -0.25, 0, 0.25, 0.5};      // pixels a pixel

int TurnOf(double angle) {
  const auto turn = static_cast<int>(std::lround(angle / M_PI * kTurns));
  return (turn % kTurns + kTurns) % kTurns;
}

double AngleOf(int turn) { return turn * M_PI / kTurns; }

// Second derivative of a Gaussian across a line, one along it; in pixels. Sum 0, of absolute values
// 1.
cv::Mat LineKernel(double angle, double across, double along) {
  const int reach = static_cast<int>(std::ceil(3 * std::max(across, along)));
  cv::Mat kernel(2 * reach + 1, 2 * reach + 1, CV_32F), gaussian(kernel.size(), CV_32F);
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const double a = (u * std::cos(angle) + v * std::sin(angle)) / along;
      const double c = (v * std::cos(angle) - u * std::sin(angle)) / across;
      const double g = std::exp(-0.5 * (a * a + c * c));
      gaussian.at<float>(v + reach, u + reach) = static_cast<float>(g);
      kernel.at<float>(v + reach, u + reach) = static_cast<float>((1 - c * c) * g);
    }
  }
  kernel -= gaussian * (cv::sum(kernel)[0] / cv::sum(gaussian)[0]);
  return kernel / cv::sum(cv::abs(kernel))[0];
}

// For every direction how clearly a line runs there through a pixel.
std::vector<Image<float>> ScoresOf(const Image<float>& image, double pixel) {
  std::vector<Image<float>> scores(kTurns);
  const cv::Mat from = MatOf(image);
  ParallelFor(0, kTurns, 1, [&](int64_t turn) {
    Image<float> best(image.width(), image.height(), -1);
    cv::Mat to;
    for (const double across : kAcross) {
      cv::filter2D(from, to, CV_32F,
                   LineKernel(AngleOf(static_cast<int>(turn)), across / pixel, kAlong / pixel));
      for (int v = 0; v < image.height(); ++v)
        for (int u = 0; u < image.width(); ++u)
          best(u, v) = std::max(best(u, v), to.at<float>(v, u));
    }
    scores[turn] = std::move(best);
  });
  return scores;
}

// Where a line has been, so that it does not go around a ring for ever.
class OwnPath {
 public:
  // Whether it was there before, in this direction; it has been from then on.
  bool HasReturned(const Vec2& p, double angle) {
    const Eigen::Vector2i at = PinholeCamera::Rounded(p);
    for (int k = 0; k < 9; ++k) {
      const auto before = steps_.find({at.x() + k % 3 - 1, at.y() + k / 3 - 1});
      if (before != steps_.end() && before->second.number + kMinRing < count_ &&
          std::cos(before->second.angle - angle) > kSameCosine)
        return true;
    }
    steps_.insert({{at.x(), at.y()}, {count_++, angle}});
    return false;
  }

 private:
  struct Step {
    size_t number;
    double angle;
  };
  std::map<std::pair<int, int>, Step> steps_;  // by pixel
  size_t count_ = 0;
};

class LineTracer {
 public:
  LineTracer(const Image<float>& image, const MaskImage& known, double pixel)
      : known_(known),
        same_line_(static_cast<int>(std::lround(kSameLine / pixel))),
        scores_(ScoresOf(image, pixel)),
        done_(kTurns, MaskImage(image.width(), image.height(), 0)) {}

  // Through a pixel, where none was found there yet.
  ImageLine Through(const Vec2& seed, int turn) {
    if (IsDone(seed, turn)) return {};
    ImageLine line = Follow(seed, AngleOf(turn) + M_PI);
    std::reverse(line.begin(), line.end());
    const bool is_ring = line.size() > kMinRing && (line.front() - seed).norm() < kReturned;
    line.push_back(seed);
    if (!is_ring) {
      const ImageLine ahead = Follow(seed, AngleOf(turn));
      line.insert(line.end(), ahead.begin(), ahead.end());
    }
    Mark(line);
    return line;
  }

  struct Seed {
    float score;
    int u, v, turn;
  };

  // Where the score is greatest across and in direction, the greatest first.
  std::vector<Seed> Seeds() const {
    std::vector<Seed> seeds;
    for (int v = 0; v < known_.height(); ++v)
      for (int u = 0; u < known_.width(); ++u)
        for (int turn = 0; turn < kTurns && known_(u, v); ++turn)
          if (IsRidge(u, v, turn)) seeds.push_back({scores_[turn](u, v), u, v, turn});
    std::stable_sort(seeds.begin(), seeds.end(),
                     [](const Seed& a, const Seed& b) { return a.score > b.score; });
    return seeds;
  }

 private:
  float At(const Vec2& p, int turn) const {
    const Image<float>& score = scores_[(turn + kTurns) % kTurns];
    const int u = static_cast<int>(std::floor(p.x())), v = static_cast<int>(std::floor(p.y()));
    if (!score.Contains(u, v) || !score.Contains(u + 1, v + 1)) return -1;
    const auto x = static_cast<float>(p.x() - u), y = static_cast<float>(p.y() - v);
    return (1 - y) * ((1 - x) * score(u, v) + x * score(u + 1, v)) +
           y * ((1 - x) * score(u, v + 1) + x * score(u + 1, v + 1));
  }

  // In a direction between two of those filtered.
  float AtAngle(const Vec2& p, double angle) const {
    double turns = std::fmod(angle / M_PI * kTurns, kTurns);
    if (turns < 0) turns += kTurns;
    const int turn = static_cast<int>(turns);
    const auto share = static_cast<float>(turns - turn);
    return (1 - share) * At(p, turn) + share * At(p, turn + 1);
  }

  bool IsRidge(int u, int v, int turn) const {
    const float score = scores_[turn](u, v);
    if (score < kStart) return false;
    const Vec2 p(u, v), aside(-std::sin(AngleOf(turn)), std::cos(AngleOf(turn)));
    return score >= At(p + aside, turn) && score >= At(p - aside, turn) &&
           score >= At(p, turn - 1) && score >= At(p, turn + 1);
  }

  bool IsDone(const Vec2& p, int turn) const {
    const Eigen::Vector2i at = PinholeCamera::Rounded(p);
    return done_[turn](at.x(), at.y()) != 0;
  }

  // A pixel at a time to where the score is greatest.
  ImageLine Follow(const Vec2& seed, double angle) const {
    ImageLine line;
    Vec2 p = seed;
    for (OwnPath path; !path.HasReturned(p, angle);) {
      float best = kGoOn;
      Vec2 best_p = p;
      double best_angle = angle;
      for (const double bend : kBends) {
        const Vec2 ahead(std::cos(angle + bend), std::sin(angle + bend));
        for (const double aside : kAside) {
          const Vec2 next = p + ahead + aside * Vec2(-ahead.y(), ahead.x());
          const float score = AtAngle(next, angle + bend);
          if (score <= best) continue;
          best = score;
          best_p = next;
          best_angle = angle + bend;
        }
      }
      const Eigen::Vector2i at = PinholeCamera::Rounded(best_p);
      const bool goes_on = best > kGoOn && known_.Contains(at.x(), at.y()) &&
                           known_(at.x(), at.y()) && !IsDone(best_p, TurnOf(best_angle));
      if (!goes_on) break;
      p = best_p;
      angle = best_angle;
      line.push_back(p);
    }
    return line;
  }

  void Mark(const ImageLine& line) {
    for (size_t i = 0; i < line.size(); ++i) {
      const Eigen::Vector2i at = PinholeCamera::Rounded(line[i]);
      const int turn = TurnOf(AngleAt(line, i));
      for (int t = turn - kSameTurns; t <= turn + kSameTurns; ++t) {
        MaskImage& done = done_[(t + kTurns) % kTurns];
        for (int v = at.y() - same_line_; v <= at.y() + same_line_; ++v)
          for (int u = at.x() - same_line_; u <= at.x() + same_line_; ++u)
            if (done.Contains(u, v)) done(u, v) = 1;
      }
    }
  }

  const MaskImage& known_;
  int same_line_;  // pixels
  std::vector<Image<float>> scores_;
  std::vector<MaskImage> done_;  // by direction: 1 where a line was found
};

}  // namespace

double AngleAt(const ImageLine& line, size_t i) {
  constexpr size_t kBeside = 3;  // points to either side; chosen
  const Vec2 ahead =
      line[std::min(line.size() - 1, i + kBeside)] - line[i < kBeside ? 0 : i - kBeside];
  return std::atan2(ahead.y(), ahead.x());
}

std::vector<ImageLine> TraceLines(const Image<float>& image, const MaskImage& known, double pixel) {
  std::vector<ImageLine> lines;
  LineTracer tracer(image, known, pixel);
  for (const LineTracer::Seed& seed : tracer.Seeds()) {
    ImageLine line = tracer.Through(Vec2(seed.u, seed.v), seed.turn);
    if (static_cast<double>(line.size()) * pixel >= kMinLength) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace curvefusion
