"""The desk of a mesh: what compiled code must know of it, and of Python's objects, to be called without Python between.

`natives` are called as Python calls its built-in functions, with the addresses of handles, floats and lists. On the
desk lie the addresses of the compiled carriers of connectivity and points, of the classes of the handles, and at which
word of an object its slots are. It is *open* while the natives may act: the mesh is in no transaction, and the points
follow by linear interpolation. Otherwise, and for whatever they don't understand, they call the method in plain Python.

Nobody tells the desk when a carrier was replaced. It is seen by that the mesh no longer holds the very same object.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec, TypeVar, cast

import numpy as np

from halfmesh._jit import Native, Operation, Record, are_possible, slots_of
from halfmesh.core.slots import reserve
from halfmesh.core.topology import EDGE_SLOTS, FACE_SLOTS, VERTEX_SLOTS, Topology, topology_at
from halfmesh.errors import StaleElementError
from halfmesh.mesh.attributes import Column, positions_at
from halfmesh.mesh.elements import Edge, Face, Halfedge, Vertex

if TYPE_CHECKING:
    from halfmesh.mesh.editing.base import Base

P = ParamSpec("P")
R = TypeVar("R")
M = TypeVar("M", bound="Base")

__all__ = ["Desk", "natively", "offer"]

# Words of a record: the desk, the method to call otherwise, and which of its methods the native stands for.
DESK, BY_PYTHON, MODE = 0, 1, 2
ACT, TRY, ASK = 0, 1, 2  # if refused, call the method, which raises; answer that it was refused; only ask
TRIANGULAR = 3  # act, and join the vertex to the corners opposite

# Words of the desk: what is told of the mesh when the desk is opened ...
(
    TOPOLOGY,  # addresses of the compiled carriers
    POINTS,
    IS_ONLY,  # whether the points are the only attribute of vertices
    HAS_POINTS,
    CATCH_UP,  # what to call when there is news
    VIEWS,  # the carrier of the handles
    OF_TOPOLOGY,  # the objects that hold the carriers, and what they must hold still
    OF_POINTS,
    HELD_TOPOLOGY,
    HELD_POINTS,
    HELD_POLICY,
    N_TOLD,
) = range(12)
# ... and what is the same in the whole process: classes and objects, and places of words in objects.
(
    VERTEX,
    HALFEDGE,
    EDGE,
    FACE,
    INT,
    FLOAT,
    FLOAT64,
    LIST,
    TUPLE,
    ARRAY,
    DTYPE,
    NONE,
    NAME_AT,
    NAME_POINT,
    TYPE_PLACE,
    T_PLACE,
    INDEX_PLACE,
    LOWERED_PLACE,
    COLUMN_PLACE,
    POLICY_PLACE,
    X,  # room for the numbers of a call
    Y,
    Z,
    WEIGHT,
    N_WORDS,
) = range(N_TOLD, N_TOLD + 25)

# Words of an array, by NumPy's ABI.
ARRAY_DATA, ARRAY_N_DIMENSIONS, ARRAY_SHAPE, ARRAY_STRIDES, ARRAY_DTYPE = 2, 3, 4, 5, 7

_AT, _POINT = "at", "point"  # as keywords are: one object for all equal names
_DTYPE = np.dtype(np.float64)


@functools.cache
def _of_process() -> list[int] | None:
    """The words that are the same for all meshes; None where compiled code can't know what objects look like."""
    if not are_possible():
        return None
    try:
        places = _places()
    except LookupError:
        return None
    classes = (Vertex, Halfedge, Edge, Face, int, float, np.float64, list, tuple, np.ndarray)
    return [*map(id, (*classes, _DTYPE, None, _AT, _POINT)), *places, *[0] * 4]


def _places() -> tuple[int, ...]:
    handle: Any = object.__new__(Vertex)
    handle._t, handle.index = marks = object(), 2**40
    topology: Any = object.__new__(Topology)
    topology.lowered = marks[0]
    column: Any = object.__new__(Column)
    column.lowered, column.policy = marks
    in_handle = slots_of(handle, t=handle._t, index=handle.index)
    in_topology = slots_of(topology, lowered=marks[0])
    in_column = slots_of(column, lowered=marks[0], policy=marks[1])
    row = np.zeros((2, 3))[1]
    in_array = slots_of(row, dtype=row.dtype)
    if in_array != {"type": in_handle["type"], "dtype": ARRAY_DTYPE}:
        raise LookupError("arrays are laid out differently")
    return (
        in_handle["type"],
        in_handle["t"],
        in_handle["index"],
        in_topology["lowered"],
        in_column["lowered"],
        in_column["policy"],
    )


