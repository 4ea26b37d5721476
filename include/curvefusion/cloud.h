#pragma once

/// Point clouds from and to files: PLY, PCD, XYZ; metres.

#include "kernel/cloud_io.h"
