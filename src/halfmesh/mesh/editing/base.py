"""What all methods that change a mesh share: elements to indices, the compiled act, refusals to exceptions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import numpy as np

from halfmesh._jit import Kernel, Operation, lowered
from halfmesh.core.statuses import DELETED_ELEMENT, MISSING_ELEMENT, REASONS
from halfmesh.core.topology import NEWS
from halfmesh.errors import ElementError, InvalidMeshError, StaleElementError, TopologyError
from halfmesh.mesh.asking import Asked
from halfmesh.mesh.elements import Edge, Element, Halfedge, Vertex
from halfmesh.mesh.positions import as_point

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike, NDArray

    from halfmesh.mesh.desk import Desk

__all__ = ["TABLES", "Base", "as_fraction"]

E = TypeVar("E", bound=Element)

TABLES = ("vertex_data", "halfedge_data", "edge_data", "face_data")
_ABOUT_AS_LONG_AS = 12  # elements: what an operator costs when it is interpreted, counted in steps of a loop


class Base(Asked):
    """The ways from a method to a kernel and back."""

    has_points: bool
    _savepoints: list[Any]
    _desk: Desk | None  # once an operator has a native here

    def _index(self, kind: type[Element], element: Any) -> int:
        """The index of a handle or an int. Whether there is such an element, alive, the kernel asks."""
        if type(element) is kind and element._t is self._t:
            return element.index
        if type(element) is int:
            return element
        return getattr(self, kind.plural).resolve(element)  # type: ignore[no-any-return]

    def _halfedge_index(self, element: Any) -> int:
        """The same for operators of an edge, that take a halfedge too: an edge or an int stands for its first."""
        if isinstance(element, Halfedge):
            return self._index(Halfedge, element)
        return 2 * self._index(Edge, element)

    def _living_halfedge(self, element: Any) -> int:
        if isinstance(element, Halfedge):
            return self._living(Halfedge, element)
        return 2 * self._living(Edge, element)

    def _halfedges(self, elements: Iterable[Any]) -> NDArray[np.int64]:
        """The indices of many of them, where an edge stands for its first; ints are halfedges."""
        indices = [2 * self._index(Edge, x) if isinstance(x, Edge) else self._index(Halfedge, x) for x in elements]
        try:
            return np.array(indices, dtype=np.int64)
        except OverflowError:
            return np.array([self._living(Halfedge, h) for h in indices])  # which raises for the first that is wrong

    def _living(self, kind: type[Element], element: Any) -> int:
        """The index of what is known to live: for questions, whose kernels do not ask that."""
        if type(element) is kind and element._t is self._t and element.is_alive:
            return element.index
        index: int = getattr(self, kind.plural).resolve(element)
        return index

    def _act(self, operation: Operation[Any, Any], *args: Any) -> int:
        """Run an operator: compiled by the shortest way there is, or interpreted until it has been called often."""
        quick, carrier = operation.quick, self._topology.lowered
        if quick is None or carrier is None:
            return self._act_slowly(operation, args)
        try:
            result: int = quick(carrier, *args)
        except OverflowError:  # no int64: there is no such element
            return -MISSING_ELEMENT
        if self._t.counts[NEWS]:
            self._catch_up()
        return result

    def _act_and_place(self, operation: Operation[Any, Any], args: tuple[Any, ...], point: ArrayLike | None) -> int:
        place = None if point is None else as_point(point)
        v = self._act(operation, *args)
        if place is not None and v >= 0:
            self.vertex_data.row("points", v)[:] = place
            self.has_points = True
        return v

    def _act_slowly(self, operation: Operation[Any, Any], args: tuple[Any, ...]) -> int:
        try:
            args = _cast(operation, args)
        except OverflowError:
            return -MISSING_ELEMENT
        run: Any = operation.at(_ABOUT_AS_LONG_AS)
        result: int = run(self, *args)
        if "compiled" in operation.__dict__:
            operation.quick = operation.entry(self._topology.__compiled__(), *map(lowered, args))
        return result

    def _run(self, kernel: Kernel[Any, Any], n_steps: int, *args: Any) -> int:
        """Run what is not one short act, but about so many steps of a loop."""
        try:
            args = _cast(kernel, args)
        except OverflowError:
            return -MISSING_ELEMENT
        run: Any = kernel.at(n_steps)
        result: int = run(self, *args)
        return result

    def _catch_up(self) -> None:
        """Columns were replaced by larger ones, or there are notes for the attributes."""
        self._topology.catch_up(compiled=True)
        self._follow()

    def _made(self, kind: type[E], index: int) -> E:
        handle: E = kind._empty()  # as `made`, whose call costs as much again
        handle._t = self._t
        handle.index = index
        return handle

    def _placed(self, v: int, place: NDArray[np.float64] | None) -> Vertex:
        """The vertex, put there."""
        if place is not None:
            self.vertex_data.row("points", v)[:] = place
            self.has_points = True
        return self._made(Vertex, v)

    def _refuse(self, doing: str, code: int, *elements: tuple[str, Any]) -> NoReturn:
        """Raise what the code of a refusal means; nothing was changed."""
        name, sentence = REASONS[abs(code)]
        about = ", ".join(f"{kind} {index}" for kind, index in elements)
        if abs(code) == MISSING_ELEMENT:
            raise ElementError(f"can't {doing} {about}: {sentence}")
        if abs(code) == DELETED_ELEMENT:
            raise StaleElementError(f"can't {doing} {about}: {sentence}")
        raise TopologyError(f"can't {doing} {about}: {sentence}", reason=name)

    def _follow(self, args: tuple[Any, ...] = ()) -> None:
        """What `Mesh` does: have the attributes follow the notes of a kernel."""
        raise NotImplementedError


def _as_int64(value: int) -> int:
    if not -(2**63) <= value < 2**63:
        raise OverflowError
    return value


_CASTS: dict[str, Any] = {"int": _as_int64, "bool": bool, "float": float}


def _cast(kernel: Kernel[Any, Any], args: tuple[Any, ...]) -> tuple[Any, ...]:
    """The arguments after the mesh, as the kernel declares them: it is compiled for these types and no others."""
    kinds = list(kernel.py_func.__annotations__.values())[1 : 1 + len(args)]
    return tuple(_CASTS[kind](a) if kind in _CASTS else a for kind, a in zip(kinds, args, strict=True))


def as_fraction(at: float) -> float:
    """A place on an edge: from 0 to 1."""
    if type(at) is float and 0.0 <= at <= 1.0:
        return at
    try:
        is_fraction = bool(0.0 <= at <= 1.0)  # which NaN is not
    except (TypeError, ValueError):  # no number, or several
        is_fraction = False
    if not is_fraction:
        raise InvalidMeshError(f"at={at!r} is no place on the edge: it runs from 0 to 1", reason="bad_parameter")
    return float(at)
