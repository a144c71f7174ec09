"""``mesh.vertices``, ``mesh.halfedges``, ``mesh.edges``, ``mesh.faces``: one class, four kinds."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from halfmesh.core.navigation import edge_slots, face_slots, halfedge_slots, vertex_slots
from halfmesh.core.topology import DELETED
from halfmesh.errors import ElementError, StaleElementError
from halfmesh.mesh.elements import Element, made

if TYPE_CHECKING:
    from halfmesh.mesh.asking import Asked

__all__ = ["Collection"]

E = TypeVar("E", bound=Element)

_SLOTS = {
    "vertex": vertex_slots.plain,
    "halfedge": halfedge_slots.plain,
    "edge": edge_slots.plain,
    "face": face_slots.plain,
}
_PER_SLOT = {"vertex": 1, "halfedge": 1, "edge": 2, "face": 1}  # places in the marked column


class Collection(Generic[E]):
    """The living elements of one kind: iterate, ``len``, ``[index]``, ``in``.

    Indices count slots, so that an element keeps its index when others are deleted.
    """

    __slots__ = ("_kind", "_mesh")

    def __init__(self, mesh: Asked, kind: type[E]) -> None:
        self._mesh = mesh
        self._kind = kind

    @property
    def indices(self) -> NDArray[np.int64]:
        """The indices of the living elements, ascending."""
        t, kind = self._mesh._t, self._kind.kind
        if len(self) == (slots := _SLOTS[kind](t)):
            return np.arange(slots)
        marks = getattr(self._mesh.topology, self._kind.column)[:: _PER_SLOT[kind]]
        return np.flatnonzero(marks != DELETED)

    def __len__(self) -> int:
        n: int = getattr(self._mesh, f"n_{self._kind.plural}")
        return n

    def __iter__(self) -> Iterator[E]:
        for i in self.indices.tolist():
            yield self._made(i)

    def __getitem__(self, index: int) -> E:
        return self._made(self.resolve(index))

    def __contains__(self, element: object) -> bool:
        try:
            self.resolve(element)
        except (ElementError, StaleElementError):
            return False
        return True

    def resolve(self, element: Any) -> int:
        """The index of a handle or an int; raises unless it names a living element of this kind and mesh."""
        name = self._kind.kind
        if isinstance(element, Element):
            if not isinstance(element, self._kind):
                raise ElementError(f"expected a {name}, got {element!r}")
            element._check()  # which may lead it to the carrier of today
            if element._t is not self._mesh.topology.__views__():
                raise ElementError(f"{element!r} belongs to another mesh")
            return element.index
        if isinstance(element, bool | np.bool_) or not isinstance(element, int | np.integer):
            raise ElementError(f"expected a {name} or its index, got {element!r}")
        slots = _SLOTS[name](self._mesh._t)
        if not 0 <= element < slots:
            raise ElementError(
                f"no {name} {element}: indices run from 0 to {slots - 1}"
                if slots
                else f"there are no {self._kind.plural}"
            )
        self._made(int(element))._check()
        return int(element)

    def _made(self, index: int) -> E:
        return made(self._kind, self._mesh.topology.__views__(), index)

    def __repr__(self) -> str:
        return f"<{len(self)} {self._kind.kind} handles of {self._mesh!r}>"
