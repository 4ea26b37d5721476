import json
import subprocess

import numpy as np
import pytest

import curvefusion as cf


def test_cameras_poses_and_stamps(scan):
    sequence = cf.read_sequence(scan)
    intrinsics = json.loads((scan / "intrinsics.json").read_text())
    assert len(sequence) == sequence.frame_count == 16
    assert sequence.folder == scan
    assert sequence.depth_camera.matrix[0, 0] == intrinsics["fx"]
    assert sequence.poses.shape == (16, 4, 4)
    rotations = sequence.poses[:, :3, :3]
    # Poses are made orthonormal in double precision.
    products = rotations @ rotations.transpose(0, 2, 1)
    np.testing.assert_allclose(products, np.tile(np.eye(3), (16, 1, 1)), atol=1e-12)
    given = np.loadtxt(scan / "trajectory.txt")
    nearest = [np.abs(given[:, 0] - stamp).argmin() for stamp in sequence.timestamps]
    # The file has a limited number of digits.
    np.testing.assert_allclose(sequence.poses[:, :3, 3], given[nearest, 1:4], atol=1e-6)


def test_images_own_their_memory(scan):
    sequence = cf.read_sequence(scan)
    depth, color = sequence.depth(0), sequence.color(-1)
    camera = sequence.depth_camera
    assert depth.shape == (camera.height, camera.width) and depth.dtype == np.float32
    assert color.shape[2] == 3 and color.dtype == np.uint8
    before = depth.copy(), color.copy()
    del sequence
    np.testing.assert_array_equal(depth, before[0])
    np.testing.assert_array_equal(color, before[1])
    assert not depth.flags.owndata  # the image of the library, not a copy of it
    depth[0, 0] = 1  # no one else's
    assert 0.2 < np.median(depth[depth > 0]) < 5


def test_frames_that_are_not_there(scan):
    sequence = cf.read_sequence(scan)
    for frame in (16, -17):
        with pytest.raises(IndexError, match="of a sequence of 16"):
            sequence.depth(frame)


def test_a_folder_without_a_sequence(tmp_path):
    with pytest.raises(cf.BadInputError, match=tmp_path.name) as raised:
        cf.read_sequence(tmp_path)
    assert isinstance(raised.value, cf.Error) and isinstance(raised.value, ValueError)
    assert not isinstance(raised.value, cf.UsageError)


def test_file_names_need_not_be_utf8(tmp_path):
    with pytest.raises(cf.BadInputError, match="\udcff"):
        cf.read_sequence(str(tmp_path) + "/\udcff")


def test_check_finds_what_the_command_finds(scan, program):
    steps = []
    report = cf.check(scan, progress=lambda *step: steps.append(step))
    printed = subprocess.run([program, "check", scan, "--json", "--quiet"], capture_output=True)
    assert report == json.loads(printed.stdout)
    assert report["figures"]["frames"] == 16
    assert steps and all(0 <= done <= total for _, done, total in steps)


def test_check_tells_of_defects_instead_of_raising(tmp_path):
    report = cf.check(tmp_path)
    assert not report["usable"]
    assert report["findings"][0]["severity"] == "error"
