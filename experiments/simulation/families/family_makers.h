#pragma once

#include "experiments/simulation/families/wire_assembly.h"
#include "experiments/simulation/random.h"

namespace curvefusion {

// One maker a family: draws all dimensions and adds the wires, in millimetres, z up.

// Lattices (lattice_families.cpp).
void MakeCage(Random& random, WireAssembly& wires);
void MakeGrid(Random& random, WireAssembly& wires);
void MakeTrolley(Random& random, WireAssembly& wires);
void MakeChair(Random& random, WireAssembly& wires);
void MakeNet(Random& random, WireAssembly& wires);

// Frames (frame_families.cpp).
void MakeRack(Random& random, WireAssembly& wires);
void MakeLegs(Random& random, WireAssembly& wires);
void MakeTruss(Random& random, WireAssembly& wires);
void MakeUmbrella(Random& random, WireAssembly& wires);
void MakeWheel(Random& random, WireAssembly& wires);

// What grows, with free tips (branching_families.cpp).
void MakeTree(Random& random, WireAssembly& wires);
void MakeVine(Random& random, WireAssembly& wires);
void MakeStand(Random& random, WireAssembly& wires);

// Bent wires (curved_families.cpp, cables.cpp).
void MakeScrolls(Random& random, WireAssembly& wires);
void MakeSpring(Random& random, WireAssembly& wires);
void MakeKnot(Random& random, WireAssembly& wires);
void MakeCables(Random& random, WireAssembly& wires);

}  // namespace curvefusion
