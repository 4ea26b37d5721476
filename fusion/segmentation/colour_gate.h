#pragma once

#include <cstdint>
#include <vector>

#include "capture/sequence.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/options.h"

namespace curvefusion {

/// How colours part wires from what shows through between them, where depth is one sheet.
struct ColourGateOptions {
  /// Frames, 0 to 1000: the wires' colours are learned from about so many; 0 = colours are not
  /// asked.
  int frames = 0;
  /// Metres, 0 to 0.2: what is wire-coloured in a disc of this diameter is a wire array that the
  /// colour image does not resolve either, as no wire is so thick; it is left to other views. 0 =
  /// not asked. Where two wires of 12 mm cross, a disc of 17 mm fits.
  double max_width = 0.02;
};
void VisitOptions(ColourGateOptions& options, OptionVisitor& visitor);

/// What the colours of wires are, and where colour images show what depth images show.
struct WireColours {
  std::vector<uint8_t> posterior;  ///< of every bin (WireColourModel); empty = nothing is known
  Vec2 shift_px = Vec2::Zero();    ///< from where a depth pixel projects to where it is seen
};

/// A frame of which some pixels are thought to be wire.
struct WireCandidates {
  MaskImage mask;    ///< of the depth image
  MaskImage arrays;  ///< where depth may be one sheet before several wires; smaller than `mask` by
                     ///< an integer factor
  int array_margin = 8;  ///< arrays reach so many pixels of `mask` beyond where `arrays` shows them
  DepthImage depth;
  ColorImage color;
};

/// Learns colours from candidates of several frames: wire is what the masks cover, background what
/// surrounds them at some distance. Masks may cover gaps: what is seen around them as well is less
/// likely wire. Learned again from what remains, once the shift is known. Linear in pixels.
WireColours LearnWireColours(const std::vector<WireCandidates>& frames, const Sequence& sequence,
                             const ColourGateOptions& options);

/// Drops the pixels of the mask, in and next to wire arrays, whose colours are unlikely for wire.
/// Pixels outside the colour image stay. Arrays that the colour image does not resolve are dropped
/// whole. Linear in pixels.
void GateByColour(const WireColours& colours, const Sequence& sequence,
                  const ColourGateOptions& options, WireCandidates& frame);

/// The pixels of the mask in and next to wire arrays.
MaskImage PixelsInArrays(const WireCandidates& frame);

/// Learns the colours again where masks cover wire arrays whole, gaps and all: wire is what lies in
/// the middle of the stripes that the colours so far show in them, background what lies in the
/// middle between. Where gaps are few pixels wide they have blurred colours that nothing around the
/// object has; taken for wire, they would close the gaps. Linear in pixels.
void SharpenColours(const std::vector<WireCandidates>& frames, const Sequence& sequence,
                    WireColours& colours);

/// Leaves of the mask, in and next to wire arrays, the pixels in the middle of the stripes that the
/// wires' colours make in the colour image, and those of levels wider than a stripe: where depth is
/// one sheet, what it has beside a wire's axis only blurs the axis. Linear in pixels.
void ThinToCrests(const WireColours& colours, const Sequence& sequence, WireCandidates& frame);

}  // namespace curvefusion
