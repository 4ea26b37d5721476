#pragma once

/// The whole method: Reconstruct turns a sequence into curves with radii, and says how far they can
/// be trusted.

#include "fusion/pipeline.h"
