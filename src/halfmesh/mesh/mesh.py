"""The object you hold: connectivity, points and named attributes, with the questions they answer.

Nothing is computed here: rules and loops live in `core`, and every method is a few lines of delegation.
"""

from __future__ import annotations

import time
import weakref
from collections.abc import Callable
from copy import deepcopy
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from halfmesh.core import invariants
from halfmesh.core.construction import Defective, construct
from halfmesh.core.facelist import FaceList, as_corner_data, as_face_list, as_indices
from halfmesh.core.notes import CORNERS, EDGES, FACES, VERTICES
from halfmesh.core.topology import (
    EDGE_SLOTS,
    FACE_SLOTS,
    HAS_NOTES,
    NEWS,
    NOTES_SIZE,
    NOTING,
    VERTEX_SLOTS,
    Topology,
)
from halfmesh.core.wire import with_wire
from halfmesh.errors import InvalidMeshError
from halfmesh.mesh.attributes import AttributeTable, Column
from halfmesh.mesh.editing import Editable
from halfmesh.mesh.editing.base import TABLES
from halfmesh.mesh.positions import as_points
from halfmesh.mesh.transactions import Undoable

__all__ = ["Mesh"]

Ints = NDArray[np.int32]
Floats = NDArray[np.float64]
R = TypeVar("R")


class Mesh(Editable, Undoable):
    """A half-edge mesh of polygons of any degree, with wire and isolated vertices.

    Parameters
    ----------
    faces : (n, k) array_like of int, list of lists, or tuple (indices, offsets)
        The vertices of each face, counter-clockwise, counted from 0. Any integer dtype and memory order; ragged
        input as a tuple of two 1-D integer arrays. Nothing is merged, dropped or reordered: face `f` is row `f`.
    points : (n, 3) or (n, 2) array_like of float, optional
        Positions of the vertices, copied; 2-D points get z = 0. Zeros if not given.
    n_vertices : int, optional
        Number of vertices, where there are no points and some vertices are in no face.
    twins : array_like of int, optional
        For each corner, the corner whose halfedge runs along the same edge the other way, -1 at a boundary; in the
        shape of `faces`, or flat. Needed only where the vertices don't say it: parallel edges and loop edges.
    edges : (n, 2) array_like of int, optional
        Wire: edges without faces.

    Attributes
    ----------
    vertex_data, halfedge_data, edge_data, face_data : AttributeTable
        Named arrays on the elements.
    vertices, halfedges, edges, faces : Collection
        The elements as handles: iterate, ``len``, ``[index]``, ``in``.
    has_points : bool
        Whether points were given.
    meta : dict
        Notes that belong to no element, such as the names of an OBJ file's groups; kept by `copy`, `load` and `save`.
    build_seconds : float
        How long the construction took.

    Raises
    ------
    InvalidMeshError
        The faces can't be held. ``error.reason`` names the defect and ``error.elements`` all that have it.

    Notes
    -----
    O(corners + vertices) for any input. Held are faces that meet in a vertex only, faces that pass a vertex twice,
    slits, several components. Refused are an edge with three faces, faces that are not oriented alike, a vertex
    where a closed fan of faces meets anything else.

    Examples
    --------
    >>> import halfmesh as hm
    >>> mesh = hm.Mesh([[0, 1, 2, 3], [1, 4, 2]], points=[[0, 0], [1, 0], [1, 1], [0, 1], [2, 0.5]])
    >>> mesh
    <Mesh: 5 vertices, 6 edges, 2 faces, with boundary>
    >>> h = mesh.find_halfedge(1, 2)
    >>> h.face, h.twin.face, h.next.target
    (Face(0), Face(1), Vertex(3))
    >>> [v.index for v in mesh.vertices[1].neighbors()]
    [4, 2, 0]
    """

    def __init__(
        self,
        faces: Any,
        points: ArrayLike | None = None,
        *,
        n_vertices: int | None = None,
        twins: ArrayLike | None = None,
        edges: ArrayLike | None = None,
    ) -> None:
        started = time.perf_counter()
        _refuse_swapped(faces, points)
        positions = None if points is None else as_points(points)
        wire = None if edges is None else as_indices(edges, "edges", 2)
        face_list = as_face_list(faces, n_vertices, None if positions is None else len(positions), wire)
        topology = _topology(face_list, twins)
        if wire is not None and len(wire):
            topology = with_wire(topology, wire)
        self._hold(topology)
        self.has_points = positions is not None
        self.meta = {}
        if positions is None:
            positions = np.zeros((face_list.n_vertices, 3))
        self.vertex_data._keep("points", positions)
        self.build_seconds = time.perf_counter() - started

    def _hold(self, topology: Topology) -> None:
        self._topology = topology
        self._cache: dict[str, tuple[int, Any]] = {}
        self._savepoints = []
        self._desk = None
        self._numbers = None
        counts = topology.__views__().counts
        self.vertex_data = AttributeTable("vertex", lambda: counts[VERTEX_SLOTS], ("points",), _noted(counts, VERTICES))
        self.halfedge_data = AttributeTable("halfedge", lambda: 2 * counts[EDGE_SLOTS], (), _noted(counts, CORNERS))
        self.edge_data = AttributeTable("edge", lambda: counts[EDGE_SLOTS], (), _noted(counts, EDGES))
        self.face_data = AttributeTable("face", lambda: counts[FACE_SLOTS], (), _noted(counts, FACES))
        # Nothing that the mesh holds may hold the mesh: a cycle would keep its columns until the collector comes round.
        topology.owner = weakref.ref(self)
        self._look_again()

    # -- what is stored ------------------------------------------------------------------------------------------

    @property
    def points(self) -> Floats:
        """Positions of the vertices, shape (n, 3), float64: a view, writing into it moves vertices."""
        return self.vertex_data["points"]

    @points.setter
    def points(self, points: ArrayLike) -> None:
        self.vertex_data["points"] = as_points(points)
        self.has_points = True

    @property
    def topology(self) -> Topology:
        """The columns ``next prev origin face vertex_halfedge face_halfedge`` as read-only arrays, without a copy."""
        return self._topology

    # -- the whole -------------------------------------------------------------------------------------------------

    def check(self) -> None:
        """Check every law of a valid mesh. O(n).

        Raises
        ------
        InvalidMeshError
            Naming the law and the elements that break it.
        """
        invariants.check(self._topology)

    def copy(self) -> Mesh:
        """An independent copy with its attributes. O(n)."""
        made = object.__new__(type(self))
        made._hold(self._topology.copy())
        made.has_points, made.build_seconds, made.meta = self.has_points, self.build_seconds, deepcopy(self._meta)
        made._numbers = None if self._numbers is None else self._numbers.copy()
        for name in TABLES:
            getattr(made, name)._adopt(getattr(self, name)._columns_in_use())
        return made

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Mesh:
        return self.copy()

    def __getstate__(self) -> dict[str, Any]:
        state: dict[str, Any] = {name: getattr(self, name)._columns_in_use() for name in TABLES}
        state |= {"topology": self._topology, "meta": self._meta, "ids": self._numbers and self._numbers.copy()}
        return state | {name: getattr(self, name) for name in _REMARKS}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._hold(state["topology"])
        self.meta, self._numbers = state["meta"], state.get("ids")
        for name in _REMARKS:
            setattr(self, name, state[name])
        for name in TABLES:
            getattr(self, name)._adopt(state[name])

    # -- a carrier: kernels take a mesh as its topology --------------------------------------------------------------

    def _announce(self, args: tuple[Any, ...]) -> None:
        """Before a kernel: have it note what the attributes that are not among its arguments need to follow."""
        if any(isinstance(a, Column) for a in args):
            following = (getattr(self, name)._is_followed(args) for name in TABLES)
            self._t.counts[NOTING] = sum(1 << place for place, is_followed in enumerate(following) if is_followed)

    def _follow(self, args: tuple[Any, ...] = ()) -> None:
        """After a kernel: let those attributes follow its notes."""
        t = self._topology.__arrays__()
        failed = None
        if t.counts[NEWS] & HAS_NOTES:
            size = t.counts[NOTES_SIZE]
            t.counts[NOTES_SIZE] = 0  # whatever comes: no note is to be followed twice
            t.counts[NEWS] &= ~HAS_NOTES
            for place, name in enumerate(TABLES):
                try:
                    getattr(self, name)._replay(1 << place, t.notes[:size], t.weights[:size], args)
                except Exception as error:
                    failed = failed or error
        if any(isinstance(a, Column) for a in args):
            t.counts[NOTING] = sum(1 << place for place, name in enumerate(TABLES) if len(getattr(self, name)))
        if failed is not None:
            raise failed

    def __announce__(self, args: tuple[Any, ...]) -> None:
        self._topology.__announce__(args)

    def __refresh__(self, args: tuple[Any, ...], compiled: bool) -> None:
        self._topology.__refresh__(args, compiled)


