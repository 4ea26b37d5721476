"""Reconstruct a scan, look at what was found, and write a mesh.

    python3 reconstruct_and_inspect.py SCAN wires.ply

A scan to try it with: curvefusion simulate cage -o SCAN --frames 90
"""

# %% What goes in
import sys

import numpy as np

import curvefusion as cf

folder, mesh_file = sys.argv[1:3]
sequence = cf.read_sequence(folder)
depth = sequence.depth(0)
print(f"{len(sequence)} frames of {depth.shape[1]} x {depth.shape[0]} pixels, {sequence.format}")
print(f"the first is {np.median(depth[depth > 0]):.2f} m away in the median")

# %% Is it usable?
for finding in cf.check(folder)["findings"]:
    print(f"{finding['severity']}: {finding['message']}")


# %% Reconstruct it; Ctrl-C ends this
def progress(stage, done, total):
    print(f"\r{stage} {done}/{total}".ljust(60), end="", file=sys.stderr, flush=True)


result = cf.reconstruct(sequence, progress=progress)
print(file=sys.stderr)
for warning in result.warnings:
    print(f"warning: {warning}")

# %% What was found
skeleton = result.skeleton
if not skeleton.edges:
    sys.exit("nothing thin was found")
print(f"{len(skeleton.edges)} curves, {skeleton.length:.2f} m")
print("diameters in mm:", np.round(2000 * result.radii, 1))
degrees = np.bincount(np.array([edge.nodes for edge in skeleton.edges]).ravel())
print(f"{np.sum(degrees >= 3)} junctions, {np.sum(degrees == 1)} free ends")
for stage in result.report["stages"]:
    print(f"  {stage['name']:<40} {stage['seconds']:6.2f} s")

# %% Tubes
tubes = cf.mesh(skeleton)
tubes.save(mesh_file)
figures = tubes.check()
state = "watertight" if tubes.watertight else figures["defects"]
print(f"{mesh_file}: {state}, {1e6 * figures['volume']:.1f} cm3")
