"""write_like_a_camera.py SCAN FOLDER SECONDS: writes a TUM scan frame by frame, so many seconds
apart, as a folder with one pose a frame, and a file `end` behind the last."""
import json
import pathlib
import shutil
import sys
import time


def stamped(path):
    lines = path.read_text().splitlines()
    return [line.split() for line in lines if line and not line.startswith("#")]


def pose_text(t, q):
    x, y, z, w = q
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), t[0]],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), t[1]],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), t[2]],
            [0, 0, 0, 1]]
    return "\n".join(" ".join(repr(value) for value in row) for row in rows) + "\n"


def main():
    scan, folder, seconds = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), float(sys.argv[3])
    intrinsics = json.loads((scan / "intrinsics.json").read_text())
    intrinsics.setdefault("depth_scale", 5000)
    (folder / "intrinsics.json").write_text(json.dumps(intrinsics))
    trajectory = next(path for name in ("trajectory.txt", "groundtruth.txt")
                      if (path := scan / name).exists())
    poses = {line[0]: [float(x) for x in line[1:]] for line in stamped(trajectory)}
    images = zip(stamped(scan / "depth.txt"), stamped(scan / "rgb.txt"))
    for number, ((stamp, depth), (_, color)) in enumerate(images):
        pose = poses[stamp]
        (folder / "pose" / f"{number:06}.txt").write_text(pose_text(pose[:3], pose[3:]))
        for kind, file in (("depth", depth), ("color", color)):
            shutil.copy(scan / file, folder / kind / f"{number:06}{pathlib.Path(file).suffix}")
        time.sleep(seconds)
    (folder / "end").write_text("")


main()
