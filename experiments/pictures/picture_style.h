#pragma once

#include <array>

#include "kernel/image.h"

namespace curvefusion {

/// A part of the preview is drawn so many times larger and then reduced, for smooth lines and text.
inline constexpr int kSupersampling = 2;

/// Colours that are told apart well on white and on photographs; edges take them in turn.
inline constexpr std::array<Rgb, 10> kEdgePalette = {{{214, 39, 40},
                                                      {31, 119, 180},
                                                      {44, 160, 44},
                                                      {255, 127, 14},
                                                      {148, 103, 189},
                                                      {0, 158, 158},
                                                      {227, 119, 194},
                                                      {140, 86, 75},
                                                      {160, 160, 20},
                                                      {60, 60, 200}}};
inline const Rgb& EdgeColor(int edge) { return kEdgePalette[edge % kEdgePalette.size()]; }

inline constexpr Rgb kWhite = {255, 255, 255};
inline constexpr Rgb kInk = {40, 44, 52};
inline constexpr Rgb kPaleInk = {110, 116, 126};

}  // namespace curvefusion
