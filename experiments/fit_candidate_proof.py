#!/usr/bin/env python3
"""Fits the coefficients of fusion/curve_graph/candidate_proof.cpp and prints what they keep.

fit_candidate_proof.py RESULT:TRUTH ...

RESULT is a new folder of `reconstruct SCAN -o RESULT --save-stages RESULT/stages` (all rounds in it are read), TRUTH the
curves.json of the scan, or `none` where the scan shows no wire. Metres are weights. What is kept is told for scans that were left out of the fit.
Needs numpy and scipy.
"""
import csv
import glob
import json
import os
import sys

import numpy as np
from scipy.spatial import cKDTree

from fit_wire_proof import logistic, motion_to_truth, table_of, true_points

NEAR = 0.006       # metres: a point is true where it lies so near to a true curve
FEW_PLACES = 0.05  # as in candidate_proof.cpp
MIN_COLOUR = 0.2   # likewise
NAMES = ["kBias", "kMiddles", "kFree", "kColour", "kPlaces"]
USED = np.array([-1.76, 4.2, 7.1, 0.58, 1.53])  # as in candidate_proof.cpp
FOLDS = 6


def terms(t):
    """As LogOdds in candidate_proof.cpp, without the constant."""
    return np.column_stack([t["middle_evidence"], t["is_free"] * t["middle_evidence"], t["colour_log_odds"],
                            np.log(t["found_places"] + FEW_PLACES)])


def read(argument):
    """All stretches of a scan, and the share of each that lies on wires."""
    result, truth = argument.rsplit(":", 1)
    rows = []
    for path in sorted(glob.glob(os.path.join(result, "stages", "colour_stretches_*.csv"))):
        rows += list(csv.DictReader(open(path)))
    if not rows:
        return None
    table, places = table_of(rows)
    table["on_wire"] = np.zeros(len(rows))
    if truth != "none":
        edges = json.load(open(os.path.join(result, "skeleton.json")))["edges"]
        wires = true_points(truth)
        R, t = motion_to_truth(np.concatenate([np.array(edge["points"])[:, :3] for edge in edges]), wires)
        table["on_wire"] = (cKDTree(wires).query(places @ R.T + t)[0] < NEAR).mean(1)
    return table


def kept(tables, log_odds):
    """Metres of true and of false stretches that stay."""
    true, false = 0, 0
    for table, odds in zip(tables, log_odds):
        stays = (odds > 0) & ((table["is_free"] > 0) | (table["colour_log_odds"] > MIN_COLOUR))
        true += (table["length"] * table["on_wire"])[stays].sum()
        false += (table["length"] * (1 - table["on_wire"]))[stays].sum()
    return true, false


def fit(tables):
    table = {key: np.concatenate([t[key] for t in tables]) for key in tables[0]}
    is_clear = (table["on_wire"] == 0) | (table["on_wire"] == 1)
    return logistic(terms(table), table["on_wire"], table["length"] * is_clear, ridge=1e-3)


def log_odds(b, table):
    return b[0] + terms(table) @ b[1:]


def main(arguments):
    tables = [t for t in map(read, arguments) if t is not None]
    count = sum(len(t["length"]) for t in tables)
    true = sum((t["length"] * t["on_wire"]).sum() for t in tables)
    print(f"{count} stretches of {len(tables)} scans: {true:.1f} m on wires of "
          f"{sum(t['length'].sum() for t in tables):.1f} m")
    print(" ".join(f"{name} {value:.2f}" for name, value in zip(NAMES, fit(tables))))
    left_out = [None] * len(tables)
    for fold in range(FOLDS):
        b = fit([t for i, t in enumerate(tables) if i % FOLDS != fold])
        for i in range(fold, len(tables), FOLDS):
            left_out[i] = log_odds(b, tables[i])
    for name, odds in (("fitted to other scans", left_out), ("as in use", [log_odds(USED, t) for t in tables])):
        print("%s: kept %.2f m on wires and %.2f m beside" % (name, *kept(tables, odds)))


if __name__ == "__main__":
    main(sys.argv[1:])
