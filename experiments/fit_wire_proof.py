#!/usr/bin/env python3
"""Fits the coefficients of fusion/curve_graph/wire_proof.cpp and prints how reliable they are.

fit_wire_proof.py [--keep-first-step] STAGES:TRUTH ... [--validation STAGES:TRUTH ...]

STAGES is a folder of `reconstruct --save-stages` (evidence.csv in it), TRUTH the curves.json of the scan, or
`none` where the scan shows no wire, or `all` where every curve is one. --keep-first-step fits what colour tells only
and takes the rest from wire_proof.cpp. Needs numpy and scipy.
"""
import csv
import json
import os
import sys

import numpy as np
from scipy.spatial import cKDTree

NEAR = 0.008       # metres: a stretch is true where it lies so near to a true curve
UNCLEAR = (0.006, 0.012)  # metres: stretches so far away teach nothing
NEIGHBOURHOOD = 0.25      # metres, as in wire_proof.cpp
LEAST = 0.03
FIRST_STEP = np.array([0.59, -1.71, 1.68, -2.44, -1.97, -2.98, 3.29, -3.0])  # as in wire_proof.cpp
SECOND_STEP = np.array([-1.17, 0.34, 1.8])  # likewise
WIDTHS = [2, 6]  # columns of terms()


def true_points(path):
    points = [np.zeros((0, 3))]
    for curve in json.load(open(path)):
        p = np.array(curve["points"], float)
        if curve.get("closed"):
            p = np.vstack([p, p[:1]])
        for a, b in zip(p[:-1], p[1:]):
            count = max(1, int(np.linalg.norm(b - a) / 0.001))
            points.append(a + (b - a) * ((np.arange(count) + 0.5) / count)[:, None])
    return np.concatenate(points)


def motion_to_truth(points, truth):
    """R and t of the rigid motion of points to the truth: trimmed iterative closest points."""
    R, t, tree = np.eye(3), np.zeros(3), cKDTree(truth)
    for threshold in np.repeat([0.03, 0.02, 0.012, 0.008], 6):
        distance, index = tree.query(points @ R.T + t)
        near = distance < threshold
        if near.sum() < 6:
            break
        a, b = points[near], truth[index[near]]
        U, _, V = np.linalg.svd((a - a.mean(0)).T @ (b - b.mean(0)))
        R = V.T @ np.diag([1, 1, np.sign(np.linalg.det(V.T @ U.T))]) @ U.T
        t = b.mean(0) - R @ a.mean(0)
    return R, t


def aligned(points, truth):
    """Points after that motion."""
    R, t = motion_to_truth(points, truth)
    return points @ R.T + t


def parts(table):
    """A number for every stretch: edges that meet in a point have the same."""
    parent, node, first, last = {}, {}, {}, {}

    def root(e):
        while parent[e] != e:
            e = parent[e]
        return e

    for i, e in enumerate(table["edge"]):
        parent.setdefault(e, e)
        first.setdefault(e, i)
        last[e] = i
    for e in parent:
        for end, i in (("0", first[e]), ("2", last[e])):
            place = tuple(table[axis + end][i] for axis in "xyz")
            if place in node:
                parent[root(e)] = root(node[place])
            node[place] = e
    return np.array([root(e) for e in table["edge"]])


def table_of(rows):
    """Columns of numbers, and the three points of every row of a table of stretches."""
    table = {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}
    return table, np.stack([np.stack([table[a + i] for a in "xyz"], 1) for i in "012"], 1)


def read(argument):
    stages, truth = argument.rsplit(":", 1)
    rows = list(csv.DictReader(open(os.path.join(stages, "evidence.csv"))))
    if not rows:
        return None
    table, places = table_of(rows)
    distance = np.full((len(rows), 3), np.inf)
    if truth == "all":
        distance[:] = 0
    elif truth != "none":
        points = true_points(truth)
        distance = cKDTree(points).query(aligned(places.reshape(-1, 3), points))[0].reshape(-1, 3)
    table["distance"] = np.median(distance, 1)
    table["true"] = (table["distance"] < NEAR).astype(float)
    table["part"] = parts(table)
    return table


def terms(t):
    """As OwnTerms in wire_proof.cpp."""
    w = t["images"] / (t["images"] + 5)
    return np.column_stack([
        w * np.log((t["same"] + LEAST) / LEAST), w * t["open"],
        w * np.clip((t["width"] - 0.012) / 0.010, 0, 1.5), w * t["past"],
        w * np.clip((t["past"] - 0.6) / 0.4, 0, 1), t["coverage"],
        np.clip((t["diameter"] - 0.012) / 0.006, 0, 1.5)])


def own_terms(t, b):
    """The log-odds of a stretch without colours, and what they owe to its width."""
    columns = terms(t)
    return b[0] + columns @ b[1:], columns[:, WIDTHS] @ b[1:][WIDTHS]


