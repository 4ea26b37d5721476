#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/polyline.h"

namespace curvefusion {

/// One wire: its centre line (a closed one repeats its first point) and its diameter, in metres.
struct WireCurve {
  Polyline points;
  double diameter = 0;                 ///< everywhere, or where it tapers: on average
  std::vector<double> diameters = {};  ///< of a wire that tapers: one a point; otherwise empty

  bool IsClosed() const { return points.size() > 2 && points.front() == points.back(); }
  double DiameterAt(size_t point) const { return diameters.empty() ? diameter : diameters[point]; }
};

/// Where wires are joined.
enum class WeldRule {
  kNearness,     ///< wherever their centre lines come within 1.2 mm
  kSharedPoints  ///< at the points they share bit for bit and nowhere else: others touch or pass
};

/// A thing made of wires, in its own frame: z up, seen best from -y.
struct WireObject {
  std::string name;
  std::vector<WireCurve> curves;
  WeldRule welds = WeldRule::kNearness;
};

/// How an object may differ from its description.
struct ObjectOptions {
  double wire_diameter = 0;            ///< metres; 0 keeps the object's own diameters
  double spacing = 0.020;              ///< metres between the axes of `parallel_wires`
  std::vector<WireCurve> curves = {};  ///< the caller's own object, under any name
  /// The name is one of ShapeFamilyNames (families/families.h), and this the seed of its object.
  std::optional<uint64_t> shape_seed = {};
};

/// Every name MakeObject knows: the paper's eight first, in the order of its Table 1.
std::vector<std::string> ObjectNames();

/// The paper's eight objects as analogues (`dish`, `cage`, `cat`, `deco`, `hanger`, `rack`,
/// `chair`, `wine`: sizes guessed from its figures, diameters from its Table 1), and objects of the
/// studies: `triangles` (1, 2, 3 and 4 mm), `parallel_wires`, `breadholder`, `valence6` (the
/// junction of the paper's limitations), `mesh_panel`, `cubeframe`, `empty` (no wire at all), and
/// of other shapes: `stool`, `basket`, `shelf`, `ladder`, `dome`, `spring`, `knot`, `coat_stand`,
/// and with solid parts (solid_objects.h). Throws Error(kUsage) for another name, unless the options
/// bring the curves, and for parallel wires thicker than their spacing.
WireObject MakeObject(const std::string& name, const ObjectOptions& options = {});

/// The paper's eight; false where `name` is none of them.
bool MakePaperObject(const std::string& name, std::vector<WireCurve>& curves);

/// Objects of other shapes; false where `name` is none of them.
bool MakeEverydayObject(const std::string& name, std::vector<WireCurve>& curves);

/// The objects of the studies; false where `name` is none of them.
bool MakeStudyObject(const std::string& name, const ObjectOptions& options,
                     std::vector<WireCurve>& curves);

}  // namespace curvefusion