def _noted(counts: Any, kind: int) -> Callable[[bool], None]:
    """Tells the operators whether there are attributes of a kind that follow by their notes."""

    def note(there_are: bool) -> None:
        counts[NOTING] = counts[NOTING] | kind if there_are else counts[NOTING] & ~kind

    return note


_REMARKS = ("has_points", "build_seconds")


def _topology(faces: FaceList, twins: ArrayLike | None) -> Topology:
    given = None if twins is None else as_corner_data(twins, "twins")
    if given is not None and len(given) != faces.n_corners:
        raise InvalidMeshError(f"twins has {len(given)} entries for {faces.n_corners} corners", reason="bad_twins")
    try:
        topology = construct(faces, given)
    except Defective:
        from halfmesh.core.diagnosis import explain, explain_twins  # 4 ms of an import, for what fails only

        raise (explain(faces) if given is None else explain_twins(faces, given)) from None
    except OverflowError as error:
        raise InvalidMeshError(str(error), reason="too_large") from None
    if given is not None and len(crowded := invariants.one_ring_holds_all_of_a_vertex(topology)):
        from halfmesh.core.diagnosis import explain_crowded

        raise explain_crowded(faces, crowded)
    return topology


def _refuse_swapped(faces: Any, points: Any) -> None:
    kinds = [array.dtype.kind for array in (faces, points) if isinstance(array, np.ndarray) and array.ndim == 2]
    if len(kinds) == 2 and kinds[0] == "f" and kinds[1] in "iu":
        raise InvalidMeshError(
            "faces are floats and points are integers; the order is Mesh(faces, points)", reason="bad_dtype"
        )
