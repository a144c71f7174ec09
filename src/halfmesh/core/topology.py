"""The columns: everything that is stored of a mesh's connectivity, and their growth.

====================  ==========  ===========================================================================
column                one per     holds
====================  ==========  ===========================================================================
``next``, ``prev``    halfedge    the halfedge after and before, around the same face or the same boundary loop
``origin``            halfedge    the vertex it leaves
``face``              halfedge    the face on its left; -1 outside
``vertex_halfedge``   vertex      a halfedge that leaves it, an exterior one if there is any; -1 if isolated
``face_halfedge``     face        a halfedge of it
====================  ==========  ===========================================================================

All are int32. An edge `e` *is* the pair of halfedges ``2e`` and ``2e + 1``, so that twin and edge are arithmetic and
cannot be wrong. Columns may be longer than what is in use; the ``counts`` say how much is.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh import _jit
from halfmesh.core.epochs import COMPACTED, ROLLED_BACK, Limits, close, hand_over

__all__ = [
    "COLUMNS",
    "DELETED",
    "EDGE_SLOTS",
    "FACE_SLOTS",
    "FEW",
    "HAS_NOTES",
    "JOURNALING",
    "JOURNAL_SIZE",
    "LIMIT",
    "NEWS",
    "NOTES_SIZE",
    "NOTING",
    "N_DEAD_EDGES",
    "N_DEAD_FACES",
    "N_DEAD_VERTICES",
    "N_EXTERIOR",
    "REPLACED",
    "REVISION",
    "VERTEX_SLOTS",
    "Arrays",
    "Topology",
    "empty_columns",
    "topology_at",
]

Ints = NDArray[np.int32]

LIMIT = 2**31 - 2  # elements of a kind: indices are int32
DELETED = -4  # in all columns of a deleted element; like no -1 ("none"), nor the ccw of a mark: -4 ^ 1 is -3

# places in `counts`
VERTEX_SLOTS, EDGE_SLOTS, FACE_SLOTS = 0, 1, 2  # slots in use, deleted elements included
N_DEAD_VERTICES, N_DEAD_EDGES, N_DEAD_FACES = 3, 4, 5
N_EXTERIOR = 6  # living halfedges without a face
REVISION = 7  # raised by every topological change
NEWS = 8  # what Python must look at when a kernel returns: REPLACED, HAS_NOTES, or both
JOURNALING, JOURNAL_SIZE = 9, 10  # whether every write is journaled, for a transaction, and the entries so far
NOTING, NOTES_SIZE = 11, 12  # the kinds of element whose attributes follow by notes, and the ints noted so far
N_COUNTS = 13

REPLACED, HAS_NOTES = 1, 2  # a column was replaced by a larger one; there are notes

COLUMNS = ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge", "counts")
SCRATCH = ("journal", "notes", "weights", "room")  # see `journal` and `notes`; room for a few ints of an operator
FIELDS = COLUMNS + SCRATCH
FEW = 16  # corners of a face for which there is room twice
_ROOM_FOR_JOURNAL = 2**17  # ints that are kept for the next transaction: 1 MB
_CARRIER = _jit.declare_carrier("Topology", FIELDS)
topology_at = _CARRIER.at(*[("i4", 1)] * 6, ("i8", 1), ("i8", 1), ("i4", 1), ("f8", 1), ("i8", 1))


class Arrays:
    """The columns as NumPy arrays, at their full capacity: what the vectorised gear reads and the builders write."""

    __slots__ = FIELDS

    next: Ints
    prev: Ints
    origin: Ints
    face: Ints
    vertex_halfedge: Ints
    face_halfedge: Ints
    counts: NDArray[np.int64]
    journal: NDArray[np.int64]
    notes: Ints
    weights: NDArray[np.float64]
    room: NDArray[np.int64]

    @property
    def nbytes(self) -> int:
        """Bytes that are held, room for growth and journal included."""
        return sum(getattr(self, name).nbytes for name in FIELDS)

    def __init__(self) -> None:
        self.journal, self.notes, self.weights = np.zeros(2, np.int64), np.zeros(2, np.int32), np.zeros(2)
        self.room = np.zeros(2 * FEW, np.int64)


class Topology:
    """The connectivity of a mesh, as the read-only arrays of the table above; kernels take it as ``t``.

    The arrays are views without a copy. They are stale after the mesh has grown: take them afresh.
    """

    __slots__ = ("_arrays", "_views", "lowered", "owner")

    def __init__(self, arrays: Arrays) -> None:
        self._views = _jit.Views()
        self.lowered: Any = None  # the compiled form, once it was asked for
        self.owner: Any = None  # gives the mesh whose attributes follow the changes, if there is one
        self._adopt(arrays)

    def _adopt(self, arrays: Arrays) -> None:
        self._arrays = arrays
        for name in FIELDS:
            setattr(self._views, name, _jit.view(getattr(arrays, name)))

    def _replace(self, arrays: Arrays) -> None:
        """Take other columns, in which elements have other indices: the old carrier is left to the old handles."""
        self._close(COMPACTED)
        arrays.counts[[NEWS, JOURNAL_SIZE]] = 0
        self._adopt(arrays)

    def _close(self, why: str) -> None:
        close(self._views, FIELDS, why)
        self._views, self.lowered = _jit.Views(), None

    def take_edges_and_faces(self, made: Arrays) -> None:
        """Take the columns of a mesh that was built over the vertices that are there, where no edge was yet."""
        counts = self._arrays.counts
        counts[[EDGE_SLOTS, FACE_SLOTS, N_EXTERIOR]] = made.counts[[EDGE_SLOTS, FACE_SLOTS, N_EXTERIOR]]
        counts[REVISION] += 1
        for name in ("counts", *SCRATCH):
            setattr(made, name, getattr(self._arrays, name))
        self.lowered = None
        self._adopt(made)

    def make_room(self, n_edges: int, n_faces: int) -> None:
        """Take columns with room for so many more, as `slots.reserve` does, but copied by all threads."""
        old, counts = self._arrays, self._arrays.counts
        names: list[str] = []
        sizes: list[tuple[int, int]] = []
        for some, used, more in (
            (("next", "prev", "origin", "face"), 2 * int(counts[EDGE_SLOTS]), 2 * n_edges),
            (("face_halfedge",), int(counts[FACE_SLOTS]), n_faces),
        ):
            if used + more > len(getattr(old, some[0])):
                names += some
                sizes += [(used, used + max(more, used // 2))] * len(some)
        arrays = Arrays()
        for name in FIELDS:
            setattr(arrays, name, getattr(old, name))
        jobs = [(getattr(old, name), *size) for name, size in zip(names, sizes, strict=True)]
        for name, column in zip(names, _jit.parallel(_enlarged, jobs), strict=True):
            setattr(arrays, name, column)
        self.lowered = None
        self._adopt(arrays)

    # -- transactions --------------------------------------------------------------------------------------------

    def put_back(self, arrays: Arrays, views: Any, limits: Limits) -> None:
        """Take the columns of before, and let the handles of that time go on as far as their elements are there.

        `arrays` and `views` are those that were in use before the first compaction since, or still are.
        """
        compiled = self.lowered if arrays is self._arrays else None
        close(views, FIELDS, ROLLED_BACK)
        self._close(ROLLED_BACK)
        self.lowered = compiled
        self._adopt(arrays)
        hand_over(views, self._views, limits)

    def end_journal(self) -> None:
        """Journal no more; what was written stays."""
        counts = self._arrays.counts
        counts[[JOURNALING, JOURNAL_SIZE]] = 0
        if len(self._arrays.journal) > _ROOM_FOR_JOURNAL:
            self._arrays.journal = np.zeros(2, np.int64)
            self._views.journal = _jit.view(self._arrays.journal)  # type: ignore[attr-defined]
            self.lowered = None

    # -- the columns in use --------------------------------------------------------------------------------------

    @property
    def next(self) -> Ints:
        """The halfedge after each, around its face or boundary loop."""
        return self._read_only("next", 2 * self._slots(EDGE_SLOTS))

    @property
    def prev(self) -> Ints:
        """The halfedge before each."""
        return self._read_only("prev", 2 * self._slots(EDGE_SLOTS))

    @property
    def origin(self) -> Ints:
        """The vertex that each halfedge leaves."""
        return self._read_only("origin", 2 * self._slots(EDGE_SLOTS))

    @property
    def face(self) -> Ints:
        """The face of each halfedge, -1 outside."""
        return self._read_only("face", 2 * self._slots(EDGE_SLOTS))

    @property
    def vertex_halfedge(self) -> Ints:
        """A halfedge that leaves each vertex, an exterior one if there is any; -1 if isolated."""
        return self._read_only("vertex_halfedge", self._slots(VERTEX_SLOTS))

    @property
    def face_halfedge(self) -> Ints:
        """A halfedge of each face."""
        return self._read_only("face_halfedge", self._slots(FACE_SLOTS))

    @property
    def nbytes(self) -> int:
        """Bytes of the columns in use: 16 a halfedge, 4 a vertex, 4 a face."""
        return sum(getattr(self, name).nbytes for name in COLUMNS[:-1])

    @property
    def capacity_nbytes(self) -> int:
        """Bytes that are held, the room for growth included."""
        return sum(getattr(self._arrays, name).nbytes for name in COLUMNS)

    def _slots(self, place: int) -> int:
        return self._views.counts[place]  # type: ignore[attr-defined,no-any-return]

    def _read_only(self, name: str, size: int) -> Ints:
        column: Ints = getattr(self._arrays, name)[:size]
        column.flags.writeable = False
        return column

    def copy(self) -> Topology:
        """A copy with no spare room. Complexity: O(n)."""
        arrays = Arrays()
        for name in COLUMNS[:-1]:
            setattr(arrays, name, _with_room(getattr(self, name).copy()))
        arrays.counts = self._arrays.counts.copy()
        arrays.counts[NEWS:] = 0  # a copy is in no transaction
        return Topology(arrays)

    def __getstate__(self) -> dict[str, Any]:
        return {name: np.array(getattr(self, name, self._arrays.counts)) for name in COLUMNS}

    def __setstate__(self, state: dict[str, Any]) -> None:
        arrays = Arrays()
        for name in COLUMNS:
            setattr(arrays, name, _with_room(state[name]))
        arrays.counts[NEWS:] = 0
        self.__init__(arrays)  # type: ignore[misc]

    def __repr__(self) -> str:
        v, e, f = (self._slots(place) for place in (VERTEX_SLOTS, EDGE_SLOTS, FACE_SLOTS))
        return f"<Topology: {v} vertices, {e} edges, {f} faces>"

    # -- a carrier -----------------------------------------------------------------------------------------------

    def __views__(self) -> Any:
        return self._views

    def __arrays__(self) -> Arrays:
        return self._arrays

    def __compiled__(self) -> Any:
        if self.lowered is None:
            self.lowered = _CARRIER.make(*(getattr(self._arrays, name) for name in FIELDS))
        return self.lowered

    def __announce__(self, args: tuple[Any, ...]) -> None:
        if self._slots(NEWS):
            self.catch_up_late()
        mesh = self.owner and self.owner()
        if mesh is not None:
            mesh._announce(args)

    def __refresh__(self, args: tuple[Any, ...], compiled: bool) -> None:
        if self._slots(NEWS) and (self.lowered is not None or not compiled):
            self.catch_up(compiled)
        mesh = self.owner and self.owner()
        if mesh is not None:
            mesh._follow(args)

    def catch_up_late(self) -> None:
        """Catch up with a compiled kernel that has raised, after which nobody did."""
        if self.lowered is not None:
            self.catch_up(compiled=True)

    def catch_up(self, compiled: bool) -> None:
        """Take the columns anew from the gear that has replaced some of them by larger ones."""
        if self._slots(NEWS) & REPLACED == 0:
            return
        arrays = Arrays()
        if compiled:
            columns = _CARRIER.take(self.lowered)
        else:
            columns = tuple(_jit.array_of(getattr(self._views, name)) for name in FIELDS)
            self.lowered = None
        for name, column in zip(FIELDS, columns, strict=True):
            setattr(arrays, name, column)
        self._adopt(arrays)
        arrays.counts[NEWS] &= ~REPLACED


def empty_columns(n_vertices: int, n_edges: int, n_faces: int, room: Any = None) -> Arrays:
    """Columns of these sizes with their counts set and their contents not.

    Those of halfedges lie in `room`, an array of int32, if they fit.
    """
    arrays = Arrays()
    size = max(2 * n_edges, 2)
    if room is None or len(room) < 4 * size:
        room = np.empty(4 * size, dtype=np.int32)
    for i, name in enumerate(("next", "prev", "origin", "face")):
        setattr(arrays, name, room[i * size : (i + 1) * size])
    arrays.vertex_halfedge = np.empty(max(n_vertices, 1), dtype=np.int32)
    arrays.face_halfedge = np.empty(max(n_faces, 1), dtype=np.int32)
    arrays.counts = np.zeros(N_COUNTS, dtype=np.int64)
    arrays.counts[:3] = n_vertices, n_edges, n_faces
    if n_edges == 0:  # rules that are branch-free may look at halfedge 0
        arrays.next[:] = arrays.prev[:] = arrays.origin[:] = arrays.face[:] = -1
    return arrays


def _enlarged(column: Ints, used: int, n: int) -> Ints:
    made = np.empty(n, dtype=np.int32)
    made[:used] = column[:used]
    return made


def _with_room(column: NDArray[Any]) -> NDArray[Any]:
    """A column is never empty: the branch-free rules may look at its first element."""
    return column if len(column) else np.full(2, -1, dtype=column.dtype)
