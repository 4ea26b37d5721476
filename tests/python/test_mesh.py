import gc
import sys
import types

import numpy as np
import pytest

import curvefusion as cf


def volume(mesh):
    a, b, c = mesh.vertices[mesh.faces].astype(float).transpose(1, 0, 2)
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6


def test_tubes_are_closed_and_of_the_right_volume(y_graph):
    tubes = cf.mesh(y_graph, radius=0.002, sides=64)
    assert tubes.watertight
    report = tubes.check()
    assert report["genus"] == 0 and report["components"] == 1 and report["defects"] == ""
    assert report["vertices"] == len(tubes.vertices) and report["faces"] == len(tubes.faces)
    assert volume(tubes) == pytest.approx(report["volume"], rel=1e-4)  # float32 corners
    # Three cylinders and the rounded ends, less what overlaps in the middle.
    assert volume(tubes) == pytest.approx(3 * np.pi * 0.002**2 * 0.1, rel=0.03)


def test_unknown_radii_are_assumed_and_told(y_graph):
    assert "1 of 3 curves is unknown" in cf.mesh(y_graph).warnings[0]
    assert cf.mesh(y_graph, radius=0.002).warnings == []


def test_arrays_outlive_the_mesh(y_graph):
    tubes = cf.mesh(y_graph)
    vertices, faces = tubes.vertices, tubes.faces
    assert vertices.dtype == np.float32 and faces.dtype == np.int32
    assert np.shares_memory(vertices, tubes.vertices) and not vertices.flags.writeable
    expected = vertices.copy(), faces.copy()
    del tubes
    gc.collect()
    np.testing.assert_array_equal(vertices, expected[0])
    np.testing.assert_array_equal(faces, expected[1])


@pytest.mark.parametrize("name", ["m.ply", "m.obj", "m.stl", "m.glb", "m.3mf"])
def test_every_format_is_read_back(y_graph, tmp_path, name):
    tubes = cf.mesh(y_graph)
    tubes.save(tmp_path / name)
    again = cf.Mesh.load(tmp_path / name)
    assert again.watertight
    scale = 1000 if name == "m.3mf" else 1
    # Coordinates are float32.
    np.testing.assert_allclose(
        np.ptp(again.vertices, axis=0), scale * np.ptp(tubes.vertices, axis=0), rtol=1e-6
    )


def test_files_that_cannot_be(y_graph, tmp_path):
    tubes = cf.mesh(y_graph)
    with pytest.raises(cf.UsageError):
        tubes.save(tmp_path / "m.dxf")
    with pytest.raises(cf.UsageError, match="inch"):
        tubes.save(tmp_path / "m.ply", unit="inch")
    with pytest.raises(cf.BadInputError, match="missing"):
        cf.Mesh.load(tmp_path / "missing.ply")
    assert list(tmp_path.iterdir()) == []


def test_a_mesh_with_a_hole_is_not_watertight(tmp_path):
    (tmp_path / "m.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    triangle = cf.Mesh.load(tmp_path / "m.obj")
    assert not triangle.watertight
    assert triangle.check()["boundary_edges"] == 3
    with pytest.raises(cf.BadInputError):
        triangle.save(tmp_path / "again.ply")


def test_arguments_that_cannot_be(y_graph):
    with pytest.raises(cf.UsageError, match="sides: 3 is not within 8 and 64"):
        cf.mesh(y_graph, sides=3)
    with pytest.raises(cf.UsageError, match="radius"):
        cf.mesh(y_graph, radius=0)
    with pytest.raises(cf.UsageError, match="corner"):
        cf.mesh(y_graph, radius_from="corner")


def test_nothing_has_an_empty_mesh():
    tubes = cf.mesh(cf.SkeletonGraph([], []))
    assert tubes.vertices.shape == (0, 3) and tubes.faces.shape == (0, 3)


def test_trimesh_gets_the_arrays(y_graph, monkeypatch):
    # trimesh is no package of Debian 12: what it would be given is looked at.
    trimesh = types.SimpleNamespace(Trimesh=lambda **arguments: arguments)
    monkeypatch.setitem(sys.modules, "trimesh", trimesh)
    tubes = cf.mesh(y_graph)
    given = tubes.to_trimesh()
    np.testing.assert_array_equal(given["vertices"], tubes.vertices)
    np.testing.assert_array_equal(given["faces"], tubes.faces)
    assert given["process"] is False
