#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Where the light of a scene comes from: a lamp above, to the left and behind the camera and as
/// much again from everywhere; a strong lamp or window at one side, with little else; two to four
/// lamps of different strength; or from everywhere alike.
enum class LightKind { kLamp, kSide, kSeveral, kDiffuse };

/// A lamp far away.
struct Lamp {
  Vec3 direction;  ///< unit vector towards it
  double power;    ///< what it adds to a matt white surface that faces it
};

/// The light on a scene.
struct Lighting {
  double ambient = 0.5;  ///< from everywhere, on matt surfaces
  double mirrored = 0;   ///< what mirror-like surfaces show of the light from everywhere
  std::vector<Lamp> lamps = {{Vec3(-0.45, -0.65, 0.75).normalized(), 0.55}};

  /// Light on a matt white surface.
  double Matt(const Vec3& normal) const;

  /// Light from a mirror-like surface towards an eye (unit vectors).
  double Mirrored(const Vec3& normal, const Vec3& to_eye) const;
};

/// The lighting of a kind; directions and strengths are drawn from the seed, but for kLamp.
Lighting MakeLighting(LightKind kind, uint64_t seed);

/// `lamp`, `side`, `several`, `diffuse`.
std::vector<std::string> LightNames();
std::string LightName(LightKind kind);
/// Throws Error(kUsage) for another name.
LightKind LightOf(const std::string& name);

/// What a mirror-like surface sends on, relative to a matt white one seen head-on, where the normal
/// and the direction half-way between light and eye enclose an angle of that cosine: a normalised
/// Phong lobe of about 10 degrees.
double MirrorLobe(double cosine);

}  // namespace curvefusion
