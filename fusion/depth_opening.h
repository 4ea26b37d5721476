#pragma once
#include "kernel/camera.h"
#include "kernel/image.h"
#include "kernel/options.h"
namespace curvefusion {
struct DepthOpeningOptions { double radius = 0.02; double discontinuity = 0.015; };
void VisitOptions(DepthOpeningOptions& options, OptionVisitor& visitor);
DepthImage OpenDepth(const DepthImage& rendering, const PinholeCamera& camera, const DepthOpeningOptions& options);
}
