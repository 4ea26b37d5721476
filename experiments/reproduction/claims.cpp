#include "experiments/reproduction/claim.h"

namespace curvefusion {

const std::vector<Claim>& Claims() {
  static const std::vector<Claim> kClaims = [] {
    std::vector<Claim> all = ClaimsOfResults();
    for (const auto& more : {ClaimsOfConditions(), ClaimsOfComparisons()}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }();
  return kClaims;
}

}  // namespace curvefusion
