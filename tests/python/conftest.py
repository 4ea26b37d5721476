import os
import subprocess

import numpy as np
import pytest

import curvefusion as cf


@pytest.fixture(scope="session")
def program():
    return os.environ["CURVEFUSION_PROGRAM"]


@pytest.fixture(scope="session")
def scan(program, tmp_path_factory):
    """A scan of a cube of wires by a camera without noise, 16 frames."""
    folder = tmp_path_factory.mktemp("scan") / "cube"
    subprocess.run(
        [program, "simulate", "cubeframe", "-o", folder, "--sensor", "ideal", "--quiet"]
        + ["--frames", "16"],
        check=True,
    )
    return folder


@pytest.fixture
def y_graph():
    """Three arms of 100 mm that meet in the origin, 4 mm thick; one has no radius."""
    tips = 0.1 * np.eye(3)
    edges = [
        cf.Edge((0, i + 1), [np.zeros(3), 0.5 * tip, tip], 0.002 if i < 2 else None)
        for i, tip in enumerate(tips)
    ]
    return cf.SkeletonGraph(np.vstack([np.zeros(3), tips]), edges)
