"""Stable ids: numbers of elements that survive compaction.

An index names a slot, and compaction moves slots. An id stays with its element as long as it lives, and is never given
to another one. Slots are filled in ascending order and compaction keeps the order, so ids ascend with indices: new
slots are numbered when somebody looks, and the way from an id to its index is a binary search. An edge gives its
halfedges theirs, ``2 * id`` and ``2 * id + 1``.
"""

from __future__ import annotations

from operator import index
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from halfmesh.mesh.elements import Edge, Element, Face, Halfedge, Vertex, made

if TYPE_CHECKING:
    from halfmesh.core.compaction import Maps
    from halfmesh.mesh.mesh import Mesh

__all__ = ["Ids", "Numbers"]

Numbering = NDArray[np.int64]
E = TypeVar("E", bound=Element)


class _Numbered:
    """The ids of one kind of element, by slot, as far as they were asked for."""

    def __init__(self) -> None:
        self.following = 0  # the next id; never lowered, so that no id is given twice
        self._ids: Numbering = np.empty(0, np.int64)
        self._n = 0

    def up_to(self, n: int) -> Numbering:
        """The ids of the first `n` slots. The new ones get the next numbers: amortised O(1) each."""
        if n > len(self._ids):
            ids = np.empty(max(n, 2 * self._n), np.int64)
            ids[: self._n] = self._ids[: self._n]
            self._ids = ids
        if n > self._n:
            self._ids[self._n : n] = np.arange(self.following, self.following + n - self._n)
            self.following += n - self._n
            self._n = n
        found = self._ids[:n]
        found.flags.writeable = False
        return found

    def take(self, ids: Numbering) -> None:
        """Have these from now on. What was handed out stays as it is, since they are never written into."""
        self._ids, self._n = ids, len(ids)

    def keep_first(self, n: int) -> None:
        """Forget the slots from `n` on, which were taken back; their ids are not given again."""
        if n < self._n:
            self.take(self._ids[:n])

    def copy(self) -> _Numbered:
        made = _Numbered()
        made.following = self.following
        made.take(self._ids[: self._n].copy())
        return made


class Numbers:
    """What a mesh holds, once ids were asked for: the ids of vertices, edges and faces."""

    def __init__(self) -> None:
        self.kinds = (_Numbered(), _Numbered(), _Numbered())

    def compacted(self, maps: Maps) -> None:
        """Keep the ids of the living, which move together."""
        for kind, new_of_old in zip(self.kinds, (maps.vertices, maps.edges, maps.faces), strict=True):
            kind.take(kind.up_to(len(new_of_old))[new_of_old >= 0])

    def state(self, sizes: tuple[int, ...]) -> tuple[Numbering, ...]:
        """The ids as they are, to be put back."""
        return tuple(kind.up_to(n) for kind, n in zip(self.kinds, sizes, strict=True))

    def put_back(self, state: tuple[Numbering, ...] | None, sizes: tuple[int, ...]) -> None:
        """Take the ids of an earlier state, if there is one, and forget what was taken back."""
        for place, (kind, n) in enumerate(zip(self.kinds, sizes, strict=True)):
            if state is not None:
                kind.take(state[place])
            kind.keep_first(n)

    def copy(self) -> Numbers:
        """An independent copy."""
        made = Numbers()
        made.kinds = tuple(kind.copy() for kind in self.kinds)  # type: ignore[assignment]
        return made


class Ids:
    """The stable ids of a mesh: ``mesh.ids``.

    Elements have ids from when they are first asked for, which are their indices at that time; whoever does not ask
    pays nothing. Elements that are made later have the next numbers. An id is never given twice, be it that its element
    was deleted, or made in a transaction that was rolled back. Copies of the mesh have the same ids.

    Examples
    --------
    >>> import halfmesh as hm
    >>> mesh = hm.shapes.icosphere(1)
    >>> name = mesh.ids.of(mesh.vertices[20])
    >>> mesh.remove_vertex(3)
    >>> maps = mesh.compact()
    >>> mesh.ids.find_vertex(name)
    Vertex(19)
    >>> mesh.ids.find_vertex(3) is None
    True
    """

    __slots__ = ("_mesh",)

    def __init__(self, mesh: Mesh) -> None:
        self._mesh = mesh

    @property
    def vertices(self) -> Numbering:
        """The id of each vertex, by index: ascending, so ``np.searchsorted`` finds many at once. Read-only."""
        return self._of_kind(0)

    @property
    def halfedges(self) -> Numbering:
        """The id of each halfedge: twice that of its edge, plus one for the second."""
        made = np.repeat(2 * self.edges, 2)
        made[1::2] += 1
        made.flags.writeable = False
        return made

    @property
    def edges(self) -> Numbering:
        """The id of each edge, by index, ascending. Read-only."""
        return self._of_kind(1)

    @property
    def faces(self) -> Numbering:
        """The id of each face, by index, ascending. Read-only."""
        return self._of_kind(2)

    def of(self, element: Element) -> int:
        """The id of an element.

        Raises
        ------
        StaleElementError, ElementError
            It was deleted, or is of another mesh.
        TypeError
            It is no handle.
        """
        if not isinstance(element, Element):
            raise TypeError(
                f"a handle has an id, {element!r} has none; by index they are in mesh.ids.vertices and its like"
            )
        index: int = getattr(self._mesh, element.plural).resolve(element)
        if isinstance(element, Halfedge):
            return 2 * int(self.edges[index >> 1]) + (index & 1)
        return int(getattr(self, element.plural)[index])

    def find_vertex(self, id: int) -> Vertex | None:
        """The vertex of this id, or None if it was deleted or never was. O(log n)."""
        return self._living(Vertex, self._index(self.vertices, id))

    def find_halfedge(self, id: int) -> Halfedge | None:
        """The halfedge of this id, or None if it was deleted or never was. O(log n)."""
        e = self._index(self.edges, index(id) >> 1)
        return self._living(Halfedge, -1 if e < 0 else 2 * e + (id & 1))

    def find_edge(self, id: int) -> Edge | None:
        """The edge of this id, or None if it was deleted or never was. O(log n)."""
        return self._living(Edge, self._index(self.edges, id))

    def find_face(self, id: int) -> Face | None:
        """The face of this id, or None if it was deleted or never was. O(log n)."""
        return self._living(Face, self._index(self.faces, id))

    def _of_kind(self, place: int) -> Numbering:
        kind = self._mesh._numbering().kinds[place]
        return kind.up_to(self._mesh._t.counts[place])

    @staticmethod
    def _index(ids: Numbering, id: int) -> int:
        place = int(np.searchsorted(ids, index(id)))
        return place if place < len(ids) and ids[place] == id else -1

    def _living(self, kind: type[E], index: int) -> E | None:
        if index < 0:
            return None
        handle = made(kind, self._mesh._t, index)
        return handle if handle.is_alive else None

    def __repr__(self) -> str:
        return f"<ids of {self._mesh!r}>"
