#!/usr/bin/python3
"""Has other people's libraries read every file of curves that `curvefusion graph` writes, and compares what they find
with skeleton.json: GraphML by NetworkX, DXF by ezdxf, STEP by OpenCASCADE (through Gmsh), SVG by svgelements. SWC, of
which Debian 12 has no reader, and the cut list are read by their published columns.

Usage: tests/clients/read_curves.py SKELETON STEM TOLERANCE
  SKELETON   skeleton.json; every edge with radii
  STEM       of STEM.graphml, .dxf, .svg, .swc, .csv (a cut list), and of STEM_fit.dxf and .step, splines within
             TOLERANCE (mm)
Needs Debian's python3-ezdxf, python3-gmsh, python3-networkx, python3-numpy and python3-svgelements.
"""

import csv
import json
import sys

import ezdxf
import gmsh
import networkx
import numpy as np
import svgelements


def length(points):
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum()


def require(is_so, what):
    if not is_so:
        sys.exit(f"FAILED: {what}")


def near(found, true, tolerance, what):
    require(len(found) == len(true), f"{what}: {len(found)} instead of {len(true)}")
    worst = np.abs(np.asarray(found, float) - np.asarray(true, float)).max() if len(true) else 0
    require(worst <= tolerance, f"{what}: off by {worst:g}")


def read_graphml(path, nodes, edges):
    graph = networkx.read_graphml(path, force_multigraph=True)
    require(not graph.is_directed(), "GraphML is directed")
    places = [[data[axis] for axis in "xyz"] for _, data in graph.nodes(data=True)]
    near(places, nodes, 0, "nodes of GraphML")
    found = sorted(tuple(map(float, data["points"].split())) for _, _, data in graph.edges(data=True))
    require(found == sorted(tuple(edge.ravel()) for edge in edges), "GraphML has other curves")
    lengths = sorted(data["length"] for _, _, data in graph.edges(data=True))
    near(lengths, sorted(map(length, edges)), 1e-12, "lengths of GraphML, m")
    print(f"  NetworkX: {graph.number_of_nodes()} nodes, {graph.number_of_edges()} edges, every coordinate")


def drawing_of(path):
    drawing = ezdxf.readfile(path)
    require(not drawing.audit().has_errors, f"ezdxf, {path}: {drawing.audit().errors}")
    require(drawing.units == ezdxf.units.MM, f"ezdxf, {path}: its unit is {drawing.units}")
    return drawing.modelspace()


def read_dxf(stem, edges, tolerance):
    found = []
    for line in drawing_of(f"{stem}.dxf").query("POLYLINE"):
        points = [list(vertex.dxf.location) for vertex in line.vertices]
        found.append(np.array(points + points[:1] if line.is_closed else points))
    require(len(found) == len(edges), f"ezdxf finds {len(found)} polylines, not {len(edges)}")
    for points, edge in zip(found, edges):
        near(points.ravel(), 1000 * edge.ravel(), 1e-6, "points of DXF, mm")
    splines = [entity.construction_tool() for entity in drawing_of(f"{stem}_fit.dxf").query("SPLINE")]
    require(len(splines) == len(edges), f"ezdxf finds {len(splines)} splines, not {len(edges)}")
    for spline, edge in zip(splines, edges):
        require(spline.degree == 3, f"ezdxf finds a spline of degree {spline.degree}")
        ends = [list(spline.point(0)), list(spline.point(spline.max_t))]
        near(np.ravel(ends), 1000 * edge[[0, -1]].ravel(), 1e-6, "ends of splines, mm")
        # Not farther from the polyline than was promised: from the nearest of its densely set points.
        dense = 1000 * np.vstack([np.linspace(a, b, 50) for a, b in zip(edge, edge[1:])])
        for t in np.linspace(0, spline.max_t, 101):
            distance = np.linalg.norm(dense - np.array(list(spline.point(t))), axis=1).min()
            step = np.linalg.norm(np.diff(dense, axis=0), axis=1).max()
            require(distance <= tolerance + step, f"ezdxf, a spline is {distance:.3f} mm from its polyline")
    print(f"  ezdxf: {len(found)} polylines, {len(splines)} cubic splines within {tolerance} mm")


