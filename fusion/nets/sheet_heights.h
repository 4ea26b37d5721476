#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/nets/net_sheets.h"
#include "fusion/nets/sheet_views.h"

namespace curvefusion {

/// Moves a sheet to where the colours of some images agree best, up to 8 mm along its upright, and
/// makes it as smooth as a polynomial of order 4.
void MoveToWhereImagesAgree(const Sequence& sequence, const std::vector<SheetView>& views,
                            NetSheet& sheet);

}  // namespace curvefusion
