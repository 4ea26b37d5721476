#include "experiments/studies/recordings.h"

#include <algorithm>

namespace curvefusion {

namespace fs = std::filesystem;

std::vector<fs::path> RecordingsOf(const StudyRequest& request) {
  std::vector<fs::path> found;
  for (const char* part : {"sim", "real"}) {
    if (request.data.empty() || !fs::is_directory(request.data / part)) continue;
    for (const auto& entry : fs::directory_iterator(request.data / part)) {
      if (entry.is_directory() && entry.path().extension() != ".truth") {
        found.push_back(entry.path());
      }
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<fs::path> recordings = request.scans;
  recordings.insert(recordings.end(), found.begin(), found.end());
  return recordings;
}

}  // namespace curvefusion
