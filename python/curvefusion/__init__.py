"""Curve skeletons and watertight tube meshes of thin structures from RGB-D scans.

Lengths are in metres, angles in radians, times in seconds.
"""

import numpy as np

from ._curvefusion import (
    BadInputError,
    Camera,
    Edge,
    Error,
    Mesh,
    ResourceError,
    Result,
    Sequence,
    SkeletonGraph,
    UsageError,
    __version__,
    check,
    contract,
    evaluate,
    mesh,
    read_sequence,
    reconstruct,
)

__all__ = [
    "BadInputError",
    "Camera",
    "Edge",
    "Error",
    "Mesh",
    "ResourceError",
    "Result",
    "Sequence",
    "SkeletonGraph",
    "UsageError",
    "__version__",
    "check",
    "contract",
    "evaluate",
    "mesh",
    "read_sequence",
    "reconstruct",
]


def _to_networkx(self):
    """Copy the graph into NetworkX.

    Returns
    -------
    networkx.MultiGraph
        Nodes 0 to N - 1 with `position`, (3,) in metres; edges with `points`, `radii`
        and `observations` as an Edge has them, and `length` in metres.

    Raises
    ------
    ImportError
        NetworkX is not installed.
    """
    import networkx

    graph = networkx.MultiGraph()
    for index, position in enumerate(self.nodes):
        graph.add_node(index, position=position)
    for edge in self.edges:
        graph.add_edge(
            *edge.nodes,
            points=edge.points,
            radii=edge.radii,
            observations=edge.observations,
            length=edge.length,
        )
    return graph


def _from_networkx(graph):
    """Make a graph of one of NetworkX.

    Parameters
    ----------
    graph : networkx.Graph or networkx.MultiGraph
        With the attributes of `to_networkx`; `radii` and `observations` may be missing.

    Returns
    -------
    SkeletonGraph
        Its nodes are in the order of those of `graph`.

    Raises
    ------
    KeyError
        A node without `position` or an edge without `points`.
    BadInputError
        As for SkeletonGraph.
    """
    index = {node: i for i, node in enumerate(graph.nodes)}
    nodes = np.array([graph.nodes[node]["position"] for node in graph.nodes], float)
    edges = []
    for first, second, data in graph.edges(data=True):
        points = np.asarray(data["points"], float)
        # An undirected edge does not tell at which of its nodes the points begin.
        ends = (index[first], index[second])
        if len(points) and not np.array_equal(points[0], nodes[ends[0]]):
            ends = ends[::-1]
        edges.append(Edge(ends, points, data.get("radii"), data.get("observations")))
    return SkeletonGraph(nodes.reshape(-1, 3), edges)


def _to_trimesh(self):
    """Copy the mesh into trimesh.

    Returns
    -------
    trimesh.Trimesh

    Raises
    ------
    ImportError
        trimesh is not installed.
    """
    import trimesh

    return trimesh.Trimesh(vertices=self.vertices, faces=self.faces, process=False)


SkeletonGraph.to_networkx = _to_networkx
SkeletonGraph.from_networkx = staticmethod(_from_networkx)
Mesh.to_trimesh = _to_trimesh