class Desk:
    """What the natives of one mesh find; it does not hold the mesh."""

    def __init__(self, words: list[int]) -> None:
        self.record = Record.of([0] * N_TOLD + words, ())
        self._held: tuple[Any, ...] = (None, None, None, None)

    def close(self) -> None:
        """Let go what belongs to the mesh: natives call the methods from now on."""
        self.record.words[:N_TOLD] = 0
        self.record.owned = ()
        self._held = (None, None, None, None)

    def open(self, mesh: Base) -> None:
        """Let the natives act on the mesh as it is now, if they may."""
        topology, column = mesh._topology, mesh.vertex_data._columns["points"]
        if self._held == (topology.lowered, column.lowered, column.policy, mesh.has_points) and self.record.owned:
            return
        if mesh._savepoints or topology.lowered is None or column.policy != "lerp":
            self.close()
            return
        points = column.__compiled__()
        if not topology_at.fits(topology.lowered) or not positions_at.fits(points):
            self.close()
            return
        views, catch_up = topology.__views__(), _catching_up(mesh._topology)
        self._held = (topology.lowered, points, column.policy, mesh.has_points)
        self.record.owned = (topology, column, views, catch_up, *self._held)
        words = self.record.words
        words[[TOPOLOGY, POINTS]] = int(topology.lowered), int(points)
        words[[IS_ONLY, HAS_POINTS]] = len(mesh.vertex_data._columns) == 1, mesh.has_points
        words[[CATCH_UP, VIEWS, OF_TOPOLOGY, OF_POINTS]] = id(catch_up), id(views), id(topology), id(column)
        words[[HELD_TOPOLOGY, HELD_POINTS, HELD_POLICY]] = id(topology.lowered), id(points), id(column.policy)


def _catching_up(topology: Topology) -> Callable[[], None]:
    owner = topology.owner

    def catch_up() -> None:
        mesh = owner()
        if mesh is not None:
            column = mesh.vertex_data._columns["points"]
            column.catch_up()
            topology.catch_up(compiled=True)
            mesh._follow((column,))

    return catch_up


def natively(
    native: Native, operation: Operation[Any, Any], mode: int = ACT, makes: tuple[int, int, int] = (0, 0, 0)
) -> Callable[[Callable[Concatenate[M, P], R]], Callable[Concatenate[M, P], R]]:
    """Declare that a method has a native, which the mesh gets once the method was called and its operation compiled.

    It needs room for so many vertices, edges and faces, which the method leaves to it.
    """

    def declare(method: Callable[Concatenate[M, P], R]) -> Callable[Concatenate[M, P], R]:
        @functools.wraps(method)
        def by_python(self: M, *args: P.args, **kwargs: P.kwargs) -> R:
            result = method(self, *args, **kwargs)
            if operation.quick is not None:
                offer(self, by_python)
            return result

        by_python.native = (native, mode, makes)  # type: ignore[attr-defined]
        return cast("Callable[Concatenate[M, P], R]", by_python)

    return declare


def offer(mesh: Base, method: Callable[..., Any]) -> None:
    """Open the desk of the mesh, and put its native in the place of the method, for this mesh."""
    name = method.__name__
    if mesh._desk is None:
        words = _of_process()
        if words is None:
            return
        mesh._desk = Desk(words)
    native, mode, makes = method.native  # type: ignore[attr-defined]
    if not mesh._savepoints:
        _make_room(mesh, makes)
    mesh._desk.open(mesh)
    if name not in mesh.__dict__ and getattr(type(mesh), name, None) is method:  # a subclass may have its own
        call = _calling(mesh._topology, method)
        record = Record.of([int(mesh._desk.record), id(call), mode], (mesh._desk.record, call))
        mesh.__dict__[name] = native.function(record, name, _documentation(method))


def _make_room(mesh: Base, makes: tuple[int, int, int]) -> None:
    """Have the next native not lack room. Columns grow by half, so that this costs O(1) a call, amortised."""
    t, counts = mesh._t, mesh._t.counts
    slots = counts[VERTEX_SLOTS], counts[EDGE_SLOTS], counts[FACE_SLOTS]
    room = len(t.vertex_halfedge), len(t.next) // 2, len(t.face_halfedge)
    more = [max(16, n // 2) if n + k > r else 0 for n, k, r in zip(slots, makes, room, strict=True)]
    if any(more):
        reserve(mesh, *more)
    mesh.vertex_data._columns["points"].reach(slots[0] + makes[0])


def _calling(topology: Topology, method: Callable[..., Any]) -> Callable[..., Any]:
    owner = topology.owner

    def by_python(*args: Any, **kwargs: Any) -> Any:
        mesh = owner()
        if mesh is None:
            raise StaleElementError(f"the mesh is gone whose {method.__name__} this was; keep a name for it")
        return method(mesh, *args, **kwargs)

    return by_python


@functools.cache
def _documentation(method: Callable[..., Any]) -> str:
    """The docstring, in the form in which a built-in function tells its signature too."""
    import inspect

    signature = inspect.signature(method)
    parameters = [p.replace(annotation=inspect.Parameter.empty) for p in signature.parameters.values()]
    plain = signature.replace(parameters=parameters, return_annotation=inspect.Signature.empty)
    return f"{method.__name__}{str(plain).replace('(self', '($self')}\n--\n\n{inspect.getdoc(method)}"
