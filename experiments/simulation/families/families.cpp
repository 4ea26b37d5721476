#include "experiments/simulation/families/families.h"

#include <algorithm>
#include <utility>

#include "experiments/simulation/families/family_makers.h"
#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {
namespace {

using Maker = void (*)(Random&, WireAssembly&);
void MakeMixture(Random& random, WireAssembly& wires);

const std::vector<std::pair<std::string, Maker>>& Makers() {
  static const std::vector<std::pair<std::string, Maker>> makers = {
      {"cage", MakeCage},       {"grid", MakeGrid},       {"rack", MakeRack},
      {"trolley", MakeTrolley}, {"chair", MakeChair},     {"legs", MakeLegs},
      {"truss", MakeTruss},     {"net", MakeNet},         {"tree", MakeTree},
      {"vine", MakeVine},       {"stand", MakeStand},     {"umbrella", MakeUmbrella},
      {"wheel", MakeWheel},     {"scrolls", MakeScrolls}, {"spring", MakeSpring},
      {"knot", MakeKnot},       {"cables", MakeCables},   {"mixture", MakeMixture}};
  return makers;
}

// Two or three small objects of other families, side by side.
void MakeMixture(Random& random, WireAssembly& wires) {
  constexpr double kWidest = 880, kHighest = 500;
  const int parts = random.Integer(2, 3);
  double right = 0;
  for (int part = 0; part < parts;) {
    const auto& maker = Makers()[random.Next() % (Makers().size() - 1)].second;  // no mixture
    WireAssembly object;
    maker(random, object);
    const Eigen::AlignedBox3d bounds = object.Bounds();
    const double gap = part == 0 ? 0 : random.Uniform(20, 60);
    const double share = kWidest * (part + 1) / parts;
    if (right + gap + bounds.sizes().x() > share || bounds.sizes().maxCoeff() > kHighest) continue;
    wires.Append(object,
                 Vec3(right + gap - bounds.min().x(), random.Uniform(-40, 40), -bounds.min().z()));
    right += gap + bounds.sizes().x();
    ++part;
  }
}

}  // namespace

std::vector<std::string> ShapeFamilyNames() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : Makers()) names.push_back(name);
  return names;
}

WireObject MakeFamilyObject(const std::string& family, uint64_t seed) {
  for (size_t i = 0; i < Makers().size(); ++i) {
    const auto& [name, maker] = Makers()[i];
    if (name != family) continue;
    Random random(seed, RandomStream::kShape, i);
    WireAssembly wires;
    maker(random, wires);
    return wires.Finished(name);
  }
  throw Error(ErrorKind::kUsage, "there is no family " + family + "; did you mean " +
                                     NearestName(family, ShapeFamilyNames()) + "?");
}

}  // namespace curvefusion
