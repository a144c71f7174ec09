"""What the representations that are only read have in common: kernels take them as they take a mesh."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from halfmesh import _jit
from halfmesh.core import navigation
from halfmesh.core.navigation import (
    edge_of,
    edge_slots,
    face_of,
    face_slots,
    halfedge_of_edge,
    halfedge_of_face,
    halfedge_of_vertex,
    halfedge_slots,
    next_of,
    origin_of,
    prev_of,
    vertex_slots,
)
from halfmesh.core.topology import (
    EDGE_SLOTS,
    FACE_SLOTS,
    N_COUNTS,
    N_EXTERIOR,
    VERTEX_SLOTS,
    Topology,
    empty_columns,
)

__all__ = ["Computed", "ReadOnly", "counts_of", "rules_of", "views_class"]

Ints = NDArray[np.int32]


def rules_of(module: Any) -> dict[Any, Any]:
    """The rules that a module has its own kernels for: those of the same name."""
    own = {name: getattr(module, name) for name in module.__all__}
    return {getattr(navigation, name): kernel for name, kernel in own.items()}


def views_class(rules: Mapping[Any, Any]) -> type[_jit.Views]:
    """The interpreted carrier for which these rules are bound."""
    return type("BoundViews", (_jit.Views,), {"rules": rules})


def counts_of(n_vertices: int, n_edges: int, n_faces: int, n_exterior: int) -> NDArray[np.int64]:
    """The column ``counts`` of a mesh that never changes."""
    counts = np.zeros(N_COUNTS, dtype=np.int64)
    counts[[VERTEX_SLOTS, EDGE_SLOTS, FACE_SLOTS, N_EXTERIOR]] = n_vertices, n_edges, n_faces, n_exterior
    return counts


class Computed:
    """Columns that are not stored: each is made, as a whole, when it is asked for."""

    __slots__ = ()
    __views__: Callable[..., Any]

    @property
    def next(self) -> Ints:
        """The halfedge after each, around its face or boundary loop."""
        return self._column(next_of, halfedge_slots)

    @property
    def prev(self) -> Ints:
        """The halfedge before each."""
        return self._column(prev_of, halfedge_slots)

    @property
    def origin(self) -> Ints:
        """The vertex that each halfedge leaves."""
        return self._column(origin_of, halfedge_slots)

    @property
    def face(self) -> Ints:
        """The face of each halfedge, -1 outside."""
        return self._column(face_of, halfedge_slots)

    @property
    def vertex_halfedge(self) -> Ints:
        """A halfedge that leaves each vertex, an exterior one if there is any; -1 if isolated."""
        return self._column(halfedge_of_vertex, vertex_slots)

    @property
    def face_halfedge(self) -> Ints:
        """A halfedge of each face."""
        return self._column(halfedge_of_face, face_slots)

    def _column(self, rule: Callable[..., Any], slots: Callable[..., Any]) -> Ints:
        column: Ints = rule(self, np.arange(slots(self))).astype(np.int32)
        return column

    def expanded(self) -> Topology:
        """The same mesh in ordinary columns, with the same vertices, edges and faces. Complexity: O(n)."""
        h = np.arange(halfedge_slots(self))
        e = edge_of(self, h)
        new = (2 * e + (halfedge_of_edge(self, e) != h)).astype(np.int32)
        made = empty_columns(*(int(slots(self)) for slots in (vertex_slots, edge_slots, face_slots)))
        made.counts[N_EXTERIOR] = self.__views__().counts[N_EXTERIOR]
        if len(h):
            made.next[new], made.prev[new] = new[self.next], new[self.prev]
            made.origin[new], made.face[new] = self.origin, self.face
        leaving = self.vertex_halfedge
        made.vertex_halfedge[: len(leaving)] = np.where(leaving >= 0, np.append(new, -1)[leaving], -1)
        made.face_halfedge[: face_slots(self)] = new[self.face_halfedge]
        return Topology(made)


class ReadOnly(Computed):
    """Connectivity that is only read, held in arrays of its own under the words of `core.navigation`."""

    fields: ClassVar[tuple[str, ...]]
    carrier: ClassVar[_jit.CarrierType]
    views: ClassVar[type[_jit.Views]]

    def __init__(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        self.arrays = {name: arrays[name] for name in self.fields}
        self._views = self.views()
        for name, array in self.arrays.items():
            setattr(self._views, name, _jit.view(array))
        self._lowered: Any = None

    @property
    def nbytes(self) -> int:
        """Bytes that are held."""
        return sum(array.nbytes for array in self.arrays.values())

    def shared(self) -> Self:
        """Another carrier of the same arrays, for a mesh of its own."""
        made = object.__new__(type(self))
        made.__setstate__(self.__getstate__())
        return made

    # -- a carrier -----------------------------------------------------------------------------------------------

    def __views__(self) -> Any:
        return self._views

    def __arrays__(self) -> Any:
        return self

    def __compiled__(self) -> Any:
        if self._lowered is None:
            self._lowered = self.carrier.make(*self.arrays.values())
        return self._lowered

    def __getstate__(self) -> dict[str, Any]:
        return {"arrays": self.arrays}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["arrays"])  # type: ignore[misc]

    def __repr__(self) -> str:
        v, e, f = (slots(self) for slots in (vertex_slots, edge_slots, face_slots))
        return f"<{type(self).__name__}: {v} vertices, {e} edges, {f} faces>"
