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
constexpr int kAroundCells = 9;

}  // namespace

StripImage::StripImage(int width, int height, const cv::Rect& part, const StripPixels& strips)
    : part_(part), to_strip_(width, height, kExplained - 1), direction_(width, height, 0) {
  SetStrips(strips);
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
  Image<float> shares(width, height);
  for (int v = part_.y; v < part_.y + part_.height; ++v) {
    const uint8_t* units = to_strip_.row(v);
    float* cells = shares.row(v / kCellPx);
    for (int u = part_.x; u < part_.x + part_.width; ++u)
      cells[u / kCellPx] += units[u] <= kReachPx[look] * kDistanceUnits;
  }
  cv::Mat around;
  cv::blur(MatOf(shares) / (kCellPx * kCellPx), around, cv::Size(kAroundCells, kAroundCells));
  seen_[look] = not_seen_[look] = Image<float>(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double chance = std::clamp<double>(around.at<float>(v, u), kMinChance, kSeen);
      seen_[look](u, v) = static_cast<float>(std::log(kSeen / chance));
      not_seen_[look](u, v) = static_cast<float>(std::log((1 - kSeen) / (1 - chance)));
    }
  }
}

}  // namespace curvefusion
