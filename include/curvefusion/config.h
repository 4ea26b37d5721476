#pragma once

/// Settings of the method from TOML files and assignments (ReadConfig).

#include "experiments/config.h"
