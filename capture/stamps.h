#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "capture/finding.h"

namespace curvefusion {

/// Puts the entries of `file` in the order of their stamps and leaves only the first entry of each;
/// warns where that changes anything. `stamp_of(entry)` gives seconds.
template <class Entry, class StampOf>
void SortByStamp(const std::string& file, const StampOf& stamp_of, const FindingHandler& on_finding,
                 std::vector<Entry>& entries) {
  const auto earlier = [&](const Entry& a, const Entry& b) { return stamp_of(a) < stamp_of(b); };
  const auto unsorted = std::is_sorted_until(entries.begin(), entries.end(), earlier);
  if (unsorted != entries.end()) {
    on_finding({Severity::kWarning,
                fmt::format("{}: the stamps are not in order (first at {:.6f}); they are sorted",
                            file, stamp_of(*unsorted))});
    std::stable_sort(entries.begin(), entries.end(), earlier);
  }
  const auto same = [&](const Entry& a, const Entry& b) { return stamp_of(a) == stamp_of(b); };
  const auto duplicate = std::adjacent_find(entries.begin(), entries.end(), same);
  if (duplicate == entries.end()) return;
  on_finding(
      {Severity::kWarning,
       fmt::format("{}: the stamp {:.6f} stands there more than once; the first entry of each "
                   "stamp is used, remove the others",
                   file, stamp_of(*duplicate))});
  entries.erase(std::unique(entries.begin(), entries.end(), same), entries.end());
}

/// Pairs each image with at most one of the other list, the smallest differences first: places of
/// depth and colour in lists of rising stamps (seconds), in the order of depth, no farther apart
/// than `tolerance`.
std::vector<std::pair<size_t, size_t>> AssociateStamps(const std::vector<double>& depth,
                                                       const std::vector<double>& color,
                                                       double tolerance);

}  // namespace curvefusion
