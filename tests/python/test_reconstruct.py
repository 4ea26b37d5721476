import ast
import json
import os
import pathlib
import re
import runpy
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import curvefusion as cf


@pytest.fixture(scope="module")
def run(scan):
    """A result, and the steps that were reported."""
    steps = []
    sequence = cf.read_sequence(scan)
    result = cf.reconstruct(
        sequence,
        settings={"radius.max_frames": 10},
        progress=lambda *step: steps.append((threading.get_ident(), step)),
    )
    return result, steps


def test_the_result_is_that_of_the_command(run, scan, program, tmp_path):
    result, _ = run
    subprocess.run(
        [program, "reconstruct", scan, "-o", tmp_path / "out", "--quiet"]
        + ["--set", "radius.max_frames=10"],
        check=True,
    )
    result.skeleton.save(tmp_path / "skeleton.json")
    expected = (tmp_path / "out" / "skeleton.json").read_bytes()
    assert (tmp_path / "skeleton.json").read_bytes() == expected
    assert result.config == (tmp_path / "out" / "config.toml").read_text()
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    for key in ("funnel", "trust", "skeleton", "poses", "cameras", "profile"):
        assert result.report[key] == report[key], key
    assert [s["name"] for s in result.report["stages"]] == [s["name"] for s in report["stages"]]


def test_what_a_result_holds(run, scan):
    result, _ = run
    assert len(result.radii) == len(result.skeleton.edges) > 0
    # The wires of the cube are 5 mm thick; a few frames give them to some percent.
    assert np.nanmedian(result.radii) == pytest.approx(0.0025, rel=0.2)
    assert result.global_radius == pytest.approx(0.0025, rel=0.2)
    assert result.poses.shape == (16, 4, 4)
    assert result.points.shape[1] == 3 and len(result.points) == result.report["points"]
    assert isinstance(result.uncertain, cf.SkeletonGraph)
    assert all(isinstance(warning, str) for warning in result.warnings)
    points = result.points
    assert np.shares_memory(points, result.points) and not points.flags.writeable


def test_progress_comes_on_the_calling_thread_in_order(run):
    _, steps = run
    assert {thread for thread, _ in steps} == {threading.get_ident()}
    assert len({stage for _, (stage, _, _) in steps}) > 3
    assert all(0 <= done <= total for _, (_, done, total) in steps)


def test_evaluation_is_that_of_the_command(run, scan, program, tmp_path):
    result, _ = run
    result.skeleton.save(tmp_path / "skeleton.json")
    truth = scan / "truth"
    command = [program, "evaluate", tmp_path / "skeleton.json", "--truth", truth, "--quiet"]
    subprocess.run(command + ["--json", tmp_path / "scores.json"], check=True)
    expected = json.loads((tmp_path / "scores.json").read_text())
    scores = cf.evaluate(result.skeleton, truth)
    names = ("result", "truth")
    assert {k: v for k, v in scores.items() if k not in names} == {
        k: v for k, v in expected.items() if k not in names
    }
    assert scores["aligned"]["curves"]["5mm"]["recall"] > 0.5
    perfect = cf.SkeletonGraph.load(truth / "skeleton.json")
    assert cf.evaluate(perfect, perfect)["raw"]["curves"]["1mm"]["f"] == 1


def test_a_truth_needs_radii(y_graph):
    with pytest.raises(cf.BadInputError, match="truth: edge 2 has no radius"):
        cf.evaluate(y_graph, y_graph)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"profile": "bset"}, "best"),
        ({"settings": {"radius.max_frame": 10}}, "radius.max_frames"),
        ({"settings": {"radius.max_frames": "many"}}, "radius.max_frames"),
        ({"settings": {"radius.max_frames": -1}}, "radius.max_frames"),
        ({"settings": {"radius.max_frames": 1.5}}, "whole number"),
        ({"settings": {"radius.max_frames": True}}, "whole number"),
    ],
)
def test_settings_that_cannot_be(scan, arguments, message):
    with pytest.raises(cf.UsageError, match=message):
        cf.reconstruct(scan, **arguments)