def colour_terms(t, b):
    """As OwnTerms in wire_proof.cpp: of kLessOfTheRest (of all but the width), kToldByColour, kOpenInColour."""
    own, width = own_terms(t, b)
    told = t["beside_most"] ** 2 / (t["beside_most"] ** 2 + 25)
    of_surfaces = np.log((t["beside_least"] + 1) / (t["on_surfaces"] + 1))
    excess = np.where(t["on_surfaces"] > 0, np.maximum(0, of_surfaces - 1), 0)
    of_most = 0.7 - np.maximum(0, np.log((t["beside_most"] + 1) / (t["beside_least"] + 1)) - excess)
    is_open = np.maximum(np.minimum(of_most, 2 * of_surfaces), -1.3)
    return told[:, None] * np.column_stack([-(own - width), np.ones(len(own)), is_open])


TERMS = ["kSame", "kOpen", "kWide", "kPast", "kMostlyPast", "kCovered", "kThick"]


def around(own, table):
    middles = np.column_stack([table[axis + "1"] for axis in "xyz"])
    length, clipped, result = table["length"], np.clip(own, -4, 4), np.zeros(len(own))
    for i, near in enumerate(cKDTree(middles).query_ball_point(middles, NEIGHBOURHOOD)):
        near = [j for j in near if j != i and table["part"][j] == table["part"][i]]
        result[i] = (clipped[near] * length[near]).sum() / (length[near].sum() + 0.04)
    return result


def weights(tables):
    """Of every scan at most 2 m of true and of false curve count; both kinds weigh the same."""
    result = []
    for table in tables:
        w = table["length"].copy()
        for label in (0, 1):
            of = table["true"] == label
            w[of] *= min(1, 2 / max(1e-9, table["length"][of].sum()))
        w[(table["distance"] > UNCLEAR[0]) & (table["distance"] < UNCLEAR[1])] = 0
        result.append(w)
    w, y = np.concatenate(result), np.concatenate([t["true"] for t in tables])
    for label in (0, 1):
        w[y == label] /= max(1e-9, w[y == label].sum())
    return w * 4 * len(tables)


def logistic(X, y, w, ridge=0.3, offset=None):
    """With a constant first; with an offset of the log-odds instead where one is given."""
    if offset is None:
        X = np.column_stack([np.ones(len(X)), X])
    penalty = ridge * np.ones(X.shape[1])
    penalty[0] *= offset is not None
    b = np.zeros(X.shape[1])
    for _ in range(50):
        p = 1 / (1 + np.exp(-np.clip((0 if offset is None else offset) + X @ b, -30, 30)))
        H = (X * (w * p * (1 - p))[:, None]).T @ X + np.diag(penalty + 1e-9)
        b -= np.linalg.solve(H, X.T @ (w * (p - y)) + penalty * b)
    return b


def print_reliability(p, y, w):
    print("said        metres  mean said  true")
    for low, high in ((0, .05), (.05, .15), (.15, .3), (.3, .5), (.5, .7), (.7, .85), (.85, .95), (.95, 1.01)):
        of = (p >= low) & (p < high) & (w > 0)
        if of.any():
            print(f"{low:.2f}-{min(high, 1):.2f}  {w[of].sum():7.2f}  {np.average(p[of], weights=w[of]):9.3f}"
                  f"  {np.average(y[of], weights=w[of]):.3f}")


def judged(t, b, g):
    return own_terms(t, b)[0] + colour_terms(t, b) @ g


def probability(tables, b, g, c):
    result = []
    for table in tables:
        own = judged(table, b, g)
        result.append(c[0] + c[1] * own + c[2] * around(own, table))
    return 1 / (1 + np.exp(-np.concatenate(result)))


def main(arguments):
    keep_first = "--keep-first-step" in arguments
    arguments = [a for a in arguments if a != "--keep-first-step"]
    split = arguments.index("--validation") if "--validation" in arguments else len(arguments)
    train = [t for t in map(read, arguments[:split]) if t is not None]
    held_out = [t for t in map(read, arguments[split + 1:]) if t is not None]
    w, y = weights(train), np.concatenate([t["true"] for t in train])
    b = FIRST_STEP if keep_first else logistic(np.concatenate([terms(t) for t in train]), y, w)
    g = logistic(np.concatenate([colour_terms(t, b) for t in train]), y, w,
                 offset=np.concatenate([own_terms(t, b)[0] for t in train]))
    own = [judged(t, b, g) for t in train]
    c = SECOND_STEP if keep_first else logistic(
        np.column_stack([np.concatenate(own), np.concatenate([around(o, t) for o, t in zip(own, train)])]), y, w)
    print("kBias", round(b[0], 2), *(f"{n} {v:.2f}" for n, v in zip(TERMS, b[1:])))
    print(f"kLessOfTheRest {g[0]:.2f} kToldByColour {g[1]:.2f} kOpenInColour {g[2]:.2f}")
    print(f"kAroundBias {c[0]:.2f} kOwn {c[1]:.2f} kAround {c[2]:.2f}")
    for name, tables in (("training", train), ("validation", held_out)):
        if tables:
            print(name)
            print_reliability(probability(tables, b, g, c), np.concatenate([t["true"] for t in tables]), weights(tables))


if __name__ == "__main__":
    main(sys.argv[1:])
