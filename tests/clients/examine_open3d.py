#!/usr/bin/python3
"""Has Open3D say whether a mesh file is a sound solid; fails where it is not.

Its test for self-intersections takes quadratic time: a minute and a half for 200,000 triangles.

Usage: tests/clients/examine_open3d.py MESH
Needs Debian's python3-open3d.
"""

import sys

import open3d


def main():
    mesh = open3d.io.read_triangle_mesh(sys.argv[1])
    mesh.remove_duplicated_vertices()  # STL repeats them
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


main()