def test_numbers_of_numpy_are_settings(scan):
    def stop(*_):
        raise StopIteration

    settings = {"radius.max_frames": np.int64(10), "volume.voxel_size": np.float32(0.0078125)}
    with pytest.raises(StopIteration):
        cf.reconstruct(scan, settings=settings, progress=stop)


def test_a_scan_that_is_none(tmp_path):
    with pytest.raises(cf.BadInputError, match=tmp_path.name):
        cf.reconstruct(tmp_path)


def test_nothing_thin_is_a_result(scan):
    result = cf.reconstruct(scan, settings={"segmentation.min_depth": 2.9})
    assert result.skeleton.edges == [] and result.skeleton.nodes.shape == (0, 3)
    assert len(result.radii) == 0 and result.global_radius is None
    assert result.points.shape == (0, 3) and result.report["trust"] is None


def test_an_exception_of_the_callback_ends_the_run(scan):
    class Enough(Exception):
        pass

    calls = []

    def progress(*step):
        calls.append(step)
        if len(calls) == 3:
            raise Enough("of this")

    with pytest.raises(Enough, match="of this"):
        cf.reconstruct(scan, progress=progress)
    assert len(calls) == 3
    assert cf.check(scan)["usable"]  # the next call works


def test_other_threads_go_on_meanwhile(scan):
    ticks = []
    done = threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.01)

    thread = threading.Thread(target=tick)
    thread.start()
    cf.check(scan)
    done.set()
    thread.join()
    # Decoding takes longer than this; with the GIL held there would be one tick.
    assert len(ticks) > 3


INTERRUPTED = """
import os, signal, sys, threading, time
import curvefusion as cf
calls = []
def progress(*step):
    if len(calls) == 5:
        print("running", flush=True)
    calls.append(step)
try:
    cf.reconstruct(sys.argv[1], progress=progress)
except KeyboardInterrupt:
    print("interrupted", len(calls), flush=True)
graph = cf.SkeletonGraph([[0, 0, 0], [0, 0, 1]], [cf.Edge((0, 1), [[0, 0, 0], [0, 0, 1]])])
print(len(graph.smooth().edges))  # later calls are not interrupted
"""


def test_control_c_ends_a_run_soon(run, scan):
    process = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, scan], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "running\n"
    process.send_signal(signal.SIGINT)
    word, calls = process.stdout.readline().split()
    assert word == "interrupted"
    _, steps = run
    assert int(calls) < len(steps) / 2  # by steps, as a machine may be slow
    assert process.communicate()[0] == "1\n"
    assert process.returncode == 0


def test_the_example_runs(scan, tmp_path, monkeypatch, capsys):
    source = pathlib.Path(os.environ["CURVEFUSION_SOURCE_DIR"])
    example = source / "examples" / "python" / "reconstruct_and_inspect.py"
    monkeypatch.setattr(sys, "argv", [str(example), str(scan), str(tmp_path / "wires.ply")])
    runpy.run_path(str(example), run_name="__main__")
    assert cf.Mesh.load(tmp_path / "wires.ply").watertight
    assert "watertight" in capsys.readouterr().out


def test_the_programs_of_the_documents_run(scan, tmp_path, monkeypatch):
    text = (pathlib.Path(os.environ["CURVEFUSION_SOURCE_DIR"]) / "docs" / "python.md").read_text()
    programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(programs) == 2
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scan").symlink_to(scan)
    for program in programs:
        exec(program, {})
    assert cf.Mesh.load("cross.stl").watertight


def test_the_stub_names_what_the_module_has():
    tree = ast.parse((pathlib.Path(cf.__file__).parent / "__init__.pyi").read_text())
    for item in tree.body:
        if isinstance(item, ast.FunctionDef):
            assert hasattr(cf, item.name)
        if isinstance(item, ast.ClassDef):
            members = {f.name for f in item.body if isinstance(f, ast.FunctionDef)}
            public = {m for m in vars(getattr(cf, item.name)) if not m.startswith("_")}
            if "__len__" in members:
                members.remove("__len__")
            assert members - {"__init__"} == public, item.name
    named = {i.name for i in tree.body if isinstance(i, (ast.FunctionDef, ast.ClassDef))}
    assert named == set(cf.__all__) - {"__version__"}
