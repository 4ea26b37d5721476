#!/usr/bin/python3
"""Runs `curvefusion live` on a long scan and shows its memory and time a frame over time.

The long scan is made of links to the frames of a short one, forth and back, so that the camera
moves evenly. The run is ended once the capture is over; the reconstruction of all frames at the
end is not waited for. Printed are a row for every tenth of the scan, and at the end what was
dropped. With --csv all samples are written, with --picture they are drawn.

Usage: benchmarks/live_over_time.py [--frames N] [--rate R] CURVEFUSION SCAN
SCAN is a folder as of `curvefusion simulate`. --picture needs gnuplot.
"""

import argparse
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

PERIOD = 1.0  # seconds between two samples


def rows(path):
    return [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]


def link(scan, frames, rate, folder):
    """A TUM sequence of so many frames from one whose images and poses have the same times."""
    images = {name: rows(scan / f"{name}.txt") for name in ("rgb", "depth")}
    poses = rows(scan / "trajectory.txt")
    lists = {name: [] for name in (*images, "trajectory")}
    (folder / "intrinsics.json").symlink_to(scan / "intrinsics.json")
    for name in images:
        (folder / name).mkdir()
    last = len(poses) - 1
    for frame in range(frames):
        step = frame % (2 * last)
        source = min(step, 2 * last - step)
        stamp = f"{1000 + frame / rate:.6f}"
        for name, files in images.items():
            file = f"{name}/{stamp}{pathlib.Path(files[source][1]).suffix}"
            (folder / file).symlink_to(scan / files[source][1])
            lists[name].append(f"{stamp} {file}")
        lists["trajectory"].append(" ".join([stamp, *poses[source][1:]]))
    for name, lines in lists.items():
        (folder / f"{name}.txt").write_text("\n".join(lines) + "\n")


def resident_megabytes(process):
    pages = int(pathlib.Path(f"/proc/{process}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGESIZE") / 1e6


def processor_milliseconds(process):
    """Of all its threads so far."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return 1000 * (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def sample(out, process, start):
    """None before the first state."""
    try:
        state = json.loads((out / "state.json").read_text())
    except FileNotFoundError:
        return None
    frames = state["frames"]
    return {
        "seconds": time.monotonic() - start,
        "phase": state["phase"],
        "arrived": frames["arrived"],
        "used": frames["used"],
        "dropped": frames["dropped"],
        "memory": resident_megabytes(process),
        "processor": processor_milliseconds(process),
        "behind": state["snapshot"]["most_seconds_behind"],
    }


def watch(arguments, folder):
    out = folder / "out"
    command = [arguments.program, "live", folder / "scan", "-o", out, "--rate", str(arguments.rate)]
    samples = []
    with open(folder / "log", "w") as log:
        run = subprocess.Popen(command, stdout=log, stderr=log)
        start = time.monotonic()
        while run.poll() is None:
            time.sleep(PERIOD)
            now = sample(out, run.pid, start)
            if now is None:
                continue
            if now["phase"] != "scanning" and samples:
                run.send_signal(signal.SIGKILL)
                run.wait()
                return samples
            samples.append(now)
    sys.exit(f"the run has ended before its capture:\n{(folder / 'log').read_text()}")


def cost_since(samples, i, j):
    """Milliseconds of processor time a frame that was used between two samples."""
    spent = samples[j]["processor"] - samples[i]["processor"]
    return spent / max(1, samples[j]["used"] - samples[i]["used"])


def table(samples):
    lines = ["| frames | memory, MB | ms a used frame since | dropped |\n| --: | --: | --: | --: |"]
    before, tenth = 0, samples[-1]["arrived"] / 10
    for k in range(1, 11):
        i = next(i for i, s in enumerate(samples) if s["arrived"] >= k * tenth - 0.5)
        s = samples[i]
        cost = cost_since(samples, before, i)
        lines.append(f"| {s['arrived']} | {s['memory']:.0f} | {cost:.1f} | {s['dropped']} |")
        before = i
    lines.append(f"\nMost seconds that a snapshot was behind: {samples[-1]['behind']:.2f}")
    return "\n".join(lines)


def write_csv(samples, path):
    keys = list(samples[0])
    lines = [",".join(keys)] + [",".join(str(s[key]) for key in keys) for s in samples]
    path.write_text("\n".join(lines) + "\n")


def draw(samples, path):
    """Memory and time a frame, the latter over windows of a twentieth of the scan."""
    window = max(1, len(samples) // 20)
    points = [
        (samples[j]["arrived"], samples[j]["memory"], cost_since(samples, j - window, j))
        for j in range(window, len(samples))
    ]
    data = "\n".join("{} {:.1f} {:.2f}".format(*point) for point in points)
    script = f"""set terminal pngcairo size 900,420 font 'DejaVu Sans,11'
set output '{path}'
$points << END
{data}
END
set xlabel 'frames'
set ylabel 'memory, MB'
set y2label 'processor ms a used frame'
set yrange [0:*]
set y2range [0:*]
set ytics nomirror
set y2tics
set key bottom right
plot $points using 1:2 with lines lw 2 title 'memory', \\
  $points using 1:3 axes x1y2 with lines lw 2 title 'time a frame'
"""
    subprocess.run(["gnuplot"], input=script.encode(), check=True)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--frames", type=int, default=10000)
    parser.add_argument("--rate", type=float, default=30, help="frames a second")
    parser.add_argument("--csv", type=pathlib.Path, help="all samples")
    parser.add_argument("--picture", type=pathlib.Path, help="PNG")
    parser.add_argument("program", help="curvefusion")
    parser.add_argument("scan", type=pathlib.Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "scan").mkdir()
        link(arguments.scan.resolve(), arguments.frames, arguments.rate, folder / "scan")
        samples = watch(arguments, folder)
    print(table(samples))
    if arguments.csv:
        write_csv(samples, arguments.csv)
    if arguments.picture:
        draw(samples, arguments.picture)


main()
