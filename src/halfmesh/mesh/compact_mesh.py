"""The mesh in a fiftieth of the memory."""

from __future__ import annotations

import os
import time
from typing import Any

import numpy as np

from halfmesh.compact.decoding import decoded
from halfmesh.compact.encoding import compacted, maps_of
from halfmesh.compact.files import read, write
from halfmesh.core.compaction import Maps
from halfmesh.core.topology import Topology
from halfmesh.errors import FormatError
from halfmesh.mesh.mesh import Mesh
from halfmesh.mesh.readonly import ReadOnlyMesh, refuse_others

__all__ = ["CompactMesh"]


class CompactMesh(ReadOnlyMesh):
    """A mesh whose connectivity takes less than five bits an edge, a fiftieth of what can be edited takes.

    It answers in the same words as :class:`Mesh`, in kernels and through handles, and can't be changed. Elements have
    other numbers: vertices are counted along a spanning tree, and points and maps go with them.

    Parameters
    ----------
    mesh : Mesh
        Each of its components must be such that it can be drawn on a sphere when its holes are capped (genus 0):
        plane domains with holes, closed surfaces of genus 0, wire, slits, loop and parallel edges, faces of any
        degree. Points are copied; other attributes stay behind.
    maps : bool
        Keep, as ``.maps``, the new index of every old element. They take 4 bytes each, twenty times the mesh itself.

    Attributes
    ----------
    vertex_data, halfedge_data, edge_data, face_data : AttributeTable
        Named arrays on the elements.
    maps : Maps or None
        ``.vertices``, ``.halfedges``, ``.edges``, ``.faces``: arrays of int32, -1 for what was deleted.
    has_points : bool
        Whether the mesh had points.
    build_seconds : float
        How long the encoding took.

    Raises
    ------
    ElementError
        It is not a `Mesh`.
    PreconditionError
        A component has genus; it says which, and how much.

    Notes
    -----
    O(n) to make, with 4 bytes a vertex and four bits an edge beside the result. A step takes a search among
    parentheses: some hundred nanoseconds, a few where it is near. Two of three steps along ``next`` and around
    vertices need one search at most, a third of them none. An isolated vertex takes nothing, a further component or
    hole 4 bytes, a boundary vertex 8 where it is not the first of its loop. See the internals in the documentation.

    References
    ----------
    G. Turan, "On the succinct representation of graphs", Discrete Applied Mathematics 8 (1984). L. Ferres, J.
    Fuentes-Sepulveda, T. Gagie, M. He, G. Navarro, "Fast and compact planar embeddings", Computational Geometry 89
    (2020).

    Examples
    --------
    >>> import halfmesh as hm
    >>> mesh = hm.shapes.icosphere(5)
    >>> small = hm.CompactMesh(mesh)
    >>> small
    <CompactMesh: 10242 vertices, 30720 edges, 20480 faces, closed>
    >>> mesh.topology.nbytes // small.topology_nbytes > 50
    True
    >>> small.vertices[0].degree, small.faces[5].degree
    (5, 3)
    >>> round(hm.geometry.area(small), 6) == round(hm.geometry.area(mesh), 6)
    True
    """

    maps: Maps | None

    def __init__(self, mesh: Mesh, *, maps: bool = False) -> None:
        refuse_others(mesh, "CompactMesh")
        started = time.perf_counter()
        encoded = compacted(mesh.topology)
        self._hold(encoded.topology, mesh.points[encoded.vertices], mesh.has_points)
        self.maps = maps_of(mesh.topology, encoded) if maps else None
        self.build_seconds = time.perf_counter() - started

    @property
    def bits_per_edge(self) -> float:
        """What the connectivity takes, everything included, by edges; the two trees alone take 4."""
        return 8 * self.topology_nbytes / max(1, self.n_edges)

    def _expanded(self) -> Topology:
        return decoded(self._topology)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the compact form with its points, to be mapped by `load`.

        Parameters
        ----------
        path : path-like
            Any name, usually with the suffix ``.hmc``. The file is there whole or not at all.

        Raises
        ------
        OSError
            Whatever the system says.

        Examples
        --------
        >>> import halfmesh as hm, tempfile, os
        >>> path = os.path.join(tempfile.mkdtemp(), "cube.hmc")
        >>> hm.CompactMesh(hm.shapes.cube()).save(path)
        >>> hm.CompactMesh.load(path)
        <CompactMesh: 8 vertices, 12 edges, 6 faces, closed>
        """
        others = {"points": self.points} if self.has_points else {}
        write(path, self._topology, others)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> CompactMesh:
        """Map a file that `save` has written into memory. O(n), for a check of all that could lead astray.

        Parameters
        ----------
        path : path-like
            The file must stay as it is while the mesh is in use. Points can be written; that doesn't reach the file.

        Raises
        ------
        FormatError
            If it is not such a file, whole and undamaged.
        OSError
            Whatever the system says.
        """
        started = time.perf_counter()
        topology, others = read(path)
        n = topology.n_vertices
        points = others.get("points", np.zeros((n, 3)))
        if points.shape != (n, 3) or points.dtype != np.float64:
            raise FormatError(f"the points are {points.dtype} of {points.shape}, not {n} by 3", path=os.fspath(path))
        made = object.__new__(cls)
        made._hold(topology, points, "points" in others)
        made.maps, made.build_seconds = None, time.perf_counter() - started
        return made

    def __getstate__(self) -> dict[str, Any]:
        return super().__getstate__() | {"maps": self.maps}

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(state)
        self.maps = state["maps"]
