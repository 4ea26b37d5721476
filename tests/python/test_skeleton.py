import gc

import networkx
import numpy as np
import pytest

import curvefusion as cf


def same(a, b):
    """Whether two graphs hold the same bits."""
    def values(edge):
        return [edge.points, edge.radii, edge.observations]

    return (
        np.array_equal(a.nodes, b.nodes)
        and [edge.nodes for edge in a.edges] == [edge.nodes for edge in b.edges]
        and all(
            (x is None and y is None) or np.array_equal(x, y)
            for e, f in zip(a.edges, b.edges)
            for x, y in zip(values(e), values(f))
        )
    )


def test_what_was_given_comes_back(y_graph):
    assert y_graph.nodes.shape == (4, 3)
    first, _, last = y_graph.edges
    assert first.nodes == (0, 1)
    np.testing.assert_array_equal(first.points, [[0, 0, 0], [0.05, 0, 0], [0.1, 0, 0]])
    np.testing.assert_array_equal(first.radii, [0.002] * 3)
    assert last.radii is None and last.observations is None
    assert y_graph.length == pytest.approx(0.3)
    assert y_graph.validate() == []
    assert repr(y_graph) == "<SkeletonGraph of 4 nodes, 3 edges, 0.300 m>"


def test_arrays_outlive_the_graph(y_graph):
    graph = y_graph.smooth()
    points = graph.edges[0].points
    expected = points.copy()
    del graph
    gc.collect()
    waste = [np.full((len(points), 3), 7.0) for _ in range(1000)]
    np.testing.assert_array_equal(points, expected)
    assert len(waste) == 1000


def test_arrays_of_a_graph_are_not_writable_and_not_copied(y_graph):
    edge = y_graph.edges[0]
    assert np.shares_memory(edge.points, y_graph.edges[0].points)
    with pytest.raises(ValueError):
        edge.points[0, 0] = 1
    with pytest.raises(ValueError):
        edge.radii[0] = 1


@pytest.mark.parametrize("name", ["graph.json", "graph.graphml"])
def test_files_keep_every_bit(y_graph, tmp_path, name):
    losses = y_graph.save(tmp_path / name)
    assert losses == []
    assert same(cf.SkeletonGraph.load(str(tmp_path / name)), y_graph)


def test_files_tell_what_they_lose(y_graph, tmp_path):
    assert y_graph.save(tmp_path / "graph.obj")
    assert cf.SkeletonGraph.load(tmp_path / "graph.obj").length == pytest.approx(0.3)
    with pytest.raises(cf.UsageError, match="stl"):
        y_graph.save(tmp_path / "graph.stl")
    with pytest.raises(cf.BadInputError, match="missing.json"):
        cf.SkeletonGraph.load(tmp_path / "missing.json")
    with pytest.raises(cf.ResourceError, match="nowhere"):
        y_graph.save(tmp_path / "nowhere" / "graph.json")


ORIGIN, TIP = [0.0, 0, 0], [0.0, 0, 1]


@pytest.mark.parametrize(
    "edge, message",
    [
        (lambda: cf.Edge((0, 2), [ORIGIN, TIP]), "no node 2"),
        (lambda: cf.Edge((0, -1), [ORIGIN, TIP]), "no node -1"),
        (lambda: cf.Edge((0, 1), [ORIGIN]), "points"),
        (lambda: cf.Edge((0, 1), [TIP, ORIGIN]), "node"),
        (lambda: cf.Edge((0, 1), [ORIGIN, ORIGIN, TIP]), r"points\[1\] repeats"),
        (lambda: cf.Edge((0, 1), [ORIGIN, [0, np.nan, 0], TIP]), r"points\[1\]"),
        (lambda: cf.Edge((0, 1), [ORIGIN, TIP], radii=-1), "radii"),
        (lambda: cf.Edge((0, 1), [ORIGIN, TIP], observations=[1, -2]), "observations"),
    ],
)
def test_edges_that_cannot_be(edge, message):
    with pytest.raises(cf.BadInputError, match=message):
        cf.SkeletonGraph([ORIGIN, TIP], [edge()])


def test_shapes_that_cannot_be():
    with pytest.raises(cf.UsageError, match=r"points: has shape \(2, 2\)"):
        cf.Edge((0, 1), np.zeros((2, 2)))
    with pytest.raises(cf.UsageError, match="radii: needs one value for each of 2"):
        cf.Edge((0, 1), [ORIGIN, TIP], radii=[1, 2, 3])
    with pytest.raises(cf.UsageError, match="nodes"):
        cf.SkeletonGraph(np.zeros(3), [])
    with pytest.raises(cf.BadInputError):
        cf.SkeletonGraph([[np.inf, 0, 0]], [])
    with pytest.raises(TypeError, match="edges"):
        cf.SkeletonGraph([ORIGIN, TIP], [None])
    with pytest.raises(cf.UsageError, match="proximity"):
        cf.SkeletonGraph([], []).validate(-1)


def test_crossing_curves_meet_in_a_junction():
    nodes = np.array([[-1, 0, 0], [1, 0, 0], [0, -1, 0.0005], [0, 1, 0.0005]])
    edges = [cf.Edge((a, b), nodes[[a, b]], 0.002) for a, b in ((0, 1), (2, 3))]
    cross = cf.SkeletonGraph(nodes, edges)
    assert len(cross.validate(0.001)) == 1
    resolved = cross.resolve(0.001)
    assert len(cross.edges) == 2  # as it was
    assert len(resolved.edges) == 4 and len(resolved.nodes) == 5
    assert resolved.validate(0.001) == []
    assert same(resolved.resolve(0.001), resolved)


