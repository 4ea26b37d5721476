#!/usr/bin/python3
"""Has Open3D say whether a mesh file is a sound solid, and whether others hold the same one; fails where not.

Its test for self-intersections takes quadratic time: a minute and a half for 200,000 triangles.

Usage: tests/clients/examine_open3d.py MESH [SAME...]     all in one unit
Needs Debian's python3-open3d.
"""

import sys

import numpy as np
import open3d


def read(path):
    mesh = open3d.io.read_triangle_mesh(path)
    mesh.remove_duplicated_vertices()  # STL repeats them
    return mesh


def require_same(path, mesh):
    other = read(path)
    counts = [(len(m.vertices), len(m.triangles)) for m in (mesh, other)]
    bounds = [np.r_[m.get_min_bound(), m.get_max_bound()] for m in (mesh, other)]
    # OBJ has nine digits, the others float32.
    if counts[0] != counts[1] or not np.allclose(*bounds, rtol=1e-6, atol=1e-6):
        sys.exit(f"Open3D, {path}: {counts[1]} vertices and triangles in {bounds[1]}, not {counts[0]} in {bounds[0]}")
    print(f"  Open3D: {path.rpartition('.')[2]} has the same mesh")


def main():
    mesh = read(sys.argv[1])
    findings = {
        "orientable": mesh.is_orientable(),
        "edge manifold": mesh.is_edge_manifold(allow_boundary_edges=False),
        "vertex manifold": mesh.is_vertex_manifold(),
        "watertight": mesh.is_watertight(),
    }
    wrong = [what for what, is_so in findings.items() if not is_so]
    if len(mesh.triangles) == 0 or wrong:
        sys.exit(f"Open3D, {sys.argv[1]}: {len(mesh.triangles)} triangles, not {', '.join(wrong)}")
    print(f"  Open3D: {', '.join(findings)}")
    for path in sys.argv[2:]:
        require_same(path, mesh)


main()
