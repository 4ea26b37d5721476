#!/usr/bin/python3
"""Writes the bags of tests/fuzz/corpus/bag: a small recording in the topics of RealSense's SDK.

The container is written by ROS itself (Debian 12: python3-rosbag, python3-sensor-msgs,
python3-geometry-msgs), so that what reads it here is tried on what others write. The values below
are those that realsense_test.cpp expects.

    tests/capture/readers/write_realsense_bag.py tests/fuzz/corpus/bag
"""

import io
import pathlib
import struct
import sys

import genpy
import numpy as np
import rosbag
from geometry_msgs.msg import Transform
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import Float32, String, UInt32

DEPTH = "/device_0/sensor_0/Depth_0"
COLOR = "/device_0/sensor_1/Color_0"
DEPTH_UNIT = 0.00025
FRAMES = 5
LOST_COLOR = 3
START = 1000


def camera_info(width, height, focal, lens, coefficients):
    info = CameraInfo(width=width, height=height, distortion_model=lens, D=coefficients)
    info.K = [focal, 0, (width - 1) / 2, 0, focal + 1, (height - 1) / 2, 0, 0, 1]
    return info


def image(pixels, encoding, number, stamp):
    message = Image(encoding=encoding, width=pixels.shape[1], height=pixels.shape[0])
    message.header.seq = number
    message.header.stamp = genpy.Time.from_sec(stamp)
    message.header.frame_id = "1"  # says that the depth unit follows the pixels
    message.step = pixels.nbytes // pixels.shape[0]
    message.data = pixels.tobytes()
    return message


def write_image(bag, topic, message, unit, recorded):
    """RealSense appends the depth unit to every image, which ROS's own messages do not have."""
    stream = io.BytesIO()
    message.serialize(stream)
    data = stream.getvalue() + struct.pack("<f", unit)
    bag.write(topic, (message._type, data, message._md5sum, type(message)), recorded, raw=True)


def write(path, compression):
    first = genpy.Time(0, 1)
    with rosbag.Bag(str(path), "w", compression=compression, chunk_threshold=1500) as bag:
        bag.write("/file_version", UInt32(4), first)
        bag.write("/device_0/sensor_0/option/Depth_Units/value", Float32(0.001), first)
        bag.write(DEPTH + "/info/camera_info", camera_info(16, 12, 15, "Brown Conrady", [0.0] * 5), first)
        bag.write(COLOR + "/info/camera_info",
                  camera_info(20, 15, 18, "Inverse Brown Conrady", [-0.05, 0.06, 0.001, -0.002, -0.01]), first)
        for prefix, x in ((DEPTH, 0.0), (COLOR, 0.015)):
            pose = Transform()
            pose.translation.x = x
            # 90 degrees about z in both: the rotation between them is none
            pose.rotation.z = pose.rotation.w = 0.5 ** 0.5
            bag.write(prefix + "/tf/0", pose, first)
        for i in range(FRAMES):
            stamp = START + i / 30
            recorded = genpy.Time.from_sec(0.1 + i / 30)
            v, u = np.mgrid[0:12, 0:16]
            depth = (2000 + 100 * i + 10 * v + u).astype("<u2")
            write_image(bag, DEPTH + "/image/data", image(depth, "mono16", i, stamp), DEPTH_UNIT, recorded)
            bag.write(DEPTH + "/image/metadata", String("not read"), recorded)
            if i == LOST_COLOR:
                continue
            v, u = np.mgrid[0:15, 0:20]
            color = np.stack([10 * i + u, 100 + v, 200 + 0 * u], axis=-1).astype(np.uint8)
            write_image(bag, COLOR + "/image/data", image(color, "rgb8", i, stamp + 0.002), 0, recorded)


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    for name in ("none", "lz4", "bz2"):
        write(folder / f"{name}.bag", name)
