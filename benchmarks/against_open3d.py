#!/usr/bin/python3
"""Times `curvefusion reconstruct` against Open3D's integration of the same frames.

Both work on the same scans (folders as of `curvefusion simulate`), in turn, on all cores. Open3D
reads the images, integrates depth and colour into a ScalableTSDFVolume and extracts the mesh; its
start is not counted. `curvefusion reconstruct` is counted as a whole, with its page and pictures.
Printed are seconds for 30 frames and their ratio in each round: median, least and greatest.

Usage: benchmarks/against_open3d.py [--rounds N] [--voxel METRES] CURVEFUSION SCAN...
Needs Debian's python3-open3d; without it says so and ends with 77, a skipped test to CTest.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

BUNDLE = 30  # frames of a bundle in the paper, whose times are given per bundle
TRUNCATION = 4  # voxels, as in Open3D's own example (4 cm for 1 cm)
MAX_DEPTH = 4.0  # metres; as CurveFusion's volume


def rows(path):
    return [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]


def rotation(x, y, z, w):
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]


def integrate(scan, voxel):
    """Seconds for reading, integration and mesh, and the number of frames."""
    import numpy
    import open3d

    camera = json.loads((scan / "intrinsics.json").read_text())
    intrinsic = open3d.camera.PinholeCameraIntrinsic(
        camera["width"], camera["height"], camera["fx"], camera["fy"], camera["cx"], camera["cy"]
    )
    poses = {row[0]: [float(value) for value in row[1:]] for row in rows(scan / "trajectory.txt")}
    frames = [row for row in rows(scan / "associations.txt") if row[2] in poses]
    start = time.monotonic()
    volume = open3d.pipelines.integration.ScalableTSDFVolume(
        voxel_length=voxel,
        sdf_trunc=TRUNCATION * voxel,
        color_type=open3d.pipelines.integration.TSDFVolumeColorType.RGB8,
    )
    for _, color, stamp, depth in frames:
        image = open3d.geometry.RGBDImage.create_from_color_and_depth(
            open3d.io.read_image(str(scan / color)),
            open3d.io.read_image(str(scan / depth)),
            depth_scale=camera["depth_scale"],
            depth_trunc=MAX_DEPTH,
            convert_rgb_to_intensity=False,
        )
        T_world_camera = numpy.eye(4)
        T_world_camera[:3, :3] = rotation(*poses[stamp][3:])
        T_world_camera[:3, 3] = poses[stamp][:3]
        volume.integrate(image, intrinsic, numpy.linalg.inv(T_world_camera))
    mesh = volume.extract_triangle_mesh()
    seconds = time.monotonic() - start
    if len(mesh.triangles) == 0:
        sys.exit(f"{scan}: Open3D's mesh has no triangles; are poses and images those of one scan?")
    return seconds, len(frames)


def open3d_seconds(scan, voxel):
    """The same in a process of its own, so that no round profits from the one before."""
    command = [sys.executable, __file__, "--integrate", "--voxel", str(voxel), "-", str(scan)]
    seconds, frames = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout.split()
    return float(seconds), int(frames)


def reconstruction_seconds(program, scan):
    with tempfile.TemporaryDirectory() as folder:
        start = time.monotonic()
        subprocess.run([program, "reconstruct", scan, "-o", folder, "--quiet"], check=True)
        return time.monotonic() - start


def spread(values):
    return f"{statistics.median(values):.2f} [{min(values):.2f}, {max(values):.2f}]"


def compare(arguments):
    print("| scan | frames | CurveFusion, s | Open3D, s | ratio |\n| --- | --: | --: | --: | --: |")
    medians = []
    for scan in arguments.scans:
        own, other = [], []
        for _ in range(arguments.rounds):
            seconds, frames = open3d_seconds(scan, arguments.voxel)
            other.append(seconds * BUNDLE / frames)
            own.append(reconstruction_seconds(arguments.program, scan) * BUNDLE / frames)
        ratios = [a / b for a, b in zip(own, other)]
        medians.append(statistics.median(ratios))
        print(f"| {scan.name} | {frames} | {spread(own)} | {spread(other)} | {spread(ratios)} |")
        sys.stdout.flush()
    print(f"\nMedian of the scans' ratios: {statistics.median(medians):.2f}")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--voxel", type=float, default=0.005, help="metres, of Open3D")
    parser.add_argument("--integrate", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("program", help="curvefusion")
    parser.add_argument("scans", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.integrate:
        print(*integrate(arguments.scans[0], arguments.voxel))
        return
    try:
        import open3d  # noqa: F401
    except ImportError:
        print("against_open3d: python3-open3d is not installed: skipped", file=sys.stderr)
        sys.exit(77)
    compare(arguments)


main()
