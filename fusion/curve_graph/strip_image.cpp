#include "fusion/curve_graph/strip_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "capture/image_mat.h"

namespace curvefusion {

namespace {

// Chosen while looking at training scans chair 3, furnished 1, rack 2, tree 2, umbrella 1 and
// vine 1 (docs/lab_notebook.md).
constexpr int kPixelStride = 2;      // every so many-th pixel of strips' middles
constexpr double kSeen = 0.8;        // of the images that look at a wire show a strip there
constexpr double kMinChance = 0.02;  // that a strip lies there by chance, at least
constexpr double kMiddlePx = 0.7;    // standard deviation of where strips have their middle
// derived: log of the density of middles at zero over that of chance, even within reach
constexpr double kAtMiddle = 0.47;

}  // namespace

StripAgreement StripAgreement::Weighted(size_t stride) const {
  StripAgreement weighted = *this;
  weighted.evidence *= kCorrelation * static_cast<double>(stride);
  weighted.middle_evidence *= kCorrelation;
  return weighted;
}

const std::array<double, StripImage::kExplained + 1> StripImage::kMiddleEvidence = [] {
  std::array<double, kExplained + 1> evidence{};
  for (size_t units = 0; units < evidence.size(); ++units) {
    const double off = static_cast<double>(units) / kDistanceUnits / kMiddlePx;
    evidence[units] = kAtMiddle - 0.5 * off * off;
  }
  return evidence;
}();

const std::array<std::array<float, 2>, StripImage::kAroundPixels + 1> StripImage::kEvidence = [] {
  std::array<std::array<float, 2>, kAroundPixels + 1> evidence{};
  for (size_t pixels = 0; pixels < evidence.size(); ++pixels) {
    const double share = static_cast<double>(pixels) / kAroundPixels;
    const double chance = std::clamp(share, kMinChance, kSeen);
    evidence[pixels] = {static_cast<float>(std::log((1 - kSeen) / (1 - chance))),
                        static_cast<float>(std::log(kSeen / chance))};
  }
  return evidence;
}();

StripImage::StripImage(int width, int height, const cv::Rect& part, const StripPixels& strips)
    : part_(part), to_strip_(width, height, kExplained - 1), direction_(width, height, 0) {
  SetStrips(strips);
}

// Without branches, which would be mispredicted: half of the places are explained or hidden.
void StripImage::AddTo(Look look, const LookedAt& places,
                       std::vector<StripAgreement>& agreements) const {
  const uint8_t* to_strip = to_strip_.data();
  const uint16_t* around = around_[look].data();
  const int width = to_strip_.width(), cells = around_[look].width();
  const int reach = ReachUnits(look);
  const auto* evidence = kEvidence.data();
  const double* middle_evidence = kMiddleEvidence.data();
  for (size_t i = 0; i < agreements.size(); ++i) {
    const int u = places.u[i], v = places.v[i];
    const int units = to_strip[v * width + u];
    const int is_open = places.is_open[i] & (units != kExplained);
    const int is_seen = units <= reach;
    StripAgreement& agreement = agreements[i];
    agreement.looked += is_open;
    agreement.seen += is_open & is_seen;
    agreement.evidence +=
        is_open * double{evidence[around[v / kCellPx * cells + u / kCellPx]][is_seen]};
    agreement.middle_evidence += (is_open & is_seen) * middle_evidence[units];
  }
}

void StripImage::Explain(const Eigen::Vector2i& from, const Eigen::Vector2i& to, int width_px) {
  cv::Mat target = MatOf(to_strip_);
  cv::line(target, {from.x(), from.y()}, {to.x(), to.y()}, cv::Scalar(kExplained), width_px);
}

void StripImage::DropExplained() {
  StripPixels left = {MaskImage(part_.width, part_.height, 0),
                      Image<uint8_t>(part_.width, part_.height)};
  MaskImage explained(to_strip_.width(), to_strip_.height());
  for (size_t i = 0; i < explained.size(); ++i)
    explained.data()[i] = to_strip_.data()[i] == kExplained;
  for (int v = 0; v < part_.height; ++v) {
    for (int u = 0; u < part_.width; ++u) {
      left.middles(u, v) = to_strip_(part_.x + u, part_.y + v) == 0;
      left.directions(u, v) = direction_(part_.x + u, part_.y + v);
    }
  }
  SetStrips(left);
  for (size_t i = 0; i < explained.size(); ++i)
    if (explained.data()[i]) to_strip_.data()[i] = kExplained;
}

void StripImage::SetStrips(const StripPixels& strips) {
  std::fill(to_strip_.data(), to_strip_.data() + to_strip_.size(), kExplained - 1);
  unexplained_.clear();
  if (AnySet(strips.middles)) SetNearest(strips);
  SetEvidence(kFirstLook);
  SetEvidence(kCloseLook);
}

// What pixels have of the nearest middle of a strip.
void StripImage::SetNearest(const StripPixels& strips) {
  MaskImage others(part_.width, part_.height);
  for (size_t i = 0; i < others.size(); ++i) others.data()[i] = strips.middles.data()[i] ? 0 : 1;
  cv::Mat distance, labels;
  cv::distanceTransform(MatOf(others), distance, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<uint8_t> direction_of_label(others.size() + 1, 0);
  for (int v = 0; v < part_.height; ++v) {
    for (int u = 0; u < part_.width; ++u) {
      if (!strips.middles(u, v)) continue;
      direction_of_label[labels.at<int>(v, u)] = strips.directions(u, v);
      if ((part_.x + u - (part_.y + v)) % kPixelStride == 0)
        unexplained_.emplace_back(part_.x + u, part_.y + v);
    }
  }
  for (int v = 0; v < part_.height; ++v) {
    uint8_t* units = to_strip_.row(part_.y + v) + part_.x;
    uint8_t* directions = direction_.row(part_.y + v) + part_.x;
    for (int u = 0; u < part_.width; ++u) {
      units[u] = static_cast<uint8_t>(
          std::min<double>(kExplained - 1, kDistanceUnits * distance.at<float>(v, u)));
      directions[u] = direction_of_label[labels.at<int>(v, u)];
    }
  }
}

void StripImage::SetEvidence(Look look) {
  const int width = (to_strip_.width() + kCellPx - 1) / kCellPx;
  const int height = (to_strip_.height() + kCellPx - 1) / kCellPx;
  const int reach = ReachUnits(look);
  Image<float> counts(width, height);
  for (int v = part_.y; v < part_.y + part_.height; ++v) {
    const uint8_t* units = to_strip_.row(v);
    float* cells = counts.row(v / kCellPx);
    for (int u = part_.x; u < part_.x + part_.width; ++u) cells[u / kCellPx] += units[u] <= reach;
  }
  cv::Mat sums;
  cv::boxFilter(MatOf(counts), sums, -1, {kAroundCells, kAroundCells}, {-1, -1}, false);
  around_[look] = Image<uint16_t>(width, height);
  std::copy(sums.begin<float>(), sums.end<float>(), around_[look].data());
}

}  // namespace curvefusion