def test_networkx_and_back(y_graph):
    graph = y_graph.to_networkx()
    assert sorted(degree for _, degree in graph.degree) == [1, 1, 1, 3]
    lengths = [data["length"] for _, _, data in graph.edges(data=True)]
    assert sum(lengths) == pytest.approx(0.3)
    assert same(cf.SkeletonGraph.from_networkx(graph), y_graph)


def test_networkx_keeps_loops_parallel_edges_and_directions():
    nodes = [[0.0, 0, 0], [1.0, 0, 0]]
    edges = [
        cf.Edge((1, 0), [nodes[1], [0.5, 1, 0], nodes[0]]),
        cf.Edge((0, 1), [nodes[0], nodes[1]], observations=[3, 4]),
        cf.Edge((0, 0), [nodes[0], [0, 1, 0], [-1, 0, 0], nodes[0]]),
    ]
    given = cf.SkeletonGraph(nodes, edges)
    graph = cf.SkeletonGraph.from_networkx(given.to_networkx())
    key = lambda edge: edge.points.tolist()
    assert sorted(map(key, graph.edges)) == sorted(map(key, given.edges))
    for edge in graph.edges:
        np.testing.assert_array_equal(edge.points[[0, -1]], graph.nodes[list(edge.nodes)])
    relabelled = networkx.relabel_nodes(given.to_networkx(), {0: "a", 1: "b"})
    assert len(cf.SkeletonGraph.from_networkx(relabelled).edges) == 3


def test_networkx_reads_our_graphml(y_graph, tmp_path):
    y_graph.save(tmp_path / "graph.graphml")
    graph = networkx.read_graphml(tmp_path / "graph.graphml", force_multigraph=True)
    positions = [[data[axis] for axis in "xyz"] for _, data in graph.nodes(data=True)]
    np.testing.assert_array_equal(positions, y_graph.nodes)
    curves = [data["points"].split() for _, _, data in graph.edges(data=True)]
    found = sorted(tuple(map(float, curve)) for curve in curves)
    assert found == sorted(tuple(edge.points.ravel()) for edge in y_graph.edges)
    assert sorted(degree for _, degree in graph.degree) == [1, 1, 1, 3]


def test_graphml_of_networkx_is_read(tmp_path):
    graph = networkx.Graph()
    positions = [[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [1.0, 2.0, 0.25]]
    for name, position in zip("abc", positions):
        graph.add_node(name, **dict(zip("xyz", position)))
    graph.add_edge("a", "b", radius=0.002)
    graph.add_edge("b", "c", colour="red")
    networkx.write_graphml(graph, tmp_path / "graph.graphml")
    read = cf.SkeletonGraph.load(tmp_path / "graph.graphml")
    np.testing.assert_array_equal(read.nodes, positions)
    assert [edge.nodes for edge in read.edges] == [(0, 1), (1, 2)]
    np.testing.assert_array_equal(read.edges[0].radii, [0.002, 0.002])
    assert read.edges[1].radii is None


def test_contraction_of_a_wire():
    random = np.random.default_rng(1)
    angle = random.uniform(0, 2 * np.pi, 3000)
    along = random.uniform(0, 0.3, 3000)
    cloud = np.column_stack([along, 0.0025 * np.cos(angle), 0.0025 * np.sin(angle)])
    for method in ("auto", "ridge", "l1"):
        curves = cf.contract(cloud, radius=0.0025, method=method)
        assert len(curves.edges) == 1, method
        # Ends may fall short by a neighbourhood.
        assert curves.length == pytest.approx(0.3, abs=0.03), method
        points = curves.edges[0].points
        # The axis of points spread evenly; their random imbalance is far below this.
        assert np.abs(points[5:-5, 1:]).max() < 0.0012, method
        assert (curves.edges[0].radii == 0.0025).all()


def test_contraction_moves_points_along_rays():
    random = np.random.default_rng(1)
    along = random.uniform(0, 0.3, 3000)
    cloud = np.column_stack([along, 0.0002 * random.normal(size=(3000, 2))])
    rays = np.tile([0.0, 0, 2], (3000, 1))  # any length
    curves = cf.contract(cloud, radius=0.004, rays=rays)
    # CurveFusion's points lie pi / 4 radii before the axis.
    assert np.median(curves.edges[0].points[:, 2]) == pytest.approx(np.pi / 4 * 0.004, abs=2e-4)
    with pytest.raises(cf.UsageError, match="rays: 2 for 3000"):
        cf.contract(cloud, rays=rays[:2])


def test_clouds_that_cannot_be():
    assert cf.contract(np.zeros((0, 3))).edges == []
    with pytest.raises(cf.BadInputError):
        cf.contract([[0, 0, np.nan]])
    with pytest.raises(cf.UsageError, match="rigde"):
        cf.contract(np.zeros((9, 3)), method="rigde")
    with pytest.raises(cf.UsageError, match=r"\(N, 3\)"):
        cf.contract(np.zeros((9, 2)))
