#pragma once

#include <string>
#include <vector>

#include "apps/page_frames.h"
#include "apps/report.h"
#include "kernel/image.h"

namespace curvefusion {

/// What the page shows beside the figures of a run.
struct PagePictures {
  std::string preview;  ///< data URL of the preview; empty where nothing was found
  std::vector<PageFrame> frames;
};

/// Makes the pictures: takes the time of decoding some frames. Throws Error(kBadInput) for a frame
/// that cannot be decoded.
PagePictures MakePagePictures(const Reconstruction& reconstruction, const ColorImage& preview);

/// The text of report.html: one page with everything in it, for people who open the result in a
/// browser. `files` are the names of the files that lie beside it. The same bytes for the same
/// arguments; below 8 MB, unless a skeleton has tens of thousands of curves.
std::string ReportPage(const RunRecord& record, const PagePictures& pictures,
                       const std::vector<std::string>& files);

}  // namespace curvefusion
