#pragma once

#include <vector>

#include "fusion/nets/line_tracing.h"
#include "fusion/nets/net_sheets.h"
#include "fusion/nets/sheet_views.h"
#include "kernel/camera.h"

namespace curvefusion {

/// The diameter of a wire of a net, metres; 0 = not told. `line` in pixels of `looks`, `step`
/// metres apart. Each of the `views` is asked for itself, as all of them together are blurred: the
/// widths at half of what the wire's colour stands out by, less what a pixel blurs. What stands out
/// by less than 8 times the `noise`, grey levels, does not count.
double DiameterOfLine(const ImageLine& line, const NetSheet& sheet, double step,
                      const std::vector<SheetView>& views, const std::vector<SheetLook>& looks,
                      const PinholeCamera& camera, double noise);

}  // namespace curvefusion
