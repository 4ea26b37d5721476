#pragma once

namespace curvefusion {

/// The graph of work of any sweep: it reads plan.json beside it. Results appear complete, whoever
/// makes them; Snakemake must not take them for its own, which it would remove before a job. What
/// it keeps are markers.
inline constexpr const char* kSnakefile = R"(# Written by `curvefusion sweep plan`.
# `curvefusion sweep run` calls it; by hand, in this folder: snakemake --cores 8 --keep-going
import json
import os
import shlex
from pathlib import Path

with open("plan.json") as file:
    PLAN = json.load(file)
CACHES = [Path(cache) for cache in PLAN["caches"]]
PLACES = [Path("."), *CACHES]
STORE = next((cache for cache in CACHES if os.access(cache, os.W_OK)), Path("."))
PROGRAM = shlex.quote(config.get("program", PLAN["program"]))
COMMAND = config.get("submit", "") + " " + PROGRAM  # "srun" runs it elsewhere


def place(path, proof):
    """Where it lies complete, otherwise where it is to be made."""
    return next((p / path for p in PLACES if (p / path / proof).exists()), STORE / path)


def result_of(cell):
    return place(f"cells/{cell}/result", "run.json")


def scan_of(scan):
    return place(f"scans/{scan}", "truth/settings.json")


SCAN = {c["cell"]: c["scan"] for c in PLAN["cells"]}
SHARDS = PLAN["shards"]
SPLIT = {c["cell"] for c in PLAN["cells"] if SHARDS > 1 and c["profile"] == "best"}
NUMBERS = range(1, SHARDS + 1)
TODO = [cell for cell in SCAN if not (result_of(cell) / "run.json").exists()]
MISSING = {s for s in SCAN.values() if not (scan_of(s) / "truth/settings.json").exists()}
TODO_SHARDS = [f"shard_{cell}_{number}" for cell in TODO if cell in SPLIT for number in NUMBERS]
for name in [*(f"cell_{cell}" for cell in TODO), *TODO_SHARDS, *(f"scan_{scan}" for scan in MISSING)]:
    Path("markers", name).unlink(missing_ok=True)  # of something that was removed since


def scan_marker(wildcards):
    scan = SCAN[wildcards.cell]
    return f"markers/scan_{scan}" if scan in MISSING else []


def shard_markers(wildcards):
    cell = wildcards.cell
    return [f"markers/shard_{cell}_{number}" for number in NUMBERS] if cell in SPLIT else []


localrules: collect, cells


rule collect:
    input: expand("markers/cell_{cell}", cell=TODO)
    shell: PROGRAM + " sweep collect . --quiet"


rule cells:
    input: expand("markers/cell_{cell}", cell=TODO)


rule simulate:
    output: touch("markers/scan_{scan}")
    params: folder=lambda wildcards: str(scan_of(wildcards.scan))
    threads: PLAN["threads"]
    resources: mem_mb=PLAN["memory_mb"]
    retries: 1
    shell: COMMAND + " sweep scan scans/{wildcards.scan}.json"
           " -o {params.folder:q} --threads {threads} --quiet"


rule shard:
    input: scan_marker
    output: touch("markers/shard_{cell}_{number}")
    params:
        scan=lambda wildcards: str(scan_of(SCAN[wildcards.cell])),
        result=lambda wildcards: str(result_of(wildcards.cell)),
    wildcard_constraints: cell="[0-9a-f]+", number="[0-9]+"
    threads: PLAN["threads"]
    resources: mem_mb=PLAN["memory_mb"]
    retries: 1
    shell: COMMAND + " sweep cell cells/{wildcards.cell} --scan {params.scan:q}"
           " -o {params.result:q} --shard {wildcards.number}/{SHARDS} --threads {threads} --quiet"


rule measure:
    input: scan_marker, shard_markers
    output: touch("markers/cell_{cell}")
    params:
        scan=lambda wildcards: str(scan_of(SCAN[wildcards.cell])),
        result=lambda wildcards: str(result_of(wildcards.cell)),
        merge=lambda wildcards: f"--merge {SHARDS}" if wildcards.cell in SPLIT else "",
    threads: PLAN["threads"]
    resources: mem_mb=PLAN["memory_mb"]
    retries: 1
    shell: COMMAND + " sweep cell cells/{wildcards.cell} --scan {params.scan:q}"
           " -o {params.result:q} {params.merge} --threads {threads} --quiet"
)";

}  // namespace curvefusion
