#pragma once

#include "kernel/point_grid.h"
