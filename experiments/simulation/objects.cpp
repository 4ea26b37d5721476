#include "experiments/simulation/objects.h"

#include "experiments/simulation/families/families.h"
#include "experiments/simulation/solid_objects.h"
#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {

std::vector<std::string> ObjectNames() {
  return {"dish",       "cage",      "cat",       "deco",           "hanger",      "rack",
          "chair",      "wine",      "triangles", "parallel_wires", "breadholder", "valence6",
          "mesh_panel", "cubeframe", "empty",     "stool",          "basket",      "shelf",
          "ladder",     "dome",      "spring",    "knot",           "coat_stand",  "seat",
          "pot_plant",  "mug"};
}

WireObject MakeObject(const std::string& name, const ObjectOptions& options) {
  WireObject object{name, options.curves};
  if (options.shape_seed) {
    object = MakeFamilyObject(name, *options.shape_seed);
  } else if (object.curves.empty() && !MakePaperObject(name, object.curves) &&
             !MakeEverydayObject(name, object.curves) && !MakeSolidObject(name, object.curves) &&
             !MakeStudyObject(name, options, object.curves)) {
    throw Error(ErrorKind::kUsage, "no object is called '" + name + "'; did you mean '" +
                                       NearestName(name, ObjectNames()) + "'?");
  }
  if (options.wire_diameter > 0) {
    for (WireCurve& curve : object.curves) {
      curve.diameter = options.wire_diameter;
      curve.diameters.clear();
    }
  }
  return object;
}

}  // namespace curvefusion