def read_step(path, edges, tolerance):
    gmsh.initialize(["gmsh", "-v", "2"])
    gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
    curves = gmsh.model.occ.importShapes(path)
    gmsh.model.occ.synchronize()
    curves = [tag for dimension, tag in curves if dimension == 1]
    require(len(curves) == len(edges), f"OpenCASCADE finds {len(curves)} curves, not {len(edges)}")
    for tag in curves:
        kind = gmsh.model.getType(1, tag)
        require(kind in ("BSpline", "Line", "Nurb"), f"OpenCASCADE finds a curve of the kind {kind}")
    found = sorted(gmsh.model.occ.getMass(1, tag) for tag in curves)
    true = sorted(1000 * length(edge) for edge in edges)
    # A spline within the tolerance rounds what noise there is off: it is shorter by some percent at most.
    near(np.array(found) / np.array(true), np.ones(len(true)), 0.05, "lengths of STEP over the true ones")
    box = np.array(gmsh.model.getBoundingBox(-1, -1)).reshape(2, 3)
    every = 1000 * np.vstack(edges)
    near(box.ravel(), np.ravel([every.min(0), every.max(0)]), 2 * tolerance, "box of STEP, mm")
    gmsh.finalize()
    print(f"  OpenCASCADE: {len(curves)} B-splines, {sum(found):.0f} mm")


def read_svg(path, edges):
    drawing = svgelements.SVG.parse(path, ppi=25.4)  # a unit is a millimetre
    lines = [shape for shape in drawing.elements() if isinstance(shape, svgelements.Polyline)]
    require(len(lines) == 3 * len(edges), f"svgelements finds {len(lines)} curves, not three views of {len(edges)}")
    views = {"front": [0, 1], "side": [2, 1], "top": [0, 2]}
    for view, axes in views.items():
        boxes = [line.bbox(with_stroke=False) for line in lines if line.id.startswith(view)]
        low = np.min([box[:2] for box in boxes], axis=0)
        high = np.max([box[2:] for box in boxes], axis=0)
        every = 1000 * np.vstack(edges)[:, axes]
        near(high - low, np.ptp(every, axis=0), 0.01, f"size of the {view} view, mm")
    print(f"  svgelements: {len(lines)} curves in three views at full size")


def read_swc(path, edges):
    samples = {}
    total = 0
    with open(path, encoding="ascii") as lines:
        for line in lines:
            words = line.split("#")[0].split()
            if not words:
                continue
            number, _, *place, radius, parent = map(float, words)
            require(len(place) == 3 and radius > 0, f"SWC, sample {number:.0f}: {line.strip()}")
            samples[number] = np.array(place)
            if parent != -1:
                require(parent in samples, f"SWC, sample {number:.0f}: its parent comes later")
                total += np.linalg.norm(samples[number] - samples[parent])
    near([total * 1e-6], [sum(map(length, edges))], 1e-9, "length of SWC, m")
    print(f"  SWC: {len(samples)} samples, {total / 1000:.0f} mm")


def read_cut_list(path, edges):
    with open(path, newline="", encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    for index, edge in enumerate(edges):
        mine = [row for row in rows if int(row["edge"]) == index]
        cut = float(mine[0]["length_mm"])
        near([cut], [1000 * length(edge)], 0.01, f"cut of edge {index}, mm")
        steps = sum(float(row["straight_mm"] or 0) + float(row["arc_mm"] or 0) for row in mine)
        near([steps], [cut], 0.02 * len(mine), f"steps of edge {index}, mm")
        require(len(mine) == int(mine[0]["bends"]) + 1, f"edge {index} has {len(mine)} rows")
    print(f"  cut list: {len(rows)} steps for {len(edges)} wires")


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.split("\n\n")[1])
    skeleton, stem, tolerance = sys.argv[1], sys.argv[2], float(sys.argv[3])
    with open(skeleton, encoding="utf-8") as file:
        content = json.load(file)
    nodes = [node["position"] for node in content["nodes"]]
    edges = [np.array(edge["points"], float) for edge in content["edges"]]
    read_graphml(f"{stem}.graphml", nodes, edges)
    read_dxf(stem, edges, tolerance)
    read_step(f"{stem}_fit.step", edges, tolerance)
    read_svg(f"{stem}.svg", edges)
    read_swc(f"{stem}.swc", edges)
    read_cut_list(f"{stem}.csv", edges)


main()
